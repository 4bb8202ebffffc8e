// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>

#include "core/robot/description.h"
#include "core/robot/state.h"

class btMultiBody;
class btMultiBodyConstraint;

namespace scoria::sim {

/// Impulses of the rows of a joint, N m s: rotor and damper, friction, lower and upper limit.
inline constexpr std::size_t kRowsPerJoint = 4;
using JointRowImpulses = std::array<std::array<double, kRowsPerJoint>, kNumJoints>;

/// What acts in the joints beside the motors' torques, as rows of Bullet's constraint solver: for
/// each joint one of rotor inertia and viscous damping, one of Coulomb friction, and one of a limit
/// that is near. The rows of a joint have the same Jacobian, whose response is computed once.
class JointRows {
 public:
  /// `robot` and `body` are borrowed.
  JointRows(const core::RobotDescription& robot, btMultiBody& body);
  ~JointRows();
  JointRows(const JointRows&) = delete;
  JointRows& operator=(const JointRows&) = delete;

  /// Sets the rows for a step from `state`.
  /// @param guess  from which the iteration starts.
  void Prepare(const RobotState& state, const JointRowImpulses& guess);
  [[nodiscard]] std::array<btMultiBodyConstraint*, kNumJoints>& constraints() noexcept {
    return constraints_;
  }
  /// Of the last step.
  [[nodiscard]] JointRowImpulses impulses() const;
  /// Of damping, friction and limits in the last step, N m s; the rotors' is inertia and no load.
  [[nodiscard]] LegArray<Vec3> Loads(const RobotState& after, double dt_s) const;

 private:
  class Drive;
  std::array<std::unique_ptr<Drive>, kNumJoints> drives_;
  std::array<btMultiBodyConstraint*, kNumJoints> constraints_{};
};

}  // namespace scoria::sim
