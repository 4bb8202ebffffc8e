// SPDX-License-Identifier: BSD-3-Clause
#include "controller/wbc/tsid.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "tests/support/robots.h"

namespace scoria::controller {
namespace {

struct Case {
  core::WholeBody wb;
  LegPhases legs;
  FootTargets feet;
  ForcePlan forces;
  Vec3 n_W = Vec3::UnitZ();

  explicit Case(const RobotState& s) {
    core::WholeBodyModel(test::Go2(), 9.81).Calc(s, wb);
    const Vec3 rpy = core::RpyFromRotation(s.R_WB);
    forces.valid = true;
    for (auto& body : forces.body) body = {rpy, wb.p_WC, Vec3::Zero(), Vec3::Zero()};
    forces.stance.fill(LegArray<bool>(true));
    for (const Leg leg : kLegs) {
      for (auto& f : forces.f_F_W) f[leg] = {0.0, 0.0, wb.mass_kg * 9.81 / 4.0};
      forces.f_next_F_W[leg] = forces.f_F_W[0][leg];
      feet[leg].p_WF = wb.p_WF[leg] + Vec3(0.0, 0.0, 0.02);
    }
  }
  void Swing(Leg leg) { legs.mode[leg] = LegMode::kSwing; }
  [[nodiscard]] WbcInput input() const { return {wb, legs, feet, forces, 0.0, n_W}; }
};

/// Accelerations that the whole robot takes under the solution, from the full 18x18 equations of
/// motion.
Vec18 Accelerate(const Case& setup, const WbcResult& r) {
  Vec18 force = -AssembleBias(setup.wb);
  for (const Leg leg : kLegs) {
    const int at = 6 + 3 * static_cast<int>(leg);
    force.segment<3>(at) += r.command.tau_Nm[leg];
    if (!setup.legs.InContact(leg)) continue;
    const Vec3 down = -test::Go2().legs[leg].foot_radius_m * setup.n_W;
    const Vec3 p_BP = setup.wb.p_BF_W[leg] + down;
    force.head<3>() += r.f_F_W[leg];
    force.segment<3>(3) += p_BP.cross(r.f_F_W[leg]);
    const Mat3 J = setup.wb.J_ll[leg] - core::Skew(down) * setup.wb.Jw_ll[leg];
    force.segment<3>(at) += J.transpose() * r.f_F_W[leg];
  }
  return AssembleMassMatrix(setup.wb).ldlt().solve(force);
}

// The reduction must satisfy what it eliminated: equations of motion and unmoving (rolling)
// contacts.
TEST(Tsid, SolutionObeysMotionContactFrictionAndTorque) {
  core::Rng rng(11, 0, core::Stream::kSensor);
  TsidParams params;
  Tsid wbc(params, test::Go2());
  for (int trial = 0; trial < 60; ++trial) {
    RobotState s = test::RandomState(rng);
    s.w_WB *= 0.3;
    for (const Leg leg : kLegs) s.qd[leg] *= 0.3;
    Case setup(s);
    if (trial % 3 != 0) setup.Swing(Leg::kFL);
    if (trial % 3 == 2) setup.Swing(Leg::kHR);
    const WbcResult r = wbc.Solve(setup.input());
    ASSERT_EQ(r.status, SolveStatus::kOptimal) << trial;
    const Vec18 a = Accelerate(setup, r);
    for (const Leg leg : kLegs) {
      const Vec3 limit = test::Go2().EffortLimits()[leg];
      EXPECT_TRUE((r.command.tau_Nm[leg].cwiseAbs() - limit).maxCoeff() < 1e-9);
      if (!setup.legs.InContact(leg)) continue;
      EXPECT_GE(r.f_F_W[leg].z(), params.f_min_N - 1e-6);
      const Vec3 f_H =
          core::RotationZ(core::RpyFromRotation(s.R_WB).z()).transpose() * r.f_F_W[leg];
      EXPECT_LE(std::abs(f_H.x()), params.friction * f_H.z() + 1e-6);
      EXPECT_LE(std::abs(f_H.y()), params.friction * f_H.z() + 1e-6);
      if (r.torque_rows_dropped) continue;  // clamped torques no longer hold the contact exactly
      const Vec3 down = -test::Go2().legs[leg].foot_radius_m * setup.n_W;
      const Vec3 qdd = a.segment<3>(6 + 3 * static_cast<int>(leg));
      const Vec3 a_F = a.head<3>() + a.segment<3>(3).cross(setup.wb.p_BF_W[leg]) +
                       setup.wb.J_ll[leg] * qdd + setup.wb.Jd_v[leg];
      const Vec3 alpha = a.segment<3>(3) + setup.wb.Jw_ll[leg] * qdd + setup.wb.Jwd_v[leg];
      const Vec3 v_P = setup.wb.v_WF[leg] + setup.wb.w_shank_W[leg].cross(down);
      const Vec3 a_P = a_F + alpha.cross(down);
      EXPECT_LT((a_P + params.contact_damping_per_s * v_P).norm(), 1e-6 * (1.0 + a.norm()))
          << "trial " << trial;
    }
  }
}

TEST(Tsid, StandingStillNeedsNoAcceleration) {
  Case setup(test::StandingState());
  Tsid wbc({}, test::Go2());
  const WbcResult r = wbc.Solve(setup.input());
  ASSERT_EQ(r.status, SolveStatus::kOptimal);
  const Vec18 a = Accelerate(setup, r);
  EXPECT_LT(a.head<3>().norm(), 0.05);
  EXPECT_LT(a.segment<3>(3).norm(), 0.5);
}

TEST(Tsid, SwingFootAcceleratesAsAsked) {
  Case setup(test::StandingState());
  setup.Swing(Leg::kFR);
  setup.Swing(Leg::kHL);
  for (const Leg leg : kLegs) setup.feet[leg].p_WF = setup.wb.p_WF[leg];
  setup.feet[Leg::kFR].a_WF = {3.0, 0.0, 5.0};
  TsidParams params;
  params.swing_weight = 1e4;
  Tsid wbc(params, test::Go2());
  const WbcResult r = wbc.Solve(setup.input());
  const Vec18 a = Accelerate(setup, r);
  const Vec3 a_F = a.head<3>() + a.segment<3>(3).cross(setup.wb.p_BF_W[Leg::kFR]) +
                   setup.wb.J_ll[Leg::kFR] * a.segment<3>(9) + setup.wb.Jd_v[Leg::kFR];
  EXPECT_LT((a_F - Vec3(3.0, 0.0, 5.0)).norm(), 0.1);
}

// One problem, three forms: the same torques.
TEST(Tsid, FormulationsGiveTheSameTorques) {
  core::Rng rng(12, 0, core::Stream::kSensor);
  TsidParams params;
  std::vector<std::unique_ptr<Tsid>> forms;
  for (const auto& [formulation, name] : EnumNames(TsidFormulation{})) {
    params.formulation = formulation;
    forms.push_back(std::make_unique<Tsid>(params, test::Go2()));
  }
  double worst_Nm = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    RobotState s = test::RandomState(rng);
    s.w_WB *= 0.3;
    for (const Leg leg : kLegs) s.qd[leg] *= 0.3;
    Case setup(s);
    if (trial % 3 != 0) setup.Swing(Leg::kFL);
    if (trial % 3 == 2) setup.Swing(Leg::kHR);
    const WbcResult expected = forms[0]->Solve(setup.input());
    ASSERT_EQ(expected.status, SolveStatus::kOptimal) << trial;
    for (std::size_t i = 1; i < forms.size(); ++i) {
      const WbcResult r = forms[i]->Solve(setup.input());
      ASSERT_EQ(r.status, SolveStatus::kOptimal) << trial;
      for (const Leg leg : kLegs)
        worst_Nm = std::max(
            worst_Nm,
            (r.command.tau_Nm[leg] - expected.command.tau_Nm[leg]).lpNorm<Eigen::Infinity>());
    }
  }
  EXPECT_LT(worst_Nm, 1e-6);
}

TEST(Tsid, StretchedLegIsLeftToTheDenseForm) {
  RobotState s = test::StandingState();
  s.q[Leg::kHL] = {0.0, 0.0, -1e-4};
  const Case setup(s);
  Tsid wbc({}, test::Go2());
  const WbcResult r = wbc.Solve(setup.input());
  EXPECT_EQ(r.status, SolveStatus::kOptimal);
  EXPECT_TRUE(r.singular_leg);
  s.q[Leg::kHL] = test::StandingState().q[Leg::kHL];
  EXPECT_FALSE(wbc.Solve(Case(s).input()).singular_leg);
}

TEST(InverseDynamics, StandingTorquesCarryTheWeightThroughTheLegs) {
  const Case setup(test::StandingState());
  const auto wbc = MakeWholeBodyController(InverseDynamicsParams{}, test::Go2());
  const WbcResult r = wbc->Solve(setup.input());
  const WbcResult expected = Tsid({}, test::Go2()).Solve(setup.input());
  ASSERT_EQ(r.status, SolveStatus::kOptimal);
  for (const Leg leg : kLegs) {
    EXPECT_LT((r.command.tau_Nm[leg] - expected.command.tau_Nm[leg]).norm(), 0.3);
    EXPECT_LT((r.command.q[leg] - setup.wb.state.q[leg]).norm(), 1e-9) << "nowhere to go";
    EXPECT_GT(r.command.kp_Nm_per_rad[leg].minCoeff(), 0.0);
  }
}

// The commanded joint velocity moves the foot as its target asks, also while the trunk turns.
TEST(InverseDynamics, SwingJointVelocityFollowsTheFootTarget) {
  RobotState s = test::StandingState();
  s.w_WB = {0.1, -0.2, 0.8};
  s.v_WB = {0.3, 0.1, 0.0};
  Case setup(s);
  setup.Swing(Leg::kFR);
  setup.feet[Leg::kFR].v_WF = {0.7, -0.1, 0.4};
  const auto wbc = MakeWholeBodyController(InverseDynamicsParams{}, test::Go2());
  RobotState moved = s;
  moved.qd[Leg::kFR] = wbc->Solve(setup.input()).command.qd[Leg::kFR];
  core::WholeBody wb;
  core::WholeBodyModel(test::Go2(), 9.81).Calc(moved, wb);
  EXPECT_LT((wb.v_WF[Leg::kFR] - setup.feet[Leg::kFR].v_WF).norm(), 0.05);
}

TEST(Tsid, StretchedLegStaysFinite) {
  RobotState s = test::StandingState();
  s.q[Leg::kFL] = {0.0, 0.0, -0.001};
  Case setup(s);
  Tsid wbc({}, test::Go2());
  const WbcResult r = wbc.Solve(setup.input());
  EXPECT_TRUE(IsUsable(r.status));
  for (const Leg leg : kLegs) EXPECT_TRUE(r.command.tau_Nm[leg].allFinite());
}

}  // namespace
}  // namespace scoria::controller
