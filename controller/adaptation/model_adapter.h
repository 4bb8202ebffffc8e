// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <variant>

#include "controller/adaptation/adaptation_params.h"
#include "controller/model/momentum_observer.h"
#include "core/robot/contact.h"
#include "core/robot/description.h"
#include "core/robot/state.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

struct AdapterInput {
  const RobotState& state;  // as estimated
  const SensorFrame& z;     // checked: finite
  const ContactEstimate& contact;
  double dt_s = 0.001;   // since the last call
  bool at_work = false;  // the robot operates and is upright; else what was learned is held
};

/// What is believed of the robot's mass, and how much of it the controller should act on.
struct Adaptation {
  double mass_kg = 0.0;              // of the whole robot; 0: nothing is learned
  Vec3 p_BC = Vec3::Zero();          // of its centre of mass, in B; z as the payload's height says
  Mat3 P = Mat3::Zero();             // covariance of [m kg, m c_x kg m, m c_y kg m]
  core::ModelParameters parameters;  // of the trunk, for gait, MPC and WBC: justified and smooth
  bool changed = false;              // `parameters` is not the last call's
  bool tared = false;                // the readings at the known mass were taken, or none asked for
  double quality = 0.0;              // 0..1: how sure, against what the update gate asks for
  bool operator==(const Adaptation&) const = default;
};

/// Learns mass and centre of mass while the robot works. One call per physics step; the filters
/// themselves run slower, on means. Noexcept, no allocation.
class ModelAdapter {
 public:
  virtual ~ModelAdapter() = default;
  [[nodiscard]] virtual const Adaptation& Update(const AdapterInput& in) noexcept = 0;
  /// Goes on from what the controller acts on now, as another adapter left it.
  virtual void Continue(const core::ModelParameters& in_use) noexcept = 0;
  /// A copy that goes on with the same bits; what is borrowed stays borrowed.
  [[nodiscard]] virtual std::unique_ptr<ModelAdapter> Clone() const = 0;
};

/// @param robot     borrowed; its model is the known, unloaded robot.
/// @param observer  of the contact forces that the adapter will be given.
[[nodiscard]] std::unique_ptr<ModelAdapter> MakeModelAdapter(const AdapterParams& params,
                                                             const core::RobotDescription& robot,
                                                             double gravity_mps2,
                                                             const ObserverParams& observer = {});

}  // namespace scoria::controller
