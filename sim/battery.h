// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/robot/description.h"

namespace scoria::sim {

/// What a battery delivers while the robot draws power from it.
struct BatteryState {
  double voltage_V = 0.0, current_A = 0.0;
  double charge = 1.0;       // share of the capacity that is left
  double delivered_J = 0.0;  // by the cells, inner losses included
  bool operator==(const BatteryState&) const = default;
};

/// Open-circuit voltage linear in charge behind an inner resistance. A power beyond what the
/// resistance lets through draws the current of the greatest power.
class Battery {
 public:
  explicit Battery(const core::BatteryParams& params) noexcept;
  void Draw(double power_W, double dt_s) noexcept;
  [[nodiscard]] const BatteryState& state() const noexcept { return state_; }

 private:
  core::BatteryParams params_;
  BatteryState state_;
};

}  // namespace scoria::sim
