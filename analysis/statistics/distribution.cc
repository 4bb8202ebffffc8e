// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/distribution.h"

#include <algorithm>
#include <cmath>

namespace scoria::analysis {
namespace {

constexpr double kLeast = 1e-6, kWidth = 0.02;  // of the logarithm

/// Lower edge of a bin.
double EdgeOf(std::size_t bin) {
  return bin == 0 ? 0.0 : kLeast * std::exp(kWidth * (static_cast<double>(bin) - 1.0));
}

}  // namespace

void Distribution::Add(double magnitude) noexcept {
  if (!std::isfinite(magnitude)) return;
  std::size_t bin = 0;
  if (magnitude >= kLeast) {
    const double steps = std::floor(std::log(magnitude / kLeast) / kWidth);
    bin = std::min(kBins - 1, 1 + static_cast<std::size_t>(steps));
  }
  ++bins_.counts[bin];
  ++count_;
}

double Distribution::Quantile(double share) const noexcept {
  const double wanted = share * static_cast<double>(count_);
  double below = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    const auto here = static_cast<double>(bins_.counts[bin]);
    if (here > 0.0 && below + here >= wanted)
      return bin == 0 ? 0.0
                      : EdgeOf(bin) + (EdgeOf(bin + 1) - EdgeOf(bin)) * (wanted - below) / here;
    below += here;
  }
  return EdgeOf(kBins);
}

}  // namespace scoria::analysis
