// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/stats.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Dense>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "core/rng.h"

namespace scoria::analysis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double Quantile(std::vector<double>& sorted_in_place, double share) {
  std::sort(sorted_in_place.begin(), sorted_in_place.end());
  const double at = share * static_cast<double>(sorted_in_place.size() - 1);
  const auto i = static_cast<std::size_t>(at);
  const std::size_t next = std::min(i + 1, sorted_in_place.size() - 1);
  return sorted_in_place[i] +
         (at - static_cast<double>(i)) * (sorted_in_place[next] - sorted_in_place[i]);
}

///  weights of the points.  b, c, a of y = b + c x + a / x; zero where not fitted.
Eigen::Vector3d FitWeighted(std::span<const CurvePoint> points, const Eigen::ArrayXd& weights,
                            int terms) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd A(n, terms);
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const CurvePoint& p = points[static_cast<std::size_t>(i)];
    A(i, 0) = 1.0;
    if (terms > 1) A(i, 1) = p.x;
    if (terms > 2) A(i, 2) = 1.0 / p.x;
    A.row(i) *= weights[i];
    b[i] = weights[i] * p.y;
  }
  Eigen::Vector3d c = Eigen::Vector3d::Zero();
  c.head(terms) = A.colPivHouseholderQr().solve(b);
  return c;
}

double Evaluate(const Eigen::Vector3d& c, double x) {
  return c[0] + c[1] * x + (c[2] != 0.0 ? c[2] / x : 0.0);
}

/// Source: [Huber1964], with the tuning constant of 95 % efficiency under normal errors.
Eigen::Vector3d FitRobustly(std::span<const CurvePoint> points, int terms) {
  constexpr double kTuning = 1.345, kNormalConsistency = 1.4826;
  constexpr int kIterations = 20;
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::Vector3d c = FitWeighted(points, Eigen::ArrayXd::Ones(n), terms);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    std::vector<double> residuals;
    for (const CurvePoint& p : points) residuals.push_back(std::abs(p.y - Evaluate(c, p.x)));
    const double scale = kNormalConsistency * SampleQuantile(residuals, 0.5);
    if (scale <= 0.0) break;
    Eigen::ArrayXd weights(n);  // square roots of the weights of the squares
    for (Eigen::Index i = 0; i < n; ++i) {
      const double u = residuals[static_cast<std::size_t>(i)] / (kTuning * scale);
      weights[i] = u > 1.0 ? std::sqrt(1.0 / u) : 1.0;
    }
    c = FitWeighted(points, weights, terms);
  }
  return c;
}

/// The points of one episode, and those of the episodes of one speed.
using Cluster = std::vector<CurvePoint>;
using Stratum = std::vector<Cluster>;

/// Clusters by their mean x, in steps of 0.1: a design of several speeds is resampled within each,
/// so that no resample lacks one.
std::vector<Stratum> StrataOf(std::span<const CurvePoint> points) {
  std::map<std::size_t, Cluster> clusters;
  for (const CurvePoint& p : points) clusters[p.cluster].push_back(p);
  std::map<long, Stratum> strata;
  for (auto& [number, cluster] : clusters) {
    double mean = 0.0;
    for (const CurvePoint& p : cluster) mean += p.x / static_cast<double>(cluster.size());
    strata[std::lround(10.0 * mean)].push_back(std::move(cluster));
  }
  std::vector<Stratum> list;
  for (auto& [speed, stratum] : strata) list.push_back(std::move(stratum));
  return list;
}

/// Percentiles of the curves through resampled clusters, at the points of the fit's grid. None from
/// fewer clusters than can be resampled.
void AddBand(const std::vector<Stratum>& strata, int terms, std::uint64_t seed, CurveFit& fit) {
  constexpr int kResamples = 400;
  constexpr std::size_t kLeastClusters = 5;
  std::size_t clusters = 0;
  for (const Stratum& stratum : strata) clusters += stratum.size();
  if (clusters < std::max(kLeastClusters, 3 * strata.size())) return;
  core::Rng rng(seed, 1, core::Stream::kBootstrap);
  std::vector<std::vector<double>> samples(fit.x.size());
  for (int r = 0; r < kResamples; ++r) {
    Cluster resampled;
    for (const Stratum& stratum : strata) {
      for (std::size_t i = 0; i < stratum.size(); ++i) {
        const Cluster& pick = stratum[static_cast<std::size_t>(
            rng.NextUniform() * static_cast<double>(stratum.size()))];
        resampled.insert(resampled.end(), pick.begin(), pick.end());
      }
    }
    const Eigen::Vector3d c = FitRobustly(resampled, terms);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i].push_back(Evaluate(c, fit.x[i]));
  }
  for (auto& s : samples) {
    fit.low.push_back(Quantile(s, 0.025));
    fit.high.push_back(Quantile(s, 0.975));
  }
}

}  // namespace

double SampleQuantile(std::vector<double> values, double share) { return Quantile(values, share); }

MeanEstimate EstimateMean(std::span<const double> values, double confidence) {
  MeanEstimate e{values.size(), kNan, {-kInfinity, kInfinity}, 0.0};
  if (values.empty()) return e;
  const auto n = static_cast<double>(values.size());
  e.mean = 0.0;
  for (const double v : values) e.mean += v / n;
  if (values.size() < 2) return e;
  double squares = 0.0;
  for (const double v : values) squares += (v - e.mean) * (v - e.mean);
  const boost::math::students_t_distribution<double> t(n - 1.0);
  e.deviation = std::sqrt(squares / (n - 1.0));
  const double half = quantile(t, 0.5 + 0.5 * confidence) * e.deviation / std::sqrt(n);
  e.interval = {e.mean - half, e.mean + half};
  return e;
}

RateEstimate EstimateRate(long events, double exposure, double confidence) {
  RateEstimate e;
  e.events = events;
  e.exposure = exposure;
  if (exposure <= 0.0) {
    e.rate = kNan;
    e.interval = {0.0, kInfinity};
    return e;
  }
  const double alpha = 1.0 - confidence, n = static_cast<double>(events);
  e.rate = n / exposure;
  using ChiSquared = boost::math::chi_squared_distribution<double>;
  if (events > 0) e.interval.low = 0.5 * quantile(ChiSquared(2.0 * n), alpha / 2.0) / exposure;
  e.interval.high = 0.5 * quantile(ChiSquared(2.0 * n + 2.0), 1.0 - alpha / 2.0) / exposure;
  return e;
}

RatioEstimate EstimateRateRatio(const RateEstimate& a, const RateEstimate& b, double confidence) {
  RatioEstimate r;
  const long total = a.events + b.events;
  if (total == 0 || a.exposure <= 0.0 || b.exposure <= 0.0) {
    r.ratio = kNan;
    r.interval = {0.0, kInfinity};
    return r;
  }
  const double x = static_cast<double>(a.events), n = static_cast<double>(total);
  const auto odds_to_ratio = [&](double p) {
    return p >= 1.0 ? kInfinity : p / (1.0 - p) * b.exposure / a.exposure;
  };
  r.ratio = b.events == 0 ? kInfinity : a.rate / b.rate;
  const double alpha = 1.0 - confidence;
  using Beta = boost::math::beta_distribution<double>;
  const double low = a.events == 0 ? 0.0 : quantile(Beta(x, n - x + 1.0), alpha / 2.0);
  const double high = b.events == 0 ? 1.0 : quantile(Beta(x + 1.0, n - x), 1.0 - alpha / 2.0);
  r.interval = {odds_to_ratio(low), odds_to_ratio(high)};
  const boost::math::binomial_distribution<double> null(n, a.exposure / (a.exposure + b.exposure));
  const double below = cdf(null, x), above = a.events == 0 ? 1.0 : cdf(complement(null, x - 1.0));
  r.p_value = std::min(1.0, 2.0 * std::min(below, above));
  return r;
}

double DetectableRatio(double rate, double exposure_each, double power) {
  if (rate <= 0.0 || exposure_each <= 0.0) return kInfinity;
  const double z_alpha = 1.959964, z_power = power >= 0.9 ? 1.281552 : 0.841621;
  // var(log ratio) = 1 / n_a + 1 / n_b with n_a = ratio n_b: solve log r = z sqrt((1 + 1/r) / n) by
  // fixed point.
  const double n = rate * exposure_each;
  double log_ratio = 0.5;
  for (int i = 0; i < 100; ++i) {
    log_ratio = (z_alpha + z_power) * std::sqrt((1.0 + std::exp(-log_ratio)) / n);
  }
  return std::exp(log_ratio);
}

Dispersion CheckShares(std::span<const PairedCounts> terrains) {
  Dispersion d;
  double events_a = 0.0, events_b = 0.0, exposure_a = 0.0, exposure_b = 0.0;
  for (const PairedCounts& t : terrains) {
    events_a += static_cast<double>(t.events_a);
    events_b += static_cast<double>(t.events_b);
    exposure_a += t.exposure_a;
    exposure_b += t.exposure_b;
  }
  if (events_a == 0.0 || events_b == 0.0) return d;
  const double ratio = events_a / exposure_a / (events_b / exposure_b);
  double chi2 = 0.0;
  int used = 0;
  for (const PairedCounts& t : terrains) {
    const double total = static_cast<double>(t.events_a + t.events_b);
    if (total == 0.0) continue;
    const double share = ratio * t.exposure_a / (ratio * t.exposure_a + t.exposure_b);
    const double difference = static_cast<double>(t.events_a) - total * share;
    chi2 += difference * difference / (total * share * (1.0 - share));
    ++used;
  }
  if (used < 2) return d;
  d.index = chi2 / (used - 1.0);
  d.p_value = cdf(complement(boost::math::chi_squared_distribution<double>(used - 1.0), chi2));
  return d;
}

Interval BootstrapRateRatio(std::span<const PairedCounts> terrains, std::uint64_t seed,
                            int resamples, double confidence) {
  if (terrains.size() < 3) return {0.0, kInfinity};
  core::Rng rng(seed, 0, core::Stream::kBootstrap);
  std::vector<double> ratios;
  for (int i = 0; i < resamples; ++i) {
    PairedCounts sum;
    for (std::size_t k = 0; k < terrains.size(); ++k) {
      const auto pick =
          static_cast<std::size_t>(rng.NextUniform() * static_cast<double>(terrains.size()));
      sum.events_a += terrains[pick].events_a;
      sum.events_b += terrains[pick].events_b;
      sum.exposure_a += terrains[pick].exposure_a;
      sum.exposure_b += terrains[pick].exposure_b;
    }
    // Half an event on either side keeps resamples without events finite.
    ratios.push_back((static_cast<double>(sum.events_a) + 0.5) / sum.exposure_a /
                     ((static_cast<double>(sum.events_b) + 0.5) / sum.exposure_b));
  }
  const double alpha = 1.0 - confidence;
  return {Quantile(ratios, alpha / 2.0), Quantile(ratios, 1.0 - alpha / 2.0)};
}

CurveFit FitCostCurve(std::span<const CurvePoint> points, int terms, std::uint64_t seed) {
  CurveFit fit;
  if (points.size() < 3) return fit;
  const Eigen::Vector3d c = FitRobustly(points, terms);
  fit.valid = true;
  fit.b = c[0];
  fit.c = c[1];
  fit.a = c[2];
  double mean = 0.0, residual = 0.0, total = 0.0, low = kInfinity, high = -kInfinity;
  for (const CurvePoint& p : points) mean += p.y / static_cast<double>(points.size());
  for (const CurvePoint& p : points) {
    residual += std::pow(p.y - Evaluate(c, p.x), 2);
    total += std::pow(p.y - mean, 2);
    low = std::min(low, p.x);
    high = std::max(high, p.x);
  }
  fit.r2 = total > 0.0 ? 1.0 - residual / total : 0.0;
  constexpr int kGrid = 40;
  for (int i = 0; i < kGrid; ++i) {
    fit.x.push_back(low + (high - low) * i / (kGrid - 1.0));
    fit.y.push_back(Evaluate(c, fit.x.back()));
  }
  AddBand(StrataOf(points), terms, seed, fit);
  return fit;
}

std::string_view CostCurveFormula(int terms) noexcept {
  return terms > 2 ? "b + c v + a/v" : terms > 1 ? "b + c v" : "b";
}

}  // namespace scoria::analysis
