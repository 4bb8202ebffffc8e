// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

namespace scoria::analysis {

/// What a test is to achieve: level (two-sided), and probability of seeing an effect that is there.
struct TestGoal {
  double alpha = 0.05, power = 0.8;
};

/// Probability that the exact test of the rate ratio (EstimateRateRatio) rejects, for two arms with
/// equal exposures: a sum over the Poisson total of the events; above 1000 of them the normal
/// approximation on log rates ([Lehr1992]).
/// @param events  expected of the arm with the lower rate, >= 0. @param ratio  of the other's rate
/// to it, >= 1. @param alpha in (0, 1), two-sided.
[[nodiscard]] double RatePower(double events, double ratio, double alpha);

/// The smallest rate ratio above 1 that this budget detects, if the lower rate is `rate`. Infinite
/// where none below 10 000 would do.
/// @param dispersion  index of CheckShares: falls that are over-dispersed tell as much as so many
/// times fewer metres; below 1 it counts as 1.
[[nodiscard]] double DetectableRatio(double rate, double exposure_each, const TestGoal& goal = {},
                                     double dispersion = 1.0);

/// Exposure of each arm that it takes to detect a rate ratio. Infinite for a ratio of 1 or without
/// events.
/// @param rate  of one arm. @param ratio  > 0, of the other arm's rate to it.
[[nodiscard]] double ExposureForRatio(double rate, double ratio, const TestGoal& goal = {},
                                      double dispersion = 1.0);

/// Probability that Student's test of `pairs` paired differences rejects.
/// @param effect_size  mean over standard deviation of the differences.
[[nodiscard]] double PairedPower(double effect_size, long pairs, double alpha);

/// The smallest effect size that so many pairs detect. Infinite for fewer than two pairs, and where
/// none below 1000 would do.
[[nodiscard]] double DetectableEffect(long pairs, const TestGoal& goal = {});

/// The fewest pairs that detect an effect size; nothing above a million.
[[nodiscard]] std::optional<long> PairsForEffect(double effect_size, const TestGoal& goal = {});

}  // namespace scoria::analysis
