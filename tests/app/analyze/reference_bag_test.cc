// SPDX-License-Identifier: BSD-3-Clause
// A bag in the reference framework's format, which scoria did not write
// (tests/data/bags/make_experiment.py), analysed from folder to report. What is expected is
// calculated here from what the script says, by hand.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/metrics/registry.h"
#include "app/analyze/experiment.h"
#include "app/analyze/write_analysis.h"
#include "core/files.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

const fs::path kExperiment = fs::path(SCORIA_SOURCE_DIR) / "tests/data/bags/experiment";

constexpr double kBagRate_Hz = 50.0, kMass_kg = 15.019, kGravity_mps2 = 9.81, kBagSpeed_mps = 0.5;
// Rows of walking: up to the one before the roll has exceeded 60 degrees for 0.03 s, from 7.34 s on
// at samples of 0.02 s, and from 9 s on.
constexpr int kLastBefore = 368, kFirstAfter = 450, kLastRow = 599;
constexpr double kBagTorque_Nm = 5.0;

double JointSpeed(int row) {
  constexpr double kAmplitude_rad = 0.05, kFrequency = 2.0 * std::numbers::pi * 2.0;
  return kAmplitude_rad * kFrequency * std::cos(kFrequency * row / kBagRate_Hz);
}

/// Of a power, over the walking: powers of a row count for the step that ends with it.
template <class Power>
double Energy(Power&& power_W) {
  double energy_J = 0.0;
  for (int row = 1; row <= kLastBefore; ++row) energy_J += power_W(row) / kBagRate_Hz;
  for (int row = kFirstAfter + 1; row <= kLastRow; ++row) energy_J += power_W(row) / kBagRate_Hz;
  return energy_J;
}

double BagMetres() {
  const double before_m = kBagSpeed_mps * 7.0,
               after_m = kBagSpeed_mps * (kLastRow - kFirstAfter) / kBagRate_Hz;
  return before_m + after_m;
}

double BagWork() { return kMass_kg * kGravity_mps2 * BagMetres(); }  // ∫ m g ds

class ReferenceBag : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::vector<LogEntry> entries = ListLogs({kExperiment});
    ASSERT_EQ(entries.size(), 1U);
    analysis_ = AnalyzeLog(entries[0].files, entries[0].id, entries[0].robot_hint, {});
    analysis_.log.remarks.insert(analysis_.log.remarks.end(), entries[0].remarks.begin(),
                                 entries[0].remarks.end());
  }
  static double Number(std::string_view key) {
    const analysis::Metrics all = analysis::AllMetrics();
    return analysis::Find(analysis::ValuesOf(all, analysis_.log.metrics), key)
        .value_or(std::nan(""));
  }
  static inline LogAnalysis analysis_;
};

TEST_F(ReferenceBag, FolderNamesRobotAndRevision) {
  EXPECT_TRUE(analysis_.log.robot.starts_with("go2 (")) << analysis_.log.robot;
  EXPECT_TRUE(analysis_.log.mass.starts_with("15.019 kg")) << analysis_.log.mass;
  const auto& remarks = analysis_.log.remarks;
  EXPECT_NE(std::find(remarks.begin(), remarks.end(), "recorded by revision 80cdde1"),
            remarks.end());
}

TEST_F(ReferenceBag, FallIsToldByTheTiltAndNotByThePlacement) {
  ASSERT_EQ(analysis_.log.metrics.falls.size(), 1U);
  EXPECT_NEAR(analysis_.log.metrics.falls[0].time_s, 7.38, 1e-6);
  EXPECT_EQ(analysis_.log.metrics.falls[0].cause, "tilt");
}

TEST_F(ReferenceBag, MetresAndTimesAreThoseOfTheScript) {
  EXPECT_NEAR(Number("distance_m"), BagMetres(), 1e-9);
  EXPECT_NEAR(Number("falls_per_m"), 1.0 / BagMetres(), 1e-9);
  EXPECT_NEAR(Number("walking_s"), (kLastBefore + kLastRow - kFirstAfter) / kBagRate_Hz, 1e-6);
  for (const char* leg : {"fl", "fr", "hl", "hr"}) {
    EXPECT_NEAR(Number(std::string("stride_") + leg + "_s"), 0.4, 1e-6) << leg;
    EXPECT_NEAR(Number(std::string("stance_") + leg + "_s"), 0.24, 1e-6) << leg;
    EXPECT_NEAR(Number(std::string("duty_") + leg), 0.6, 1e-6) << leg;
  }
  EXPECT_NEAR(Number("phase_fr"), 0.5, 1e-6);
  EXPECT_NEAR(Number("phase_hl"), 0.5, 1e-6);
}

TEST_F(ReferenceBag, CostsOfTransportAreThoseOfTheirDefinitions) {
  const auto joints_W = [](int row) { return 12.0 * kBagTorque_Nm * std::abs(JointSpeed(row)); };
  EXPECT_NEAR(Number("cot_mech_abs"), Energy(joints_W) / BagWork(), 1e-9);
  const auto positive_W = [](int row) {
    return 12.0 * kBagTorque_Nm * std::max(JointSpeed(row), 0.0);
  };
  EXPECT_NEAR(Number("cot_mech_pos"), Energy(positive_W) / BagWork(), 1e-9);
  const auto electrical_W = [](int row) {  // robots/go2/go2.yaml: idle 50 W, losses 0.6, 0.6, 0.163
    double power_W = 50.0;
    for (const double loss : {0.6, 0.6, 0.163}) {
      const double joint_W = kBagTorque_Nm * JointSpeed(row) + loss * kBagTorque_Nm * kBagTorque_Nm;
      power_W += 4.0 * std::max(0.0, joint_W);
    }
    return power_W;
  };
  EXPECT_NEAR(Number("cot_electrical"), Energy(electrical_W) / BagWork(), 1e-9);
  const auto battery_W = [](int) { return 28.0 * 4.0; };
  EXPECT_NEAR(Number("cot_battery"), Energy(battery_W) / BagWork(), 1e-6);
  EXPECT_EQ(analysis_.log.metrics.substitutes.at(logs::RowGroup::kEnergy),
            "measured torques with the measured joint speeds (speeds come 0.0 ms after the angles, "
            "torques by how much after their commands is not known); battery: voltage times "
            "current");
}

// Mean over samples of sum |tau w| / (m g v), where v is not 0: plot_cost_of_transport.py, whose m
// is 10 kg for every robot; here it is the robot's.
TEST_F(ReferenceBag, CostOfTheReferencesScriptIsTheMeanOfSamples) {
  double sum = 0.0;
  int rows = 0;
  for (int row = 0; row <= kLastRow; ++row) {
    const bool moves = row < 350 || row >= kFirstAfter;
    if (!moves) continue;
    sum += 12.0 * kBagTorque_Nm * std::abs(JointSpeed(row)) /
           (kMass_kg * kGravity_mps2 * kBagSpeed_mps);
    ++rows;
  }
  EXPECT_NEAR(Number("cot_samples"), sum / rows, 1e-9);
}

TEST_F(ReferenceBag, IsPooledBySequencerAndCommandedSpeed) {
  ASSERT_EQ(analysis_.parts.size(), 1U);
  EXPECT_EQ(analysis_.parts[0].sequencer, "adaptive");
  EXPECT_DOUBLE_EQ(analysis_.parts[0].command_mps, 0.5);
  EXPECT_NEAR(analysis_.parts[0].metrics.distance_m, BagMetres(), 1e-9);
  EXPECT_EQ(analysis_.parts[0].metrics.outcome->falls, 1);
}

TEST_F(ReferenceBag, FilesHoldTheNumbers) {
  const test::TemporaryFolder folder;
  const fs::path page = WriteAnalysis({analysis_, analysis_}, "twice", folder.path() / "out");
  EXPECT_TRUE(fs::exists(page));
  const auto json = nlohmann::json::parse(core::ReadText(folder.path() / "out/analysis.json"));
  EXPECT_NEAR(json.at("logs").at(0).at("metrics").at("scalars").at("distance_m").get<double>(),
              BagMetres(), 1e-9);
  const auto& pooled = json.at("pooled").at(0);
  EXPECT_EQ(pooled.at("sequencer"), "adaptive");
  EXPECT_NEAR(pooled.at("scalars").at("distance_m").get<double>(), 2.0 * BagMetres(), 1e-9);
  EXPECT_EQ(pooled.at("scalars").at("falls"), 2.0);
  EXPECT_NEAR(pooled.at("scalars").at("cot_mech_abs").get<double>(), Number("cot_mech_abs"), 1e-9);
  EXPECT_NE(core::ReadText(folder.path() / "out/report/report.txt").find("Quality of the logs"),
            std::string::npos);
}

}  // namespace
}  // namespace scoria::app
