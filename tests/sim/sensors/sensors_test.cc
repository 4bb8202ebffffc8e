// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sensors/sensors.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "core/config/archive.h"
#include "core/math/so3.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

/// A walk without a break.
core::EventClock At(double time_s) { return {time_s, 0.0, time_s}; }

constexpr double kStep_s = 1e-3;
const Vec3 kGravity_W(0.0, 0.0, -9.81);

Sensors MakeSensors(const SensorParams& params, std::vector<SensorFault> faults = {},
                    std::uint64_t seed = 1) {
  return Sensors(test::Go2(), params, std::move(faults), kGravity_W, kStep_s, seed);
}

SensorFault FaultOf(SensorFaultKind kind, double magnitude, std::vector<std::string> legs = {}) {
  SensorFault fault;
  fault.kind = kind;
  fault.magnitude = magnitude;
  fault.legs = std::move(legs);
  fault.ramp_s = 2.0;
  return fault;
}

Truth Standing() {
  Truth truth;
  truth.state = test::StandingState();
  truth.f_normal_N = {30.0, 40.0, 50.0, 60.0};
  return truth;
}

LegArray<Vec3> Torques() { return LegArray<Vec3>(Vec3(1.0, -2.0, 8.0)); }

/// What the sensors say after `steps` steps, the fault clock running.
SensorFrame ReadFor(Sensors& sensors, const Truth& truth, int steps, std::int64_t first = 0) {
  SensorFrame z;
  for (int i = 0; i < steps; ++i) {
    const std::int64_t k = first + i;
    z = sensors.Read(truth, Torques(), k, At(static_cast<double>(k + 1) * kStep_s), false);
  }
  return z;
}

/// Standard deviation and mean, gathered one by one.
struct Moments {
  double sum = 0.0, squares = 0.0;
  int n = 0;
  void Add(double x) {
    sum += x;
    squares += x * x;
    ++n;
  }
  void Add(const Vec3& v) {
    for (const double x : v) Add(x);
  }
  [[nodiscard]] double mean() const { return sum / n; }
  [[nodiscard]] double deviation() const { return std::sqrt(squares / n - mean() * mean()); }
};

/// The deviation is right within four of its standard errors.
void ExpectDeviation(const Moments& moments, double sigma) {
  EXPECT_NEAR(moments.deviation(), sigma, 4.0 * sigma / std::sqrt(2.0 * moments.n));
}

ImuParams QuietImu() { return WithoutErrors().imu; }

TEST(IdealSensors, ReadTheTruthOfEveryStep) {
  core::RobotDescription robot = test::Go2();
  robot.p_BS = {0.1, -0.05, 0.03};
  robot.R_BS = core::ExpSo3({0.2, -0.4, 1.0});
  Sensors sensors(robot, IdealSensors{}, {}, kGravity_W, kStep_s, 1);
  core::Rng rng(1, 0, core::Stream::kSensor);
  Vec3 v_WS_before = Vec3::Zero();
  for (int k = 0; k < 20; ++k) {
    if (k == 10) sensors.Reset();
    Truth truth;
    truth.state = test::RandomState(rng);
    for (double& f : truth.f_normal_N) f = rng.NextUniform(0.0, 100.0);
    truth.contact[Leg::kHL] = k % 3 == 0;
    const SensorFrame z = sensors.Read(truth, Torques(), k, At(0.0), true);
    const RobotState& s = truth.state;
    const Vec3 v_WS = s.v_WB + s.w_WB.cross(s.R_WB * robot.p_BS);
    const bool is_first = k == 0 || k == 10;
    const Vec3 a_WS = is_first ? Vec3::Zero() : Vec3((v_WS - v_WS_before) / kStep_s);
    v_WS_before = v_WS;
    const Mat3 R_WS = s.R_WB * robot.R_BS;
    EXPECT_EQ(z.step, k);
    EXPECT_EQ(z.imu_time_s, k * kStep_s);
    const double rounding = 1e-14;  // a compiler may fuse a product and a sum here and not there
    EXPECT_LT((z.a_WS_S - R_WS.transpose() * (a_WS - kGravity_W)).norm(),
              rounding / kStep_s * (1.0 + v_WS.norm() + a_WS.norm()));
    EXPECT_LT((z.w_WS_S - R_WS.transpose() * s.w_WB).norm(), rounding * (1.0 + s.w_WB.norm()));
    EXPECT_EQ(z.q, s.q);
    EXPECT_EQ(z.qd, s.qd);
    EXPECT_EQ(z.tau_Nm, Torques());
    EXPECT_EQ(z.foot_force_raw, truth.f_normal_N);
    ASSERT_TRUE(z.truth.has_value());
    EXPECT_EQ(z.truth->state, s);
    EXPECT_EQ(z.truth->contact[Leg::kHL], truth.contact[Leg::kHL]);
  }
}

TEST(SensorParams, AreRealisticUnlessTheScenarioSaysIdeal) {
  EXPECT_TRUE(std::holds_alternative<RealisticSensors>(SensorParams{}));
  const auto read = [](const char* yaml) {
    return core::ReadConfig<SensorParams>(core::ParseConfig(yaml, "sensors.yaml"));
  };
  EXPECT_TRUE(std::holds_alternative<IdealSensors>(read("{type: ideal}")));
  const SensorParams realistic = read("{imu: {sampling: {rate_Hz: 500}}}");
  EXPECT_EQ(std::get<RealisticSensors>(realistic).imu.sampling.rate_Hz, 500.0);
  EXPECT_EQ(std::get<RealisticSensors>(realistic).torque.sampling.latency_s, 0.002);
}

TEST(Imu, WhiteNoiseHasItsDensityAtEveryRate) {
  for (const double rate_Hz : {1000.0, 200.0}) {
    ImuParams params = QuietImu();
    params.sampling.rate_Hz = rate_Hz;
    params.gyro_noise_radps_per_sqrt_Hz = 1.7e-4;
    params.accel_noise_mps2_per_sqrt_Hz = 2e-3;
    Imu imu(test::Go2(), params, kGravity_W, kStep_s, 7);
    Moments gyro, accel;
    const int every = static_cast<int>(std::lround(1000.0 / rate_Hz));
    for (int k = 0; k < 20000; ++k) {
      const Imu::Sample& sample = imu.Read(RobotState{}, k, {});
      if (k % every != 0) continue;
      gyro.Add(sample.w_WS_S);
      accel.Add(Vec3(sample.a_WS_S + kGravity_W));
    }
    ExpectDeviation(gyro, 1.7e-4 * std::sqrt(rate_Hz));
    ExpectDeviation(accel, 2e-3 * std::sqrt(rate_Hz));
  }
}

TEST(Imu, TurnOnBiasAndScaleHaveTheirSpread) {
  ImuParams params = QuietImu();
  params.gyro_bias_radps = 2e-3;
  params.accel_bias_mps2 = 0.03;
  ImuParams scaled = QuietImu();
  scaled.scale_error = 1e-3;
  Moments gyro, accel, scale;
  RobotState turning;
  turning.w_WB = Vec3::Constant(2.0);
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Imu imu(test::Go2(), params, kGravity_W, kStep_s, seed);
    const Imu::Sample sample = imu.Read(RobotState{}, 0, {});
    gyro.Add(sample.w_WS_S);
    accel.Add(Vec3(sample.a_WS_S + kGravity_W));
    Imu off(test::Go2(), scaled, kGravity_W, kStep_s, seed);
    scale.Add(Vec3(test::Go2().R_BS * off.Read(turning, 0, {}).w_WS_S / 2.0));
  }
  ExpectDeviation(gyro, 2e-3);
  ExpectDeviation(accel, 0.03);
  ExpectDeviation(scale, 1e-3);
  EXPECT_NEAR(scale.mean(), 1.0, 4e-3 / std::sqrt(scale.n));
}

// A walk of density d has moved by d √t after t.
TEST(Imu, BiasWalksWithTheRootOfTime) {
  ImuParams params = QuietImu();
  params.gyro_walk_radps2_per_sqrt_Hz = 1e-5;
  params.accel_walk_mps3_per_sqrt_Hz = 1e-4;
  params.sampling.rate_Hz = 500.0;
  Moments gyro, gyro_longer, accel;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Imu imu(test::Go2(), params, kGravity_W, kStep_s, seed);
    for (int k = 0; k < 2000; ++k) {
      const Imu::Sample& sample = imu.Read(RobotState{}, k, {});
      if (k == 499) {
        gyro.Add(sample.w_WS_S);
        accel.Add(Vec3(sample.a_WS_S + kGravity_W));
      }
      if (k == 1999) gyro_longer.Add(sample.w_WS_S);
    }
  }
  ExpectDeviation(gyro, 1e-5 * std::sqrt(0.5));
  ExpectDeviation(gyro_longer, 1e-5 * std::sqrt(2.0));
  ExpectDeviation(accel, 1e-4 * std::sqrt(0.5));
}

TEST(Imu, AtRestReadsGravityUpwards) {
  Sensors sensors = MakeSensors(RealisticSensors{});
  const Truth truth = Standing();
  Vec3 mean_B = Vec3::Zero();
  for (int k = 0; k < 1000; ++k)
    mean_B += test::Go2().R_BS * sensors.Read(truth, Torques(), k, At(0.0), false).a_WS_S / 1000.0;
  EXPECT_LT((mean_B + kGravity_W).cwiseAbs().maxCoeff(), 4.0 * 0.03 + 4e-3 * 9.81);
  EXPECT_GT((mean_B + kGravity_W).norm(), 0.0);
}

// a = −ω² r at the end of an arm that spins; the mean over a step turns with it by ω dt / 2.
TEST(Imu, LeverArmFeelsTheSpin) {
  core::RobotDescription robot = test::Go2();
  robot.p_BS = {0.2, 0.0, 0.0};
  robot.R_BS = Mat3::Identity();
  Imu imu(robot, QuietImu(), kGravity_W, kStep_s, 1);
  const double w = 3.0, r = 0.2;
  Imu::Sample sample;
  RobotState s;
  s.w_WB.z() = w;
  for (int k = 0; k < 100; ++k) {
    s.R_WB = core::RotationZ(w * k * kStep_s);
    sample = imu.Read(s, k, {});
  }
  EXPECT_LT((sample.a_WS_S - Vec3(-w * w * r, 0.0, 9.81)).norm(), 0.6 * w * w * w * r * kStep_s);
  EXPECT_LT((sample.w_WS_S - s.w_WB).norm(), 1e-12);
}

TEST(Imu, SlowSamplesIntegrateToTheSameVelocityAndAngle) {
  ImuParams params = QuietImu();
  params.sampling.rate_Hz = 100.0;
  core::RobotDescription robot = test::Go2();
  robot.p_BS = Vec3::Zero();
  robot.R_BS = Mat3::Identity();
  Imu imu(robot, params, kGravity_W, kStep_s, 1);
  core::Rng rng(2, 0, core::Stream::kSensor);
  RobotState s;
  const double interval_s = 0.01;
  Vec3 v_W = Vec3::Zero(), v_W_start = Vec3::Zero(), angle = Vec3::Zero(), true_angle = angle;
  for (int k = 0; k <= 300; ++k) {
    // The orientation stays, so that means in S and in W are the same.
    s.v_WB += 0.05 * Vec3(rng.NextNormal(), rng.NextNormal(), rng.NextNormal());
    s.w_WB = Vec3(rng.NextNormal(), rng.NextNormal(), rng.NextNormal());
    const Imu::Sample& sample = imu.Read(s, k, {});
    if (k == 0) v_W_start = s.v_WB;
    if (k > 0) true_angle += s.w_WB * kStep_s;
    if (k > 0 && k % 10 == 0) {
      EXPECT_EQ(sample.time_s, k * kStep_s);
      v_W += (sample.a_WS_S + kGravity_W) * interval_s;
      angle += sample.w_WS_S * interval_s;
    } else {
      EXPECT_EQ(sample.time_s, (k - k % 10) * kStep_s);  // held
    }
  }
  EXPECT_LT((v_W - (s.v_WB - v_W_start)).norm(), 1e-12);
  EXPECT_LT((angle - true_angle).norm(), 1e-12);
}

TEST(Imu, SaturatesAndComesLate) {
  ImuParams params = QuietImu();
  params.gyro_limit_radps = 34.9;
  params.accel_limit_mps2 = 157.0;
  params.sampling.latency_s = 0.003;
  Imu imu(test::Go2(), params, kGravity_W, kStep_s, 1);
  RobotState s;
  for (int k = 0; k < 10; ++k) {
    s.v_WB.x() += 1.0;  // 1000 m/s²
    s.w_WB = test::Go2().R_BS * Vec3(0.0, -50.0, 0.0);
    const Imu::Sample sample = imu.Read(s, k, {});
    EXPECT_EQ(sample.time_s, std::max(0, k - 3) * kStep_s);
    EXPECT_EQ(sample.w_WS_S.y(), -34.9);
    EXPECT_LE(sample.a_WS_S.cwiseAbs().maxCoeff(), 157.0);
  }
}

TEST(Encoders, AnglesAreWholeQuanta) {
  const double quantum = 2.0 * std::numbers::pi / 16384.0;
  Encoders encoders(EncoderParams{}, kStep_s, 3);
  RobotState s;
  double first = 0.0;
  for (int k = 0; k < 1000; ++k) {
    s.q[Leg::kHR].z() = -1.2 + 3e-5 * k;
    const double q = encoders.Read(s, {}).q[Leg::kHR].z();
    if (k == 0) first = q;
    EXPECT_LE(std::abs(q - s.q[Leg::kHR].z()), 0.5 * quantum + 1e-12);
    const double quanta = (q - first) / quantum;
    EXPECT_NEAR(quanta, std::round(quanta), 1e-6);
  }
}

// ω̂ = ω_n² / (s + ω_n)² of the velocity: e^(−ω_n t) (1 + ω_n t) is missing after a step of speed.
TEST(Encoders, TrackingLoopAnswersAsItsTransferFunction) {
  EncoderParams params = WithoutErrors().encoders;
  params.velocity_bandwidth_Hz = 125.0;
  Encoders encoders(params, kStep_s, 1);
  RobotState s;
  (void)encoders.Read(s, {});
  const double w = 2.0 * std::numbers::pi * 125.0;
  for (int k = 1; k < 20; ++k) {
    const double t = k * kStep_s;
    s.q[Leg::kFL].y() = 3.0 * t;
    const double missing = std::exp(-w * t) * (1.0 + w * t);
    EXPECT_NEAR(encoders.Read(s, {}).qd[Leg::kFL].y(), 3.0 * (1.0 - missing), 1e-12);
  }
}

TEST(Encoders, VelocityNoiseStaysBelowFiveHundredthsAtEverySpeed) {
  for (const double speed : {0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0}) {
    Encoders encoders(EncoderParams{}, kStep_s, 3);
    RobotState s;
    Moments error;
    for (int k = 0; k < 20000; ++k) {
      s.q[Leg::kFL].x() = speed * k * kStep_s;
      const double qd = encoders.Read(s, {}).qd[Leg::kFL].x();
      if (k > 100) error.Add(qd - speed);
    }
    EXPECT_LT(error.deviation(), 0.05) << speed;
    EXPECT_LT(std::abs(error.mean()), 1e-3) << speed;
  }
}

TEST(Encoders, VelocityOfASineLagsByTwoToThreeMilliseconds) {
  Encoders encoders(EncoderParams{}, kStep_s, 3);
  const double w = 2.0 * std::numbers::pi * 2.0, amplitude = 0.5;
  RobotState s;
  double in_phase = 0.0, quadrature = 0.0;
  constexpr int kSteps = 5000, kSkip = 500;  // whole periods
  for (int k = 0; k < kSteps + kSkip; ++k) {
    const double t = k * kStep_s;
    s.q[Leg::kFL].x() = amplitude * std::sin(w * t);
    const double qd = encoders.Read(s, {}).qd[Leg::kFL].x();
    if (k < kSkip) continue;
    in_phase += 2.0 / kSteps * qd * std::cos(w * t);
    quadrature += 2.0 / kSteps * qd * std::sin(w * t);
  }
  const double lag_s = std::atan2(quadrature, in_phase) / w;
  EXPECT_NEAR(lag_s, 1.0 / (std::numbers::pi * 125.0), 5e-5);
  EXPECT_GT(lag_s, 0.002);
  EXPECT_LT(lag_s, 0.003);
  EXPECT_NEAR(std::hypot(in_phase, quadrature), amplitude * w, 5e-3 * amplitude * w);
}

TEST(TorqueSensor, GainOffsetAndNoiseHaveTheirSpread) {
  TorqueSensorParams quiet;
  quiet.noise_Nm = 0.0;
  Moments gain, offset, noise;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const auto at = [&](double tau_Nm) {
      TorqueSensor sensor(quiet, kStep_s, seed);
      return sensor.Read(LegArray<Vec3>(Vec3::Constant(tau_Nm)), {});
    };
    const LegArray<Vec3> none = at(0.0), ten = at(10.0);
    for (const Leg leg : kLegs) {
      offset.Add(none[leg]);
      gain.Add(Vec3((ten[leg] - none[leg]) / 10.0));
    }
  }
  ExpectDeviation(offset, 0.1);
  ExpectDeviation(gain, 0.02);
  EXPECT_NEAR(gain.mean(), 1.0, 4.0 * 0.02 / std::sqrt(gain.n));
  TorqueSensorParams noisy;
  noisy.gain_error = noisy.offset_Nm = 0.0;
  TorqueSensor sensor(noisy, kStep_s, 1);
  for (int k = 0; k < 2000; ++k) noise.Add(sensor.Read(ZeroPerLeg(), {})[Leg::kFR]);
  ExpectDeviation(noise, 0.15);
}

TEST(TorqueSensor, ComesTwoMillisecondsLate) {
  TorqueSensorParams params = WithoutErrors().torque;
  params.sampling = TorqueSensorParams{}.sampling;
  TorqueSensor sensor(params, kStep_s, 1);
  std::vector<double> got;
  for (const double tau : {1.0, 2.0, 3.0, 4.0, 5.0})
    got.push_back(sensor.Read(LegArray<Vec3>(Vec3::Constant(tau)), {})[Leg::kHL].z());
  EXPECT_EQ(got, (std::vector<double>{1.0, 1.0, 1.0, 2.0, 3.0}));
  sensor.Reset();
  EXPECT_EQ(sensor.Read(LegArray<Vec3>(Vec3::Constant(9.0)), {})[Leg::kHL].z(), 9.0);
}

TEST(FootForce, CountsAreWholeWithZeroLevelAndDeadBand) {
  FootForceParams params;
  params.drift_per_sqrt_s = 0.0;
  Moments log_gain;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto at = [&](double force_N) {
      FootForceSensors sensors(params, kStep_s, seed);
      return sensors.Read(LegArray<double>(force_N), {});
    };
    const LegArray<double> free = at(0.0), light = at(5.0), heavy = at(205.0), crush = at(5000.0);
    for (const Leg leg : kLegs) {
      EXPECT_EQ(free[leg], std::round(free[leg]));
      EXPECT_GE(free[leg], 5.0);
      EXPECT_LE(free[leg], 15.0);
      EXPECT_EQ(light[leg], free[leg]);
      EXPECT_EQ(heavy[leg], std::round(heavy[leg]));
      EXPECT_EQ(crush[leg], 1023.0);
      log_gain.Add(std::log((heavy[leg] - free[leg]) / 200.0));
    }
  }
  ExpectDeviation(log_gain, 0.15);
  EXPECT_NEAR(log_gain.mean(), 0.0, 4.0 * 0.15 / std::sqrt(log_gain.n));
}

TEST(FootForce, ZeroLevelDriftsAsARandomWalk) {
  FootForceParams params = WithoutErrors().foot_force;
  params.sampling.rate_Hz = 500.0;
  params.zero_min = params.zero_max = 1000.0;
  params.drift_per_sqrt_s = 0.2;
  Moments drift;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    FootForceSensors sensors(params, kStep_s, seed);
    LegArray<double> counts;
    for (int k = 0; k < 2000; ++k) counts = sensors.Read(LegArray<double>(0.0), {});
    for (const double c : counts) drift.Add(c - 1000.0);
  }
  ExpectDeviation(drift, 0.2 * std::sqrt(2.0));
}

TEST(FootForce, RobotsWithoutFootSensorsReadNothing) {
  core::RobotDescription robot = test::Go2();
  robot.config.has_foot_sensors = false;
  Sensors sensors(robot, RealisticSensors{}, {FaultOf(SensorFaultKind::kFootPacked, 40.0)},
                  kGravity_W, kStep_s, 1);
  EXPECT_EQ(ReadFor(sensors, Standing(), 50).foot_force_raw, LegArray<double>(0.0));
}

/// Difference that a fault makes to ideal sensors after one second.
struct Effect {
  SensorFrame with, without;
};
Effect EffectOf(const SensorFault& fault) {
  Sensors faulty = MakeSensors(IdealSensors{}, {fault}), sound = MakeSensors(IdealSensors{});
  return {ReadFor(faulty, Standing(), 1000), ReadFor(sound, Standing(), 1000)};
}

TEST(SensorFaults, OfTheFeet) {
  Effect e = EffectOf(FaultOf(SensorFaultKind::kFootDrift, 80.0, {"FL"}));  // half of the ramp
  EXPECT_NEAR(e.with.foot_force_raw[Leg::kFL], 30.0 + 40.0, 1e-9);
  EXPECT_EQ(e.with.foot_force_raw[Leg::kHR], 60.0);
  e = EffectOf(FaultOf(SensorFaultKind::kFootDropout, 0.0, {"FR", "HR"}));
  EXPECT_EQ(e.with.foot_force_raw, LegArray<double>(30.0, 0.0, 50.0, 0.0));
  e = EffectOf(FaultOf(SensorFaultKind::kFootPacked, 25.0));
  EXPECT_EQ(e.with.foot_force_raw, LegArray<double>(40.0, 45.0, 50.0, 55.0));
  SensorFault hard = FaultOf(SensorFaultKind::kFootPacked, -20.0);
  hard.gain = 0.75;
  e = EffectOf(hard);
  EXPECT_EQ(e.with.foot_force_raw, LegArray<double>(2.5, 10.0, 17.5, 25.0));
}

TEST(SensorFaults, StuckFeetKeepTheirCounts) {
  SensorFault fault = FaultOf(SensorFaultKind::kFootStuck, 0.0, {"HL"});
  fault.at_s = 0.1;
  fault.duration_s = 0.1;
  Sensors sensors = MakeSensors(IdealSensors{}, {fault});
  Truth truth = Standing();
  (void)ReadFor(sensors, truth, 100);
  truth.f_normal_N[Leg::kHL] = 0.0;
  EXPECT_EQ(ReadFor(sensors, truth, 50, 100).foot_force_raw[Leg::kHL], 50.0);
  sensors.Reset();
  EXPECT_EQ(ReadFor(sensors, truth, 40, 150).foot_force_raw[Leg::kHL], 50.0);
  EXPECT_EQ(ReadFor(sensors, truth, 20, 190).foot_force_raw[Leg::kHL], 0.0);
}

TEST(SensorFaults, OfTheImu) {
  Effect e = EffectOf(FaultOf(SensorFaultKind::kImuBiasStep, 0.02));
  EXPECT_TRUE(e.with.w_WS_S.isApprox(e.without.w_WS_S + Vec3::Constant(0.02), 1e-12));
  EXPECT_EQ(e.with.a_WS_S, e.without.a_WS_S);
  e = EffectOf(FaultOf(SensorFaultKind::kAccelBiasStep, 0.3));
  EXPECT_TRUE(e.with.a_WS_S.isApprox(e.without.a_WS_S + Vec3::Constant(0.3), 1e-12));
  e = EffectOf(FaultOf(SensorFaultKind::kImuTemperature, 40.0));  // half of the ramp
  EXPECT_TRUE(e.with.w_WS_S.isApprox(e.without.w_WS_S + Vec3::Constant(20.0 * 2.6e-4), 1e-9));
  EXPECT_TRUE(e.with.a_WS_S.isApprox(e.without.a_WS_S + Vec3::Constant(20.0 * 2e-3), 1e-9));
  e = EffectOf(FaultOf(SensorFaultKind::kImuNan, 0.0));
  EXPECT_TRUE(e.with.w_WS_S.array().isNaN().all() && e.with.a_WS_S.array().isNaN().all());
  e = EffectOf(FaultOf(SensorFaultKind::kImuDropout, 1.0));
  EXPECT_EQ(e.with.imu_time_s, 0.0);
}

TEST(SensorFaults, LostSamplesLeaveTheStampBehind) {
  Sensors sensors = MakeSensors(RealisticSensors{}, {FaultOf(SensorFaultKind::kImuDropout, 0.3)});
  int lost = 0;
  constexpr int kSteps = 5000;
  for (int k = 0; k < kSteps; ++k) {
    const SensorFrame z = sensors.Read(Standing(), Torques(), k, At(1.0 + k * kStep_s), false);
    lost += z.imu_time_s != static_cast<double>(k) * kStep_s ? 1 : 0;
  }
  EXPECT_NEAR(lost, 0.3 * kSteps, 4.0 * std::sqrt(0.21 * kSteps));
}

TEST(SensorFaults, OfTheJoints) {
  Effect e = EffectOf(FaultOf(SensorFaultKind::kEncoderOffset, 0.05, {"HR"}));
  EXPECT_EQ(e.with.q[Leg::kHR], Vec3(e.without.q[Leg::kHR] + Vec3::Constant(0.05)));
  EXPECT_EQ(e.with.q[Leg::kFL], e.without.q[Leg::kFL]);
  EXPECT_EQ(e.with.qd, e.without.qd);
  e = EffectOf(FaultOf(SensorFaultKind::kTorqueDropout, 0.0, {"FL"}));
  EXPECT_EQ(e.with.tau_Nm[Leg::kFL], Vec3::Zero());
  EXPECT_EQ(e.with.tau_Nm[Leg::kFR], e.without.tau_Nm[Leg::kFR]);
  e = EffectOf(FaultOf(SensorFaultKind::kTorqueTemperature, 3.0));
  EXPECT_TRUE(e.with.tau_Nm[Leg::kHL].isApprox(e.without.tau_Nm[Leg::kHL] + Vec3::Constant(1.5)));
}

TEST(SensorFaults, LastTheirTimeAndSayWhenTheyBegin) {
  SensorFault fault = FaultOf(SensorFaultKind::kTorqueDropout, 0.0);
  fault.at_s = 0.0105;
  fault.duration_s = 0.005;
  Sensors sensors = MakeSensors(IdealSensors{}, {fault});
  std::vector<int> begun, dead;
  for (int k = 0; k < 30; ++k) {
    const SensorFrame z = sensors.Read(Standing(), Torques(), k, At(k * kStep_s), false);
    if (sensors.HasBegun(0)) begun.push_back(k);
    if (z.tau_Nm[Leg::kFL].isZero()) dead.push_back(k);
  }
  EXPECT_EQ(begun, std::vector<int>{11});
  EXPECT_EQ(dead, (std::vector<int>{11, 12, 13, 14, 15}));
  EXPECT_EQ(sensors.faults().size(), 1u);
}

TEST(SensorFaults, MistakesAreNamed) {
  EXPECT_EQ(FaultOf(SensorFaultKind::kFootStuck, 0.0, {"FL", "HR"}).Problem(), "");
  EXPECT_EQ(FaultOf(SensorFaultKind::kFootStuck, 0.0, {"RL"}).Problem(),
            "legs: unknown \"RL\"; choices: FL, FR, HL, HR");
  EXPECT_EQ(FaultOf(SensorFaultKind::kImuNan, 0.0, {"FL"}).Problem(),
            "legs: imu_nan concerns no leg");
  EXPECT_EQ(FaultOf(SensorFaultKind::kFootDrift, 0.0).Problem(), "magnitude: foot_drift needs one");
  EXPECT_EQ(FaultOf(SensorFaultKind::kFootStuck, 2.0).Problem(), "magnitude: foot_stuck has none");
  EXPECT_EQ(FaultOf(SensorFaultKind::kFootPacked, 0.0).Problem(), "");
  EXPECT_EQ(FaultOf(SensorFaultKind::kImuDropout, 1.5).Problem(),
            "magnitude: imu_dropout needs a share in (0, 1]");
}

/// Frames of realistic sensors on a moving robot.
std::vector<SensorFrame> Record(const RealisticSensors& params,
                                const std::vector<SensorFault>& faults, std::uint64_t seed) {
  Sensors sensors = MakeSensors(params, faults, seed);
  core::Rng rng(4, 0, core::Stream::kSensor);
  std::vector<SensorFrame> frames;
  for (int k = 0; k < 200; ++k) {
    Truth truth = Standing();
    truth.state = test::RandomState(rng);
    for (double& f : truth.f_normal_N) f = rng.NextUniform(0.0, 100.0);
    frames.push_back(sensors.Read(truth, Torques(), k, At(k * kStep_s), false));
  }
  return frames;
}

/// Which groups of numbers differ anywhere.
std::set<std::string> Differences(const std::vector<SensorFrame>& a,
                                  const std::vector<SensorFrame>& b) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].a_WS_S != b[i].a_WS_S || a[i].w_WS_S != b[i].w_WS_S) names.insert("imu");
    if (!(a[i].q == b[i].q && a[i].qd == b[i].qd)) names.insert("encoders");
    if (!(a[i].tau_Nm == b[i].tau_Nm)) names.insert("torque");
    if (!(a[i].foot_force_raw == b[i].foot_force_raw)) names.insert("feet");
  }
  return names;
}

TEST(Sensors, SameSeedGivesTheSameBits) {
  EXPECT_EQ(Record(RealisticSensors{}, {}, 5), Record(RealisticSensors{}, {}, 5));
  EXPECT_EQ(Differences(Record(RealisticSensors{}, {}, 5), Record(RealisticSensors{}, {}, 6)),
            (std::set<std::string>{"encoders", "feet", "imu", "torque"}));
}

TEST(Sensors, FaultOfOneLeavesTheOthersAlone) {
  const std::vector<SensorFrame> sound = Record(RealisticSensors{}, {}, 5);
  for (const auto& [kind, name] : EnumNames(SensorFaultKind{})) {
    SensorFault fault = FaultOf(kind, 0.5);
    fault.ramp_s = 0.001;
    if (kind == SensorFaultKind::kFootDrift || kind == SensorFaultKind::kFootPacked)
      fault.magnitude = 50.0;
    fault.at_s = 0.05;
    const bool of_imu = name.starts_with("imu") || name.starts_with("accel");
    const std::string sensor = of_imu                        ? "imu"
                               : name.starts_with("foot")    ? "feet"
                               : name.starts_with("encoder") ? "encoders"
                                                             : "torque";
    const std::set<std::string> changed =
        Differences(sound, Record(RealisticSensors{}, {fault}, 5));
    EXPECT_EQ(changed, std::set<std::string>{sensor}) << name;
  }
}

TEST(Sensors, SlowerSamplingOfOneLeavesTheOthersAlone) {
  const std::vector<SensorFrame> usual = Record(RealisticSensors{}, {}, 5);
  const auto slower = [&](const std::function<SamplingParams&(RealisticSensors&)>& of) {
    RealisticSensors params;
    of(params).rate_Hz = 100.0;
    return Differences(usual, Record(params, {}, 5));
  };
  using Names = std::set<std::string>;
  EXPECT_EQ(slower([](RealisticSensors & p) -> auto& { return p.imu.sampling; }), Names{"imu"});
  EXPECT_EQ(slower([](RealisticSensors & p) -> auto& { return p.encoders.sampling; }),
            Names{"encoders"});
  EXPECT_EQ(slower([](RealisticSensors & p) -> auto& { return p.torque.sampling; }),
            Names{"torque"});
  EXPECT_EQ(slower([](RealisticSensors & p) -> auto& { return p.foot_force.sampling; }),
            Names{"feet"});
}

// Without noise and walk, what is left are the values of the turn-on.
TEST(Sensors, ResetKeepsTheTurnOnAndForgetsTheMotion) {
  RealisticSensors params;
  params.imu.gyro_noise_radps_per_sqrt_Hz = params.imu.accel_noise_mps2_per_sqrt_Hz = 0.0;
  params.imu.gyro_walk_radps2_per_sqrt_Hz = params.imu.accel_walk_mps3_per_sqrt_Hz = 0.0;
  params.torque.noise_Nm = 0.0;
  params.foot_force.drift_per_sqrt_s = 0.0;
  Sensors sensors = MakeSensors(params);
  const SensorFrame before = ReadFor(sensors, Standing(), 7);
  Truth moving = Standing();
  moving.state.v_WB = {1.0, 2.0, 3.0};
  moving.state.q[Leg::kFL].y() += 0.3;
  (void)sensors.Read(moving, ZeroPerLeg(), 7, At(0.0), false);
  sensors.Reset();
  const SensorFrame after = ReadFor(sensors, Standing(), 1);
  EXPECT_EQ(after.a_WS_S, before.a_WS_S);
  EXPECT_EQ(after.w_WS_S, before.w_WS_S);
  EXPECT_EQ(after.q, before.q);
  EXPECT_EQ(after.qd, ZeroPerLeg());
  EXPECT_EQ(after.tau_Nm, before.tau_Nm);
  EXPECT_EQ(after.foot_force_raw, before.foot_force_raw);
}

TEST(Sensors, ReadingAllocatesNothing) {
  Sensors sensors = MakeSensors(RealisticSensors{}, {FaultOf(SensorFaultKind::kImuDropout, 0.5),
                                                     FaultOf(SensorFaultKind::kFootDrift, 5.0)});
  const Truth truth = Standing();
  const test::AllocationGuard guard;
  (void)ReadFor(sensors, truth, 100);
  sensors.Reset();
  (void)ReadFor(sensors, truth, 100, 100);
  EXPECT_EQ(guard.count(), 0);
}

}  // namespace
}  // namespace scoria::sim
