// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/power.h"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/poisson.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "analysis/statistics/interval.h"

namespace scoria::analysis {
namespace {

using Binomial = boost::math::binomial_distribution<double>;
using Normal = boost::math::normal_distribution<double>;

/// Bisection of a rising condition on a logarithmic scale. @returns where it begins to hold.
/// @pre it holds at `high`.
template <class Condition>
double FirstWhere(double low, double high, Condition holds) {
  constexpr double kTolerance = 1e-4;
  while (high / low > 1.0 + kTolerance) {
    const double middle = std::sqrt(low * high);
    (holds(middle) ? high : low) = middle;
  }
  return high;
}

/// By the total number of events: the test rejects if one arm has at most `most` of them.
class ExactTest {
 public:
  explicit ExactTest(double alpha) : alpha_(alpha) {}
  /// @param total  not below the one before. @returns the probability of a rejection.
  double Power(long total, double share) {
    const double n = static_cast<double>(total);
    while (2 * (most_ + 1) < total && cdf(Binomial(n, 0.5), most_ + 1.0) <= 0.5 * alpha_) ++most_;
    if (most_ < 0) return 0.0;
    const Binomial events(n, share);
    const double most = static_cast<double>(most_);
    return cdf(events, most) + cdf(complement(events, n - most - 1.0));
  }

 private:
  double alpha_;
  long most_ = -1;
};

}  // namespace

double RatePower(double events, double ratio, double alpha) {
  constexpr double kManyEvents = 1000.0;
  if (events <= 0.0) return 0.0;
  const double total = events * (1.0 + ratio);
  if (total > kManyEvents) {
    const double error = std::sqrt(1.0 / events + 1.0 / (ratio * events));
    const double z = quantile(complement(Normal(), 0.5 * alpha)), shift = std::log(ratio) / error;
    return cdf(Normal(), shift - z) + cdf(Normal(), -shift - z);
  }
  const boost::math::poisson_distribution<double> totals(total);
  constexpr double kSpread = 8.0;  // standard deviations, beyond which nothing adds up
  const double half = kSpread * (1.0 + std::sqrt(total)), share = ratio / (1.0 + ratio);
  const auto first = static_cast<long>(std::max(1.0, total - half));
  const auto last = static_cast<long>(total + half);
  ExactTest test(alpha);
  double power = 0.0;
  for (long n = first; n <= last; ++n)
    power += pdf(totals, static_cast<double>(n)) * test.Power(n, share);
  return power;
}

double DetectableRatio(double rate, double exposure_each, const TestGoal& goal, double dispersion) {
  constexpr double kLargest = 1e4;
  if (rate <= 0.0 || exposure_each <= 0.0) return kInfinity;
  const double events = rate * exposure_each / std::max(1.0, dispersion);
  const auto seen = [&](double ratio) {
    return RatePower(events, ratio, goal.alpha) >= goal.power;
  };
  return seen(kLargest) ? FirstWhere(1.0, kLargest, seen) : kInfinity;
}

double ExposureForRatio(double rate, double ratio, const TestGoal& goal, double dispersion) {
  constexpr double kFewest = 1e-3, kMost = 1e9;
  if (rate <= 0.0 || ratio <= 0.0) return kInfinity;
  const double lower = rate * std::min(1.0, ratio), apart = std::max(ratio, 1.0 / ratio);
  const auto seen = [&](double events) {
    return RatePower(events, apart, goal.alpha) >= goal.power;
  };
  if (!seen(kMost)) return kInfinity;
  return FirstWhere(kFewest, kMost, seen) * std::max(1.0, dispersion) / lower;
}

double PairedPower(double effect_size, long pairs, double alpha) {
  if (pairs < 2) return 0.0;
  const double n = static_cast<double>(pairs), shift = std::abs(effect_size) * std::sqrt(n);
  const boost::math::students_t_distribution<double> student(n - 1.0);
  const double critical = quantile(complement(student, 0.5 * alpha));
  constexpr long kManyPairs = 300;  // from where the non-central t is as good as normal
  if (pairs > kManyPairs)
    return cdf(Normal(),
               (shift - critical) / std::sqrt(1.0 + 0.5 * critical * critical / (n - 1.0)));
  const boost::math::non_central_t_distribution<double> shifted(n - 1.0, shift);
  return cdf(complement(shifted, critical)) + cdf(shifted, -critical);
}

double DetectableEffect(long pairs, const TestGoal& goal) {
  constexpr double kSmallest = 1e-4, kLargest = 1e3;
  if (pairs < 2) return kInfinity;
  const auto seen = [&](double effect) {
    return PairedPower(effect, pairs, goal.alpha) >= goal.power;
  };
  return seen(kLargest) ? FirstWhere(kSmallest, kLargest, seen) : kInfinity;
}

std::optional<long> PairsForEffect(double effect_size, const TestGoal& goal) {
  constexpr long kMost = 1000000;
  const auto seen = [&](long n) { return PairedPower(effect_size, n, goal.alpha) >= goal.power; };
  if (!seen(kMost)) return std::nullopt;
  long low = 1, high = kMost;  // seen at `high` only
  while (high - low > 1) {
    const long middle = low + (high - low) / 2;
    (seen(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace scoria::analysis
