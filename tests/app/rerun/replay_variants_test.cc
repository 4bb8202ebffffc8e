// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/replay_variants.h"

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/rerun/replay_text.h"
#include "app/run/run_scenario.h"
#include "core/files.h"
#include "logs/format/open_log.h"
#include "tests/support/go1_log.h"
#include "tests/support/logs.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

std::string MessageOf(const auto& act) {
  try {
    act();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "no error";
}

TEST(ParseVariant, SplitsAtCommasOutsideBrackets) {
  const Variant v =
      ParseVariant("legs=controller.estimator={type: inekf, slip_nis: 9},controller.a=[1,2]");
  EXPECT_EQ(v.name, "legs");
  EXPECT_EQ(v.set, (std::vector<std::string>{"controller.estimator={type: inekf, slip_nis: 9}",
                                             "controller.a=[1,2]"}));
}

TEST(ParseVariant, SaysWhatItsFormIs) {
  EXPECT_EQ(MessageOf([] { (void)ParseVariant("inekf"); }),
            "--variant inekf: is not NAME=key=value,key=value");
  EXPECT_EQ(MessageOf([] { (void)ParseVariant("a=b"); }),
            "--variant a=b: is not NAME=key=value,key=value");
  EXPECT_EQ(MessageOf([] { (void)ParseVariant("a/b=c=d"); }),
            "--variant a/b=c=d: a name is of letters, digits, _ - and .");
  EXPECT_EQ(MessageOf([] { (void)ParseVariant("a=b={c"); }),
            "--variant a=b={c: a bracket is not closed");
}

/// A walk on rough ground with its log, walked once for all tests.
class ReplayVariantsOfOurLog : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TemporaryFolder>();
    RunOptions options;
    options.folder = folder_->path() / "run";
    (void)RunToFolder(test::LoadScenario("rough", {"duration_s=20", "log.keep=full"}), options);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static LogInputOptions Log() { return {.log = folder_->path() / "run" / "log.mcap"}; }

  static std::unique_ptr<test::TemporaryFolder> folder_;
};
std::unique_ptr<test::TemporaryFolder> ReplayVariantsOfOurLog::folder_;

const std::vector<Variant> kEstimators = {
    {"inekf", {"controller.estimator.type=inekf"}},
    {"feet", {"controller.estimator.type=leg_odometry"}},
};

TEST_F(ReplayVariantsOfOurLog, ScoresEachAgainstTruthAndFeet) {
  const ReplayReport report = ReplayVariants(Log(), kEstimators, {}, 2);
  EXPECT_EQ(report.inputs.rows, 20000u) << "every step's inputs";
  EXPECT_NEAR(report.inputs.period_s, 0.001, 1e-9);
  ASSERT_TRUE(report.logged);
  ASSERT_EQ(report.variants.size(), 2u);
  const VariantResult &inekf = report.variants[0], &feet = report.variants[1];
  EXPECT_NEAR(inekf.estimation.velocity_rmse_mps, report.logged->velocity_rmse_mps, 0.01);
  EXPECT_LT(inekf.estimation.velocity_rmse_mps, feet.estimation.velocity_rmse_mps);
  EXPECT_GT(inekf.estimation.nis_dof, 0u);
  EXPECT_EQ(feet.estimation.nis_dof, 0u) << "it has no innovation";
  for (const VariantResult& v : report.variants) {
    EXPECT_GT(v.consistency.footholds, 50u);
    EXPECT_NEAR(v.consistency.closure_m, 0.3 * 20.0, 3.0);
    EXPECT_EQ(v.gaps, 0u);
    EXPECT_FALSE(v.started_in_motion);
  }
  EXPECT_NE(DescribeReplay(report).find("standing feet's speed"), std::string::npos);
}

TEST_F(ReplayVariantsOfOurLog, DoesNotDependOnWorkersOrOnOtherVariants) {
  const ReplayReport together = ReplayVariants(Log(), kEstimators, {}, 2);
  const ReplayReport alone = ReplayVariants(Log(), {kEstimators[1]}, {}, 1);
  EXPECT_EQ(ReplayJson(together)["variants"][1], ReplayJson(alone)["variants"][0]);
}

TEST_F(ReplayVariantsOfOurLog, WritesAllEstimatesByNameAndTrajectories) {
  const test::TemporaryFolder out;
  const ReplayReport report = ReplayVariants(
      Log(), kEstimators, {.log = out.path() / "all.mcap", .tum = out.path() / "tum"}, 2);
  EXPECT_EQ(report.files.size(), 5u);
  std::map<std::string, std::uint64_t> counts;
  const auto log = logs::OpenLog(out.path() / "all.mcap");
  log->ForEach({}, [&](const logs::LogMessage& m) {
    ++counts[m.channel.topic];
    return true;
  });
  EXPECT_EQ(counts["/scoria/row/measured"], 10000u);
  EXPECT_EQ(counts["/replay/inekf/estimate"], counts["/replay/feet/estimate"]);
  EXPECT_GT(counts["/replay/feet/contacts"], 9000u);
  const std::string tum = core::ReadText(out.path() / "tum" / "feet.tum");
  EXPECT_EQ(static_cast<std::uint64_t>(std::count(tum.begin(), tum.end(), '\n')),
            1 + counts["/replay/feet/estimate"]);
  EXPECT_EQ(MessageOf([&] {
              (void)ReplayVariants(Log(), kEstimators, {.log = out.path() / "all.mcap"}, 1);
            }),
            (out.path() / "all.mcap").string() + ": is there already; --force overwrites it");
}

TEST_F(ReplayVariantsOfOurLog, NamesTheVariantOfAWrongKey) {
  const auto run = [](const char* set) {
    return MessageOf([&] { (void)ReplayVariants(Log(), {{"mine", {set}}}, {}, 1); });
  };
  const std::string wrong = run("controller.estimator.tipe=inekf");
  EXPECT_TRUE(wrong.starts_with("--variant mine: ")) << wrong;
  EXPECT_NE(wrong.find("did you mean \"type\"?"), std::string::npos) << wrong;
  const std::string not_here = run("terrain.seed=2");
  EXPECT_NE(not_here.find("a replay can only change controller.*"), std::string::npos) << not_here;
  EXPECT_EQ(MessageOf([] {
              (void)ReplayVariants(Log(), {kEstimators[0], kEstimators[0]}, {}, 1);
            }),
            "--variant inekf: there is another of this name");
}

TEST_F(ReplayVariantsOfOurLog, SaysWhatALogLacks) {
  LogInputs inputs = SurveyInputs(Log());
  const auto refused = [&](const std::vector<std::string>& set) {
    return MessageOf([&] { (void)SetUpVariant(inputs, set); });
  };
  EXPECT_EQ(refused({}), "no error");
  inputs.accelerometer = false;
  EXPECT_EQ(refused({}),
            "the log holds no accelerometer, which this estimator needs; "
            "controller.estimator.type=leg_odometry does without");
  const std::string legs = "controller.estimator.type=leg_odometry";
  EXPECT_EQ(refused({legs}), "no error");
  inputs.true_contacts = false;
  EXPECT_EQ(refused({legs, "controller.contact.source=truth"}),
            "the log holds no true contacts for controller.contact.source=truth");
  inputs.torques = false;
  const VariantSetup off = SetUpVariant(inputs, {legs, "controller.adaptation.type=kf_plus"});
  EXPECT_EQ(off.remarks,
            (std::vector<std::string>{"the log holds no torques: no mass is learned",
                                      "the log holds no torques: contacts come from the foot "
                                      "forces"}));
  inputs.foot_forces = inputs.plan = false;
  EXPECT_EQ(refused({legs}),
            "the log holds neither torques nor foot forces nor a gait plan: no contacts");
  inputs.gyroscope = false;
  EXPECT_EQ(refused({legs}), "the log holds no rates of a gyroscope");
}

/// A Go1's YAML beside its URDF in the reference data.
fs::path WriteGo1(const fs::path& folder, const fs::path& data) {
  std::string yaml = "name: go1\nurdf: " + (data / "go1.urdf").string() +
                     "\nimu_link: imu_link\nhas_foot_sensors: false\n"
                     "motors: {armature_kgm2: [0, 0, 0], friction_Nm: [0, 0, 0], "
                     "damping_Nms_per_rad: [0.01, 0.01, 0.01]}\nlegs:\n";
  const std::vector<std::pair<std::string, std::string>> legs = {
      {"FL", "FL"}, {"FR", "FR"}, {"HL", "RL"}, {"HR", "RR"}};
  for (const auto& [leg, go1] : legs)
    yaml += "  " + leg + ": {haa: " + go1 + "_hip_joint, hfe: " + go1 +
            "_thigh_joint, kfe: " + go1 + "_calf_joint, foot: " + go1 + "_foot}\n";
  core::WriteText(folder / "go1.yaml", yaml);
  return folder / "go1.yaml";
}

double Drift(const VariantResult& v) {
  return analysis::SummariseDrift(v.estimation).horizontal_pct;
}

// The log begins in motion, has no foot sensors, and its torques and speeds are of its own step.
TEST(ReplayVariants, WeighTheGo1OfAnotherSimulator) {
  const std::optional<fs::path> data = test::Go1Folder();
  if (!data) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const test::TemporaryFolder folder;
  LogInputOptions log{.log = *data / "go1_trot_1khz.csv", .robot = WriteGo1(folder.path(), *data)};
  const std::vector<Variant> variants = {
      {"kf_plus",
       {"controller.adaptation.type=kf_plus", "controller.adaptation.tare.enabled=false"}}};
  const ReplayReport report = ReplayVariants(log, variants, {}, 2);
  const VariantResult& kf_plus = report.variants[0];
  ASSERT_TRUE(kf_plus.mass);
  EXPECT_NEAR(kf_plus.mass->mass_kg, 14.10, 0.03 * 14.10);
  EXPECT_TRUE(kf_plus.started_in_motion);
  const analysis::EdgeQuality& touchdown =
      kf_plus.estimation.contact.of(analysis::ContactDetector::kFused).touchdown;
  EXPECT_LE(std::abs(touchdown.delays.Quantile(0.5)), 0.010);
  EXPECT_LE(touchdown.delays.Quantile(0.95), 0.010);
}

TEST(ReplayVariants, LegsWeighWhatTheFeetOfARealGo2Carry) {
  const char* root = std::getenv("SCORIA_REFERENCE_DATA");
  if (root == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  int walks = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(root) / "logs/go2_entangle_lowstate")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".csv" || name.find("label") != std::string::npos) continue;
    SCOPED_TRACE(name);
    const ReplayReport report = ReplayVariants(
        {.log = entry.path(), .robot = fs::path(SCORIA_SOURCE_DIR) / "robots/go2/go2.yaml"},
        {{"kf_plus",
          {"controller.adaptation.type=kf_plus", "controller.adaptation.tare.enabled=false"}}},
        {}, 1);
    const VariantResult& v = report.variants[0];
    ASSERT_TRUE(v.mass && v.feet_carry_kg);
    EXPECT_NEAR(v.mass->mass_kg, *v.feet_carry_kg, 0.15 * *v.feet_carry_kg);
    ++walks;
  }
  EXPECT_EQ(walks, 3);
}

// Of robots and simulators that are not ours.
TEST(ReplayVariants, TheFilterDriftsLessThanTheLegs) {
  const std::optional<fs::path> go1 = test::Go1Folder();
  if (!go1) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const fs::path logs = go1->parent_path();
  const fs::path go2 = fs::path(SCORIA_SOURCE_DIR) / "robots/go2/go2.yaml";
  const test::TemporaryFolder folder;
  for (const LogInputOptions& log :
       {LogInputOptions{.log = *go1 / "go1_trot_1khz.csv", .robot = WriteGo1(folder.path(), *go1)},
        LogInputOptions{.log = logs / "go2_mujoco_serow/go2_walk.csv", .robot = go2},
        LogInputOptions{.log = logs / "go2_vicon_orl/test_4", .robot = go2}}) {
    SCOPED_TRACE(log.log);
    const ReplayReport report = ReplayVariants(log, kEstimators, {}, 2);
    EXPECT_LT(Drift(report.variants[0]), Drift(report.variants[1]));
  }
}

}  // namespace
}  // namespace scoria::app
