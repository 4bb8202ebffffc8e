// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/report.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/metrics/bias_budget.h"
#include "analysis/report/sections/model_course.h"
#include "analysis/study/adaptation.h"
#include "analysis/study/compare.h"
#include "analysis/study/fall_groups.h"
#include "analysis/terrain/terrain_view.h"
#include "core/files.h"
#include "tests/support/robots.h"
#include "tests/support/rows.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;

using Spoil = std::function<void(const std::string& arm, int seed, EpisodeMetrics& m)>;

/// A campaign folder as `scoria campaign` leaves it, with made-up results: arm b falls often, one
/// episode of c crashed.
void WriteCampaign(const fs::path& folder, const EstimationMetrics& estimation = {},
                   const Spoil& spoil = nullptr) {
  nlohmann::json index = {
      {"name", "made <up>"},
      {"arms", {"a", "b"}},
      {"episodes", nlohmann::json::array()},
      {"sweep", {{{"key", "speed_mps"}, {"label", "speed [m/s]"}, {"values", {"0.3", "0.6"}}}}}};
  for (const char* arm : {"a", "b"}) {
    for (const char* speed : {"0.3", "0.6"}) {
      for (int seed = 1; seed <= 3; ++seed) {
        const std::string id = fmt::format("{}-{}-s{}", arm, speed, seed);
        index["episodes"].push_back({{"id", id}, {"arm", arm}, {"point", {speed}}, {"seed", seed}});
        fs::create_directories(folder / "episodes" / id);
        EpisodeMetrics m;
        m.distance_m = 50.0;
        m.mass_kg = 15.0;
        m.energy = {500.0, 300.0, 2000.0};
        m.cot = {.mech_abs = 0.5, .electrical = 2.0};
        m.mpc = m.wbc = {1e-4, 2e-4, 3e-4, 1000};
        for (int k = 0; k < 10; ++k)
          m.windows.push_back(
              {std::stod(speed) + 0.002 * k, std::stod(speed), 0.5 + 0.01 * k, 0.3, 2.0});
        m.tracking = {.samples_s = 10.0,
                      .velocity_rmse_mps = 0.02,
                      .height_rmse_m = 0.003,
                      .roll_rmse_rad = 0.01,
                      .pitch_rmse_rad = 0.01};
        m.estimation = estimation;
        const int falls = *arm == 'b' ? 6 : 0;
        for (int k = 0; k < falls; ++k) m.falls.push_back({1.0 * k, "tilt at x 0 m"});
        const nlohmann::json counters = {{"early_contact", 1}, {"mpc_failure", 0}};
        const nlohmann::json terrain = ToJson(
            {.nu_1m_m = 0.07, .hurst = 0.6, .slope_mean_rad = 0.2, .materials = {{"tuff", 1.0}}});
        nlohmann::json result = {{"end", "completed"},
                                 {"falls", falls},
                                 {"stuck", 0},
                                 {"walked_m", 50.0},
                                 {"real_time_factor", 15.0},
                                 {"us_per_step", {{"MPC", 5.0}, {"physics", 15.0}}},
                                 {"counters", counters},
                                 {"terrain", terrain}};
        if (spoil) spoil(arm, seed, m);
        result["metrics"] = m;
        if (id == "a-0.6-s3") result = {{"end", "crashed"}, {"message", "signal 11"}};
        std::ofstream(folder / "episodes" / id / "result.json") << result.dump();
      }
    }
  }
  std::ofstream(folder / "campaign.json") << index.dump();
}

/// Of an estimator that drifts by 2 % and a sensor that is 6 ms late and sometimes distrusted.
EstimationMetrics DriftingEstimation() {
  EstimationAccumulator e;
  for (int i = 0; i < 25000; ++i) {
    logs::Row row = test::WholeRow();
    row.episode->operating = true;
    row.time_s = 0.002 * i;
    row.truth->p_WB_m = {0.001 * i, 0.0, 0.3};
    row.estimate->p_WB_m = {0.00102 * i, 0.0, 0.3};
    row.estimate->v_WB_mps[1] += 0.1;
    row.estimate->P_tilt_v = {1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.001};
    row.estimate->P_tilt_v->back() = 1.0;
    const auto stance = [](int at) { return at >= 0 && (at / 100) % 2 == 1; };
    row.true_contacts->contact.fill(stance(i));
    row.plan->stance.fill(stance(i + 5));
    row.contacts->sensor->contact.fill(stance(i - 3));
    row.contacts->contact = row.contacts->sensor->contact;
    row.contacts->source->fill(2);
    row.contacts->sensor->healthy.fill(i % 1000 > 50);
    row.contacts->sensor->counts.fill(stance(i) ? 20.0 + i % 50 : i % 30);
    row.contacts->observer->probability.fill(stance(i) ? 0.6 + 0.01 * (i % 30) : 0.01 * (i % 70));
    row.contacts->observer->contact.fill(row.contacts->observer->probability[0] > 0.5);
    e.AddRow(row);
  }
  return e.Finish();
}

TEST(Compare, VerdictNamesWhoFallsLessWithItsInterval) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path());
  const CampaignResults results = LoadResults(folder.path());
  const Comparison c = Compare(results, "a", "b", {"0.3"});
  EXPECT_EQ(c.falls_a.events, 0);
  EXPECT_EQ(c.falls_b.events, 18);
  EXPECT_LT(c.rates.judged.interval.high, 1.0);
  EXPECT_EQ(c.verdict.find("speed [m/s] 0.3: a falls less than b: a fell 0 times in 150 m, b 18 "
                           "times in 150 m, rate ratio 0.00"),
            0u)
      << c.verdict;
  EXPECT_EQ(PoolCell(results, "a", {"0.6"}).broken, 1);
}

// An episode that hardly walked adds its energy and its way, not its energy alone.
TEST(Compare, PooledCostCountsEnergyAndWayOfTheSameEpisodes) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path(), {}, [](const std::string&, int seed, EpisodeMetrics& m) {
    m.distance_m = seed == 1 ? 0.5 : 50.0;
    m.transport_J = 150.0 * m.distance_m;
    m.energy.mech_abs_J = 75.0 * m.distance_m;
    if (seed == 1) m.cot.reset();
  });
  EXPECT_NEAR(PoolCell(LoadResults(folder.path()), "a", {"0.3"}).values.at("cot_mech_abs"), 0.5,
              1e-12);
}

TEST(FallGroups, AreFallsWithinAMetreOnOneGround) {
  CampaignResults results;
  results.arms = {"a", "b"};
  const auto walk = [&](const std::string& arm, const std::string& ground,
                        const std::vector<Vec2>& places) {
    EpisodeRecord e;
    e.arm = arm;
    e.ground = ground;
    e.has_metrics = true;
    for (const Vec2& p : places) e.metrics.falls.push_back({1.0, "tilt", p});
    results.episodes.push_back(e);
  };
  walk("a", "g1", {{0.0, 0.0}, {0.9, 0.0}, {1.8, 0.0}, {5.0, 0.0}});  // a chain is one place
  walk("b", "g1", {{0.5, 0.5}, {0.4, 0.4}});
  walk("b", "g2", {{0.0, 0.0}});
  walk("b", "g3", {});
  const std::vector<FallGroup> groups = GroupFalls(results);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].size(), 5u);
  EXPECT_EQ(DescribeGroups(groups, CountGrounds(results, {"a", "b"}, {})),
            "the 7 falls lie at 3 places, on 2 of 3 grounds; one place makes 5 of them");
  EXPECT_EQ(GroupFalls(results, {"a"}).size(), 2u);
  EXPECT_EQ(DescribeGroups({}, 3), "");
}

TEST(Report, BeginsWithVerdictBudgetPlacesAndPicture) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path(), {}, [](const std::string&, int, EpisodeMetrics& m) {
    for (FallEvent& fall : m.falls) fall.p_WB = Vec2(1.0, 2.0);
  });
  const std::string html =
      core::ReadText(WriteReport(folder.path(), ReportPicture{"\xff\xd8", "The first fall"}));
  const std::string head = html.substr(0, html.find("at each point</h2>"));
  for (const char* part :
       {"Whole sweep: a falls less than b", "<th>metres walked</th>",
        "Smallest effect that this budget sees: a rate ratio of",
        "The 36 falls lie at 3 places, on 3 of 3 grounds", "data:image/jpeg;base64,/9g="})
    EXPECT_NE(head.find(part), std::string::npos) << part;
}

TEST(Report, IsSelfContainedAndShowsFailures) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path());
  const fs::path page = WriteReport(folder.path());
  std::ifstream in(page);
  std::stringstream text;
  text << in.rdbuf();
  const std::string html = text.str();
  EXPECT_NE(html.find("made &lt;up&gt;"), std::string::npos);
  EXPECT_NE(html.find("signal 11"), std::string::npos);
  EXPECT_NE(html.find("a falls less than b"), std::string::npos);
  EXPECT_EQ(html.find("src=\"http"), std::string::npos);
  EXPECT_EQ(html.find("<img"), std::string::npos);
  int drawings = 0;
  for (std::size_t at = 0; (at = html.find("<svg", at)) != std::string::npos; ++at) ++drawings;
  EXPECT_GE(drawings, 5);
  for (const char* name :
       {"falls_speed_mps", "cot_mech_abs", "cot_electrical", "tracking", "solve_times"}) {
    for (const char* extension : {".gp", ".svg", ".png", ".pdf"}) {
      EXPECT_TRUE(fs::exists(page.parent_path() / "figures" / (std::string(name) + extension)))
          << name << extension;
    }
  }
  EXPECT_TRUE(fs::exists(page.parent_path() / "metrics.csv"));
  EXPECT_NE(core::ReadText(page.parent_path() / "report.txt").find("a-0.6-s3  crashed  signal 11"),
            std::string::npos);
}

TEST(Report, ShowsEstimationAndContactDetection) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path(), DriftingEstimation());
  const fs::path page = WriteReport(folder.path());
  const std::string html = core::ReadText(page);
  EXPECT_NE(html.find(">State estimation</h2>"), std::string::npos);
  EXPECT_NE(html.find("<td>3</td><td>2.00</td><td>0.00</td><td>0.000</td>"), std::string::npos);
  EXPECT_NE(html.find(">Contact detection</h2>"), std::string::npos);
  EXPECT_NE(html.find("<td>6 / 6</td>"), std::string::npos);
  EXPECT_NE(html.find("<td>momentum observer</td>"), std::string::npos);
  EXPECT_NE(html.find("sensor distrusted"), std::string::npos);
  for (const char* extension : {".gp", ".svg", ".png", ".pdf"})
    EXPECT_TRUE(
        fs::exists(page.parent_path() / "figures" / (std::string("contact_roc") + extension)));
  const std::string csv = core::ReadText(page.parent_path() / "metrics.csv");
  const std::string header = csv.substr(0, csv.find('\n'));
  const std::string line =
      csv.substr(header.size() + 1, csv.find('\n', header.size() + 1) - header.size() - 1);
  EXPECT_NE(header.find(",drift_horizontal_pct,"), std::string::npos);
  EXPECT_EQ(std::count(header.begin(), header.end(), ','),
            std::count(line.begin(), line.end(), ','));
  const auto json = nlohmann::json::parse(core::ReadText(page.parent_path() / "metrics.json"));
  EXPECT_NEAR(json.at("cells").at(0).at("estimation").at("nees_ratio").get<double>(), 2.0, 1e-12);
}

/// Arm b learned a payload of 3 kg and holds its height and attitude better than a.
void Adapt(const std::string& arm, int seed, EpisodeMetrics& m) {
  m.tracking = {.samples_s = 10.0,
                .height_rmse_m = 0.010 + 0.001 * seed,
                .roll_rmse_rad = 0.02,
                .pitch_rmse_rad = 0.03};
  m.model.intervals = {{.duration_s = 10.0, .mass_kg = 15.0, .used_rows = 5000},
                       {.start_s = 10.0,
                        .duration_s = 10.0,
                        .mass_kg = 18.0,
                        .step_kg = 3.0,
                        .used_rows = 5000,
                        .used_bias_kg = -3.0}};
  if (arm == "a") return;
  *m.tracking.height_rmse_m -= 0.004 + 0.001 * (seed - 2);
  m.model.present = true;
  for (ModelInterval& i : m.model.intervals) {
    i.rows = 5000;
    i.settled = true;
    i.settling_s = 1.5;
    i.bias_kg = -0.05 * seed;
    i.rmse_kg = 0.2;
    i.com_x_rmse_m = 0.003;
    i.com_y_rmse_m = 0.002;
    i.used_bias_kg = -0.1;
  }
}

TEST(Report, ShowsModelAdaptation) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path(), {}, Adapt);
  const fs::path page = WriteReport(folder.path());
  const std::string html = core::ReadText(page);
  EXPECT_NE(html.find(">Online model adaptation</h2>"), std::string::npos);
  EXPECT_NE(html.find("<td>b</td><td>2</td><td>18.00</td><td>3</td><td>3 / 3</td><td>0.100</td>"
                      "<td>0.145</td><td>0.200</td><td>1.50</td><td>3.0</td><td>2.0</td>"
                      "<td>100</td>"),
            std::string::npos);
  EXPECT_NE(html.find("<td>b</td><td>all</td><td>15.00 to 18.00</td><td>3</td>"),
            std::string::npos);
  EXPECT_NE(html.find(">Tracking with and without adaptation</h2>"), std::string::npos);
  EXPECT_NE(html.find("<td>b against a</td>"), std::string::npos);
  const std::string csv = core::ReadText(page.parent_path() / "metrics.csv");
  EXPECT_NE(csv.substr(0, csv.find('\n')).find(",model_bias_median_kg,"), std::string::npos);
  const auto json = nlohmann::json::parse(core::ReadText(page.parent_path() / "metrics.json"));
  const auto& a = json.at("cells").at(0).at("model");
  EXPECT_TRUE(a.at("model_bias_median_kg").is_null());
  EXPECT_NEAR(a.at("model_used_bias_median_kg").get<double>(), 1.5, 1e-12);
  const auto& b = json.at("cells").at(1).at("model");
  EXPECT_NEAR(b.at("model_bias_median_kg").get<double>(), 0.1, 1e-12);
}

/// Arm b reads too much, more so at 0.6 m/s, and from seed to seed; a late row for each interval.
void Misread(const std::string& arm, int seed, EpisodeMetrics& m) {
  Adapt(arm, seed, m);
  if (arm == "a") return;
  const bool fast = m.windows.front().command_mps > 0.5;
  ModelInterval& added = m.model.intervals[1];
  added.late_rows = 100;
  added.late_bias_kg = 0.1 * seed + (fast ? 0.3 + 0.01 * seed : 0.0);
  added.late_noise_kg = 0.05;
  ModelInterval removed = added;
  removed.step_kg = -3.0;
  removed.late_bias_kg -= 0.1;
  m.model.intervals.push_back(removed);
}

TEST(BiasBudget, ComparesWithTheBaselineBySeed) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path(), {}, Misread);
  EXPECT_TRUE(CalcBiasBudget(LoadResults(folder.path())).empty()) << "no axis has a baseline";
  nlohmann::json index = nlohmann::json::parse(core::ReadText(folder.path() / "campaign.json"));
  index["sweep"][0]["baseline"] = "0.3";
  core::WriteText(folder.path() / "campaign.json", index.dump());
  const std::vector<BiasLine> lines = CalcBiasBudget(LoadResults(folder.path()));
  ASSERT_EQ(lines.size(), 2u) << "a did not learn";
  EXPECT_TRUE(lines[0].baseline);
  EXPECT_NEAR(lines[0].bias_kg.mean, 0.15, 1e-12);
  EXPECT_NEAR(lines[0].bias_kg.deviation, 0.1, 1e-12);
  EXPECT_NEAR(lines[0].added_kg.mean, 0.2, 1e-12);
  EXPECT_NEAR(lines[0].removed_kg.mean, 0.1, 1e-12);
  EXPECT_NEAR(lines[0].noise_kg.mean, 0.05, 1e-12);
  EXPECT_NEAR(lines[1].change_kg.mean, 0.32, 1e-12);
  // Differences of 0.31, 0.32 and 0.33 kg.
  EXPECT_NEAR(lines[1].change_kg.interval.high, 0.32 + 0.01 * 2.484, 1e-5);
  const std::string html = core::ReadText(WriteReport(folder.path()));
  EXPECT_NE(html.find("<td>0.3</td><td>b</td><td>3</td><td>+0.15 ± 0.10</td><td>baseline</td>"),
            std::string::npos);
  EXPECT_NE(html.find("<td>+0.32 (95 %: +0.30 to +0.34)</td>"), std::string::npos);
}

TEST(Report, PairsTrackingBySeed) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path(), {}, Adapt);
  const auto all = CompareWithUnadapted(LoadResults(folder.path()), AllMetrics());
  ASSERT_EQ(all.size(), 3u);  // pooled, then two points
  EXPECT_EQ(all[0].arm, "b");
  EXPECT_EQ(all[0].baseline, "a");
  const MeanEstimate height_m = all[0].Find("height_rmse_m")->pairs.difference;
  EXPECT_EQ(height_m.count, 3u);
  EXPECT_NEAR(height_m.mean, -0.004, 1e-12);
  // Differences of -3, -4 and -5 mm.
  EXPECT_NEAR(height_m.interval.high, -0.004 + 0.001 * 2.484, 1e-5);
  EXPECT_EQ(all[2].Find("height_rmse_m")->pairs.difference.count, 2u);  // one episode of a crashed
}

/// The course of two payloads, the second taken away gradually.
TEST(Report, DrawsTheCourseOfTheLearnedMass) {
  logs::LogContent log;
  for (int i = 0; i < 3000; ++i) {
    logs::Row row = test::WholeRow();
    row.time_s = 0.01 * i;
    row.episode->operating = true;
    row.model->learned->tared = i > 200;
    const double left = std::clamp((2500.0 - i) / 500.0, 0.0, 1.0);
    row.true_mass->mass_kg = 15.0 + (i > 1000 ? 2.5 * left : 0.0);
    row.model->learned->mass_kg = row.model->used_mass_kg = row.true_mass->mass_kg;
    row.model->learned->sigma_kg = 0.1;
    log.rows.push_back(row);
  }
  const test::TemporaryFolder folder;
  const CaptionedFigure f = ModelCourse(log, "made_up");
  f.figure.Render(folder.path());
  for (const char* extension : {".gp", ".svg", ".png", ".pdf"})
    EXPECT_TRUE(fs::exists(folder.path() / (std::string("model_made_up") + extension)));
  const std::string script = core::ReadText(folder.path() / "model_made_up.gp");
  EXPECT_NE(script.find("rect from 10.01,graph 0 to 20.01,graph 1"), std::string::npos);
}

TEST(Report, MissingFolderIsNamed) {
  try {
    (void)WriteReport("/nonexistent/results");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_EQ(std::string(e.what()),
              "/nonexistent/results: holds neither campaign.json nor result.json");
  }
}

}  // namespace
}  // namespace scoria::analysis
