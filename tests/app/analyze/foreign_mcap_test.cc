// SPDX-License-Identifier: BSD-3-Clause
// A bag in the reference framework's format that npm's @mcap/core and
// @foxglove/rosmsg2-serialization wrote (tests/data/bags/foxglove_walk.mcap): 4 s of made-up
// signals by formulas, as below. What is expected follows from them by hand.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "analysis/metrics/registry.h"
#include "app/analyze/analyze_log.h"

namespace scoria::app {
namespace {

constexpr double kRate_Hz = 100.0, kWeight_N = 15.019 * 9.81, kSpeed_mps = 0.5;
constexpr int kLast = 399;  // of the rows, which begin with 0

/// The sum of half-second chords of x = 0.5 t, y = 0.01 sin(k / 30).
double Metres() {
  const auto y_m = [](int k) { return 0.01 * std::sin(k / 30.0); };
  double metres = 0.0;
  for (int from = 0; from < kLast; from += 50) {
    const int to = std::min(from + 50, kLast);
    metres += std::hypot(kSpeed_mps * (to - from) / kRate_Hz, y_m(to) - y_m(from));
  }
  return metres;
}

double Work() { return kWeight_N * Metres(); }

constexpr double kTorque_Nm = -1.5, kJointSpeed_radps = 0.25, kTime_s = kLast / kRate_Hz;

class ForeignMcap : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::filesystem::path source = SCORIA_SOURCE_DIR;
    AnalyzeOptions options;
    options.robot = source / "robots/go2/go2.yaml";
    analysis_ = AnalyzeLog({source / "tests/data/bags/foxglove_walk.mcap"}, "walk", "", options);
  }
  static double Number(std::string_view key) {
    const analysis::Metrics all = analysis::AllMetrics();
    return analysis::Find(analysis::ValuesOf(all, analysis_.log.metrics), key)
        .value_or(std::nan(""));
  }
  static inline LogAnalysis analysis_;
};

TEST_F(ForeignMcap, MetresAndTimesAreThoseOfTheFormulas) {
  EXPECT_EQ(Number("falls"), 0.0);
  EXPECT_NEAR(Number("distance_m"), Metres(), 1e-9);
  EXPECT_NEAR(Number("walking_s"), kTime_s, 1e-9);
}

TEST_F(ForeignMcap, CostsOfTransportAreThoseOfTheirDefinitions) {
  const double joint_W = kTorque_Nm * kJointSpeed_radps;
  EXPECT_NEAR(Number("cot_mech_abs"), 12.0 * std::abs(joint_W) * kTime_s / Work(), 1e-9);
  EXPECT_NEAR(Number("cot_mech_pos"), 0.0, 1e-12);
  double power_W = 50.0;  // robots/go2/go2.yaml: idle 50 W, losses 0.6, 0.6, 0.163
  for (const double loss : {0.6, 0.6, 0.163})
    power_W += 4.0 * std::max(0.0, joint_W + loss * kTorque_Nm * kTorque_Nm);
  EXPECT_NEAR(Number("cot_electrical"), power_W * kTime_s / Work(), 1e-9);
  EXPECT_NEAR(Number("cot_samples"), 12.0 * std::abs(joint_W) / (kWeight_N * kSpeed_mps), 1e-9);
}

// Twice a second the voltage is a sixteenth of a volt lower; straight between, the last one holds.
TEST_F(ForeignMcap, BatteryCostIsVoltageTimesCurrent) {
  double energy_J = 0.0;
  for (int k = 1; k <= kLast; ++k)
    energy_J += (28.5 - std::min(2.0 * k / kRate_Hz, 7.0) / 16.0) * 7.25 / kRate_Hz;
  EXPECT_NEAR(Number("cot_battery"), energy_J / Work(), 1e-6);
}

}  // namespace
}  // namespace scoria::app
