// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "core/robot/whole_body.h"
#include "sim/plant/contact_point.h"

namespace scoria::sim {

/// When the iteration over contacts and joints stops.
struct SolverParams {
  int max_iterations = 100;
  double residual = 1e-14;  // of squared velocity, m^2/s^2
};

/// What moves the robot during one step; borrowed for a call.
struct StepInput {
  const core::WholeBody& wb;          // H + A, h and kinematics at the start
  const core::SpatialInertia& trunk;  // with all that is fixed to it, in B
  const LegArray<Vec3>& tau_Nm;       // of the motors, at the joints
  Vec6 wrench_B_W = Vec6::Zero();     // on the trunk, N and N m about B's origin
  double dt_s = 0.0;
};

struct StepResult {
  RobotState state;                             // at the end of the step
  LegArray<Vec3> joint_impulse = ZeroPerLeg();  // N m s, of damping, friction and limits
  int iterations = 0;                           // of the contact solver
};

/// Dynamics of one robot: how it moves under torques, and what the contacts bear. Whatever the
/// scenario sees besides is made of its result by Plant, the same for every engine.
class Engine {
 public:
  virtual ~Engine() = default;
  /// One step from in.wb.state. Rotor inertia, damping, friction and limits of the joints act
  /// inside it.
  /// @param contacts  impulses are returned in place; velocities only where the ground remembers.
  [[nodiscard]] virtual StepResult Step(const StepInput& in, std::span<ContactPoint> contacts) = 0;
  /// Forgets the last step, from whose impulses the next one may start.
  virtual void Reset() noexcept = 0;
  /// The copy goes on with the same bits; it borrows what this one borrows.
  [[nodiscard]] virtual std::unique_ptr<Engine> Clone() const = 0;
};

}  // namespace scoria::sim
