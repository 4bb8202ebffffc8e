// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "controller/adaptation/model_adapter.h"
#include "controller/estimation/contact_estimator.h"
#include "controller/estimation/sample_guard.h"
#include "controller/estimation/state_estimator.h"
#include "controller/model/model_params.h"
#include "core/clone_ptr.h"
#include "core/robot/counters.h"
#include "core/robot/local_ground.h"
#include "core/robot/plans.h"
#include "core/robot/whole_body.h"
#include "core/robot/world_shift.h"

namespace scoria::controller {

/// The parts of ControllerParams that turn samples into contacts, state and mass.
struct SensingParams {
  SampleGuardParams samples;
  ContactParams contact;
  EstimatorParams estimator;
  AdapterParams adaptation;
  ModelParams model = {};
  bool operator==(const SensingParams&) const = default;
};

/// @returns true if a stage needs SensorFrame::truth.
[[nodiscard]] bool NeedsTruth(const SensingParams& params) noexcept;

/// The truth in place of what one stage finds, for one step: to see what would have happened if
/// that stage had been right. Stages run on all the same, and what comes after them takes the
/// truth. An empty field changes nothing.
struct TrueInputs {
  /// In place of the estimated state, in the true world. Place and heading at which the
  /// substitution begins stay those of the estimate, since the plans in force are laid out in its
  /// world.
  std::optional<RobotState> state;
  std::optional<LegArray<bool>> contact;       // in place of the fused contact
  std::optional<core::ModelParameters> trunk;  // in place of the adapted model
  /// The ground itself in place of the plane through the last footholds: footholds lie on it, and
  /// the plane that body and swing keep to is laid through it. Borrowed for the step.
  const LocalGround* ground = nullptr;
};

/// What is planned and known beside the samples.
struct SensingContext {
  const ContactPlan& contacts;  // in force
  double contacts_age_s = 0.0;  // since they were planned
  GroundPlane plane;            // through the last footholds
  bool operating = false;       // false: the robot rests and waits for its attitude
};

/// What one step of sensing finds.
struct Sensed {
  ContactEstimate contact;
  StateEstimate estimate;
  Adaptation adaptation;
};

/// Samples in; contacts, state, mass and the whole-body model at that state out. It runs before
/// the plans in the controller, and alone on the samples of a log. Step neither throws, allocates,
/// prints nor locks; a copy goes on with the same bits and borrows the same robot.
class Sensing {
 public:
  /// @param robot   borrowed.
  /// @param step_s  time between two calls of Step.
  /// @param known   model from before; none: the nominal one with the offset of the parameters.
  Sensing(const SensingParams& params, const core::RobotDescription& robot, double gravity_mps2,
          double step_s, const Placement& placement,
          const std::optional<core::ModelParameters>& known);

  const Sensed& Step(const SensorFrame& raw, const SensingContext& context,
                     const TrueInputs& true_inputs, Counters& counters) noexcept;

  /// Changes variants and parameters between two steps; stages that do not change are not touched,
  /// new ones go on from what the last step found. Allocates.
  void Reconfigure(const SensingParams& params);

  /// Changes where contacts come from; nothing that was learned is lost.
  void SetContactChoice(ContactChoice choice) noexcept { contact_->SetChoice(choice); }

  /// The estimate goes on from `from`, as StateEstimator::Continue says.
  void ContinueEstimate(const StateEstimate& from, double sigma_scale) noexcept {
    estimator_->Continue(from, sigma_scale);
  }

  [[nodiscard]] const Sensed& sensed() const noexcept { return sensed_; }
  /// At the last estimate.
  [[nodiscard]] const core::WholeBody& wb() const noexcept { return wb_; }
  [[nodiscard]] const core::WholeBodyModel& model() const noexcept { return model_; }
  /// The last frame, checked.
  [[nodiscard]] const SensorFrame& last_samples() const noexcept { return samples_.last(); }

 private:
  void ActOn(const core::ModelParameters& model) noexcept;
  void SubstituteState(const TrueInputs& true_inputs) noexcept;
  void UpdateModel(const TrueInputs& true_inputs) noexcept;

  SensingParams params_;
  const core::RobotDescription& robot_;
  double step_s_;
  core::WholeBodyModel model_;
  SampleGuard samples_;
  std::optional<ContactEstimator> contact_;
  core::ClonePtr<StateEstimator> estimator_;
  core::ClonePtr<ModelAdapter> adapter_;
  bool started_ = false;
  core::WholeBody wb_;
  std::optional<core::WorldShift> from_truth_;  // to the estimate's world, while that is replaced
  bool model_is_true_ = false;
  Sensed sensed_;
};

}  // namespace scoria::controller
