// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/survival.h"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/normal.hpp>

namespace scoria::analysis {

std::optional<double> SurvivalCurve::Median() const noexcept {
  for (const SurvivalStep& step : steps) {
    if (step.survival <= 0.5) return step.length;
  }
  return std::nullopt;
}

SurvivalCurve EstimateSurvival(std::span<const Lifetime> lifetimes, double confidence) {
  SurvivalCurve curve;
  std::vector<Lifetime> sorted(lifetimes.begin(), lifetimes.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const Lifetime& a, const Lifetime& b) { return a.length < b.length; });
  const double z = quantile(boost::math::normal_distribution<double>(), 0.5 + 0.5 * confidence);
  double survival = 1.0, greenwood = 0.0;
  Interval band{1.0, 1.0};
  for (std::size_t i = 0; i < sorted.size();) {
    SurvivalStep step{sorted[i].length, static_cast<long>(sorted.size() - i), 0, 1.0, {}};
    for (; i < sorted.size() && sorted[i].length == step.length; ++i) {
      if (sorted[i].event) ++step.events;
      if (!sorted[i].event) curve.censored.push_back(step.length);
    }
    curve.end = step.length;
    if (step.events == 0) continue;
    const double n = static_cast<double>(step.at_risk), d = static_cast<double>(step.events);
    survival *= 1.0 - d / n;
    if (step.at_risk == step.events) {
      survival = 0.0;
      band.low = 0.0;
    } else {
      greenwood += d / (n * (n - d));
      const double spread = z * std::sqrt(greenwood) / std::log(survival);  // < 0
      band = {std::pow(survival, std::exp(-spread)), std::pow(survival, std::exp(spread))};
    }
    step.survival = survival;
    step.band = band;
    curve.steps.push_back(step);
  }
  return curve;
}

}  // namespace scoria::analysis
