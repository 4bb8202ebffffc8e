// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/time_quantiles.h"

#include <algorithm>
#include <cmath>

namespace scoria::analysis {

void TimeHistogram::Add(double time_s) {
  const double bin = std::log(time_s / kShortest_s) / kWidth;
  ++counts_[static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0))];
  longest_s_ = std::max(longest_s_, time_s);
  ++count_;
}

TimeQuantiles TimeHistogram::Summarise() const {
  TimeQuantiles q{0.0, 0.0, longest_s_, static_cast<int>(count_)};
  if (count_ == 0) return q;
  const auto at = [&](double share) {
    const auto rank = static_cast<long>(share * static_cast<double>(count_ - 1));
    long below = 0;
    std::size_t bin = 0;
    while (below + counts_[bin] <= rank) below += counts_[bin++];
    const double middle_s = kShortest_s * std::exp((static_cast<double>(bin) + 0.5) * kWidth);
    return std::min(middle_s, longest_s_);
  };
  q.median_s = at(0.5);
  q.p99_s = at(0.99);
  return q;
}

}  // namespace scoria::analysis
