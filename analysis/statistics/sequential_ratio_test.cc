// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/sequential_ratio_test.h"

#include <cmath>

namespace scoria::analysis {
namespace {

/// Share of the falls that are a's, if its rate is `ratio` times b's.
double Share(const PairedCounts& terrain, double ratio) {
  return ratio * terrain.exposure_a / (ratio * terrain.exposure_a + terrain.exposure_b);
}

double LogLikelihoodRatio(const PairedCounts& terrain, double ratio, double null_ratio) {
  const double share = Share(terrain, ratio), null_share = Share(terrain, null_ratio);
  return static_cast<double>(terrain.events_a) * std::log(share / null_share) +
         static_cast<double>(terrain.events_b) * std::log((1.0 - share) / (1.0 - null_share));
}

}  // namespace

void SequentialRatioTest::Add(const PairedCounts& terrain) noexcept {
  for (std::size_t i = 0; i < kRatios.size(); ++i) {
    greater_[i] += LogLikelihoodRatio(terrain, null_ratio_ * kRatios[i], null_ratio_);
    less_[i] += LogLikelihoodRatio(terrain, null_ratio_ / kRatios[i], null_ratio_);
  }
  evidence_.Update(LogEvidence(alternative_, greater_, less_));
}

}  // namespace scoria::analysis
