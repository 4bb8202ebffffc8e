// SPDX-License-Identifier: BSD-3-Clause
#include "logs/interval_histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace scoria::logs {
namespace {

constexpr int kBitsKept = 10;  // leading ones of a magnitude: 512 bins per power of two

/// Of the bin that a duration falls into; grows with it.
std::int32_t BinOf(std::int64_t interval_ns) {
  const auto bits = static_cast<std::uint64_t>(interval_ns);
  const std::uint64_t magnitude = interval_ns < 0 ? ~bits + 1 : bits;
  const int dropped = std::max(0, static_cast<int>(std::bit_width(magnitude)) - kBitsKept);
  const auto bin = static_cast<std::int32_t>(
      (static_cast<std::uint64_t>(dropped) << (kBitsKept - 1)) + (magnitude >> dropped));
  return interval_ns < 0 ? -bin : bin;
}

}  // namespace

void IntervalHistogram::Add(std::int64_t interval_ns) {
  Bin& bin = bins_[BinOf(interval_ns)];
  ++bin.count;
  ++count_;
  bin.mean_ns += (static_cast<double>(interval_ns) - bin.mean_ns) / static_cast<double>(bin.count);
}

double IntervalHistogram::Quantile_ns(double share) const {
  const auto rank = static_cast<std::uint64_t>(share * static_cast<double>(count_ - 1));
  std::uint64_t below = 0;
  for (const auto& [number, bin] : bins_) {
    below += bin.count;
    if (below > rank) return bin.mean_ns;
  }
  return bins_.rbegin()->second.mean_ns;
}

std::uint64_t IntervalHistogram::CountWithin(double low_ns, double high_ns) const {
  std::uint64_t within = 0;
  for (const auto& [number, bin] : bins_) {
    if (bin.mean_ns >= low_ns && bin.mean_ns <= high_ns) within += bin.count;
  }
  return within;
}

}  // namespace scoria::logs
