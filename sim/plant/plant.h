// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "core/robot/description.h"
#include "core/robot/state.h"
#include "core/robot/whole_body.h"
#include "sim/ground_law.h"
#include "sim/payload.h"
#include "sim/plant/truth.h"
#include "sim/sliding_payload.h"
#include "terrains/heightfield.h"

namespace scoria::sim {

/// scoria's own dynamics: StepSolver on the whole-body model.
struct ScoriaDynamics {
  static constexpr const char* kType = "scoria";
  template <class Archive>
  void Serialize(Archive&) {}
  bool operator==(const ScoriaDynamics&) const = default;
};

/// Bullet's dynamics: btMultiBody and its constraint solver. Knows neither plastic ground nor a
/// sliding payload.
struct BulletDynamics {
  static constexpr const char* kType = "bullet";
  template <class Archive>
  void Serialize(Archive&) {}
  bool operator==(const BulletDynamics&) const = default;
};

using EngineParams = std::variant<ScoriaDynamics, BulletDynamics>;

/// Numbers of the physics engine. Time itself is the runner's: one Step is `step_s`.
struct PhysicsParams {
  double step_s = 0.001;
  int max_solver_iterations = 100;
  double solver_residual = 1e-14;  // of squared velocity
  GroundParams ground = ElasticGround{};
  EngineParams engine = ScoriaDynamics{};
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("step_s", step_s, {.min = 1e-4, .max = 2e-3});
    a.Field("max_solver_iterations", max_solver_iterations, {.min = 5, .max = 1000});
    a.Field("solver_residual", solver_residual,
            {.min = 0.0, .max = 1e-6, .doc = "(m/s)^2 at which the contact solver stops"});
    a.Field("ground", ground, {.doc = "what the ground remembers of a foot"});
    a.Field("engine", engine,
            {.doc = "what moves the robot: scoria's step solver, or Bullet's btMultiBody"});
  }
};

[[nodiscard]] std::string EngineName(const EngineParams& engine);

/// What of a scenario's physics the engine cannot express, with its key; empty if nothing.
[[nodiscard]] std::string EngineProblem(const PhysicsParams& params, bool has_sliding_payload);

/// One quadruped on one ground. Bullet finds the contacts: feet touch the ground's bicubic surface
/// in one contact each; trunk, thighs and shanks touch its triangulated heightfield. An Engine
/// moves the robot.
class Plant {
 public:
  /// `robot` and `ground` are borrowed and must outlive the plant.
  /// @pre EngineProblem() is empty.
  Plant(const core::RobotDescription& robot, const terrains::Heightfield& ground,
        const PhysicsParams& params, const Vec3& gravity_W,
        const std::optional<SlidingPayloadParams>& sliding = std::nullopt);
  ~Plant();
  /// The copy goes on where the original is, with the same bits under the same torques; neither
  /// touches the other. Both borrow the same robot and ground.
  Plant(const Plant& other);
  Plant& operator=(const Plant&) = delete;

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
