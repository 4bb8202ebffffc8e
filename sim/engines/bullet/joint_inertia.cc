// SPDX-License-Identifier: BSD-3-Clause
#include "sim/engines/bullet/joint_inertia.h"

#include <Eigen/Cholesky>

namespace scoria::sim {

JointInertia::JointInertia(const core::MotorParams& motors)
    : armature_kgm2_(motors.armature_kgm2.replicate<4, 1>()),
      damping_Nms_per_rad_(motors.damping_Nms_per_rad.replicate<4, 1>()) {}

void JointInertia::Prepare(const Responses& V, double dt_s) {
  using Mat12 = Eigen::Matrix<double, kNumJoints, kNumJoints>;
  resistance_kgm2_ = armature_kgm2_ + dt_s * damping_Nms_per_rad_;
  const Vec12 r = resistance_kgm2_.cwiseSqrt();
  const Responses Vr = V * r.asDiagonal();
  const Mat12 S = Mat12::Identity() + r.asDiagonal() * Vr.bottomRows<kNumJoints>();
  const Eigen::LLT<Mat12> cholesky(S);
  W_ = cholesky.matrixL().solve(Vr.transpose()).transpose();
  responses_ = V - W_ * W_.bottomRows<kNumJoints>().transpose();
}

double JointInertia::Correct(const Eigen::Ref<const Velocities>& j,
                             Eigen::Ref<Velocities> response) const noexcept {
  const Vec12 along = W_.transpose() * j;
  response -= W_ * along;
  return along.squaredNorm();
}

JointInertia::Velocities JointInertia::FreeChange(const Vec12& before_radps,
                                                  const Vec12& free_radps) const noexcept {
  const Vec12 impulses_Nms =
      armature_kgm2_.cwiseProduct(before_radps) - resistance_kgm2_.cwiseProduct(free_radps);
  return responses_ * impulses_Nms;
}

}  // namespace scoria::sim
