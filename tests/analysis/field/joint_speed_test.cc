// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/joint_speed.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scoria::analysis {
namespace {

/// Angles and speeds of two swings at once, the speeds late by `speed_s`; commands of torque, and
/// torques late by `torque_s`.
JointDelays Measure(double step_s, double speed_s, double torque_s, double size = 1.0) {
  JointDelays delays;
  for (int k = 0; k < 4000; ++k) {
    const double t = step_s * k, late = t - speed_s;
    logs::Row row;
    row.time_s = k < 2000 ? t : t + 1.0;
    logs::Array12 q{}, qd{}, commanded{}, tau{};
    for (std::size_t j = 0; j < q.size(); ++j) {
      const double phase = 0.3 * static_cast<double>(j);
      q[j] = size * (0.2 * std::sin(12.0 * t + phase) + 0.05 * std::sin(50.0 * t));
      qd[j] = size * (2.4 * std::cos(12.0 * late + phase) + 2.5 * std::cos(50.0 * late));
      commanded[j] = size * 5.0 * std::sin(40.0 * t + phase);
      tau[j] = size * 5.0 * std::sin(40.0 * (t - torque_s) + phase);
    }
    row.measured.emplace().q_rad = q;
    row.measured->qd_radps = qd;
    row.measured->tau_Nm = tau;
    row.joint_command.emplace().tau_Nm = commanded;
    delays.Add(row);
  }
  return delays;
}

TEST(JointDelays, AreFoundOfSpeedsAndTorques) {
  constexpr double kShareOfStep = 0.1;
  for (const double step_s : {0.001, 0.002, 0.005}) {
    for (const double lag_s : {0.0, 0.0025, 0.006}) {
      const JointDelays delays = Measure(step_s, lag_s, 0.003);
      ASSERT_TRUE(delays.speed_s());
      EXPECT_NEAR(*delays.speed_s(), lag_s, kShareOfStep * step_s + 1e-4) << step_s;
      ASSERT_TRUE(delays.torque_s());
      EXPECT_NEAR(*delays.torque_s(), 0.003, kShareOfStep * step_s + 1e-4) << step_s;
    }
  }
}

TEST(JointDelays, AreNotToldOfJointsThatHardlyMove) {
  EXPECT_FALSE(Measure(0.002, 0.0025, 0.003, 0.01).speed_s());
  EXPECT_FALSE(Measure(0.002, 0.0025, 0.003, 0.01).torque_s());
  EXPECT_FALSE(JointDelays().speed_s());
}

TEST(JointSpeed, IsTheOneOfTheInstantOfTheTorques) {
  EXPECT_EQ(ChooseJointSpeed(0.0005, std::nullopt), JointSpeed::kMeasured);
  EXPECT_EQ(ChooseJointSpeed(0.0025, std::nullopt), JointSpeed::kDerivative);
  EXPECT_EQ(ChooseJointSpeed(0.0025, 0.0022), JointSpeed::kMeasured);
  EXPECT_EQ(ChooseJointSpeed(0.0060, 0.0010), JointSpeed::kDerivative);
  EXPECT_EQ(ChooseJointSpeed(std::nullopt, std::nullopt), JointSpeed::kMeasured);
}

}  // namespace
}  // namespace scoria::analysis
