// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/statistics/interval.h"

namespace scoria::analysis {

/// How long something lasted: to its event (metres to the first fall), or to the end of observation
/// without one (censored).
struct Lifetime {
  double length = 0.0;
  bool event = false;
};

/// Kaplan-Meier estimate of the share that lasts longer than `length`, after the events there.
struct SurvivalStep {
  double length = 0.0;
  long at_risk = 0, events = 0;  // just before, and there
  double survival = 1.0;
  Interval band;  // pointwise
};

struct SurvivalCurve {
  std::vector<SurvivalStep> steps;  // at every length with an event, rising
  std::vector<double> censored;     // lengths, rising
  double end = 0.0;                 // the longest length
  /// Smallest length that at most half survive; nothing where more do.
  [[nodiscard]] std::optional<double> Median() const noexcept;
};

/// The band is Greenwood's variance on the scale of log(-log S), which stays within [0, 1]; where S
/// is 0 it reaches from 0 to the step before. Lifetimes censored at the length of an event are at
/// risk there.
/// @param confidence in (0, 1). Source: [KaplanMeier1958], [Kalbfleisch2002].
[[nodiscard]] SurvivalCurve EstimateSurvival(std::span<const Lifetime> lifetimes,
                                             double confidence = 0.95);

}  // namespace scoria::analysis
