// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/tick.h"

#include <algorithm>

#include "core/math/so3.h"
#include "logs/quality/plausible.h"
#include "logs/quality/signal_values.h"

namespace scoria::logs {
namespace {

constexpr auto kImu = static_cast<std::size_t>(MotionSource::kImu);
constexpr auto kEstimate = static_cast<std::size_t>(MotionSource::kEstimate);
constexpr auto kTruth = static_cast<std::size_t>(MotionSource::kTruth);

/// The numbers of a signal, if all of them can have been measured.
std::span<const double> Plausible(const Row& row, SignalId signal) {
  const std::span<const double> values = ValuesOf(row, signal);
  return std::all_of(values.begin(), values.end(),
                     [&](double value) { return IsPlausible(signal, value); })
             ? values
             : std::span<const double>();
}

std::optional<Vec3> Vector(const Row& row, SignalId signal) {
  const std::span<const double> v = Plausible(row, signal);
  if (v.empty()) return std::nullopt;
  return Vec3(v[0], v[1], v[2]);
}

std::optional<LegArray<Vec3>> Joints(const Row& row, SignalId signal) {
  const std::span<const double> v = Plausible(row, signal);
  if (v.empty()) return std::nullopt;
  Array12 flat{};
  std::copy(v.begin(), v.end(), flat.begin());
  return Unflatten(flat);
}

std::optional<Vec3> Mixed(const std::optional<Vec3>& a, const std::optional<Vec3>& b, double s) {
  if (!a || !b) return std::nullopt;
  return Vec3((1.0 - s) * *a + s * *b);
}

std::optional<LegArray<Vec3>> Mixed(const std::optional<LegArray<Vec3>>& a,
                                    const std::optional<LegArray<Vec3>>& b, double s) {
  if (!a || !b) return std::nullopt;
  LegArray<Vec3> mixed = ZeroPerLeg();
  for (const Leg leg : kLegs) mixed[leg] = (1.0 - s) * (*a)[leg] + s * (*b)[leg];
  return mixed;
}

std::optional<Mat3> Mixed(const std::optional<Mat3>& a, const std::optional<Mat3>& b, double s) {
  if (!a || !b) return std::nullopt;
  return Mat3(*a * core::ExpSo3(s * core::LogSo3(a->transpose() * *b)));
}

template <class T>
PerSource<T> Mixed(const PerSource<T>& a, const PerSource<T>& b, double s) {
  PerSource<T> mixed;
  for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i] = Mixed(a[i], b[i], s);
  return mixed;
}

}  // namespace

Tick MakeTick(const Row& row, const core::RobotDescription* robot) {
  const Mat3 R_BS = robot != nullptr ? robot->R_BS : Mat3::Identity();
  const auto turned = [&](std::optional<Vec3> v_S) {
    if (v_S) v_S = R_BS * *v_S;
    return v_S;
  };
  Tick t;
  t.time_s = row.time_s;
  t.q = Joints(row, SignalId::kJointQ);
  t.qd = Joints(row, SignalId::kJointQd);
  t.tau = Joints(row, SignalId::kJointTau);
  t.w_WB_B = turned(Vector(row, SignalId::kImuRate));
  t.a_WS_B = turned(Vector(row, SignalId::kImuAcceleration));
  t.rpy_rad = {Vector(row, SignalId::kImuAttitude), Vector(row, SignalId::kEstimateAttitude),
               Vector(row, SignalId::kTruthAttitude)};
  for (std::size_t i = 0; i < kNumMotionSources; ++i) {
    if (t.rpy_rad[i]) t.R_WB[i] = core::RotationFromRpy(*t.rpy_rad[i]);
  }
  if (t.R_WB[kImu]) t.R_WB[kImu] = *t.R_WB[kImu] * R_BS.transpose();
  t.p_WB[kEstimate] = Vector(row, SignalId::kEstimatePosition);
  t.p_WB[kTruth] = Vector(row, SignalId::kTruthPosition);
  t.v_WB[kEstimate] = Vector(row, SignalId::kEstimateVelocity);
  t.v_WB[kTruth] = Vector(row, SignalId::kTruthVelocity);
  t.w_true = Vector(row, SignalId::kTruthRate);
  if (const auto feet = Plausible(row, SignalId::kFootForce); !feet.empty())
    std::copy(feet.begin(), feet.end(), t.foot_force.emplace().begin());
  return t;
}

Tick Interpolate(const Tick& a, const Tick& b, double s) {
  Tick t;
  t.time_s = (1.0 - s) * a.time_s + s * b.time_s;
  t.q = Mixed(a.q, b.q, s);
  t.qd = Mixed(a.qd, b.qd, s);
  t.tau = Mixed(a.tau, b.tau, s);
  t.w_WB_B = Mixed(a.w_WB_B, b.w_WB_B, s);
  t.a_WS_B = Mixed(a.a_WS_B, b.a_WS_B, s);
  t.R_WB = Mixed(a.R_WB, b.R_WB, s);
  t.rpy_rad = s < 0.5 ? a.rpy_rad : b.rpy_rad;  // angles turn over
  t.p_WB = Mixed(a.p_WB, b.p_WB, s);
  t.v_WB = Mixed(a.v_WB, b.v_WB, s);
  t.w_true = Mixed(a.w_true, b.w_true, s);
  t.foot_force = s < 0.5 ? a.foot_force : b.foot_force;
  return t;
}

std::optional<Vec3> RateOf(const Tick& tick) {
  if (tick.w_WB_B) return tick.w_WB_B;
  if (tick.w_true && tick.R_WB[kTruth]) return tick.R_WB[kTruth]->transpose() * *tick.w_true;
  return std::nullopt;
}

std::optional<Mat3> AttitudeOf(const Tick& tick) {
  for (const std::optional<Mat3>& R_WB : tick.R_WB) {
    if (R_WB) return R_WB;
  }
  return std::nullopt;
}

std::optional<Vec3> VelocityOf(const Tick& tick) {
  return tick.v_WB[kTruth] ? tick.v_WB[kTruth] : tick.v_WB[kEstimate];
}

}  // namespace scoria::logs
