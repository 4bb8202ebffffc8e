// SPDX-License-Identifier: BSD-3-Clause
#include "controller/safety/supervisor.h"

#include <algorithm>

namespace scoria::controller {
namespace {

double Ramp(double from, bool up, double step) noexcept {
  return std::clamp(from + (up ? step : -step), 0.0, 1.0);
}

}  // namespace

std::string_view FallbackName(Monitor monitor) noexcept {
  switch (monitor) {
    case Monitor::kMpc:
      return "equal forces";
    case Monitor::kBody:
      return "inverse dynamics";
    case Monitor::kEstimator:
      return "gravity, wide covariances";
    case Monitor::kContact:
      return "the hierarchy";
    case Monitor::kFooting:
      return "careful walking";
    case Monitor::kLoad:
      break;
  }
  return "standing, crouched";
}

const MonitorParams& Supervisor::ParamsOf(Monitor monitor) const noexcept {
  switch (monitor) {
    case Monitor::kMpc:
      return params_.mpc;
    case Monitor::kBody:
      return params_.body;
    case Monitor::kEstimator:
      return params_.estimator;
    case Monitor::kContact:
      return params_.contact;
    case Monitor::kFooting:
      return params_.footing;
    case Monitor::kLoad:
      break;
  }
  return params_.load;
}

void Supervisor::Note(Monitor monitor, const State& state, double quality) noexcept {
  transitions_.list[transitions_.count++] = {monitor, state.fallen_back, quality,
                                             ParamsOf(monitor).least_quality,
                                             state.fallen_back ? state.unsound_s : state.sound_s};
}

/// Unsound time adds up and sound time takes from it; sound time must be without a break.
void Supervisor::UpdateMonitor(Monitor monitor, double quality, double dt_s) noexcept {
  const MonitorParams& params = ParamsOf(monitor);
  State& state = states_[static_cast<std::size_t>(monitor)];
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
  if (state.fallen_back != before) Note(monitor, state, quality);
}

void Supervisor::Update(const Qualities& qualities, double dt_s) noexcept {
  transitions_.count = 0;
  for (std::size_t i = 0; i < kNumMonitors; ++i)
    UpdateMonitor(static_cast<Monitor>(i), qualities[i], dt_s);
  const double step = params_.ramp_s > dt_s ? dt_s / params_.ramp_s : 1.0;
  care_ = Ramp(care_, HasFallenBack(Monitor::kFooting), step);
  crouch_ = Ramp(crouch_, HasFallenBack(Monitor::kLoad), step);
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
