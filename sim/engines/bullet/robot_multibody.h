// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/robot/description.h"
#include "core/robot/state.h"

class btMultiBody;
class btMultiBodyLinkCollider;

namespace scoria::sim {

/// A robot as one btMultiBody. Bullet wants the base at its COM and diagonal inertias, so every
/// body has a frame D at its COM along its principal axes. Damping, sleeping and limits of velocity
/// are off.
class RobotMultiBody {
 public:
  /// `robot` is borrowed for the call.
  /// @param trunk  with all that is fixed to it, in B.
  RobotMultiBody(const core::RobotDescription& robot, const core::SpatialInertia& trunk);
  ~RobotMultiBody();
  RobotMultiBody(const RobotMultiBody&) = delete;
  RobotMultiBody& operator=(const RobotMultiBody&) = delete;

  [[nodiscard]] btMultiBody& body() noexcept { return *body_; }
  [[nodiscard]] const core::SpatialInertia& trunk() const noexcept { return trunk_; }
  /// What stands for a body, as core::BodyIndex, in contacts.
  [[nodiscard]] btMultiBodyLinkCollider& collider(int body_index) noexcept {
    return *colliders_[static_cast<std::size_t>(body_index)];
  }

  void SetState(const RobotState& state);
  [[nodiscard]] RobotState state() const;

 private:
  core::SpatialInertia trunk_;
  Mat3 R_BD_ = Mat3::Identity();  // of the trunk
  std::unique_ptr<btMultiBody> body_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
};

}  // namespace scoria::sim
