// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace scoria::logs {

/// Mean and variance of numbers as they come.
class Moments {
 public:
  void Add(double x) noexcept {
    ++count_;
    const double d = x - mean_;
    mean_ += d / static_cast<double>(count_);
    m2_ += d * (x - mean_);
  }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] double mean() const noexcept { return mean_; }
  [[nodiscard]] double deviation() const noexcept {
    return count_ > 1 ? std::sqrt(m2_ / static_cast<double>(count_ - 1)) : 0.0;
  }

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0.0, m2_ = 0.0;
};

/// Correlation and slope of pairs as they come.
class PairMoments {
 public:
  void Add(double x, double y) noexcept {
    ++count_;
    const double n = static_cast<double>(count_), dx = x - mean_x_, dy = y - mean_y_;
    mean_x_ += dx / n;
    mean_y_ += dy / n;
    xx_ += dx * (x - mean_x_);
    yy_ += dy * (y - mean_y_);
    xy_ += dx * (y - mean_y_);
  }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// 0 where one of them does not change.
  [[nodiscard]] double correlation() const noexcept {
    return xx_ > 0.0 && yy_ > 0.0 ? xy_ / std::sqrt(xx_ * yy_) : 0.0;
  }
  /// Of y over x, such that errors of both count alike: the ratio of deviations, by sign.
  [[nodiscard]] double slope() const noexcept {
    return xx_ > 0.0 ? std::copysign(std::sqrt(yy_ / xx_), xy_) : 0.0;
  }
  [[nodiscard]] double deviation_x() const noexcept { return Deviation(xx_); }
  [[nodiscard]] double deviation_y() const noexcept { return Deviation(yy_); }

 private:
  [[nodiscard]] double Deviation(double squares) const noexcept {
    return count_ > 1 ? std::sqrt(squares / static_cast<double>(count_ - 1)) : 0.0;
  }
  std::uint64_t count_ = 0;
  double mean_x_ = 0.0, mean_y_ = 0.0, xx_ = 0.0, yy_ = 0.0, xy_ = 0.0;
};

/// Mean of a quantity, and how sure its sign is: t is the mean over its standard error, of means
/// over blocks, since neighbours are alike, and of their roots, since a robot moves much now and
/// little then.
class BlockMean {
 public:
  static constexpr std::uint64_t kBlock = 50;  // ticks: about half a stride

  void Add(double x) noexcept {
    sum_ += x;
    block_sum_ += x;
    ++count_;
    if (++block_count_ < kBlock) return;
    const double mean = block_sum_ / static_cast<double>(block_count_);
    blocks_.Add(std::copysign(std::sqrt(std::abs(mean)), mean));
    block_sum_ = 0.0;
    block_count_ = 0;
  }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] double mean() const noexcept {
    return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0;
  }
  /// 0 below six blocks.
  [[nodiscard]] double t() const noexcept {
    if (blocks_.count() < 6) return 0.0;
    const double error = blocks_.deviation() / std::sqrt(static_cast<double>(blocks_.count()));
    if (error > 0.0) return blocks_.mean() / error;
    return blocks_.mean() == 0.0
               ? 0.0
               : std::copysign(std::numeric_limits<double>::infinity(), blocks_.mean());
  }

 private:
  std::uint64_t count_ = 0, block_count_ = 0;
  double sum_ = 0.0, block_sum_ = 0.0;
  Moments blocks_;
};

/// Decisions between hypotheses want the difference of their costs this many standard errors from
/// zero.
inline constexpr double kSureAbove_t = 4.0;

/// A cost that grows as the square of an error over its size, and no further than kLargestCost: one
/// bad sample says no more than that the hypothesis does not explain it.
inline constexpr double kLargestCost = 4.0;
[[nodiscard]] inline double RobustCost(double squared_error, double size) noexcept {
  return std::fmin(0.5 * squared_error / (size * size), kLargestCost);
}

}  // namespace scoria::logs
