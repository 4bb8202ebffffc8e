// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/qp_problems.h"

#include "core/math/so3.h"

namespace scoria::test {
namespace {

using controller::TsidProblem;

template <int rows, int columns>
Eigen::Matrix<double, rows, columns> Normal(core::Rng& rng, double scale = 1.0) {
  Eigen::Matrix<double, rows, columns> m;
  for (double& v : m.reshaped()) v = scale * rng.NextNormal();
  return m;
}

/// Normal force of a stance foot, and how far its pyramid is used.
Vec3 InsideCone(core::Rng& rng, double friction) {
  const double fz = 20.0 + 40.0 * rng.NextUniform();
  const auto share = [&] { return 1.8 * (rng.NextUniform() - 0.5) * friction; };
  return {fz * share(), fz * share(), fz};
}

void AddCosts(core::Rng& rng, TsidProblem& p) {
  p.G_BB.diagonal() << 1.0, 1.0, 1.0, 2.0, 2.0, 2.0;
  p.g_B = Normal<6, 1>(rng, 5.0);
  for (const Leg leg : kLegs) {
    p.G_Bl[leg].setZero();
    p.G_ll[leg].setZero();
    p.g_l[leg].setZero();
    const int at = 3 * static_cast<int>(leg);
    if (p.stance[leg]) {
      p.G_ff.block<3, 3>(at, at) = 0.1 * Mat3::Identity();
      p.g_f.segment<3>(at) = Normal<3, 1>(rng, 10.0);
      continue;
    }
    const Eigen::Matrix<double, 3, 9> J = Normal<3, 9>(rng);
    const Mat3 J_l = J.rightCols<3>();
    p.G_BB += J.leftCols<6>().transpose() * J.leftCols<6>();
    p.G_Bl[leg] = J.leftCols<6>().transpose() * J_l;
    p.G_ll[leg] = J_l.transpose() * J_l + 0.01 * Mat3::Identity();
    p.g_l[leg] = Normal<3, 1>(rng, 5.0);
  }
}

}  // namespace

LegArray<bool> SampleStance(int trial) {
  LegArray<bool> stance(true);
  if (trial % 3 != 0) stance[Leg::kFL] = false;
  if (trial % 3 == 2) stance[Leg::kHR] = false;
  return stance;
}

TsidProblem SampleTsid(core::Rng& rng, const LegArray<bool>& stance) {
  constexpr double kFriction = 0.5, kForceMin_N = 2.0;
  TsidProblem p;
  p.stance = stance;
  const Vec6 a = Normal<6, 1>(rng);
  p.H_BB = 8.0 * Mat6::Identity();
  p.h_B.setZero();
  Vec6 wrench = Vec6::Zero();
  TsidProblem::Cone cone;
  cone << -1, 0, kFriction, 1, 0, kFriction, 0, -1, kFriction, 0, 1, kFriction, 0, 0, 1;
  for (const Leg leg : kLegs) {
    const Mat3 L = Normal<3, 3>(rng, 0.3);
    p.H_ll[leg] = L * L.transpose() + 0.2 * Mat3::Identity();
    p.H_Bl[leg] = Normal<6, 3>(rng, 0.3);
    p.H_BB += p.H_Bl[leg] * p.H_ll[leg].inverse() * p.H_Bl[leg].transpose();
    p.h_l[leg] = Normal<3, 1>(rng, 3.0);
    p.J[leg] = 0.3 * Mat3::Identity() + Normal<3, 3>(rng, 0.05);
    p.J_B[leg] << Mat3::Identity(), -core::Skew(Normal<3, 1>(rng, 0.3));
    p.cone[leg] = cone;
    p.cone_min[leg] << 0, 0, 0, 0, kForceMin_N;
    const Vec3 qdd = Normal<3, 1>(rng, 3.0);
    Vec3 tau = p.H_Bl[leg].transpose() * a + p.H_ll[leg] * qdd + p.h_l[leg];
    if (stance[leg]) {
      const Vec3 f = InsideCone(rng, kFriction);
      tau -= p.J[leg].transpose() * f;
      wrench += p.J_B[leg].transpose() * f;
    }
    p.a_c[leg] = p.J_B[leg] * a + p.J[leg] * qdd;
    p.h_B -= p.H_Bl[leg] * qdd;
    const Vec3 margin = Vec3::Constant(0.5) + 20.0 * rng.NextUniform() * Vec3::Ones();
    p.tau_min[leg] = tau - margin;
    p.tau_max[leg] = tau + margin;
  }
  p.h_B += wrench - p.H_BB * a;
  AddCosts(rng, p);
  return p;
}

controller::OcpQp SampleOcp(core::Rng& rng, bool euler) {
  controller::OcpQp qp;
  qp.horizon = 6;
  qp.friction = 0.5;
  qp.f_min_N = 2.0;
  qp.f_max_N = 120.0;
  qp.start_force_N = 150.0;
  qp.forward_euler = euler;
  const double dt = 0.04;
  for (double& v : qp.x0) v = 0.1 * rng.NextNormal();
  for (int k = 0; k <= qp.horizon; ++k) {
    controller::OcpStage& s = qp.stages[static_cast<std::size_t>(k)];
    s.Q << Vec3::Constant(50.0), Vec3::Constant(80.0), Vec3::Constant(0.5), Vec3::Constant(10.0);
    s.q = -s.Q.cwiseProduct(0.1 * Vec12::Ones());
    if (k == qp.horizon) break;
    s.E = dt * Mat3::Identity();
    s.dt_s = dt;
    s.b[11] = -dt * 9.81;
    s.R.setConstant(2e-4);
    s.stance = k % 2 == 0 ? LegArray<bool>(true, false, false, true)
                          : LegArray<bool>(true, true, true, true);
    for (const Leg leg : kLegs) {
      if (!s.stance[leg]) continue;
      for (int i = 0; i < 3; ++i) {
        s.B(9 + i, 3 * static_cast<int>(leg) + i) = dt / 15.0;
        for (int j = 0; j < 3; ++j)
          s.B(6 + i, 3 * static_cast<int>(leg) + j) = dt * rng.NextNormal();
        if (!euler) s.B(3 + i, 3 * static_cast<int>(leg) + i) = 0.5 * dt * dt / 15.0;
      }
    }
  }
  return qp;
}

}  // namespace scoria::test
