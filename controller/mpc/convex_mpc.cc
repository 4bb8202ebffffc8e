// SPDX-License-Identifier: BSD-3-Clause
#include "controller/mpc/convex_mpc.h"

#include <algorithm>

#include <Eigen/LU>

#include "core/math/so3.h"

namespace scoria::controller {
namespace {

Vec12 WeightVector(const MpcWeights& w) noexcept {
  Vec12 q;
  q << w.rpy, w.position, w.angular_velocity, w.velocity;
  return 2.0 * q;  // the QP has a factor one half
}

Vec12 StateOf(const Vec3& rpy, const Vec3& p, const Vec3& w, const Vec3& v) noexcept {
  Vec12 x;
  x << rpy, p, w, v;
  return x;
}

}  // namespace

bool MpcInput::StandsAt(Leg leg, int stage) const noexcept {
  if (stage == 0) return legs.InContact(leg);
  if (legs.mode[leg] == LegMode::kEarlyContact &&
      stage * contacts.dt_s < contacts.swing_remaining_s[leg])
    return true;
  return contacts.stage_stance[static_cast<std::size_t>(stage)][leg];
}

ConvexMpc::ConvexMpc(const MpcParams& params, const core::RobotDescription& robot,
                     double gravity_mps2)
    : params_(params),
      foot_radius_m_(robot.legs[Leg::kFL].foot_radius_m),
      gravity_mps2_(gravity_mps2),
      solver_(params.solver) {}

void ConvexMpc::Build(const MpcInput& in) noexcept {
  const core::WholeBody& wb = in.wb;
  const double dt = params_.stage_s;
  const auto& reference = in.reference.stages;
  Vec3 rpy = core::RpyFromRotation(wb.state.R_WB);
  rpy.z() = core::UnwrapNear(rpy.z(), reference[0].rpy_rad.z());
  R_WT_ = GroundFrame(in.reference.n_W, rpy.z());

  qp_.horizon = params_.horizon;
  qp_.friction = params_.friction;
  qp_.f_min_N = params_.f_min_N;
  qp_.f_max_N = params_.f_max_N;
  qp_.start_force_N = wb.mass_kg * gravity_mps2_;
  qp_.forward_euler = true;
  qp_.x0 = StateOf(rpy, wb.p_WC, wb.state.w_WB, wb.v_WC);
  const Vec12 weights = WeightVector(in.contacts.standing ? params_.stand : params_.move);
  const Vec3 contact_offset = -foot_radius_m_ * in.reference.n_W;

  for (int k = 0; k <= params_.horizon; ++k) {
    const auto i = static_cast<std::size_t>(k);
    OcpStage& stage = qp_.stages[i];
    const BodyReference::Stage& ref = reference[i];
    stage.Q = weights;
    stage.q = -weights.cwiseProduct(StateOf(ref.rpy_rad, ref.p_WC, ref.w_WB, ref.v_WC));
    if (k == params_.horizon) break;

    const Mat3 turn = core::RotationZ(ref.rpy_rad.z() - rpy.z());
    const Mat3 I_inverse = (turn * wb.I_C_W * turn.transpose()).inverse();
    const Vec3 p_WC =
        wb.p_WC + ref.p_WC - reference[0].p_WC;  // the reference motion from where we are
    stage.E = dt * core::RotationZ(ref.rpy_rad.z()).transpose();
    stage.dt_s = dt;
    stage.b.setZero();
    stage.b[11] = -dt * gravity_mps2_;
    stage.R.setConstant(2.0 * params_.force_weight);
    stage.r.setZero();
    stage.B.setZero();
    for (const Leg leg : kLegs) {
      stage.stance[leg] = in.StandsAt(leg, k);
      if (!stage.stance[leg]) continue;
      const Vec3& foot = in.footholds.stage[i][leg];
      const Vec3 r = foot + contact_offset - p_WC;
      const int column = 3 * static_cast<int>(leg);
      stage.B.block<3, 3>(6, column) = dt * I_inverse * core::Skew(r) * R_WT_;
      stage.B.block<3, 3>(9, column) = dt / wb.mass_kg * R_WT_;
    }
  }
}

ForcePlan ConvexMpc::ToPlan() const noexcept {
  const OcpSolution& solution = solver_.solution();
  ForcePlan plan;
  plan.valid = true;
  plan.dt_s = params_.stage_s;
  for (int k = 0; k < ForcePlan::kStages; ++k) {
    const auto i = static_cast<std::size_t>(
        std::min(k, params_.horizon - 1));  // a shorter horizon repeats its last stage
    const auto to = static_cast<std::size_t>(k);
    const Vec12& x = solution.x[i];
    plan.body[to] = {x.segment<3>(0), x.segment<3>(3), x.segment<3>(6), x.segment<3>(9)};
    plan.stance[to] = qp_.stages[i].stance;
    for (const Leg leg : kLegs) {
      plan.f_F_W[to][leg] = R_WT_ * solution.u[i].segment<3>(3 * static_cast<int>(leg));
    }
  }
  for (const Leg leg : kLegs) {
    for (int k = 0; k < params_.horizon; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (!qp_.stages[i].stance[leg]) continue;
      plan.f_next_F_W[leg] = R_WT_ * solution.u[i].segment<3>(3 * static_cast<int>(leg));
      break;
    }
  }
  return plan;
}

MpcResult ConvexMpc::Solve(const MpcInput& in) noexcept {
  Build(in);
  const OcpSolution& solution = solver_.Solve(qp_);
  MpcResult result;
  result.status = solution.status;
  result.iterations = solution.iterations;
  if (IsUsable(result.status)) result.plan = ToPlan();
  return result;
}

}  // namespace scoria::controller
