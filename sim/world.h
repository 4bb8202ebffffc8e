// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "core/robot/description.h"
#include "core/robot/state.h"
#include "core/robot/whole_body.h"
#include "sim/ground_law.h"
#include "sim/payload.h"
#include "sim/sliding_payload.h"
#include "sim/step_solver.h"
#include "terrains/heightfield.h"

namespace scoria::sim {

/// Numbers of the physics engine. Time itself is the runner's: one Step is `step_s`.
struct PhysicsParams {
  double step_s = 0.001;
  int max_solver_iterations = 100;
  double solver_residual = 1e-14;  // of squared velocity
  GroundParams ground = ElasticGround{};
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("step_s", step_s, {.min = 1e-4, .max = 2e-3});
    a.Field("max_solver_iterations", max_solver_iterations, {.min = 5, .max = 1000});
    a.Field("solver_residual", solver_residual,
            {.min = 0.0, .max = 1e-6, .doc = "(m/s)^2 at which the contact solver stops"});
    a.Field("ground", ground, {.doc = "what the ground remembers of a foot"});
  }
};

/// Where the robot's mechanical energy came from and went, J since Reset. Whatever the sum of works
/// does not explain of the change of energy is the integrator's error. What payloads bring and take
/// is external work; the damper of a sliding one is a joint.
struct EnergyLedger {
  Work work;
  double kinetic_J = 0.0, potential_J = 0.0;  // now; rotors included, potential from z = 0
  double initial_J = 0.0;                     // kinetic and potential at Reset
  [[nodiscard]] double Error_J() const noexcept {
    return kinetic_J + potential_J - initial_J -
           (work.motor_J + work.joint_J + work.contact_J + work.external_J);
  }
  bool operator==(const EnergyLedger&) const = default;
};

/// The true state of the robot and of its contacts after a step. Forces act on the robot.
struct Truth {
  RobotState state;
  Vec3 a_WB = Vec3::Zero();               // m/s^2, mean over the last step
  Vec3 p_WC = Vec3::Zero();               // centre of mass, payloads included
  double mass_kg = 0.0;                   // likewise
  core::SpatialInertia trunk;             // with all that is fixed to it
  double slide_m = 0.0, slide_mps = 0.0;  // of a sliding payload
  LegArray<Vec3> p_WF = ZeroPerLeg();     // foot sphere centres
  LegArray<Vec3> f_F_W = ZeroPerLeg();    // N, ground on foot
  LegArray<double> f_normal_N;            // its share along the ground's normal
  LegArray<bool> contact;                 // f_normal_N above 5 N on a Go2, as much on others
  LegArray<double> penetration_m;         // > 0 inside the ground
  double trunk_force_N = 0.0;             // magnitude of all ground force on the trunk
  EnergyLedger energy;
  bool operator==(const Truth&) const = default;
};

/// One quadruped on one ground. Bullet finds the contacts: feet touch the ground's bicubic surface
/// in one contact each; trunk, thighs and shanks touch its triangulated heightfield. StepSolver
/// moves the robot.
class World {
 public:
  /// `robot` and `ground` are borrowed and must outlive the world.
  World(const core::RobotDescription& robot, const terrains::Heightfield& ground,
        const PhysicsParams& params, const Vec3& gravity_W,
        const std::optional<SlidingPayloadParams>& sliding = std::nullopt);
  ~World();
  /// The copy goes on where the original is, with the same bits under the same torques; neither
  /// touches the other. Both borrow the same robot and ground.
  World(const World& other);
  World& operator=(const World&) = delete;

  /// Places the robot at rest or in motion; contact memory is forgotten. Payloads stay on it.
  void Reset(const RobotState& state);

  /// Advances by one step under torques at the joints (motor side). Rotor inertia, damping and
  /// friction of the joints act inside the step.
  void Step(const LegArray<Vec3>& tau_Nm);

  [[nodiscard]] const Truth& truth() const noexcept;
  [[nodiscard]] int solver_iterations() const noexcept;  // of the last step
  /// Steps so far that stopped at the limit of iterations, as a robot that lies on many points may.
  [[nodiscard]] std::int64_t unconverged_steps() const noexcept;

  /// Sets a constant external force and moment on the trunk, in W about the bare trunk's COM, until
  /// changed.
  void SetTrunkWrench(const Vec3& f_W, const Vec3& t_W);

  /// Scales the friction of all of the ground from the next step on; stays over Reset.
  /// @pre scale >= 0.
  void SetFrictionScale(double scale);

  /// Takes a sliding payload off: it goes on with the velocity it has, the robot with its own. No
  /// effect without one.
  void RemoveSlidingPayload();

  /// Changes mass, centre of mass and inertia of the trunk between two steps. Where what was added
  /// moved with the trunk (kMatched), all velocities stay. Where it was at rest (kRest), it joins
  /// in a perfectly plastic impact, H' v' = H v over all coordinates, so the robot's linear and
  /// angular momentum stay; the acceleration of the next step contains that impact.
  /// @pre  the mass is positive, and the inertia with it.
  void SetTrunkParameters(const core::SpatialInertia& trunk, AttachVelocity attach_velocity);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scoria::sim
