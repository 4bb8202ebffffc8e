// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "analysis/statistics/e_process.h"
#include "analysis/statistics/paired_counts.h"

namespace scoria::analysis {

/// Sequential test of "the rate of a is `null_ratio` times that of b" for falls that are Poisson
/// given the terrain, however hard it is: of the falls on a terrain, a's are binomial. One-sided,
/// it also holds for "at most" (kGreater) or "at least" (kLess) that many times. Terrains that
/// treat the arms differently are not covered: see SequentialSignTest.
///
/// E is the likelihood ratio of the binomial counts, averaged over rate ratios of 1.25, 1.5, 2, 3,
/// 5, 10 and 30 times the null's, or their inverses, or both.
/// Source: mixture of [Robbins1970], conditional on the totals as [Przyborowski1940].
class SequentialRatioTest {
 public:
  explicit SequentialRatioTest(Alternative alternative = Alternative::kTwoSided,
                               double null_ratio = 1.0) noexcept
      : alternative_(alternative), null_ratio_(null_ratio) {}

  /// @param terrain  counts of the next one; exposures > 0.
  void Add(const PairedCounts& terrain) noexcept;
  [[nodiscard]] const EProcess& evidence() const noexcept { return evidence_; }

 private:
  static constexpr std::array<double, 7> kRatios = {1.25, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0};
  Alternative alternative_;
  double null_ratio_;
  std::array<double, kRatios.size()> greater_{}, less_{};  // log of the likelihood ratios
  EProcess evidence_;
};

}  // namespace scoria::analysis
