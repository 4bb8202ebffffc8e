// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/sequential_t_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <boost/math/distributions/students_t.hpp>

namespace scoria::analysis {

void SequentialTTest::Add(double difference) {
  constexpr std::array<double, 4> kVariances = {0.25, 1.0, 4.0, 16.0};
  sum_ += difference;
  squares_ += difference * difference;
  ++count_;
  if (squares_ == 0.0) return;
  const double n = count_, all = count_ + pilot_count_,
               direction = sum_ / std::sqrt(squares_);  // S
  const double sign = alternative_ == Alternative::kLess ? -1.0 : 1.0;
  std::array<double, kVariances.size()> log_e{};
  for (std::size_t i = 0; i < kVariances.size(); ++i) {
    const double g = kVariances[i], shrink = g / (1.0 + n * g);
    const double rest = 1.0 - direction * direction * shrink;  // > 0, since S² ≤ n
    log_e[i] = -0.5 * std::log1p(n * g) - 0.5 * all * std::log(rest);
    if (alternative_ == Alternative::kTwoSided) continue;
    const boost::math::students_t_distribution<double> t(all);
    const double share = cdf(t, sign * direction * std::sqrt(all * shrink / rest));
    log_e[i] += std::log(std::max(2.0 * share, std::numeric_limits<double>::min()));
  }
  evidence_.Update(LogMeanExp(log_e));
}

}  // namespace scoria::analysis
