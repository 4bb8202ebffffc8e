// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "core/robot/description.h"
#include "core/robot/state.h"
#include "sim/payload.h"
#include "sim/sliding_payload.h"
#include "terrains/heightfield.h"

namespace scoria::test {

struct MujocoOptions {
  double gravity_mps2 = 9.81;
  double step_s = 0.001;
  bool joint_losses = false;                              // damping and friction of the motors
  const terrains::Heightfield* ground = nullptr;          // with feet and bodies that touch it
  std::vector<sim::PayloadParams> payloads = {};          // welded to the trunk
  std::optional<sim::SlidingPayloadParams> sliding = {};  // the last joint
};

/// A robot in MuJoCo, an independent physics engine: free joint, twelve hinges with armature, a
/// site at every foot.
class MujocoModel {
 public:
  MujocoModel(const core::RobotDescription& robot, const MujocoOptions& options);

  /// Sets the state and computes everything that depends on it. MuJoCo's free joint: linear
  /// velocity in W, angular in B.
  void Set(const RobotState& state);
  void SetTorques(const LegArray<Vec3>& tau_Nm);
  [[nodiscard]] RobotState state() const;

  struct Deleter {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  std::unique_ptr<mjModel, Deleter> model;
  std::unique_ptr<mjData, Deleter> data;
};

}  // namespace scoria::test
