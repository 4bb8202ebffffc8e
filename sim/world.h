// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "core/robot/description.h"
#include "core/robot/state.h"
#include "terrains/heightfield.h"

namespace scoria::sim {

/// Numbers of the physics engine. Time itself is the runner's: one Step is `step_s`.
struct PhysicsParams {
  double step_s = 0.001;
  int max_solver_iterations = 50;
  double solver_residual = 1e-14;  // of squared velocity
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("step_s", step_s, {.min = 1e-4, .max = 2e-3});
    a.Field("max_solver_iterations", max_solver_iterations, {.min = 5, .max = 1000});
    a.Field("solver_residual", solver_residual,
            {.min = 0.0, .max = 1e-6, .doc = "(m/s)^2 at which the contact solver stops"});
  }
};

/// The true state of the robot and of its contacts after a step. Forces act on the robot.
struct Truth {
  RobotState state;
  Vec3 a_WB = Vec3::Zero();             // m/s^2, mean over the last step
  LegArray<Vec3> p_WF = ZeroPerLeg();   // foot sphere centres
  LegArray<Vec3> f_F_W = ZeroPerLeg();  // N, ground on foot
  LegArray<double> f_normal_N;          // its share along the ground's normal
  LegArray<double> penetration_m;       // > 0 inside the ground
  double trunk_force_N = 0.0;           // magnitude of all ground force on the trunk
  bool operator==(const Truth&) const = default;
};

/// One quadruped on one ground in Bullet. Feet touch the ground's bicubic surface in one contact
/// each; trunk, thighs and shanks touch Bullet's triangulated heightfield. Copying is not possible;
/// build a new world per episode.
class World {
 public:
  /// `robot` and `ground` are borrowed and must outlive the world.
  World(const core::RobotDescription& robot, const terrains::Heightfield& ground,
        const PhysicsParams& params, const Vec3& gravity_W);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Places the robot at rest or in motion; contact memory is forgotten.
  void Reset(const RobotState& state);

  /// Advances by one step under torques at the joints (motor side, after all actuation effects).
  void Step(const LegArray<Vec3>& tau_Nm);

  [[nodiscard]] const Truth& truth() const noexcept;

  /// Sets a constant external force and moment on the trunk, in W about B's COM, until changed.
  void SetTrunkWrench(const Vec3& f_W, const Vec3& t_W);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scoria::sim
