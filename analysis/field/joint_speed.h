// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "logs/row.h"

namespace scoria::analysis {

/// Where the joints' speeds are from that powers are computed with.
enum class JointSpeed { kMeasured, kDerivative };

/// Finds by how much one signal of the joints follows another: the delay at which they are nearest,
/// up to 12 samples.
class SignalLag {
 public:
  /// @param least_rms  of the signal that leads: below, noise decides.
  explicit SignalLag(double least_rms) noexcept : least_rms_(least_rms) {}

  /// Samples in order. @param starts  the sample before is no neighbour.
  void Add(double time_s, const logs::Array12& leads, const logs::Array12& follows, bool starts);

  /// Nothing where the joints hardly moved, or there are too few samples.
  [[nodiscard]] std::optional<double> lag_s() const;

 private:
  static constexpr std::size_t kDelays = 12;
  std::array<logs::Array12, kDelays + 1> last_{};  // what leads, a ring
  std::size_t count_ = 0;                          // since the last interruption
  double least_rms_, last_s_ = 0.0;
  std::array<double, kDelays + 1> squares_{};
  double leading_squares_ = 0.0, steps_s_ = 0.0;
  std::size_t compared_ = 0;
};

/// How late the measured speeds and torques of a log's joints are: speeds after the centred
/// derivative of the angles, torques after their commands with the torques of the gains.
class JointDelays {
 public:
  /// Rows in order.
  void Add(const logs::Row& row);
  [[nodiscard]] std::optional<double> speed_s() const { return speeds_.lag_s(); }
  [[nodiscard]] std::optional<double> torque_s() const { return torques_.lag_s(); }

 private:
  struct Sample {
    double time_s = 0.0;
    logs::Array12 q{}, qd{};
  };
  void AddSpeeds(const logs::Row& row);
  void AddTorques(const logs::Row& row);

  SignalLag speeds_{0.3}, torques_{0.3};  // rad/s, N m
  std::optional<Sample> before_, now_;
  bool speeds_start_ = true;
  std::optional<double> last_torque_s_;
};

/// The speeds whose power with the measured torques is of one instant: the measured ones, unless
/// they are late and the torques are less so, or nothing is known of these.
[[nodiscard]] JointSpeed ChooseJointSpeed(std::optional<double> speed_lag_s,
                                          std::optional<double> torque_lag_s) noexcept;

/// (after - before) / their distance in time, rad/s.
[[nodiscard]] logs::Array12 CalcJointDerivative(const logs::Array12& before_rad,
                                                const logs::Array12& after_rad,
                                                double between_s) noexcept;

}  // namespace scoria::analysis
