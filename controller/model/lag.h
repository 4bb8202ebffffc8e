// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <Eigen/Core>

namespace scoria::controller {

/// The longest delay in steps.
inline constexpr std::size_t kLongestLag = 32;

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
