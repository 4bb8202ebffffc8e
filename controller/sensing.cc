// SPDX-License-Identifier: BSD-3-Clause
#include "controller/sensing.h"

#include <utility>

namespace scoria::controller {
namespace {

core::ModelParameters WithMassOffset(core::ModelParameters model, double offset_kg) noexcept {
  model.trunk.mass_kg += offset_kg;
  return model;
}

}  // namespace

bool NeedsTruth(const SensingParams& params) noexcept {
  return NeedsTruth(params.contact) || NeedsTruth(params.estimator);
}

Sensing::Sensing(const SensingParams& params, const core::RobotDescription& robot,
                 double gravity_mps2, double step_s, const Placement& placement,
                 const std::optional<core::ModelParameters>& known)
    : params_(params),
      robot_(robot),
      step_s_(step_s),
      model_(robot, gravity_mps2),
      samples_(params.samples),
      contact_(std::in_place, params.contact, robot, gravity_mps2, step_s),
      estimator_(MakeStateEstimator(params.estimator, robot, gravity_mps2, placement)),
      adapter_(MakeModelAdapter(params.adaptation, robot, gravity_mps2, params.contact.observer)) {
  if (known) {
    ActOn(*known);
  } else if (params.model != ModelParams{}) {
    ActOn(WithMassOffset(model_.parameters(), params.model.mass_offset_kg));
  }
}

/// The model to go on with, until adaptation finds another.
void Sensing::ActOn(const core::ModelParameters& model) noexcept {
  model_.SetParameters(model);
  adapter_->Continue(model);
}

const Sensed& Sensing::Step(const SensorFrame& raw, const SensingContext& context,
                            const TrueInputs& true_inputs, Counters& counters) noexcept {
  const CheckedFrame& checked = samples_.Check(raw, counters);
  if (!std::exchange(started_, true)) {
    RobotState at_hand;
    at_hand.q = checked.z.q;
    model_.Calc(at_hand, wb_);
  }
  sensed_.contact = contact_->Update({checked.z, wb_, context.contacts, context.contacts_age_s,
                                      context.plane, robot_.legs[Leg::kFL].foot_radius_m});
  if (true_inputs.contact) {
    sensed_.contact.contact = *true_inputs.contact;
    sensed_.contact.source = LegArray<ContactSource>(ContactSource::kTruth);
  }
  sensed_.estimate =
      estimator_->Update({checked.z, checked.imu_dt_s, checked.imu_saturated, sensed_.contact, wb_,
                          context.plane.Normal(), !context.operating},
                         counters);
  SubstituteState(true_inputs);
  sensed_.adaptation = adapter_->Update(
      {sensed_.estimate.state, checked.z, sensed_.contact, step_s_, context.operating});
  UpdateModel(true_inputs);
  model_.Calc(sensed_.estimate.state, wb_);
  return sensed_;
}

void Sensing::SubstituteState(const TrueInputs& true_inputs) noexcept {
  if (!true_inputs.state) {
    from_truth_.reset();
    return;
  }
  RobotState& state = sensed_.estimate.state;
  if (!from_truth_) from_truth_ = core::WorldShift::Between(*true_inputs.state, state);
  state = from_truth_->Apply(*true_inputs.state);
}

void Sensing::UpdateModel(const TrueInputs& true_inputs) noexcept {
  if (true_inputs.trunk) {
    model_.SetParameters(*true_inputs.trunk);
  } else if (sensed_.adaptation.changed || model_is_true_) {
    model_.SetParameters(sensed_.adaptation.parameters);
  }
  model_is_true_ = true_inputs.trunk.has_value();
}

void Sensing::Reconfigure(const SensingParams& params) {
  const SensingParams before = std::exchange(params_, params);
  const double gravity_mps2 = model_.gravity_mps2();
  ContactParams other_choice = before.contact;
  other_choice.source = params.contact.source;
  if (params.contact == other_choice) {
    contact_->SetChoice(params.contact.source);
  } else {
    contact_.emplace(params.contact, robot_, gravity_mps2, step_s_);
  }
  if (params.estimator != before.estimator) {
    estimator_ = MakeStateEstimator(params.estimator, robot_, gravity_mps2, {});
    estimator_->Continue(sensed_.estimate, 1.0);
  }
  if (params.adaptation != before.adaptation ||
      params.contact.observer != before.contact.observer) {
    adapter_ = MakeModelAdapter(params.adaptation, robot_, gravity_mps2, params.contact.observer);
    adapter_->Continue(model_.parameters());
  }
  if (params.model != before.model)
    ActOn(WithMassOffset(model_.parameters(),
                         params.model.mass_offset_kg - before.model.mass_offset_kg));
  samples_.set_params(params.samples);
}

}  // namespace scoria::controller
