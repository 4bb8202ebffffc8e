// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "controller/reference/reference_planner.h"
#include "controller/swing/foothold_planner.h"
#include "controller/swing/swing_trajectory.h"
#include "core/math/so3.h"
#include "tests/support/robots.h"

namespace scoria::controller {
namespace {

core::WholeBody Standing(const Vec3& v_WB = Vec3::Zero()) {
  RobotState s = test::StandingState();
  s.v_WB = v_WB;
  core::WholeBody wb;
  core::WholeBodyModel(test::Go2(), 9.81).Calc(s, wb);
  return wb;
}

TEST(SwingTrajectory, StartsAndEndsAtRestAndReachesItsApex) {
  SwingParams params;
  SwingTrajectory swing(params, test::Go2());
  const core::WholeBody wb = Standing();
  LegPhases legs;
  legs.mode[Leg::kFL] = LegMode::kSwing;
  legs.swing_s = LegArray<double>(0.2);
  FootholdPlan footholds;
  const Vec3 from = wb.p_WF[Leg::kFL], to = from + Vec3(0.1, 0.02, 0.03);
  footholds.next[Leg::kFL] = to;
  double top = -1.0;
  FootTarget last;
  for (int i = 0; i <= 1000; ++i) {
    legs.swing_progress[Leg::kFL] = i / 1000.0;
    const FootTarget t = swing.Plan(wb, legs, footholds)[Leg::kFL];
    if (i == 0) {
      EXPECT_LT((t.p_WF - from).norm() + t.v_WF.norm(), 1e-12);
    } else {  // velocity is the derivative of position
      const double dt = 0.2 / 1000.0;
      EXPECT_LT(((t.p_WF - last.p_WF) / dt - 0.5 * (t.v_WF + last.v_WF)).norm(), 2e-3);
    }
    last = t;
    top = std::max(top, t.p_WF.z());
  }
  EXPECT_LT((last.p_WF - to).norm() + last.v_WF.norm(), 1e-12);
  EXPECT_NEAR(top, to.z() + params.apex_m, 1e-9);
}

TEST(SwingTrajectory, LateFootGoesDownAtItsSpeed) {
  SwingParams params;
  params.lower_speed_mps = 0.3;
  SwingTrajectory swing(params, test::Go2());
  const core::WholeBody wb = Standing();
  LegPhases legs;
  legs.mode[Leg::kHR] = LegMode::kSwing;
  legs.swing_progress[Leg::kHR] = 0.5;
  FootholdPlan footholds;
  footholds.next[Leg::kHR] = wb.p_WF[Leg::kHR];
  (void)swing.Plan(wb, legs, footholds);
  legs.mode[Leg::kHR] = LegMode::kLowering;
  legs.late_s[Leg::kHR] = 0.1;
  const FootTarget t = swing.Plan(wb, legs, footholds)[Leg::kHR];
  EXPECT_NEAR(t.p_WF.z(), wb.p_WF[Leg::kHR].z() - 0.03, 1e-12);
  EXPECT_EQ(t.v_WF, Vec3(0.0, 0.0, -0.3));
}

TEST(SwingTrajectory, HeldFootMovesWithTheBody) {
  SwingTrajectory swing({}, test::Go2());
  core::WholeBody wb = Standing();
  LegPhases legs;
  FootholdPlan footholds;
  footholds.next = wb.p_WF;
  legs.mode[Leg::kFR] = LegMode::kHolding;
  const Vec3 before = swing.Plan(wb, legs, footholds)[Leg::kFR].p_WF;
  EXPECT_LT((before - wb.p_WF[Leg::kFR]).norm(), 1e-12);
  wb.state.p_WB += Vec3(0.1, 0.0, -0.02);
  wb.state.v_WB = {0.3, 0.0, 0.0};
  const FootTarget after = swing.Plan(wb, legs, footholds)[Leg::kFR];
  EXPECT_LT((after.p_WF - before - Vec3(0.1, 0.0, -0.02)).norm(), 1e-12);
  EXPECT_EQ(after.v_WF, Vec3(0.3, 0.0, 0.0));
}

TEST(SwingTrajectory, StumbleLiftsTheFootBeforeItGoesOn) {
  SwingParams params;
  SwingTrajectory swing(params, test::Go2());
  core::WholeBody wb = Standing();
  LegPhases legs;
  FootholdPlan footholds;
  footholds.plane.z0_m = -1.0;
  const Vec3 start = wb.p_WF[Leg::kFL];
  footholds.next = wb.p_WF;
  footholds.next[Leg::kFL] = start + Vec3(0.2, 0.0, 0.0);
  legs.mode[Leg::kFL] = LegMode::kSwing;
  (void)swing.Plan(wb, legs, footholds);
  legs.mode[Leg::kFL] = LegMode::kStumble;
  legs.swing_progress[Leg::kFL] = 0.3;
  const Vec3 hit = wb.p_WF[Leg::kFL] = start + Vec3(0.05, 0.0, 0.04);
  EXPECT_LT((swing.Plan(wb, legs, footholds)[Leg::kFL].p_WF - hit).norm(), 1e-12);
  legs.swing_progress[Leg::kFL] = 0.5;  // two sevenths of the rest: still upwards only
  const FootTarget rising = swing.Plan(wb, legs, footholds)[Leg::kFL];
  EXPECT_NEAR(rising.p_WF.x(), hit.x(), 1e-12);
  EXPECT_GT(rising.p_WF.z(), hit.z() + 0.03);
  legs.swing_progress[Leg::kFL] = 0.65;  // half of the rest: the apex
  EXPECT_NEAR(swing.Plan(wb, legs, footholds)[Leg::kFL].p_WF.z(),
              hit.z() + params.apex_m + params.stumble_lift_m, 1e-9);
  legs.swing_progress[Leg::kFL] = 1.0;
  EXPECT_LT((swing.Plan(wb, legs, footholds)[Leg::kFL].p_WF - footholds.next[Leg::kFL]).norm(),
            1e-9);
}

TEST(SwingTrajectory, ApexCountsFromTheGroundBetweenTheEnds) {
  SwingParams params;
  SwingTrajectory swing(params, test::Go2());
  const core::WholeBody wb = Standing();
  LegPhases legs;
  FootholdPlan footholds;
  footholds.next = wb.p_WF;
  footholds.plane.z0_m = 0.05;  // both ends lie in a hollow of the plane
  legs.mode[Leg::kFL] = LegMode::kSwing;
  (void)swing.Plan(wb, legs, footholds);
  legs.swing_progress[Leg::kFL] = 0.5;
  EXPECT_NEAR(swing.Plan(wb, legs, footholds)[Leg::kFL].p_WF.z(),
              0.05 + test::Go2().legs[Leg::kFL].foot_radius_m + params.apex_m, 1e-9);
}

TEST(SwingTrajectory, NextSwingAfterALateFootStartsWhereTheFootIs) {
  SwingTrajectory swing({}, test::Go2());
  core::WholeBody wb = Standing();
  LegPhases legs;
  FootholdPlan footholds;
  footholds.next = wb.p_WF;
  for (const LegMode mode : {LegMode::kSwing, LegMode::kLowering, LegMode::kSwing}) {
    legs.mode[Leg::kFL] = mode;
    legs.swing_progress[Leg::kFL] = mode == LegMode::kLowering ? 1.0 : 0.0;
    wb.p_WF[Leg::kFL].x() -= 0.1;  // the body moved on in the meantime
    const FootTarget t = swing.Plan(wb, legs, footholds)[Leg::kFL];
    if (mode == LegMode::kSwing) {
      EXPECT_LT((t.p_WF - wb.p_WF[Leg::kFL]).norm(), 1e-9);
    }
  }
}

TEST(FootholdPlanner, StepsSymmetricallyAtTheCommandedSpeedAndOutwardsWhenPushed) {
  const double v = 0.4;
  ContactPlan contacts;
  contacts.standing = false;
  contacts.horizon = 4;
  contacts.duty = LegArray<double>(0.6);
  contacts.stance_s = LegArray<double>(0.3);
  contacts.swing_s = LegArray<double>(0.2);
  contacts.swing_remaining_s = LegArray<double>(0.0);  // about to touch down
  BodyReference reference;
  for (auto& stage : reference.stages) stage.v_WC = {v, 0.0, 0.0};
  const GroundPlane plane;
  const auto foothold = [&](const Vec3& v_WB, Leg leg) {
    FootholdPlanner planner({}, test::Go2(), 9.81);
    const core::WholeBody wb = Standing(v_WB);
    return Vec3(planner.Plan(wb, contacts, LegPhases{}, reference, plane).next[leg] -
                wb.state.p_WB - test::Go2().NeutralFoothold(leg));
  };
  const Vec3 step = foothold({v, 0.0, 0.0}, Leg::kFL);
  EXPECT_NEAR(step.x(), 0.5 * 0.3 * v, 1e-9);  // half a stance ahead
  EXPECT_NEAR(step.y(), 0.0, 1e-9);
  EXPECT_GT(foothold({v, 0.3, 0.0}, Leg::kFR).y(), 0.3 * 0.1);  // catches a sideways push
  // The clip keeps the direction of the step, also to the front.
  const Vec3 far = foothold({3.0, 0.3, 0.0}, Leg::kFL);
  EXPECT_LE(far.head<2>().norm(), FootholdParams{}.max_reach_m + 1e-9);
  EXPECT_NEAR(far.y() / far.x(), (0.15 * 0.3 + 0.1 * 0.3) / (0.15 * 3.0 + 0.1 * (3.0 - v)), 0.05);
  EXPECT_GT(far.x(), 0.0);
}

TEST(FootholdPlanner, StepsAboveReachAreShortened) {
  ContactPlan contacts;
  contacts.standing = false;
  contacts.horizon = 2;
  contacts.duty = LegArray<double>(0.6);
  contacts.stance_s = LegArray<double>(0.3);
  contacts.swing_s = LegArray<double>(0.2);
  GroundPlane plane;
  FootholdParams params;
  params.max_step_height_m = 0.05;
  FootholdPlanner planner(params, test::Go2(), 9.81);
  const core::WholeBody wb = Standing({0.4, 0.0, 0.0});
  BodyReference reference;
  for (auto& stage : reference.stages) stage.v_WC = {0.4, 0.0, 0.0};
  (void)planner.Plan(wb, contacts, LegPhases{}, reference, plane);  // learns where the feet stand
  plane.z0_m = 0.12;                                                // the ground ahead is higher
  const Vec3 step =
      planner.Plan(wb, contacts, LegPhases{}, reference, plane).next[Leg::kFL] - wb.p_WF[Leg::kFL];
  EXPECT_NEAR(step.z(), 0.05, 1e-3);
}

/// Rises 0.1 per metre ahead of the trunk, with a kerb of 0.05 m at 0.25 m. The trunk is 0.28 m up.
class Kerb final : public LocalGround {
 public:
  [[nodiscard]] double HeightOverTrunk(const Vec2& p_BP_H) const noexcept override {
    return -0.28 + 0.1 * p_BP_H.x() + (p_BP_H.x() > 0.25 ? 0.05 : 0.0);
  }
};

/// The same robot elsewhere, turned by `yaw_rad`.
core::WholeBody Placed(const Vec3& p_WB, double yaw_rad) {
  RobotState s = test::StandingState();
  s.p_WB = p_WB;
  s.R_WB = core::RotationZ(yaw_rad);
  core::WholeBody wb;
  core::WholeBodyModel(test::Go2(), 9.81).Calc(s, wb);
  return wb;
}

// Footholds lie on the ground that is known, wherever the robot believes itself to be.
TEST(FootholdPlanner, KnownGroundReplacesThePlane) {
  ContactPlan contacts;
  contacts.standing = false;
  contacts.horizon = 2;
  contacts.duty = LegArray<double>(0.6);
  contacts.stance_s = LegArray<double>(0.3);
  contacts.swing_s = LegArray<double>(0.2);
  const BodyReference reference;
  const Kerb kerb;
  for (const double yaw_rad : {0.0, 2.0}) {
    const Vec3 p_WB(3.0, -2.0, 1.0);
    const core::WholeBody wb = Placed(p_WB, yaw_rad);
    FootholdPlanner planner({}, test::Go2(), 9.81);
    const FootholdPlan plan =
        planner.Plan(wb, contacts, LegPhases{}, reference, GroundPlane{}, &kerb);
    for (const Leg leg : kLegs) {
      const Vec3 p_BF_H = core::RotationZ(-yaw_rad) * (plan.next[leg] - p_WB);
      EXPECT_NEAR(p_BF_H.z(), kerb.HeightOverTrunk(p_BF_H.head<2>()) + 0.022, 1e-9) << yaw_rad;
    }
  }
}

TEST(ReferencePlanner, KnownGroundGivesThePlaneAtOnce) {
  ReferencePlanner planner({}, 0.30);
  const Kerb kerb;
  const Vec3 p_WB(3.0, -2.0, 1.0);
  const core::WholeBody wb = Placed(p_WB, 0.5 * std::numbers::pi);
  planner.ObserveGround(wb, kerb);
  EXPECT_NEAR(planner.plane().slope.y(), 0.1, 1e-3) << "feet are within 0.25 m: no kerb";
  EXPECT_NEAR(planner.plane().slope.x(), 0.0, 1e-3);
  EXPECT_NEAR(planner.plane().Height(p_WB), 1.0 - 0.28, 1e-3);
  const BodyReference reference = planner.Plan(wb, Command{}, 2, 0.05, 0.01);
  EXPECT_NEAR(reference.stages[0].p_WC.z(), reference.ground_z_m + 0.30, 1e-9);
}

TEST(ReferencePlanner, DithersWhileTheRobotRestsOnly) {
  ReferencePlanner planner({.stand_dither_m = 0.006, .stand_dither_Hz = 0.5}, 0.30);
  const core::WholeBody wb = Placed({0.0, 0.0, 0.3}, 0.0);
  double least_m = 1.0, most_m = 0.0;
  for (int i = 0; i < 400; ++i) {
    const BodyReference reference = planner.Plan(wb, Command{}, 2, 1e-4, 0.01);
    const BodyReference::Stage &now = reference.stages[0], &next = reference.stages[1];
    EXPECT_NEAR(next.p_WC.z() - now.p_WC.z(), 1e-4 * now.v_WC.z(), 1e-8);
    least_m = std::min(least_m, now.p_WC.z());
    most_m = std::max(most_m, now.p_WC.z());
  }
  EXPECT_NEAR(most_m - least_m, 0.012, 1e-5);
  const BodyReference walking = planner.Plan(wb, {.v_x_mps = 0.3}, 2, 0.05, 0.01);
  EXPECT_NEAR(walking.stages[2].p_WC.z(), 0.30, 1e-12);
  EXPECT_EQ(walking.stages[2].v_WC.z(), 0.0);
}

TEST(ReferencePlanner, FollowsTheGroundPlaneAndHoldsStillWhenStanding) {
  ReferencePlanner planner({}, 0.30);
  RobotState s = test::StandingState();
  // All four feet on a plane that rises 0.1 per metre: lift the body's frame by a pitch.
  core::WholeBody wb;
  core::WholeBodyModel model(test::Go2(), 9.81);
  model.Calc(s, wb);
  for (const Leg leg : kLegs) wb.p_WF[leg].z() = 0.022 + 0.1 * wb.p_WF[leg].x();
  BodyReference reference;
  for (int i = 0; i < 200; ++i) {
    planner.ObserveFeet(wb, LegArray<bool>(true), 0.022, 0.01);
    reference = planner.Plan(wb, Command{}, 10, 0.05, 0.01);
  }
  EXPECT_NEAR(planner.plane().slope.x(), 0.1, 1e-3);
  EXPECT_NEAR(reference.stages[0].rpy_rad.y(), -0.6 * std::atan(0.1),
              1e-3);  // nose up on a rising slope
  EXPECT_NEAR(reference.stages[10].p_WC.x(), reference.stages[0].p_WC.x(), 1e-12);
  EXPECT_NEAR(reference.stages[0].p_WC.z(), 0.30 + 0.1 * reference.stages[0].p_WC.x(), 2e-3);
}

}  // namespace
}  // namespace scoria::controller
