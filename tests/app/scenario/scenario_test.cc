// SPDX-License-Identifier: BSD-3-Clause
#include "app/scenario/scenario.h"

#include <fstream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "analysis/report/plain_text.h"
#include "app/campaign/campaign.h"
#include "app/campaign/campaign_plan.h"
#include "app/scenario/config_docs.h"
#include "core/files.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

std::string ErrorOf(const std::vector<std::string>& overrides) {
  try {
    (void)test::LoadScenario("flat", overrides);
  } catch (const core::ConfigError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Scenario, EveryFileOfTheRepositoryLoads) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::SourcePath("scenarios"))) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_NO_THROW((void)LoadScenario(entry.path(), {})) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 3);
  for (const auto& entry : std::filesystem::directory_iterator(test::SourcePath("campaigns"))) {
    EXPECT_NO_THROW((void)LoadCampaign(entry.path(), {})) << entry.path();
  }
}

TEST(Scenario, EffectiveYamlReadsBackToItself) {
  const Scenario scenario = test::LoadScenario("vulcano");
  const std::string yaml = EffectiveYaml(scenario);
  const auto again = core::ReadConfig<Scenario>(core::ParseConfig(yaml, "effective.yaml"));
  EXPECT_EQ(EffectiveYaml(again), yaml);
}

TEST(Scenario, ErrorsNameTheOverrideAndTheRule) {
  EXPECT_EQ(ErrorOf({"controller.mpc.horizon=40"}),
            "--set controller.mpc.horizon=40: controller.mpc.horizon: 40 is outside [2, 20]");
  EXPECT_EQ(ErrorOf({"controller.gait.type=trot"}),
            "--set controller.gait.type=trot: controller.gait.type: unknown \"trot\"; choices: "
            "ags, bio, sgs, sgs_matched");
  EXPECT_EQ(ErrorOf({"controler.gait=3"}),
            "--set controler.gait=3: controler: unknown key (did you mean \"controller\"?)");
}

TEST(Scenario, VelocityStepsThatRunBackwardsAreRefused) {
  EXPECT_NE(ErrorOf({"operator.steps=[{at_s: 5, v_x_mps: 0.3}, {at_s: 2, v_x_mps: 0}]"})
                .find("operator.steps[1].at_s: 2 is before 5, that of the step above"),
            std::string::npos);
  EXPECT_EQ(ErrorOf({"operator.steps=[{at_s: 2}, {at_s: 2, v_x_mps: 0.3}]"}), "no error");
}

TEST(Scenario, OverridesReachTheItemsOfLists) {
  const Scenario scenario = test::LoadScenario("push", {"pushes.0.impulse_Ns=30"});
  EXPECT_EQ(scenario.pushes.at(0).impulse_Ns, 30.0);
  EXPECT_EQ(scenario.pushes.at(0).at_s, 5.0);
  try {
    (void)test::LoadScenario("push", {"pushes.1.impulse_Ns=30"});
    FAIL();
  } catch (const core::ConfigError& e) {
    EXPECT_STREQ(e.what(), "--set pushes.1.impulse_Ns=30: 1: the list has 1 items, counted from 0");
  }
}

/// What LoadCampaign says of a sweep of the level trot.
std::string SweepError(const std::string& sweep) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "c.yaml";
  core::WriteText(file, fmt::format("name: c\nscenario: {{base: {}}}\narms: [{{name: a}}]\nsweep:\n"
                                    "{}\n",
                                    test::SourcePath("scenarios/flat.yaml").string(), sweep));
  try {
    (void)LoadCampaign(file, {});
  } catch (const core::ConfigError& e) {
    const std::string what = e.what();
    return what.substr(what.find("c.yaml"));
  }
  return "no error";
}

TEST(Campaign, SweepsOverVariantsOfSeveralKeys) {
  const Campaign campaign = LoadCampaign(test::SourcePath("campaigns/bias_errors.yaml"), {});
  const CampaignAxis& axis = campaign.sweep.at(0);
  EXPECT_EQ(axis.baseline, "nothing");
  EXPECT_EQ(axis.key, axis.label);
  ASSERT_EQ(axis.names.size(), axis.sets.size());
  EXPECT_EQ(axis.names.at(1), "torque gain error");
  core::ConfigNode node = campaign.scenario;
  core::MergeConfig(node, axis.sets.at(1));
  const auto scenario = core::ReadConfig<Scenario>(node);
  EXPECT_EQ(std::get<sim::RealisticSensors>(scenario.sensors).torque.gain_error, 0.0);
}

TEST(Campaign, SweepErrorsNameTheRule) {
  EXPECT_EQ(SweepError("  - {label: l, key: seed, variants: [{name: v}]}"),
            "c.yaml:5:37: sweep[0].variants: stands in place of key and values");
  EXPECT_EQ(SweepError("  - {values: [1]}"),
            "c.yaml:5:5: sweep[0].key: is missing and has no default");
  EXPECT_EQ(SweepError("  - {key: seed}"), "c.yaml:5:5: sweep[0].values: must list at least one");
  EXPECT_EQ(SweepError("  - {label: l, variants: []}"),
            "c.yaml:5:5: sweep[0].variants: must list at least one");
  EXPECT_EQ(SweepError("  - {variants: [{name: v}]}"),
            "c.yaml:5:5: sweep[0].label: is missing; variants need one");
  EXPECT_EQ(SweepError("  - {label: l, baseline: w, variants: [{name: v}]}"),
            "c.yaml:5:26: sweep[0].baseline: w: is none of the variants");
  EXPECT_EQ(SweepError("  - {label: l, variants: [{name: v, sed: 1}]}"),
            "c.yaml:5:37: sweep[0].variants[0].sed: unknown key (did you mean \"set\"?)");
  EXPECT_EQ(SweepError("  - {key: duration_s, baseline: 20, values: [10, 20]}"), "no error");
}

/// What LoadCampaign says of a design over the level trot.
std::string DesignError(const std::string& design) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "c.yaml";
  core::WriteText(file, fmt::format("name: c\nscenario: {{base: {}}}\narms: [{{name: a}}]\n"
                                    "sweep: {}\n",
                                    test::SourcePath("scenarios/flat.yaml").string(), design));
  try {
    const Campaign campaign = LoadCampaign(file, {});
    return fmt::format("{} points", campaign.design->points.size());
  } catch (const core::ConfigError& e) {
    const std::string what = e.what();
    return what.substr(what.find("c.yaml"));
  }
}

TEST(Campaign, DesignErrorsNameTheRule) {
  EXPECT_EQ(DesignError("{points: 9, factors: [{key: duration_s, from: 1, to: 2}]}"), "9 points");
  EXPECT_EQ(DesignError("{design: latin_hypercube, points: 11, factors: [{key: duration_s, from: "
                        "1, to: 2, scale: log}, {key: gravity_mps2, from: 3, to: 9}]}"),
            "8 points");
  EXPECT_EQ(DesignError("{points: 9}"), "c.yaml:4:8: sweep.factors: must list at least one factor");
  EXPECT_TRUE(DesignError("{design: grid}")
                  .starts_with("c.yaml:4:17: sweep.design: unknown \"grid\"; choices"));
  EXPECT_EQ(DesignError("{factors: [{key: duration_s, from: 2, to: 2}]}"),
            "c.yaml:4:19: sweep.factors[0].to: 2 is not above 2");
  EXPECT_EQ(DesignError("{factors: [{key: duration_s, from: 0, to: 2, scale: log}]}"),
            "c.yaml:4:19: sweep.factors[0].from: must be above 0 on a logarithmic scale");
  EXPECT_EQ(DesignError("{points: 3, factors: [{key: duration_s, from: 1, to: 2}, {key: "
                        "gravity_mps2, from: 3, to: 9}]}"),
            "c.yaml:4:8: sweep.points: 2 factors need at least 4");
  EXPECT_EQ(DesignError("{factors: [{key: seed, from: 1, to: 2}, {key: seed, from: 1, to: 2}]}"),
            "c.yaml:4:48: sweep.factors[1].key: seed: is a factor already");
  EXPECT_NE(DesignError("{points: 9, factors: [{key: duratoin_s, from: 1, to: 2}]}")
                .find("c.yaml:4:8: duratoin_s: unknown key (did you mean \"duration_s\"?)"),
            std::string::npos);
}

TEST(Campaign, DesignSetsItsFactors) {
  const Campaign campaign = LoadCampaign(test::SourcePath("campaigns/factors.yaml"), {});
  ASSERT_TRUE(campaign.design);
  const std::vector<CampaignJob> jobs = Plan(campaign);
  EXPECT_EQ(jobs.size(), campaign.arms.size() * campaign.design->points.size() *
                             static_cast<std::size_t>(campaign.seeds));
  std::size_t at = 0;
  while (campaign.design->factors.at(at).key != "operator.speed_mps") ++at;
  for (const CampaignJob& job : jobs) {
    EXPECT_EQ(std::get<RouteParams>(job.scenario.operation).speed_mps, std::stod(job.point.at(at)));
  }
  EXPECT_EQ(jobs.front().id, "ags-p1-s1");
}

TEST(CampaignPlan, TellsWhatTheBudgetSees) {
  const Campaign campaign = LoadCampaign(test::SourcePath("campaigns/demo.yaml"), {});
  const std::string assumed = analysis::ToPlainText(PlanCampaign(campaign, {}, std::nullopt));
  EXPECT_NE(assumed.find("3 arms × 3 points × 5 seeds: 45 episodes; 300 m of each arm at most."),
            std::string::npos)
      << assumed;
  EXPECT_NE(assumed.find("power 80 %, level 5 %"), std::string::npos);
  for (const char* line : {"\n30 ", "\n100 ", "\n300 "})
    EXPECT_NE(assumed.find(line), std::string::npos) << line;
  const std::string given =
      analysis::ToPlainText(PlanCampaign(campaign, {0.01, 0.9}, FallRate{0.02, "measured"}));
  EXPECT_NE(given.find("power 90 %, level 1 %"), std::string::npos);
  EXPECT_NE(given.find("\n50 "), std::string::npos);
  EXPECT_NE(given.find("measured"), std::string::npos);
  EXPECT_EQ(given.find("assumed"), std::string::npos);
  analysis::CampaignResults results;
  EXPECT_FALSE(MeasuredFallRate(results));
  results.episodes.resize(2);
  for (analysis::EpisodeRecord& e : results.episodes) {
    e.has_metrics = true;
    e.metrics.outcome.emplace();
    e.metrics.outcome->falls = 2;
    e.metrics.distance_m = 50.0;
  }
  EXPECT_NEAR(MeasuredFallRate(results)->per_m, 0.04, 1e-12);
  EXPECT_EQ(MeasuredFallRate(results)->source, "4 falls in 100 m");
}

TEST(Docs, ConfigTableIsCurrent) {
  std::ifstream in(test::SourcePath("docs/CONFIG.md"));
  std::stringstream text;
  text << in.rdbuf();
  EXPECT_EQ(text.str(), ConfigMarkdown())
      << "run: build/release/bin/scoria schema --markdown > docs/CONFIG.md";
}

// Every source that a docstring cites in brackets stands in the list of references.
TEST(Docs, EveryCitationHasItsReference) {
  std::ifstream in(test::SourcePath("docs/REFERENCES.md"));
  std::stringstream text;
  text << in.rdbuf();
  const std::string references = text.str();
  const std::regex citation(R"(\[([A-Z][A-Za-z]+[0-9]{4}|MCAP)\])");
  int cited = 0;
  for (const char* folder : {"core", "terrains", "sim", "controller", "analysis", "app"}) {
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(test::SourcePath(folder))) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        for (std::sregex_iterator it(line.begin(), line.end(), citation), end; it != end; ++it) {
          ++cited;
          EXPECT_NE(references.find("[" + (*it)[1].str() + "]"), std::string::npos)
              << entry.path() << ": " << (*it)[0];
        }
      }
    }
  }
  EXPECT_GT(cited, 8);
}

TEST(ControllerChanges, AreCheckedWhenTheScenarioIsRead) {
  const auto error = [](const std::string& changes) -> std::string {
    try {
      (void)test::LoadScenario("flat", {"controller_changes=" + changes});
    } catch (const core::ConfigError& e) {
      const std::string file = test::SourcePath("scenarios/flat.yaml").string() + ":2:1: ";
      const std::string text = e.what();
      EXPECT_TRUE(text.starts_with(file)) << text;
      return text.substr(std::min(text.size(), file.size()));
    }
    return "";
  };
  EXPECT_EQ(error("[{at_s: 1, set: [gait.type=sgs]}]"), "");
  EXPECT_EQ(
      error("[{at_s: 1, set: [gait.type=sgs]}, {at_s: 2, set: [gait.type=trott]}]"),
      "controller_changes[1].set: gait.type=trott: gait.type: unknown \"trott\"; choices: ags, "
      "bio, sgs, sgs_matched");
  EXPECT_EQ(error("[{at_s: 1, set: [gait.type=sgs, mpc.horizon=40]}]"),
            "controller_changes[0].set: mpc.horizon=40: mpc.horizon: 40 is outside [2, 20]");
  EXPECT_EQ(error("[{at_s: 1, set: [mpc.horizont=10]}]"),
            "controller_changes[0].set: mpc.horizont=10: mpc.horizont: unknown key (did you mean "
            "\"horizon\"?)");
  EXPECT_EQ(error("[{at_s: 1, set: [mpc.horizon]}]"),
            "controller_changes[0].set: mpc.horizon: must read key.subkey=value");
  EXPECT_EQ(error("[{at_s: 1, set: [mpc.f_min_N=200, mpc.f_max_N=100]}]"),
            "controller_changes[0].set: mpc: f_min_N must be below f_max_N");
  EXPECT_EQ(error("[{at_s: 1, set: [rates.mpc_Hz=50]}]"),
            "controller_changes[0].set: rates cannot change while walking");
  EXPECT_EQ(error("[{at_s: 2, set: [mpc.horizon=20]}, {at_s: 1, set: [mpc.horizon=10]}]"),
            "controller_changes[1].at_s: 1 is before 2, that of the change above");
}

TEST(Scenario, WhatTheEngineCannotExpressIsRefused) {
  const std::string bullet = "physics.engine.type=bullet";
  constexpr const char* kWhy = "engine bullet cannot express it; physics.engine.type: scoria can";
  EXPECT_TRUE(ErrorOf({bullet, "physics.ground.type=plastic"})
                  .ends_with(std::string(": physics.ground.type: plastic: ") + kWhy));
  EXPECT_TRUE(ErrorOf({bullet, "sliding_payload={name: block, mass_kg: 2}"})
                  .ends_with(std::string(": sliding_payload: ") + kWhy));
  EXPECT_EQ(ErrorOf({bullet}), "no error");
  EXPECT_EQ(ErrorOf({"physics.ground.type=plastic", "sliding_payload={name: block, mass_kg: 2}"}),
            "no error");
  EXPECT_TRUE(ErrorOf({"physics.engine.type=bulet"})
                  .ends_with("physics.engine.type: unknown \"bulet\"; choices: bullet, scoria "
                             "(did you mean \"bullet\"?)"));
}

TEST(Scenario, RatesThatDoNotDivideAreRefused) {
  const auto error = [](const std::string& set) -> std::string {
    try {
      (void)test::LoadScenario("flat", {set});
    } catch (const core::ConfigError& e) {
      const std::string text = e.what();
      return text.substr(text.find(": ") + 2);
    }
    return "";
  };
  constexpr const char* kProblem =
      "300 Hz is no whole number of physics steps of 0.001 s; the nearest rates are 333.3 and 250 "
      "Hz";
  for (const std::string key :
       {"controller.rates.wbc_Hz", "controller.rates.mpc_Hz", "sensors.imu.sampling.rate_Hz",
        "sensors.foot_force.sampling.rate_Hz"}) {
    EXPECT_EQ(error(key + "=300"), key + ": " + kProblem);
  }
  EXPECT_EQ(error("controller.adaptation={type: kf, rate_Hz: 300}"),
            std::string("controller.adaptation.rate_Hz: ") + kProblem);
  EXPECT_EQ(error("sensors.imu.sampling.rate_Hz=4000"), "");  // one in every step
  EXPECT_EQ(error("physics.step_s=0.0005"), "");
}

// A log of an older version holds the gain per tick.
TEST(Scenario, FormerKeysAreReadAndNoted) {
  const Scenario scenario =
      test::LoadScenario("flat", {"controller.reference.plane_slope_gain=0.1"});
  EXPECT_NEAR(scenario.controller.reference.plane_slope_s, 0.0949, 1e-4);
  ASSERT_EQ(scenario.notes.size(), 1u);
  EXPECT_NE(scenario.notes[0].find("controller.reference.plane_slope_gain is now plane_slope_s"),
            std::string::npos)
      << scenario.notes[0];
}

// A change of one choice leaves the section's other keys as they were tuned.
TEST(ControllerChanges, KeepWhatTheyDoNotName) {
  const Scenario scenario =
      test::LoadScenario("flat", {"controller.contact.fusion.force_sigma=0.03",
                                  "controller_changes=[{at_s: 1, set: [contact.source=sensor]}]"});
  const controller::ControllerParams changed = ChangedControllers(scenario).front();
  EXPECT_EQ(changed.contact.source, controller::ContactChoice::kSensor);
  EXPECT_EQ(changed.contact.fusion.force_sigma, 0.03);
}

}  // namespace
}  // namespace scoria::app
