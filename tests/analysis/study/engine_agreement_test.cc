// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/engine_agreement.h"

#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "analysis/metrics/registry.h"
#include "analysis/report/plain_text.h"
#include "analysis/report/report.h"
#include "tests/support/robots.h"

namespace scoria::analysis {
namespace {

constexpr double kMetres = 50.0;

/// Falls of an arm in an engine on a seed.
using Falls = std::function<int(const std::string& arm, const std::string& engine, int seed)>;

/// Two arms on two grounds, 8 seeds each, in both engines. In bullet the height RMSE is 1 mm more,
/// the roll RMSE by chance as often less as more.
CampaignResults Walked(const Falls& falls) {
  CampaignResults results;
  results.name = "engines";
  results.arms = {"ags", "sgs"};
  results.axes = {{"terrain.roughness_scale", "roughness", {"1", "2"}, ""},
                  {"physics.engine.type", "engine", {"scoria", "bullet"}, ""}};
  for (const auto& point : AllPoints(results.axes)) {
    for (const std::string& arm : results.arms) {
      for (int seed = 1; seed <= 8; ++seed) {
        EpisodeRecord& e = results.episodes.emplace_back();
        e.id = fmt::format("{}-{}-{}-s{}", arm, point[0], point[1], seed);
        e.arm = arm;
        e.point = point;
        e.engine = point[1];
        e.seed = static_cast<std::uint64_t>(seed);
        e.ground = fmt::format("{}/{}", point[0], seed);
        e.end = "completed";
        e.has_metrics = true;
        e.metrics.outcome.emplace();
        e.metrics.outcome->falls = falls(arm, point[1], seed);
        e.metrics.distance_m = kMetres;
        e.metrics.tracking.samples_s = 10.0;
        const bool bullet = point[1] == "bullet";
        e.metrics.tracking.height_rmse_m = 0.010 + (bullet ? 0.001 + 1e-5 * seed : 0.0);
        e.metrics.tracking.roll_rmse_rad =
            0.010 + (bullet ? 0.001 * (seed % 2 == 0 ? 1 : -1) : 0.0);
      }
    }
  }
  return results;
}

EngineAgreement Compared(const Falls& falls) {
  return *CompareEngines(Walked(falls), AllMetrics());
}

TEST(EngineAgreement, PairsEnginesByArmSeedAndPoint) {
  const EngineAgreement all = Compared([](const std::string& arm, const std::string& engine, int) {
    return (arm == "ags" ? 1 : 2) * (engine == "bullet" ? 2 : 1);
  });
  EXPECT_EQ(all.engine, "bullet");
  EXPECT_EQ(all.reference, "scoria");
  ASSERT_EQ(all.axes.size(), 1u);
  EXPECT_EQ(all.axes[0].label, "roughness");
  ASSERT_EQ(all.arms.size(), 6u) << "two arms, over the sweep and at two points";
  const ArmInEngines& ags = all.arms[0];
  EXPECT_EQ(ags.arm, "ags");
  EXPECT_TRUE(ags.point.empty());
  EXPECT_EQ(ags.falls.falls_a.events, 32);
  EXPECT_EQ(ags.falls.falls_b.events, 16);
  EXPECT_EQ(ags.falls.falls_b.exposure, 16 * kMetres);
  const MetricDifference* height = ags.metrics.Find("height_rmse_m");
  ASSERT_NE(height, nullptr);
  EXPECT_NEAR(height->pairs.difference.mean, 0.001045, 1e-9);
  EXPECT_EQ(all.arms[2].point, (std::vector<std::string>{"2"}));
  EXPECT_EQ(all.arms[2].falls.falls_a.events, 16);
}

TEST(EngineAgreement, BaselineOfTheAxisIsTheReference) {
  CampaignResults results = Walked([](const std::string&, const std::string&, int) { return 1; });
  results.axes[1].baseline = "bullet";
  const EngineAgreement all = *CompareEngines(results, AllMetrics());
  EXPECT_EQ(all.reference, "bullet");
  EXPECT_NEAR(all.arms[0].metrics.Find("height_rmse_m")->pairs.difference.mean, -0.001045, 1e-9);
  results.axes[1].values.pop_back();
  EXPECT_FALSE(CompareEngines(results, AllMetrics()));
  results.axes.pop_back();
  EXPECT_FALSE(CompareEngines(results, AllMetrics()));
}

TEST(EngineAgreement, SentencesSayWhatIsShown) {
  const EngineAgreement all = Compared([](const std::string& arm, const std::string& engine, int) {
    return arm == "ags" && engine == "bullet" ? 3 : 1;
  });
  EXPECT_EQ(FallsInEngines(all, all.arms[0])
                .find("ags falls more in bullet than in scoria: 48 in "
                      "800 m and 16 in 800 m, rate ratio 3.00 (95 %: "),
            0u)
      << FallsInEngines(all, all.arms[0]);
  EXPECT_EQ(FallsInEngines(all, all.arms[3])
                .find("That sgs falls more or less in bullet than in "
                      "scoria is not shown: 16 in 800 m and 16"),
            0u)
      << FallsInEngines(all, all.arms[3]);
  EXPECT_EQ(MetricInEngines(all, all.arms[0], "height_rmse_m"),
            "height RMSE [mm] of ags is larger in bullet: 11.0 in bullet, 10.0 in scoria, "
            "difference +1.0 (95 %: +1.0 to +1.1).");
  EXPECT_EQ(MetricInEngines(all, all.arms[0], "roll_rmse_rad")
                .find("roll RMSE [deg] of ags: no difference is shown, "),
            0u)
      << MetricInEngines(all, all.arms[0], "roll_rmse_rad");
  EXPECT_EQ(MetricInEngines(all, all.arms[0], "cot_mech_abs"), "") << "nobody has it";
  const EngineAgreement none =
      Compared([](const std::string&, const std::string&, int) { return 0; });
  EXPECT_EQ(FallsInEngines(none, none.arms[0]), "ags fell in neither engine.");
}

TEST(EngineAgreement, VerdictOnArmsDependsOnTheEngineOrNot) {
  const auto verdict = [](const Falls& falls) {
    const EngineAgreement all = Compared(falls);
    EXPECT_EQ(all.verdicts.size(), 3u);
    return VerdictsInEngines(all, all.verdicts[0]);
  };
  const auto begins = [](const std::string& text, const std::string& start) {
    return text.compare(0, start.size(), start) == 0;
  };
  using S = const std::string&;
  const std::string turned =
      verdict([](S arm, S engine, int) { return (arm == "ags") == (engine == "bullet") ? 4 : 1; });
  EXPECT_TRUE(
      begins(turned, "The verdict on ags and sgs depends on the engine: rate ratio 0.25 (95 %: "))
      << turned;
  EXPECT_NE(turned.find("in scoria, 4.00 (95 %: "), std::string::npos) << turned;
  EXPECT_NE(turned.find("in bullet; ratio of the two 16.00 (95 %: "), std::string::npos) << turned;
  const std::string same = verdict([](S arm, S, int) { return arm == "ags" ? 4 : 1; });
  EXPECT_TRUE(begins(
      same, "Both engines show that ags falls more than sgs; that they differ is not shown: "))
      << same;
  const std::string none = verdict([](S, S, int) { return 1; });
  EXPECT_TRUE(
      begins(none,
             "In neither engine a difference in falls between ags and sgs is shown, nor that "
             "the engines differ: "))
      << none;
  const std::string one = verdict([](S arm, S engine, int seed) {
    if (arm == "ags" && engine == "scoria") return 2;
    return arm == "ags" && seed % 2 == 0 ? 2 : 1;
  });
  EXPECT_TRUE(begins(one,
                     "That ags falls more than sgs is shown in scoria alone; that the engines "
                     "differ is not: "))
      << one;
  const std::string nothing = verdict([](S, S engine, int) { return engine == "bullet" ? 1 : 0; });
  EXPECT_TRUE(
      begins(nothing, "Whether the verdict on ags and sgs depends on the engine is unknown"))
      << nothing;
}

TEST(EngineAgreement, ReportHasItsSectionWhereTheEngineIsSwept) {
  const test::TemporaryFolder folder;
  CampaignResults results =
      Walked([](const std::string& arm, const std::string&, int) { return arm == "ags" ? 4 : 1; });
  const auto compose = [&] {
    return ComposeReport(MakeReportInput(folder.path(), results, std::nullopt));
  };
  const std::string text = ToPlainText(compose());
  for (const char* expected :
       {"64 episodes in bullet and scoria", "The same in both engines?",
        "Both engines show that ags falls more than sgs; that they differ is not shown: ",
        "height RMSE [mm] of sgs is larger in bullet: ", "bullet minus scoria, at each point"})
    EXPECT_NE(text.find(expected), std::string::npos) << expected;
  results.axes[1].key = "terrain.friction_scale";
  const std::string other = ToPlainText(compose());
  EXPECT_NE(other.find("The same in both engines?, because the physics engine was not swept."),
            std::string::npos);
}

}  // namespace
}  // namespace scoria::analysis
