// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "controller/gait/gait_sequencer.h"
#include "controller/mpc/convex_mpc.h"
#include "controller/reference/reference_planner.h"
#include "core/math/so3.h"
#include "tests/support/robots.h"

namespace scoria::controller {
namespace {

/// A standing robot turned by `yaw_rad`, and everything the MPC needs to hold it.
struct Standing {
  core::WholeBody wb;
  ContactPlan contacts;
  LegPhases legs;
  BodyReference reference;
  FootholdPlan footholds;

  explicit Standing(double yaw_rad, int horizon) {
    RobotState s = test::StandingState();
    s.R_WB = core::RotationZ(yaw_rad);
    core::WholeBodyModel(test::Go2(), 9.81).Calc(s, wb);
    contacts.standing = true;
    contacts.horizon = horizon;
    contacts.stage_stance.fill(LegArray<bool>(true));
    footholds.stage.fill(wb.p_WF);
    for (auto& stage : reference.stages) {
      stage.rpy_rad = {0.0, 0.0, yaw_rad};
      stage.p_WC = wb.p_WC;
    }
  }
  [[nodiscard]] MpcInput input() const { return {wb, contacts, legs, reference, footholds}; }
};

TEST(ConvexMpc, StandingForcesSumToTheWeightAtAnyHorizonAndHeading) {
  for (const int horizon : {10, 20}) {
    for (const double yaw : {0.0, 0.8, 3.0}) {
      MpcParams params;
      params.horizon = horizon;
      ConvexMpc mpc(params, test::Go2(), 9.81);
      const Standing robot(yaw, horizon);
      const MpcResult result = mpc.Solve(robot.input());
      ASSERT_EQ(result.status, SolveStatus::kOptimal);
      Vec3 f = Vec3::Zero(), t = Vec3::Zero();
      for (const Leg leg : kLegs) {
        const Vec3 r = robot.wb.p_WF[leg] - Vec3(0, 0, 0.022) - robot.wb.p_WC;
        f += result.plan.f_F_W[0][leg];
        t += r.cross(result.plan.f_F_W[0][leg]);
      }
      const double weight = robot.wb.mass_kg * 9.81;
      EXPECT_NEAR(f.z(), weight, 0.02 * weight);
      EXPECT_LT(f.head<2>().norm(), 0.5);
      EXPECT_LT(t.norm(), 0.5);
    }
  }
}

// Newton and Euler by hand: the first predicted state follows from the first forces.
TEST(ConvexMpc, PredictionObeysTheRigidBody) {
  MpcParams params;
  ConvexMpc mpc(params, test::Go2(), 9.81);
  Standing robot(0.5, params.horizon);
  robot.reference.stages[0].v_WC = {0.4, 0.1, 0.0};
  for (auto& stage : robot.reference.stages) stage.v_WC = {0.4, 0.1, 0.0};
  robot.contacts.standing = false;
  const MpcResult result = mpc.Solve(robot.input());
  ASSERT_EQ(result.status, SolveStatus::kOptimal);
  Vec3 f(0, 0, -9.81 * robot.wb.mass_kg), t = Vec3::Zero();
  for (const Leg leg : kLegs) {
    f += result.plan.f_F_W[0][leg];
    t += (robot.wb.p_WF[leg] - Vec3(0, 0, 0.022) - robot.wb.p_WC).cross(result.plan.f_F_W[0][leg]);
  }
  const auto& next = result.plan.body[1];
  EXPECT_LT((next.v_WC - robot.wb.v_WC - params.stage_s * f / robot.wb.mass_kg).norm(), 1e-9);
  EXPECT_LT((next.w_WB - params.stage_s * robot.wb.I_C_W.inverse() * t).norm(), 1e-9);
  EXPECT_GT(next.v_WC.x(), 0.0) << "it accelerates towards the reference";
}

TEST(ConvexMpc, ForcesStayInTheFrictionPyramidOnASlope) {
  MpcParams params;
  ConvexMpc mpc(params, test::Go2(), 9.81);
  Standing robot(0.0, params.horizon);
  robot.reference.n_W = Vec3(-0.3, 0.0, 1.0).normalized();
  for (auto& stage : robot.reference.stages) stage.v_WC = {2.0, 0.0, 0.0};
  robot.contacts.standing = false;
  const MpcResult result = mpc.Solve(robot.input());
  ASSERT_EQ(result.status, SolveStatus::kOptimal);
  for (const Leg leg : kLegs) {
    const Vec3& f = result.plan.f_F_W[0][leg];
    const double normal = f.dot(robot.reference.n_W);
    EXPECT_GE(normal, params.f_min_N - 1e-9);
    EXPECT_LE((f - normal * robot.reference.n_W).norm(),
              std::sqrt(2.0) * params.friction * normal + 1e-9);
  }
}

TEST(ConvexMpc, SwingFeetGetNoForceButTheOneOfTheirNextStance) {
  MpcParams params;
  ConvexMpc mpc(params, test::Go2(), 9.81);
  Standing robot(0.0, params.horizon);
  robot.legs.mode[Leg::kFL] = robot.legs.mode[Leg::kHR] = LegMode::kSwing;
  const MpcResult result = mpc.Solve(robot.input());
  EXPECT_EQ(result.plan.f_F_W[0][Leg::kFL], Vec3::Zero());
  EXPECT_GT(result.plan.f_next_F_W[Leg::kFL].z(), params.f_min_N - 1e-9);
  EXPECT_FALSE(result.plan.stance[0][Leg::kFL]);
  EXPECT_TRUE(result.plan.stance[1][Leg::kFL]);
}

}  // namespace
}  // namespace scoria::controller
