// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>

namespace scoria::logs {

/// How often durations of which length occur, of any sign. Memory is bounded, whatever is added:
/// bins are as wide as 1/512 of what they hold, and know the mean of it, so that equal durations
/// are exact.
class IntervalHistogram {
 public:
  void Add(std::int64_t interval_ns);

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }

  /// The mean of the bin that holds the quantile. @pre count() > 0, share in [0, 1].
  [[nodiscard]] double Quantile_ns(double share) const;

  /// How many lie between these bounds, both included, as far as bins tell.
  [[nodiscard]] std::uint64_t CountWithin(double low_ns, double high_ns) const;

 private:
  struct Bin {
    std::uint64_t count = 0;
    double mean_ns = 0.0;
  };
  std::map<std::int32_t, Bin> bins_;
  std::uint64_t count_ = 0;
};

}  // namespace scoria::logs
