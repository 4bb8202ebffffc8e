// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/joint_speed.h"

#include <algorithm>
#include <cmath>

namespace scoria::analysis {
namespace {

constexpr double kNeighbours_s = 0.05;  // samples further apart are none

/// What a command asks of the joints, with the torques of its gains; nothing if it says too little.
std::optional<logs::Array12> CommandedTorques(const logs::Row& row) {
  if (!row.joint_command || !row.joint_command->tau_Nm) return std::nullopt;
  const logs::JointCommandRow& c = *row.joint_command;
  const logs::MeasuredRow& m = *row.measured;
  logs::Array12 tau_Nm = *c.tau_Nm;
  for (std::size_t k = 0; k < tau_Nm.size(); ++k) {
    if (c.kp_Nm_per_rad && c.q_rad && m.q_rad)
      tau_Nm[k] += (*c.kp_Nm_per_rad)[k] * ((*c.q_rad)[k] - (*m.q_rad)[k]);
    if (c.kd_Nms_per_rad && c.qd_radps && m.qd_radps)
      tau_Nm[k] += (*c.kd_Nms_per_rad)[k] * ((*c.qd_radps)[k] - (*m.qd_radps)[k]);
  }
  return tau_Nm;
}

}  // namespace

logs::Array12 CalcJointDerivative(const logs::Array12& before_rad, const logs::Array12& after_rad,
                                  double between_s) noexcept {
  logs::Array12 derivative{};
  for (std::size_t k = 0; k < derivative.size(); ++k)
    derivative[k] = (after_rad[k] - before_rad[k]) / between_s;
  return derivative;
}

void SignalLag::Add(double time_s, const logs::Array12& leads, const logs::Array12& follows,
                    bool starts) {
  if (starts) count_ = 0;
  last_[count_ % last_.size()] = leads;
  ++count_;
  const double step_s = time_s - last_s_;
  last_s_ = time_s;
  if (count_ < last_.size()) return;
  for (std::size_t delay = 0; delay <= kDelays; ++delay) {
    const logs::Array12& then = last_[(count_ - 1 - delay) % last_.size()];
    for (std::size_t k = 0; k < follows.size(); ++k) {
      const double difference = follows[k] - then[k];
      squares_[delay] += difference * difference;
    }
  }
  for (const double value : leads) leading_squares_ += value * value;
  steps_s_ += step_s;
  ++compared_;
}

std::optional<double> SignalLag::lag_s() const {
  constexpr std::size_t kLeastSamples = 200;
  const double joints = 12.0 * static_cast<double>(compared_);
  if (compared_ < kLeastSamples || leading_squares_ < least_rms_ * least_rms_ * joints)
    return std::nullopt;
  const auto best = std::min_element(squares_.begin(), squares_.end());
  const double step_s = steps_s_ / static_cast<double>(compared_);
  const auto index = best - squares_.begin();
  if (index == 0 || best + 1 == squares_.end()) return static_cast<double>(index) * step_s;
  // The vertex of the parabola through the least and its neighbours.
  const double before = *(best - 1), after = *(best + 1);
  const double vertex = 0.5 * (before - after) / (before - 2.0 * *best + after);
  return (static_cast<double>(index) + vertex) * step_s;
}

void JointDelays::Add(const logs::Row& row) {
  if (!row.measured) return;
  AddSpeeds(row);
  AddTorques(row);
}

/// The derivative at a sample is known when the next one has come.
void JointDelays::AddSpeeds(const logs::Row& row) {
  const logs::MeasuredRow& m = *row.measured;
  if (!m.q_rad || !m.qd_radps) return;
  const Sample after{row.time_s, *m.q_rad, *m.qd_radps};
  const double step_s = now_ ? after.time_s - now_->time_s : 0.0;
  const bool is_next = step_s > 0.0 && step_s < kNeighbours_s;
  if (!is_next) {
    before_.reset();
    speeds_start_ = true;
  } else if (before_) {
    speeds_.Add(now_->time_s,
                CalcJointDerivative(before_->q, after.q, after.time_s - before_->time_s), now_->qd,
                speeds_start_);
    speeds_start_ = false;
  }
  if (is_next) before_ = now_;
  now_ = after;
}

void JointDelays::AddTorques(const logs::Row& row) {
  const std::optional<logs::Array12> commanded = CommandedTorques(row);
  if (!commanded || !row.measured->tau_Nm) return;
  const double step_s = last_torque_s_ ? row.time_s - *last_torque_s_ : 0.0;
  const bool starts = step_s <= 0.0 || step_s > kNeighbours_s;
  torques_.Add(row.time_s, *commanded, *row.measured->tau_Nm, starts);
  last_torque_s_ = row.time_s;
}

JointSpeed ChooseJointSpeed(std::optional<double> speed_lag_s,
                            std::optional<double> torque_lag_s) noexcept {
  constexpr double kLate_s = 0.001;  // beyond this, speeds are not of the instant of the angles
  const double speed_s = speed_lag_s.value_or(0.0), torque_s = torque_lag_s.value_or(0.0);
  const bool late = speed_s > kLate_s && speed_s - torque_s > torque_s;
  return late ? JointSpeed::kDerivative : JointSpeed::kMeasured;
}

}  // namespace scoria::analysis
