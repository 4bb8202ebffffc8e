// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "controller/controller.h"
#include "core/hash.h"
#include "core/rng.h"
#include "sim/actuation.h"
#include "sim/payload.h"
#include "sim/plant/plant.h"
#include "sim/sensors/sensors.h"

namespace scoria::test {

struct LoopParams {
  sim::PhysicsParams physics;
  sim::SensorParams sensors = sim::RealisticSensors{};
  std::vector<sim::SensorFault> sensor_faults;
  std::vector<sim::PayloadEvent> payloads;
  std::optional<sim::SlidingPayloadParams> sliding;
  controller::ControllerParams controller;
  controller::Start::Pose pose = controller::Start::Pose::kStanding;
  double fault_share = 0.0;  // of ticks at which either solver fails
};

/// Plant, payloads, sensors, controller and motors step by step, as an episode has them: stands for
/// 0.5 s, then walks forwards in a wide turn. A copy is a clone of every part.
class ClosedLoop {
 public:
  /// `robot` and `ground` are borrowed.
  ClosedLoop(const LoopParams& params, const core::RobotDescription& robot,
             const terrains::Heightfield& ground);

  void Step();
  void Run(int steps);

  /// Over everything that every step so far has brought.
  [[nodiscard]] std::uint64_t hash() const noexcept { return hash_.value(); }
  [[nodiscard]] int steps() const noexcept { return step_; }
  [[nodiscard]] const controller::ControlOutput& control() const noexcept { return control_; }

  /// What of the truth the controller is given in place of its own findings.
  struct Substitute {
    bool state = false, contact = false, trunk = false, ground = false;
  };
  Substitute substitute;

  sim::Plant plant;
  sim::PayloadRack payloads;
  sim::Actuation actuation;
  sim::Sensors sensors;
  controller::Controller controller;
  Command walk{.v_x_mps = 0.35, .w_z_radps = 0.2};

 private:
  [[nodiscard]] controller::TrueInputs CollectTrueInputs(const SensorFrame& z) const;
  void Add(const SensorFrame& z);

  const terrains::Heightfield& ground_;
  LoopParams params_;
  core::Rng fault_rng_;
  core::Hash64 hash_;
  controller::ControlOutput control_;
  int step_ = 0;
};

}  // namespace scoria::test
