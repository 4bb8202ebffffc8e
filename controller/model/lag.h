// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/Core>

namespace scoria::controller {

/// Step of a first-order low pass towards its input, for an input held over dt.
[[nodiscard]] double LowPassShare(double cutoff_Hz, double dt_s) noexcept;

/// By what a force of the momentum observer comes late: its age, and the low passes since.
struct Lag {
  std::size_t steps = 0;
  double loop_share = 1.0;  // of either pole of the tracking loop that gives the joint speeds
  double share = 1.0;       // of the last low pass
};

/// @param delay_s       rounded to whole steps.
/// @param bandwidth_Hz  natural frequency of the tracking loop; 0: the speeds are immediate.
[[nodiscard]] Lag CalcLag(double delay_s, double bandwidth_Hz, double cutoff_Hz,
                          double dt_s) noexcept;

/// The newest values of a signal.
template <class T>
class DelayLine {
 public:
  static constexpr std::size_t kMaxSteps = 32;

  void Clear() noexcept { filled_ = 0; }
  /// @returns the place of the next value, the newest from now on.
  [[nodiscard]] T& Next() noexcept {
    newest_ = (newest_ + 1) % ring_.size();
    filled_ = std::min(filled_ + 1, ring_.size());
    return ring_[newest_];
  }
  /// The value so many steps before the newest, or the oldest if there are fewer.
  /// @pre  Next was called since the start or Clear.
  [[nodiscard]] const T& Ago(std::size_t steps) const noexcept {
    return ring_[(newest_ + ring_.size() - std::min(steps, filled_ - 1)) % ring_.size()];
  }

 private:
  std::array<T, kMaxSteps + 1> ring_;
  std::size_t newest_ = 0, filled_ = 0;
};

/// The low passes of Lag: ω² / (s + ω)², as a critically damped tracking loop of natural frequency
/// ω has it, then one of first order.
template <int kRows>
class LowPassChain {
 public:
  using Vector = Eigen::Matrix<double, kRows, 1>;

  /// As if the signal had always been so.
  void Settle(const Vector& x) noexcept { first_ = second_ = out_ = x; }
  /// @param prompt    passes both.
  /// @param by_speed  was made of the loop's speeds and passes only the last; they add.
  const Vector& Update(const Vector& prompt, const Vector& by_speed, const Lag& lag) noexcept {
    first_ += lag.loop_share * (prompt - first_);
    second_ += lag.loop_share * (first_ - second_);
    out_ += lag.share * (second_ + by_speed - out_);
    return out_;
  }
  [[nodiscard]] const Vector& out() const noexcept { return out_; }

 private:
  Vector first_ = Vector::Zero(), second_ = Vector::Zero(), out_ = Vector::Zero();
};

}  // namespace scoria::controller
