// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/sobol_indices.h"

#include <limits>

#include "analysis/statistics/mean.h"
#include "core/demand.h"
#include "core/math/quantile.h"
#include "core/rng.h"

namespace scoria::analysis {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Indices from rows of responses, each of a point a, a point b, and one point for each factor.
/// @param rows  which of them, in any order and number.
std::vector<SobolIndices> EstimateFromRows(std::span<const double> responses, std::size_t factors,
                                           std::span<const std::size_t> rows) {
  const std::size_t width = PointsPerRow(factors);
  const double n = static_cast<double>(rows.size());
  std::vector<double> both;
  for (const std::size_t row : rows) {
    both.push_back(responses[row * width]);
    both.push_back(responses[row * width + 1]);
  }
  const double deviation = EstimateMean(both).deviation, variance = deviation * deviation;
  std::vector<SobolIndices> indices(factors, {kNan, kNan, {kNan, kNan}});
  if (variance <= 0.0) return indices;
  for (std::size_t k = 0; k < factors; ++k) {
    double from_a = 0.0, from_b = 0.0;  // half the mean square changes
    for (const std::size_t row : rows) {
      const double mixed = responses[row * width + 2 + k];
      const double a = responses[row * width] - mixed, b = responses[row * width + 1] - mixed;
      from_a += 0.5 * a * a / n;
      from_b += 0.5 * b * b / n;
    }
    indices[k].first = 1.0 - from_b / variance;
    indices[k].total = from_a / variance;
  }
  return indices;
}

/// Percentiles of the total indices through resampled rows.
void AddIntervals(std::span<const double> responses, std::size_t rows, std::uint64_t seed,
                  std::vector<SobolIndices>& indices) {
  constexpr int kResamples = 1000;
  core::Rng rng(seed, 4, core::Stream::kBootstrap);
  std::vector<std::vector<double>> totals(indices.size());
  std::vector<std::size_t> picks(rows);
  for (int i = 0; i < kResamples; ++i) {
    for (std::size_t& pick : picks)
      pick = static_cast<std::size_t>(rng.NextUniform() * static_cast<double>(rows));
    const auto resampled = EstimateFromRows(responses, indices.size(), picks);
    for (std::size_t k = 0; k < indices.size(); ++k) {
      if (resampled[k].total >= 0.0) totals[k].push_back(resampled[k].total);  // not NaN
    }
  }
  for (std::size_t k = 0; k < indices.size(); ++k) {
    if (totals[k].empty()) continue;
    indices[k].total_interval = {core::SampleQuantile(totals[k], 0.025),
                                 core::SampleQuantile(totals[k], 0.975)};
  }
}

}  // namespace

std::vector<UnitPoint> SensitivityPoints(std::span<const UnitPoint> sample) {
  std::vector<UnitPoint> points;
  for (const UnitPoint& both : sample) {
    const auto middle = both.begin() + static_cast<std::ptrdiff_t>(both.size() / 2);
    const UnitPoint a(both.begin(), middle), b(middle, both.end());
    points.push_back(a);
    points.push_back(b);
    for (std::size_t k = 0; k < a.size(); ++k) {
      points.push_back(a);
      points.back()[k] = b[k];
    }
  }
  return points;
}

std::vector<SobolIndices> EstimateSobolIndices(std::span<const double> responses,
                                               std::size_t factors, std::uint64_t seed) {
  constexpr std::size_t kEnoughRows = 5;
  const std::size_t rows = responses.size() / PointsPerRow(factors);
  SCORIA_DEMAND(factors > 0 && rows * PointsPerRow(factors) == responses.size(),
                "{} responses of {} factors", responses.size(), factors);
  std::vector<std::size_t> all(rows);
  for (std::size_t row = 0; row < rows; ++row) all[row] = row;
  std::vector<SobolIndices> indices = EstimateFromRows(responses, factors, all);
  if (rows >= kEnoughRows) AddIntervals(responses, rows, seed, indices);
  return indices;
}

}  // namespace scoria::analysis
