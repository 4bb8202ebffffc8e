// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/stance_velocity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "core/robot/whole_body.h"
#include "tests/support/robots.h"

namespace scoria::core {
namespace {

/// A trunk in motion, and the joint speeds with which three feet stand; the fourth swings.
struct Stance {
  RobotDescription robot = test::Go2();
  RobotState state = test::StandingState();
  LegArray<bool> contact = LegArray<bool>(true);

  explicit Stance(StanceFoot how) {
    state.R_WB = RotationFromRpy({0.1, -0.2, 0.7});
    state.v_WB = Vec3(0.3, -0.2, 0.1);
    state.w_WB = Vec3(0.4, 0.5, -0.6);
    for (const Leg leg : kLegs) {
      const LegKinematics foot = CalcLegKinematics(robot.legs[leg], state.q[leg]);
      // The lowest point of the foot is fixed to the shank, or there is only the centre.
      const Vec3 down_B =
          how == StanceFoot::kRolls
              ? Vec3(state.R_WB.transpose() * (-robot.legs[leg].foot_radius_m * Vec3::UnitZ()))
              : Vec3(Vec3::Zero());
      Mat3 J_low;  // of the point, by the shank's turns about the joints
      const double c = std::cos(state.q[leg].x()), s = std::sin(state.q[leg].x());
      for (int k = 0; k < 3; ++k) {
        const Vec3 axis_B = k == 0 ? Vec3(Vec3::UnitX()) : Vec3(0.0, c, s);
        J_low.col(k) = foot.J.col(k) + axis_B.cross(down_B);
      }
      const Vec3 v_B = state.R_WB.transpose() *
                       (state.v_WB + state.w_WB.cross(state.R_WB * (foot.p_BF + down_B)));
      state.qd[leg] = -J_low.inverse() * v_B;
    }
    state.qd[Leg::kHR].setConstant(9.0);
    contact[Leg::kHR] = false;
  }

  [[nodiscard]] Vec3 CalcOf(Leg leg, StanceFoot how) const {
    return CalcFootStanceVelocity(robot.legs[leg], state.R_WB, state.w_WB, state.q[leg],
                                  state.qd[leg], how);
  }
  [[nodiscard]] std::optional<Vec3> CalcMean() const {
    return CalcStanceVelocity(robot, state.R_WB, state.w_WB, state.q, state.qd, contact);
  }
};

TEST(StanceVelocity, EveryStandingFootTellsTheTrunksWhetherItStaysOrRolls) {
  for (const StanceFoot how : {StanceFoot::kStays, StanceFoot::kRolls}) {
    const Stance stance(how);
    for (const Leg leg : kLegs) {
      if (stance.contact[leg]) {
        EXPECT_LT((stance.CalcOf(leg, how) - stance.state.v_WB).norm(), 1e-12);
      }
    }
  }
  const Stance stays(StanceFoot::kStays), rolls(StanceFoot::kRolls);
  ASSERT_TRUE(stays.CalcMean() && rolls.CalcMean());
  EXPECT_LT((*stays.CalcMean() - stays.state.v_WB).norm(), 1e-12);
  EXPECT_GT((*rolls.CalcMean() - rolls.state.v_WB).norm(), 0.01)
      << "feet that roll carry the trunk further";
}

TEST(StanceVelocity, IsNoneWithoutAStandingFoot) {
  Stance stance(StanceFoot::kStays);
  stance.contact = LegArray<bool>(false);
  EXPECT_FALSE(stance.CalcMean());
}

}  // namespace
}  // namespace scoria::core
