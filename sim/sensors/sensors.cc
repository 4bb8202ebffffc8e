// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sensors/sensors.h"

#include <utility>

namespace scoria::sim {
namespace {

RealisticSensors Resolve(const SensorParams& params) noexcept {
  const auto* realistic = std::get_if<RealisticSensors>(&params);
  return realistic != nullptr ? *realistic : WithoutErrors();
}

}  // namespace

Sensors::Sensors(const core::RobotDescription& robot, const SensorParams& params,
                 std::vector<SensorFault> faults, const Vec3& gravity_W, double step_s,
                 std::uint64_t seed)
    : has_foot_sensors_(robot.config.has_foot_sensors),
      faults_(std::move(faults)),
      imu_(robot, Resolve(params).imu, gravity_W, step_s, seed),
      encoders_(Resolve(params).encoders, step_s, seed),
      torque_(Resolve(params).torque, step_s, seed),
      foot_force_(Resolve(params).foot_force, step_s, seed) {}

void Sensors::Reset() noexcept {
  imu_.Reset();
  encoders_.Reset();
  torque_.Reset();
  foot_force_.Reset();
}

SensorFrame Sensors::Read(const Truth& truth, const LegArray<Vec3>& motor_tau_Nm, std::int64_t step,
                          const core::EventClock& now, bool give_truth) noexcept {
  const FaultEffects& faults = faults_.Update(now);
  SensorFrame z;
  z.step = step;
  const Encoders::Sample& joints = encoders_.Read(truth.state, faults.encoders);
  z.q = joints.q;
  z.qd = joints.qd;
  z.tau_Nm = torque_.Read(motor_tau_Nm, faults.torque);
  const Imu::Sample& inertial = imu_.Read(truth.state, step, faults.imu);
  z.imu_time_s = inertial.time_s;
  z.a_WS_S = inertial.a_WS_S;
  z.w_WS_S = inertial.w_WS_S;
  if (has_foot_sensors_) z.foot_force_raw = foot_force_.Read(truth.f_normal_N, faults.feet);
  if (give_truth) {
    SensorFrame::Truth& given = z.truth.emplace();
    given.state = truth.state;
    given.contact = truth.contact;
  }
  return z;
}

}  // namespace scoria::sim
