// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "analysis/statistics/histogram.h"

namespace scoria::analysis {

/// How often magnitudes occur: counts in bins 2 % wide, from 1e-6 to 1e4 in whatever unit. A day
/// of rows takes no more room than a minute, and a quantile is right within 2 %.
class Distribution {
 public:
  /// @param magnitude  not negative. What is smaller than the smallest bin counts as 0, what is
  /// larger than the largest as the largest; what is not finite is left out.
  void Add(double magnitude) noexcept;

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }

  /// The magnitude below which a share of them lies, interpolated within its bin.
  /// @param share  in [0, 1].   @pre count() > 0.
  [[nodiscard]] double Quantile(double share) const noexcept;

  bool operator==(const Distribution&) const = default;

 private:
  static constexpr std::size_t kBins = 1153;  // the first one: about 0

  BinCounts<kBins> bins_;
  std::uint64_t count_ = 0;
};

}  // namespace scoria::analysis
