// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/cost_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Dense>

#include "core/math/quantile.h"
#include "core/rng.h"

namespace scoria::analysis {
namespace {

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
    const double scale = kNormalConsistency * core::SampleQuantile(residuals, 0.5);
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
  for (const auto& s : samples) {
    fit.low.push_back(core::SampleQuantile(s, 0.025));
    fit.high.push_back(core::SampleQuantile(s, 0.975));
  }
}

}  // namespace

CurveFit FitCostCurve(std::span<const CurvePoint> points, int terms, std::uint64_t seed) {
  CurveFit fit;
  if (points.size() < 3) return fit;
  const Eigen::Vector3d c = FitRobustly(points, terms);
  fit.valid = true;
  fit.b = c[0];
  fit.c = c[1];
  fit.a = c[2];
  double mean = 0.0, residual = 0.0, total = 0.0, low = std::numeric_limits<double>::infinity(),
         high = -low;
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
