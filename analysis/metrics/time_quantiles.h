// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace scoria::analysis {

struct TimeQuantiles {
  double median_s = 0.0, p99_s = 0.0, max_s = 0.0;
  int count = 0;
};

/// Counts durations in bins one per cent wide, so that a day of walking takes no more room than a
/// minute.
class TimeHistogram {
 public:
  void Add(double time_s);
  [[nodiscard]] TimeQuantiles Summarise() const;

 private:
  static constexpr double kShortest_s = 1e-8, kWidth = 0.01;  // of the logarithm
  static constexpr std::size_t kBins = 2303;                  // up to 100 s
  std::array<long, kBins> counts_{};
  double longest_s_ = 0.0;
  long count_ = 0;
};

}  // namespace scoria::analysis
