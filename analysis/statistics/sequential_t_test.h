// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "analysis/statistics/e_process.h"

namespace scoria::analysis {

/// Sequential Student's t-test of "the mean of the paired differences is zero", for differences
/// that are normal: metrics that are averages over an episode. It needs fewer pairs for a large
/// effect than SequentialSignTest, but counts and values with few levels are not for it.
///
/// E is the likelihood ratio of the data up to scale, the standardised effect drawn from a normal
/// distribution of variance g about zero (of one sign for a one-sided test), averaged over g = 1/4,
/// 1, 4 and 16:
///   E_g = (1 + n g)^-1/2 (1 - S² g / (1 + n g))^-n/2,  S² = (Σ d)² / Σ d²,
/// and for one side twice that times the distribution function of Student's t with n degrees of
/// freedom.
/// Earlier values that tell the scale alone (a pilot) count in Σ d² and in the n of the exponent
/// and of the degrees of freedom, not in Σ d and in the other n: with many of them a large effect
/// shows in its first pair. If the differences spread less than the pilot, the test errs on the
/// safe side. Source: [Lai1976], [PerezOrtiz2024].
class SequentialTTest {
 public:
  /// Deviations of the differences' scale: the sum of their squares, and how many degrees of
  /// freedom they have.
  struct Pilot {
    double squares = 0.0;
    int count = 0;
  };
  explicit SequentialTTest(Alternative alternative = Alternative::kTwoSided) noexcept
      : SequentialTTest(alternative, Pilot()) {}
  SequentialTTest(Alternative alternative, const Pilot& pilot) noexcept
      : alternative_(alternative), squares_(pilot.squares), pilot_count_(pilot.count) {}

  /// @param difference  of the next pair, finite; in any order that does not depend on it.
  void Add(double difference);
  [[nodiscard]] const EProcess& evidence() const noexcept { return evidence_; }

 private:
  Alternative alternative_;
  double sum_ = 0.0, squares_ = 0.0;
  int pilot_count_ = 0, count_ = 0;
  EProcess evidence_;
};

}  // namespace scoria::analysis
