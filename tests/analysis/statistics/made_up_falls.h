// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/statistics/paired_counts.h"
#include "core/rng.h"
#include "tests/analysis/statistics/gamma.h"

namespace scoria::test {

/// Falls of two arms: Poisson, with rates drawn from a gamma distribution for each terrain
/// (negative binomial counts over terrains).
struct FallModel {
  double falls = 1.0;     // expected of arm b on a terrain
  double ratio = 1.0;     // of a's to b's
  int terrain_shape = 0;  // of the gamma distribution that both arms share; 0: none
  int arm_shape = 0;      // likewise, drawn for each arm
};

inline std::vector<analysis::PairedCounts> MakeFalls(const FallModel& model, int terrains,
                                                     std::uint64_t seed) {
  constexpr double kExposure_m = 50.0;
  core::Rng rng(seed, 0, core::Stream::kOperator);
  std::vector<analysis::PairedCounts> counts;
  for (int i = 0; i < terrains; ++i) {
    const double mean = model.falls * DrawGamma(rng, model.terrain_shape);
    const int a = rng.NextPoisson(model.ratio * mean * DrawGamma(rng, model.arm_shape));
    const int b = rng.NextPoisson(mean * DrawGamma(rng, model.arm_shape));
    counts.push_back({a, b, kExposure_m, kExposure_m});
  }
  return counts;
}

}  // namespace scoria::test
