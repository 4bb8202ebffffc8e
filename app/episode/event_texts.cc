// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/event_texts.h"

#include <fmt/format.h>

namespace scoria::app {

std::string DescribePush(const Push& push) {
  return fmt::format("{} N s over {} s", push.impulse_Ns, push.duration_s);
}

std::string DescribeChange(const ControllerChange& change) {
  return fmt::format("{}", fmt::join(change.set, ", "));
}

std::string DescribeSource(Leg leg, ContactSource source) {
  return fmt::format("{}: {}", LegName(leg), core::EnumName(source));
}

std::string DescribeTransition(const controller::Transition& t) {
  const std::string_view monitor = core::EnumName(t.monitor);
  return t.fell_back
             ? fmt::format("{}: fallback engaged, {} (quality {:.2f} below {:.2f}, {:.2f} s)",
                           monitor, controller::FallbackName(t.monitor), t.quality, t.least_quality,
                           t.lasted_s)
             : fmt::format("{}: fallback released (sound for {:.2f} s)", monitor, t.lasted_s);
}

std::string DescribePoorGround(const Place& place) {
  return fmt::format(
      "the robot hardly stands at x {:.3f} m, y {:.3f} m, the best place that the operator found",
      place.p_WB.x(), place.p_WB.y());
}

}  // namespace scoria::app
