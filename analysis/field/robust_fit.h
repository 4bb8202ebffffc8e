// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Cholesky>

#include "core/math/types.h"

namespace scoria::analysis {

/// y = X b, three equations of one instant.
template <int kSize>
struct FitSample {
  Eigen::Matrix<double, 3, kSize> X = Eigen::Matrix<double, 3, kSize>::Zero();
  Vec3 y = Vec3::Zero();
  std::size_t block = 0;  // errors of samples of one block may be alike
};

template <int kSize>
struct RobustFit {
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  Vector b = Vector::Zero();
  Matrix covariance = Matrix::Zero();

  [[nodiscard]] Vector sigma() const { return covariance.diagonal().cwiseSqrt(); }
};

/// Weighted least squares. The covariance is by the scores of blocks, so that it holds for errors
/// that are alike within a block and differ in size (sandwich estimator, [Huber1967], with the
/// factor n / (n - kSize) for n blocks).
/// @param weights  one a sample.
/// @returns nothing where X does not tell b, or from fewer than kSize + 2 blocks.
template <int kSize>
[[nodiscard]] std::optional<RobustFit<kSize>> FitWeighted(
    const std::vector<FitSample<kSize>>& samples, const std::vector<double>& weights) {
  using Fit = RobustFit<kSize>;
  struct Sums {
    typename Fit::Matrix A = Fit::Matrix::Zero();
    typename Fit::Vector y = Fit::Vector::Zero();
  };
  std::map<std::size_t, Sums> blocks;
  Sums all;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const FitSample<kSize>& s = samples[i];
    const typename Fit::Matrix A = weights[i] * s.X.transpose() * s.X;
    const typename Fit::Vector y = weights[i] * s.X.transpose() * s.y;
    Sums& block = blocks[s.block];
    block.A += A, block.y += y;
    all.A += A, all.y += y;
  }
  constexpr double kLeastCondition = 1e-12;
  const Eigen::LDLT<typename Fit::Matrix> solver(all.A);
  if (blocks.size() < kSize + 2 || solver.rcond() < kLeastCondition) return std::nullopt;
  Fit fit;
  fit.b = solver.solve(all.y);
  typename Fit::Matrix scores = Fit::Matrix::Zero();
  for (const auto& [number, block] : blocks) {
    const typename Fit::Vector score = block.y - block.A * fit.b;
    scores += score * score.transpose();
  }
  const auto n = static_cast<double>(blocks.size());
  const typename Fit::Matrix inverse = solver.solve(Fit::Matrix::Identity());
  fit.covariance = n / (n - kSize) * inverse * scores * inverse;
  return fit;
}

/// FitWeighted with the weights of [Huber1964], in ten rounds: an error beyond kWide times the
/// median size counts as one of that size, since markers are mixed up and feet hit the ground.
template <int kSize>
[[nodiscard]] std::optional<RobustFit<kSize>> FitRobustly(
    const std::vector<FitSample<kSize>>& samples) {
  constexpr int kRounds = 10;
  constexpr double kWide = 1.5;
  std::vector<double> weights(samples.size(), 1.0);
  std::optional<RobustFit<kSize>> fit = FitWeighted(samples, weights);
  for (int round = 0; round < kRounds && fit; ++round) {
    std::vector<double> sizes;
    for (const FitSample<kSize>& s : samples) sizes.push_back((s.y - s.X * fit->b).norm());
    std::vector<double> sorted = sizes;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double wide = kWide * *middle;
    for (std::size_t i = 0; i < sizes.size(); ++i)
      weights[i] = sizes[i] > wide ? wide / sizes[i] : 1.0;
    fit = FitWeighted(samples, weights);
  }
  return fit;
}

}  // namespace scoria::analysis
