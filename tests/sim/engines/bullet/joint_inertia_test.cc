// SPDX-License-Identifier: BSD-3-Clause
#include "sim/engines/bullet/joint_inertia.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/robot/whole_body.h"
#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

constexpr double kStep_s = 1e-3, kTolerance = 1e-9;

/// A Go2 whose mass matrix is known with rotors and dampers, M, and without, H.
class JointInertiaOfGo2 : public ::testing::Test {
 protected:
  void Take(const RobotState& state) {
    const core::MotorParams& motors = test::Go2().config.motors;
    core::WholeBody wb;
    core::WholeBodyModel(test::Go2(), 9.81).Calc(state, wb);
    H = M = core::AssembleMassMatrix(wb);
    for (int j = 0; j < kNumJoints; ++j) {
      H(6 + j, 6 + j) -= motors.armature_kgm2[j % kJointsPerLeg];
      M(6 + j, 6 + j) += kStep_s * motors.damping_Nms_per_rad[j % kJointsPerLeg];
    }
    inertia.Prepare(H.ldlt().solve(Mat18::Identity().rightCols<kNumJoints>()), kStep_s);
  }

  core::Rng rng{3, 0, core::Stream::kSensor};
  Mat18 H, M;
  JointInertia inertia{test::Go2().config.motors};
};

TEST_F(JointInertiaOfGo2, ResponsesAreThoseOfTheMassMatrixWithRotors) {
  for (int trial = 0; trial < 20; ++trial) {
    Take(test::RandomState(rng));
    EXPECT_TRUE(inertia.responses().isApprox(
        M.ldlt().solve(Mat18::Identity().rightCols<kNumJoints>()), kTolerance));
    Vec18 j;
    for (double& x : j) x = rng.NextUniform(-1.0, 1.0);
    Vec18 response = H.ldlt().solve(j);
    const double mobility = j.dot(response), less = inertia.Correct(j, response);
    EXPECT_TRUE(response.isApprox(M.ldlt().solve(j), kTolerance));
    EXPECT_NEAR(mobility - less, j.dot(response), kTolerance * mobility);
  }
}

// M v* = (H + A) v + dt (τ − h) is what the step is; H v_free = H v + dt (τ − h) what is given.
TEST_F(JointInertiaOfGo2, FreeChangeLeadsToTheStepWithRotorsAndDampers) {
  const core::MotorParams& motors = test::Go2().config.motors;
  Take(test::RandomState(rng));
  Vec18 before, impulse;
  for (double& x : before) x = rng.NextUniform(-5.0, 5.0);
  for (double& x : impulse) x = rng.NextUniform(-0.01, 0.01);
  const Vec18 free = before + H.ldlt().solve(impulse);
  Vec18 momentum = H * before + impulse;
  for (int j = 0; j < kNumJoints; ++j)
    momentum[6 + j] += motors.armature_kgm2[j % kJointsPerLeg] * before[6 + j];
  const Vec18 after = free + inertia.FreeChange(before.tail<kNumJoints>(), free.tail<kNumJoints>());
  EXPECT_TRUE(after.isApprox(M.ldlt().solve(momentum), kTolerance));
}

}  // namespace
}  // namespace scoria::sim
