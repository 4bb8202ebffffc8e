// SPDX-License-Identifier: BSD-3-Clause
#include "controller/safety/supervisor.h"

#include <algorithm>

namespace scoria::controller {
namespace {

double Ramp(double from, bool up, double step) noexcept {
  return std::clamp(from + (up ? step : -step), 0.0, 1.0);
}

}  // namespace

std::string_view FallbackName(Watch watch) noexcept {
  switch (watch) {
    case Watch::kMpc:
      return "equal forces";
    case Watch::kBody:
      return "inverse dynamics";
    case Watch::kEstimator:
      return "gravity, wide covariances";
    case Watch::kContact:
      return "the hierarchy";
    case Watch::kFooting:
      return "careful walking";
    case Watch::kLoad:
      break;
  }
  return "standing, crouched";
}

const WatchParams& Supervisor::ParamsOf(Watch watch) const noexcept {
  switch (watch) {
    case Watch::kMpc:
      return params_.mpc;
    case Watch::kBody:
      return params_.body;
    case Watch::kEstimator:
      return params_.estimator;
    case Watch::kContact:
      return params_.contact;
    case Watch::kFooting:
      return params_.footing;
    case Watch::kLoad:
      break;
  }
  return params_.load;
}

void Supervisor::Note(Watch watch, const State& state, double quality) noexcept {
  transitions_.list[transitions_.count++] = {watch, state.fallen_back, quality,
                                             ParamsOf(watch).least_quality,
                                             state.fallen_back ? state.unsound_s : state.sound_s};
}

/// Unsound time adds up and is taken back by sound time; sound time must be without a break.
void Supervisor::UpdateWatch(Watch watch, double quality, double dt_s) noexcept {
  const WatchParams& params = ParamsOf(watch);
  State& state = states_[static_cast<std::size_t>(watch)];
  const bool on = params_.enabled && params.enabled;
  const bool sound = quality >= params.least_quality;  // false also if not a number
  state.unsound_s = std::max(0.0, state.unsound_s + (sound ? -dt_s : dt_s));
  state.sound_s = sound ? state.sound_s + dt_s : 0.0;
  const bool before = state.fallen_back;
  if (!on) {
    state = {};
  } else if (before) {
    state.unsound_s = std::min(state.unsound_s, params.after_s);
    state.fallen_back = state.sound_s < params.recover_s;
  } else {
    state.fallen_back = !sound && state.unsound_s > params.after_s;
  }
  if (state.fallen_back != before) Note(watch, state, quality);
}

void Supervisor::Update(const Qualities& qualities, double dt_s) noexcept {
  transitions_.count = 0;
  for (std::size_t i = 0; i < kNumWatches; ++i)
    UpdateWatch(static_cast<Watch>(i), qualities[i], dt_s);
  const double step = params_.ramp_s > dt_s ? dt_s / params_.ramp_s : 1.0;
  care_ = Ramp(care_, HasFallenBack(Watch::kFooting), step);
  crouch_ = Ramp(crouch_, HasFallenBack(Watch::kLoad), step);
}

Command Supervisor::Temper(const Command& command, double nominal_height_m) const noexcept {
  const double share = (1.0 - care_ * (1.0 - params_.careful_speed_share)) * (1.0 - crouch_);
  Command tempered = command;
  tempered.v_x_mps *= share;
  tempered.v_y_mps *= share;
  tempered.w_z_radps *= share;
  const double height_m = command.height_m > 0.0 ? command.height_m : nominal_height_m;
  if (crouch_ > 0.0) tempered.height_m = height_m * (1.0 - crouch_ * (1.0 - params_.crouch_share));
  return tempered;
}

}  // namespace scoria::controller
