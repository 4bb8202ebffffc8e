// SPDX-License-Identifier: BSD-3-Clause
#include "app/run/walk_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scoria::app {

double CommandedWay(const OperatorParams& operation, double duration_s) {
  constexpr double kStandUp_s = 3.0;
  const double walking_s = std::max(0.0, duration_s - kStandUp_s);
  if (const auto* route = std::get_if<RouteParams>(&operation))
    return std::min(route->distance_m, route->speed_mps * walking_s);
  const std::vector<VelocityStep>& steps = std::get<VelocityProgramme>(operation).steps;
  double way_m = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double until_s =
        i + 1 < steps.size() ? std::min(steps[i + 1].at_s, walking_s) : walking_s;
    way_m +=
        std::hypot(steps[i].v_x_mps, steps[i].v_y_mps) * std::max(0.0, until_s - steps[i].at_s);
  }
  return way_m;
}

std::string DescribeFailure(const EpisodeResult& result, double commanded_m) {
  constexpr double kCommanded_m = 0.5, kWalked_m = 0.1;
  if (result.end == EpisodeEnd::kInterrupted) return "";
  if (result.end == EpisodeEnd::kNonFinite)
    return fmt::format("the state is not finite after {:.3f} s", result.duration_s);
  if (commanded_m > kCommanded_m && !(result.walked_m >= kWalked_m))
    return fmt::format("walked {:.2f} m where {:.2f} m were commanded", result.walked_m,
                       commanded_m);
  return "";
}

}  // namespace scoria::app
