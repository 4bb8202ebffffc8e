// SPDX-License-Identifier: BSD-3-Clause
#include "sim/battery.h"

#include <algorithm>
#include <cmath>

namespace scoria::sim {

Battery::Battery(const core::BatteryParams& params) noexcept : params_(params) {
  state_.charge = params.start_charge;
  state_.voltage_V = params.empty_V + params.start_charge * (params.full_V - params.empty_V);
}

void Battery::Draw(double power_W, double dt_s) noexcept {
  const double open_V = params_.empty_V + state_.charge * (params_.full_V - params_.empty_V);
  const double R = params_.resistance_Ohm;
  // P = (V_open − I R) I, the smaller root.
  const double root = std::sqrt(std::max(0.0, open_V * open_V - 4.0 * R * power_W));
  state_.current_A = R > 0.0 ? (open_V - root) / (2.0 * R) : power_W / open_V;
  state_.voltage_V = open_V - R * state_.current_A;
  state_.delivered_J += open_V * state_.current_A * dt_s;
  constexpr double kSecondsPerHour = 3600.0;
  state_.charge = std::max(
      0.0, state_.charge - state_.current_A * dt_s / (kSecondsPerHour * params_.capacity_Ah));
}

}  // namespace scoria::sim
