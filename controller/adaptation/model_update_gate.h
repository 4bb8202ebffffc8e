// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/adaptation/adaptation_params.h"
#include "controller/adaptation/model_adapter.h"
#include "core/robot/description.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

/// Turns an excess over the nominal robot, Δπ = [Δm; Δ(m c_x); Δ(m c_y)] of a point mass at a known
/// height in B, into what the controller is told. Masses stay positive and the trunk's centre of
/// mass inside the rectangle of its hips.
class ModelUpdateGate {
 public:
  /// `robot` is borrowed.
  ModelUpdateGate(const UpdateGateParams& params, const core::RobotDescription& robot) noexcept;

  /// The nearest Δπ that a robot can have.
  [[nodiscard]] Vec3 Clamp(const Vec3& dpi) const noexcept;

  /// @param nominal  the unloaded robot at its pose.
  /// @param P        covariance of Δπ.
  [[nodiscard]] Adaptation Update(const Vec3& dpi, const Mat3& P, const core::WholeBody& nominal,
                                  double dt_s) noexcept;

  /// Goes on from a trunk that the controller acts on already. @returns its Δπ.
  Vec3 Continue(const core::ModelParameters& in_use) noexcept;

  [[nodiscard]] const UpdateGateParams& params() const noexcept { return params_; }

 private:
  [[nodiscard]] core::ModelParameters CalcTrunk(const Vec3& dpi) const noexcept;

  UpdateGateParams params_;
  const core::RobotDescription& robot_;
  Vec2 hips_m_ = Vec2::Zero();  // half sides of the rectangle
  Vec3 goal_ = Vec3::Zero();    // last of each of Δπ that was sure enough
  Vec3 used_ = Vec3::Zero();    // Δπ of the controller's model
};

}  // namespace scoria::controller
