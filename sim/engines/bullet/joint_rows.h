// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>

#include "core/robot/description.h"
#include "core/robot/state.h"
#include "sim/engines/bullet/joint_inertia.h"

class btMultiBody;
class btMultiBodyConstraint;

namespace scoria::sim {

/// Impulses of the rows of a joint, N m s: friction, lower and upper limit.
inline constexpr std::size_t kRowsPerJoint = 3;
using JointRowImpulses = std::array<std::array<double, kRowsPerJoint>, kNumJoints>;

/// What has bounds in the joints, as rows of Bullet's constraint solver: for each joint one of
/// Coulomb friction, and one of a limit that is near. The rows of a joint have the same Jacobian
/// and response.
class JointRows {
 public:
  /// `robot` and `body` are borrowed.
  JointRows(const core::RobotDescription& robot, btMultiBody& body);
  ~JointRows();
  JointRows(const JointRows&) = delete;
  JointRows& operator=(const JointRows&) = delete;

  /// Sets the rows for a step from `state`.
  /// @param inertia  of this step.
  /// @param guess  from which the iteration starts.
  void Prepare(const RobotState& state, const JointInertia& inertia, const JointRowImpulses& guess);
  [[nodiscard]] std::array<btMultiBodyConstraint*, kNumJoints>& constraints() noexcept {
    return constraints_;
  }
  /// Of the last step.
  [[nodiscard]] JointRowImpulses impulses() const;
  /// Of damping, friction and limits in the last step, N m s.
  [[nodiscard]] LegArray<Vec3> Loads(const RobotState& after, double dt_s) const;

 private:
  class Drive;
  std::array<std::unique_ptr<Drive>, kNumJoints> drives_;
  std::array<btMultiBodyConstraint*, kNumJoints> constraints_{};
};

}  // namespace scoria::sim
