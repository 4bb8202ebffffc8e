// SPDX-License-Identifier: BSD-3-Clause
#include "controller/model/lag.h"

#include <cmath>

#include "core/math/low_pass.h"

namespace scoria::controller {

Lag CalcLag(double delay_s, double bandwidth_Hz, double cutoff_Hz, double dt_s) noexcept {
  return {static_cast<std::size_t>(std::lround(delay_s / dt_s)),
          bandwidth_Hz > 0.0 ? core::LowPassShare(core::TimeConstant_s(bandwidth_Hz), dt_s) : 1.0,
          core::LowPassShare(core::TimeConstant_s(cutoff_Hz), dt_s)};
}

}  // namespace scoria::controller
