// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/print_estimation.h"

#include <numbers>

#include <fmt/format.h>

namespace scoria::app {

void PrintEstimation(const char* what, const analysis::EstimationMetrics& m) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const analysis::DriftSummary drift = analysis::SummariseDrift(m);
  fmt::print(
      "  {:9} drift {:.2f} % horizontal, {:.2f} % vertical, {:.3f} deg/m yaw; velocity {:.4f} m/s, "
      "roll {:.2f} deg, pitch {:.2f} deg RMSE; {}contact {:.2f} % right\n",
      what, drift.horizontal_pct, drift.vertical_pct, drift.yaw_deg_per_m, m.velocity_rmse_mps,
      m.roll_rmse_rad * kDegrees, m.pitch_rmse_rad * kDegrees,
      m.nees_rows > 0 ? fmt::format("NEES/5 {:.2f}; ", m.nees_ratio) : "",
      100.0 * m.contact.of(analysis::ContactWord::kCounted).Accuracy());
}

}  // namespace scoria::app
