// SPDX-License-Identifier: BSD-3-Clause
#include "core/rate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace scoria::core {
namespace {

int OrThrow(double rate_Hz, double step_s) {
  if (const std::optional<int> steps = StepsBetween(rate_Hz, step_s)) return *steps;
  throw std::invalid_argument(RateProblem(rate_Hz, step_s));
}

}  // namespace

std::optional<int> StepsBetween(double rate_Hz, double step_s) noexcept {
  if (std::isinf(rate_Hz)) return 1;
  constexpr double kRounding = 1e-6, kMost = 1e9;
  const double steps = 1.0 / (rate_Hz * step_s), whole = std::round(steps);
  if (!(whole >= 1.0 && whole <= kMost) || std::abs(steps - whole) > kRounding * whole)
    return std::nullopt;
  return static_cast<int>(whole);
}

std::string RateProblem(double rate_Hz, double step_s) {
  if (StepsBetween(rate_Hz, step_s)) return "";
  const double fewer = std::max(1.0, std::floor(1.0 / (rate_Hz * step_s)));
  const std::string nearest =
      rate_Hz * step_s > 1.0 ? fmt::format("the highest rate is {:.4g} Hz", 1.0 / step_s)
                             : fmt::format("the nearest rates are {:.4g} and {:.4g} Hz",
                                           1.0 / (fewer * step_s), 1.0 / ((fewer + 1.0) * step_s));
  return fmt::format("{} Hz is no whole number of physics steps of {} s; {}", rate_Hz, step_s,
                     nearest);
}

RateDivider::RateDivider(double rate_Hz, double step_s)
    : every_steps_(OrThrow(rate_Hz, step_s)), interval_s_(every_steps_ * step_s) {}

}  // namespace scoria::core
