// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace scoria::analysis {

/// Which way a test looks: for positive effects, for negative ones, or for both.
enum class Alternative { kGreater, kLess, kTwoSided };

/// Evidence against a null hypothesis, as data arrive. Under the null hypothesis the expected value
/// of E is at most 1 whenever one looks, and the probability that it ever reaches 1 / α is at most
/// α (Ville's inequality). So one may look after every datum, and stop whenever one likes.
/// Source: [Howard2021], [Ramdas2023].
class EProcess {
 public:
  /// E as of now, in logarithms.
  [[nodiscard]] double log_e() const noexcept { return log_e_; }
  /// Valid at any time: 1 over the largest E so far, at most 1.
  [[nodiscard]] double p_value() const noexcept { return std::exp(-log_largest_); }
  /// @param alpha  level, in (0, 1).
  [[nodiscard]] bool Rejects(double alpha) const noexcept { return p_value() <= alpha; }

  void Update(double log_e) noexcept {
    log_e_ = log_e;
    log_largest_ = std::max(log_largest_, log_e);
  }

 private:
  double log_e_ = 0.0, log_largest_ = 0.0;
};

/// log of the mean of exp(x), without overflow: averages of E are evidence too.
/// @param x  not empty, finite.
[[nodiscard]] inline double LogMeanExp(std::span<const double> x) noexcept {
  const double largest = *std::max_element(x.begin(), x.end());
  double sum = 0.0;
  for (const double value : x) sum += std::exp(value - largest);
  return largest + std::log(sum / static_cast<double>(x.size()));
}

/// E, in logarithms, of averages over alternatives on either side.
[[nodiscard]] inline double LogEvidence(Alternative alternative, std::span<const double> greater,
                                        std::span<const double> less) noexcept {
  if (alternative == Alternative::kGreater) return LogMeanExp(greater);
  if (alternative == Alternative::kLess) return LogMeanExp(less);
  return LogMeanExp(std::array{LogMeanExp(greater), LogMeanExp(less)});
}

}  // namespace scoria::analysis
