// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "analysis/statistics/e_process.h"

namespace scoria::analysis {

/// Sequential test of "the paired differences are symmetric about zero", which holds, whatever
/// their distribution, where swapping the two of a pair changes nothing: two controllers of the
/// same quality on the same seeds. No variance need be known and no normality assumed; differences
/// of falls between terrains may be over-dispersed.
///
/// The n-th difference d with the root mean square r of the differences so far, this one included,
/// gives the factor exp(κ d / r) / cosh(κ d / r), whose expectation is 1 given |d| and the past.
/// Their products are averaged over six κ from 1/8 to 4. A factor is below 2: level α takes at
/// least log2(1 / α) pairs, and a few more, because of the average. Zeros count for nothing.
/// Source: [DeLaPena1999], [Ramdas2020], tests of symmetry; mixture after
/// [Robbins1970].
class SequentialSignTest {
 public:
  explicit SequentialSignTest(Alternative alternative = Alternative::kTwoSided) noexcept
      : alternative_(alternative) {}

  /// @param difference  of the next pair, finite; in any order that does not depend on it.
  void Add(double difference) noexcept;
  [[nodiscard]] const EProcess& evidence() const noexcept { return evidence_; }

 private:
  static constexpr std::array<double, 6> kSlopes = {0.125, 0.25, 0.5, 1.0, 2.0, 4.0};
  Alternative alternative_;
  std::array<double, kSlopes.size()> greater_{}, less_{};  // log of the products
  double squares_ = 0.0;
  int count_ = 0;  // that are not zero
  EProcess evidence_;
};

}  // namespace scoria::analysis
