// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/sequential_sign_test.h"

#include <cmath>

namespace scoria::analysis {

void SequentialSignTest::Add(double difference) noexcept {
  if (difference == 0.0) return;
  squares_ += difference * difference;
  ++count_;
  const double z = difference / std::sqrt(squares_ / count_);
  for (std::size_t i = 0; i < kSlopes.size(); ++i) {
    // exp(x) / cosh(x) = 2 / (1 + exp(-2 x)).
    greater_[i] += std::log(2.0) - std::log1p(std::exp(-2.0 * kSlopes[i] * z));
    less_[i] += std::log(2.0) - std::log1p(std::exp(2.0 * kSlopes[i] * z));
  }
  evidence_.Update(LogEvidence(alternative_, greater_, less_));
}

}  // namespace scoria::analysis
