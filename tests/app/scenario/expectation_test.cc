// SPDX-License-Identifier: BSD-3-Clause
#include "app/scenario/expectation.h"

#include <fstream>
#include <regex>

#include <gtest/gtest.h>

#include "analysis/metrics/registry.h"
#include "app/episode/event_kinds.h"
#include "app/scenario/observable.h"
#include "app/scenario/scenario.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

Expectations Read(const std::string& expect) {
  return test::LoadScenario("flat", {"expect=" + expect}).expect;
}

std::string ErrorOf(const std::string& expect) {
  try {
    (void)Read(expect);
  } catch (const core::ConfigError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Expectation, ShortAndLongFormsMeanTheSame) {
  EXPECT_EQ(Read("{falls: 0}"), Read("{falls: {equals: 0}}"));
  EXPECT_EQ(Read("{falls: [0, 2]}"), Read("{falls: {between: [0, 2]}}"));
  const Expectations e = Read("{tracking.height_rmse_mm: {max: 12}, supervisor.contact: {min: 1}}");
  EXPECT_EQ(e.at("tracking.height_rmse_mm").max, 12.0);
  EXPECT_EQ(e.at("supervisor.contact").min, 1.0);
}

TEST(Expectation, SurvivesTheEffectiveScenario) {
  const Scenario scenario = test::LoadScenario("flat", {"expect={falls: 0, stuck: [0, 1]}"});
  const auto again =
      core::ReadConfig<Scenario>(core::ParseConfig(EffectiveYaml(scenario), "effective.yaml"));
  EXPECT_EQ(again.expect, scenario.expect);
}

TEST(Expectation, ErrorsNameKeyAndRule) {
  const std::string at = "--set expect=";
  EXPECT_EQ(ErrorOf("{fals: 0}"),
            at + "{fals: 0}: expect.fals: unknown key (did you mean \"falls\"?)");
  EXPECT_EQ(ErrorOf("{tracking.hight_rmse_mm: 1}"),
            at + "{tracking.hight_rmse_mm: 1}: expect.tracking.hight_rmse_mm: unknown key (did you "
                 "mean \"tracking.height_rmse_mm\"?)");
  EXPECT_EQ(ErrorOf("{falls: {}}"),
            at + "{falls: {}}: expect.falls: needs equals, between, min or max");
  EXPECT_EQ(ErrorOf("{falls: {equals: 1, min: 0}}"),
            at + "{falls: {equals: 1, min: 0}}: expect.falls: equals, between, and min with max "
                 "stand in place of each other");
  EXPECT_EQ(ErrorOf("{falls: {min: 2, max: 1}}"),
            at + "{falls: {min: 2, max: 1}}: expect.falls: min 2 is above max 1");
  EXPECT_EQ(ErrorOf("{falls: [2, 1]}"),
            at + "{falls: [2, 1]}: expect.falls: between: 2 is above 1");
  EXPECT_EQ(ErrorOf("{falls: {maximum: 1}}"),
            at + "{falls: {maximum: 1}}: expect.falls.maximum: unknown key; known here: equals, "
                 "min, max, between");
  EXPECT_EQ(ErrorOf("{falls: none}"),
            at + "{falls: none}: expect.falls.equals: \"none\" is not a number");
}

TEST(Expectation, BreachesAreToldBothSidesOfEachBound) {
  Bounds equals, least, most, between;
  equals.equals = least.min = most.max = 1.0;
  between.between = std::array{1.0, 2.0};
  EXPECT_EQ(DescribeBreach(equals, 1.0), "");
  EXPECT_EQ(DescribeBreach(equals, 2.0), "must be 1");
  EXPECT_EQ(DescribeBreach(least, 1.0), "");
  EXPECT_EQ(DescribeBreach(least, 0.5), "must be at least 1");
  EXPECT_EQ(DescribeBreach(most, 1.0), "");
  EXPECT_EQ(DescribeBreach(most, 1.5), "must be at most 1");
  EXPECT_EQ(DescribeBreach(between, 1.0) + DescribeBreach(between, 2.0), "");
  EXPECT_EQ(DescribeBreach(between, 2.5), "must be from 1 to 2");
  EXPECT_NE(DescribeBreach(most, std::nan("")), "") << "not a number keeps no bound";
}

TEST(Observables, MetricsAreThereInBothUnitsAndByFamily) {
  const Observables all = AllObservables();
  for (const analysis::Metric& metric : analysis::AllMetrics())
    EXPECT_TRUE(all.contains(metric.info.key)) << metric.info.key;
  const auto expect = [&](const char* name, const char* key, double scale) {
    ASSERT_TRUE(all.contains(name)) << name;
    EXPECT_EQ(all.find(name)->second.key, key);
    EXPECT_DOUBLE_EQ(all.find(name)->second.scale, scale);
  };
  expect("tracking.height_rmse_mm", "height_rmse_m", 1e3);
  expect("height_rmse_m", "height_rmse_m", 1.0);
  expect("roll_rmse_deg", "roll_rmse_rad", 180.0 / 3.14159265358979323846);
  expect("contact_accuracy_pct", "contact_accuracy", 100.0);
  expect("timing.mpc_median_us", "mpc_median_s", 1e6);
  expect("est_velocity_rmse_mmps", "est_velocity_rmse_mps", 1e3);
  EXPECT_EQ(all.find("supervisor.load")->second,
            (Observable{Observable::Source::kCounter, "fallback_load"}));
}

// A metric whose shown unit has no key would be there in one unit only.
TEST(Observables, EveryShownUnitHasAKey) {
  for (const analysis::Metric& metric : analysis::AllMetrics()) {
    const std::string_view unit = metric.info.shown_unit;
    if (metric.info.scale == 1.0 || unit == "% of motors") continue;
    EXPECT_NE(KeyOfUnit(unit), "") << metric.info.key;
  }
}

TEST(Observables, EveryEventThatAnEpisodeAnnouncesIsKnown) {
  std::ifstream in(test::SourcePath("app/episode/episode.cc"));
  const std::string source((std::istreambuf_iterator<char>(in)), {});
  const std::regex call(R"re(Announce\("([a-z_]+)")re");
  int kinds = 0;
  for (auto it = std::sregex_iterator(source.begin(), source.end(), call);
       it != std::sregex_iterator(); ++it) {
    const std::string kind = (*it)[1];
    EXPECT_NE(std::find(kEventKinds.begin(), kEventKinds.end(), kind), kEventKinds.end()) << kind;
    ++kinds;
  }
  EXPECT_EQ(kinds, static_cast<int>(kEventKinds.size()));
}

}  // namespace
}  // namespace scoria::app
