// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "core/rng.h"

namespace scoria::test {

/// A gamma variate of mean 1 and an integer shape: a sum of exponentials.
inline double DrawGamma(core::Rng& rng, int shape) {
  double sum = 0.0;
  for (int i = 0; i < shape; ++i) sum -= std::log(1.0 - rng.NextUniform()) / shape;
  return shape == 0 ? 1.0 : sum;
}

}  // namespace scoria::test
