// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/ratio_of_ratios.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "analysis/statistics/interval.h"

namespace scoria::analysis {
namespace {

/// Events of a in the first setting, given the margins of the table of four.
class Hypergeometric {
 public:
  explicit Hypergeometric(const CountsInTwoSettings& c)
      : first_(c.first.events_a + c.first.events_b),
        second_(c.second.events_a + c.second.events_b),
        of_a_(c.first.events_a + c.second.events_a) {}

  [[nodiscard]] long least() const { return std::max(0L, of_a_ - second_); }
  [[nodiscard]] long most() const { return std::min(first_, of_a_); }

  /// P(from <= X <= to) at the given odds.
  [[nodiscard]] double Share(long from, long to, double log_odds) const {
    double largest = -kInfinity;
    for (long k = least(); k <= most(); ++k) largest = std::max(largest, LogWeight(k, log_odds));
    double inside = 0.0, all = 0.0;
    for (long k = least(); k <= most(); ++k) {
      const double weight = std::exp(LogWeight(k, log_odds) - largest);
      all += weight;
      if (from <= k && k <= to) inside += weight;
    }
    return inside / all;
  }

 private:
  static double LogChoose(long n, long k) {
    const auto log_factorial = [](long x) { return std::lgamma(static_cast<double>(x) + 1.0); };
    return log_factorial(n) - log_factorial(k) - log_factorial(n - k);
  }
  [[nodiscard]] double LogWeight(long k, double log_odds) const {
    return LogChoose(first_, k) + LogChoose(second_, of_a_ - k) + static_cast<double>(k) * log_odds;
  }

  long first_, second_, of_a_;
};

/// Where a share that rises with the odds reaches a value, by bisection.
template <class Share>
double LogOddsWhere(Share share, double value) {
  double low = -50.0, high = 50.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (share(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

RatioEstimate Exact(const CountsInTwoSettings& c, double confidence) {
  const Hypergeometric table(c);
  const long x = c.first.events_a;
  const double log_exposures = std::log(c.first.exposure_a * c.second.exposure_b /
                                        (c.first.exposure_b * c.second.exposure_a));
  const auto at_least = [&](double odds) { return table.Share(x, table.most(), odds); };
  const auto more_than = [&](double odds) { return table.Share(x + 1, table.most(), odds); };
  const double tail = 0.5 * (1.0 - confidence);
  RatioEstimate r;
  r.ratio = static_cast<double>(c.first.events_a * c.second.events_b) /
            static_cast<double>(c.first.events_b * c.second.events_a) * std::exp(-log_exposures);
  r.interval.low =
      x == table.least() ? 0.0 : std::exp(LogOddsWhere(at_least, tail) - log_exposures);
  r.interval.high =
      x == table.most() ? kInfinity : std::exp(LogOddsWhere(more_than, 1.0 - tail) - log_exposures);
  r.p_value =
      std::min(1.0, 2.0 * std::min(at_least(log_exposures), 1.0 - more_than(log_exposures)));
  return r;
}

}  // namespace

RatioOfRatios CompareRatios(std::span<const CountsInTwoSettings> terrains, double confidence) {
  constexpr std::size_t kEnoughTerrains = 6;
  constexpr std::uint64_t kBootstrapSeed = 20251017;
  constexpr int kResamples = 2000;
  CountsInTwoSettings sum;
  for (const CountsInTwoSettings& t : terrains) sum += t;
  RatioOfRatios r;
  const auto any = [](const PairedCounts& c) { return c.events_a + c.events_b > 0; };
  if (!any(sum.first) || !any(sum.second)) {
    r.exact = {std::numeric_limits<double>::quiet_NaN(), {0.0, kInfinity}, 1.0};
    r.by_terrain = r.judged = r.exact;
    return r;
  }
  r.exact = r.judged = Exact(sum, confidence);
  r.by_terrain = BootstrapRatioOfRatios(terrains, kBootstrapSeed, kResamples, confidence);
  if (terrains.size() < kEnoughTerrains) return r;
  r.judged.interval = {std::min(r.exact.interval.low, r.by_terrain.interval.low),
                       std::max(r.exact.interval.high, r.by_terrain.interval.high)};
  r.judged.p_value = std::max(r.exact.p_value, r.by_terrain.p_value);
  return r;
}

}  // namespace scoria::analysis
