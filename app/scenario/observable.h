// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace scoria::app {

/// Something of an episode that can be bounded.
struct Observable {
  /// A metric of the registry; how many times an event happened; how many times something did not
  /// go to plan (Count).
  enum class Source { kMetric, kEvent, kCounter };
  Source source = Source::kMetric;
  std::string key;     // of the metric, the event's kind, the counter's name
  double scale = 1.0;  // from the metric's unit to that of the name
  bool operator==(const Observable&) const = default;
};

/// All by name. A metric is there under its key, and under its key in the unit that is shown, each
/// with and without its family: height_rmse_m, height_rmse_mm, tracking.height_rmse_mm. Events are
/// events.KIND, counters are counters.NAME, and supervisor.MONITOR is how many times that monitor's
/// fallback was engaged.
using Observables = std::map<std::string, Observable, std::less<>>;
[[nodiscard]] Observables AllObservables();

/// @returns true for a name of the falls, or of the falls per metre.
[[nodiscard]] bool IsFallRate(std::string_view name);

/// @returns true for a name of a metric.
[[nodiscard]] bool IsMetric(std::string_view name);

/// What a unit is in a key, as "mmps" of "mm/s"; empty for a unit that no key has.
[[nodiscard]] std::string_view KeyOfUnit(std::string_view unit) noexcept;

}  // namespace scoria::app
