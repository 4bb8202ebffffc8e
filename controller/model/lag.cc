// SPDX-License-Identifier: BSD-3-Clause
#include "controller/model/lag.h"

#include <cmath>
#include <numbers>

namespace scoria::controller {

double LowPassShare(double cutoff_Hz, double dt_s) noexcept {
  return 1.0 - std::exp(-2.0 * std::numbers::pi * cutoff_Hz * dt_s);
}

Lag CalcLag(double delay_s, double bandwidth_Hz, double cutoff_Hz, double dt_s) noexcept {
  return {static_cast<std::size_t>(std::lround(delay_s / dt_s)),
          bandwidth_Hz > 0.0 ? LowPassShare(bandwidth_Hz, dt_s) : 1.0,
          LowPassShare(cutoff_Hz, dt_s)};
}

}  // namespace scoria::controller
