// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "controller/estimation/contact_estimator.h"
#include "core/math/so3.h"
#include "core/rng.h"
#include "core/robot/whole_body.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/go1_log.h"
#include "tests/support/robots.h"

namespace scoria::controller {
namespace {

namespace fs = std::filesystem;

constexpr double kGravity_mps2 = 9.81;
constexpr double kStep_s = 1e-3;

// --- A Go1 of another team's simulator ----------------------------------------------------------

using test::Go1Folder;
using test::LoadGo1;
using test::LogTick;
using test::ReadGo1Log;

/// Errors of an estimate against the log's own forces and contacts.
class Score {
 public:
  void Add(const Vec3& estimated, const Vec3& truth, bool in_contact, bool said) {
    if (in_contact) {
      stance_ += std::pow(estimated.z() - truth.z(), 2);
      ++stance_n_;
    } else {
      swing_ += (estimated - truth).squaredNorm();
      ++swing_n_;
    }
    right_ += said == in_contact ? 1 : 0;
  }
  [[nodiscard]] double stance_N() const { return std::sqrt(stance_ / stance_n_); }
  [[nodiscard]] double swing_N() const { return std::sqrt(swing_ / swing_n_); }
  [[nodiscard]] double accuracy() const { return right_ / (stance_n_ + swing_n_); }

 private:
  double stance_ = 0.0, swing_ = 0.0, stance_n_ = 0.0, swing_n_ = 0.0, right_ = 0.0;
};

constexpr int kSettle = 20;  // ticks of the log's start left out
constexpr double kGo1FootRadius_m = 0.02;

/// Contact by the fusion from any estimate of force, with no plan known (all feet planned to
/// stand).
class PlanlessFusion {
 public:
  bool Update(Leg leg, const core::WholeBody& wb, const Vec3& f_F_W) {
    FusionInput in;
    in.force = f_F_W.z() / (wb.mass_kg * kGravity_mps2);
    in.height_m = wb.p_WF[leg].z() - kGo1FootRadius_m;
    contact_[leg] = DecideContact(params_, CalcContactProbability(params_, in), contact_[leg]);
    return contact_[leg];
  }

 private:
  FusionParams params_;
  LegArray<bool> contact_;
};

TEST(Go1Log, ObserverFindsForcesAndContactsBetterThanQuasiStaticTorques) {
  const std::optional<fs::path> folder = Go1Folder();
  if (!folder) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const core::RobotDescription robot = LoadGo1(*folder);
  const std::vector<LogTick> log = ReadGo1Log(*folder, robot);
  ASSERT_EQ(log.size(), 5000u);
  ObserverParams params;
  // The log's torques and speeds are those of its own step and free of noise: the lag of the low
  // pass is what is left.
  params.torque_delay_s = params.velocity_bandwidth_Hz = 0.0;
  params.cutoff_Hz = 120.0;
  MomentumObserver observer(params, robot, kGravity_mps2);
  const core::WholeBodyModel model(robot, kGravity_mps2);
  core::WholeBody wb, at_rest;
  PlanlessFusion by_observer, by_torque;
  Score dynamic, quasi_static;
  for (std::size_t i = 0; i < log.size(); ++i) {
    const LogTick& tick = log[i];
    model.Calc(tick.state, wb);
    RobotState rest = tick.state;
    rest.v_WB = rest.w_WB = Vec3::Zero();
    rest.qd = ZeroPerLeg();
    model.Calc(rest, at_rest);
    const LegArray<Vec3> f = observer.Update({wb, tick.z, kStep_s});
    const LegArray<Vec3> f_qs =
        CalcQuasiStaticForces(at_rest, tick.z.tau_Nm, params.singular_below_m);
    for (const Leg leg : kLegs) {
      const bool said = by_observer.Update(leg, wb, f[leg]);
      const bool said_qs = by_torque.Update(leg, wb, f_qs[leg]);
      if (i < kSettle) continue;
      dynamic.Add(f[leg], tick.f_F_W[leg], tick.contact[leg], said);
      quasi_static.Add(f_qs[leg], tick.f_F_W[leg], tick.contact[leg], said_qs);
    }
  }
  RecordProperty("stance_N", std::to_string(dynamic.stance_N()));
  RecordProperty("stance_quasi_static_N", std::to_string(quasi_static.stance_N()));
  RecordProperty("swing_N", std::to_string(dynamic.swing_N()));
  RecordProperty("swing_quasi_static_N", std::to_string(quasi_static.swing_N()));
  RecordProperty("accuracy", std::to_string(dynamic.accuracy()));
  RecordProperty("accuracy_quasi_static", std::to_string(quasi_static.accuracy()));
  EXPECT_GE(dynamic.accuracy(), 0.985);
  EXPECT_LE(dynamic.stance_N(), 5.0);
  EXPECT_LE(dynamic.swing_N(), 4.0);
  EXPECT_GT(dynamic.accuracy(), quasi_static.accuracy());
  EXPECT_LT(dynamic.stance_N(), quasi_static.stance_N());
  EXPECT_LT(dynamic.swing_N(), quasi_static.swing_N());
}

/// Sensors with the errors of real ones: torque gain, offset, noise and delay, encoders of 14 bit
/// with a tracking loop for the speed, noise of the IMU.
class HonestSensors {
 public:
  explicit HonestSensors(std::uint64_t seed) : rng_(seed, 0, core::Stream::kSensor) {
    for (const Leg leg : kLegs) {
      gain_[leg] = Vec3::Ones() + Noise(0.02);
      offset_Nm_[leg] = Noise(0.1);
    }
  }
  SensorFrame Update(SensorFrame z) {
    for (const Leg leg : kLegs) {
      const Vec3 tau = gain_[leg].cwiseProduct(z.tau_Nm[leg]) + offset_Nm_[leg] + Noise(0.15);
      z.tau_Nm[leg] = started_ ? older_[leg] : tau;
      older_[leg] = started_ ? old_[leg] : tau;
      old_[leg] = tau;
      Track(leg, z);
    }
    z.a_WS_S += Noise(0.05);
    z.w_WS_S += Noise(0.005);
    started_ = true;
    return z;
  }

 private:
  Vec3 Noise(double sigma) {
    const double x = rng_.NextNormal(), y = rng_.NextNormal(), z = rng_.NextNormal();
    return sigma * Vec3(x, y, z);
  }
  /// Second-order tracking loop, critically damped, at 10 kHz within the drive.
  void Track(Leg leg, SensorFrame& z) {
    constexpr double kCount_rad = 2.0 * M_PI / 16384.0, kInner_s = 1e-4,
                     kLoop_radps = 2.0 * M_PI * 125.0;
    const Vec3 q = kCount_rad * (z.q[leg] / kCount_rad).array().round().matrix();
    if (!started_) {
      q_[leg] = q;
      qd_[leg] = z.qd[leg];
    }
    for (int i = 0; i < 10; ++i) {
      const Vec3 error = q - q_[leg];
      q_[leg] += kInner_s * (qd_[leg] + 2.0 * kLoop_radps * error);
      qd_[leg] += kInner_s * kLoop_radps * kLoop_radps * error;
    }
    z.q[leg] = q;
    z.qd[leg] = qd_[leg];
  }

  core::Rng rng_;
  LegArray<Vec3> gain_, offset_Nm_, old_ = ZeroPerLeg(), older_ = ZeroPerLeg();
  LegArray<Vec3> q_ = ZeroPerLeg(), qd_ = ZeroPerLeg();
  bool started_ = false;
};

/// Ticks to the nearest change of the log's contact of that leg.
std::vector<int> TicksToEdge(const std::vector<LogTick>& log, Leg leg) {
  std::vector<int> distance(log.size(), static_cast<int>(log.size()));
  int since = static_cast<int>(log.size());
  for (std::size_t i = 1; i < log.size(); ++i) {
    since = log[i].contact[leg] != log[i - 1].contact[leg] ? 0 : since + 1;
    distance[i] = since;
  }
  int until = static_cast<int>(log.size());
  for (std::size_t i = log.size(); i-- > 0;) {
    distance[i] = std::min(distance[i], until);
    until = distance[i] == 0 ? 1 : until + 1;
  }
  return distance;
}

TEST(Go1Log, WithHonestSensorsContactsAreRightAndInTime) {
  const std::optional<fs::path> folder = Go1Folder();
  if (!folder) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const core::RobotDescription robot = LoadGo1(*folder);
  const std::vector<LogTick> log = ReadGo1Log(*folder, robot);
  const core::WholeBodyModel model(robot, kGravity_mps2);
  constexpr int kEdge = 15, kClean = 50;  // ticks
  double right = 0.0, n = 0.0;
  std::vector<int> delays;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    HonestSensors sensors(seed);
    ContactEstimator estimator({}, robot, kGravity_mps2, kStep_s);
    const ContactPlan no_plan;
    core::WholeBody wb;
    std::vector<LegArray<bool>> said;
    for (const LogTick& tick : log) {
      const SensorFrame z = sensors.Update(tick.z);
      RobotState state = tick.state;
      state.q = z.q;
      state.qd = z.qd;
      model.Calc(state, wb);
      said.push_back(estimator.Update({z, wb, no_plan, 0.0, {}, kGo1FootRadius_m}).observer);
    }
    for (const Leg leg : kLegs) {
      const std::vector<int> edge = TicksToEdge(log, leg);
      for (std::size_t i = kSettle; i < log.size(); ++i) {
        if (edge[i] > kEdge) {
          right += said[i][leg] == log[i].contact[leg] ? 1.0 : 0.0;
          n += 1.0;
        }
        // Touchdowns after a clean swing and before a clean stance.
        const bool clean = edge[i] == 0 && log[i].contact[leg] && i > kClean &&
                           i + kClean < log.size() && edge[i - kClean / 2] >= kClean / 2 &&
                           edge[i + kClean / 2] >= kClean / 2;
        if (!clean) continue;
        int delay = 0;
        while (delay < kClean && !said[i + static_cast<std::size_t>(delay)][leg]) ++delay;
        delays.push_back(delay);
      }
    }
  }
  ASSERT_GT(delays.size(), 30u);
  std::sort(delays.begin(), delays.end());
  RecordProperty("accuracy", std::to_string(right / n));
  RecordProperty("median_ticks", delays[delays.size() / 2]);
  RecordProperty("p95_ticks", delays[delays.size() * 95 / 100]);
  EXPECT_GE(right / n, 0.99);
  EXPECT_LE(delays[delays.size() / 2], 10);
  EXPECT_LE(delays[delays.size() * 95 / 100], 25);
}

// --- Momentum observer --------------------------------------------------------------------------

struct Motion {
  RobotState state;
  Vec3 vd_WB = Vec3::Zero(), wd_WB = Vec3::Zero();
  LegArray<Vec3> qdd = ZeroPerLeg(), f_F_W = ZeroPerLeg();
};

/// What ideal sensors read of a motion: torques by the equations of motion, the IMU by kinematics.
SensorFrame Sense(const core::RobotDescription& robot, const core::WholeBody& wb, const Motion& m) {
  SensorFrame z;
  z.q = m.state.q;
  z.qd = m.state.qd;
  const Mat3 R_WS = m.state.R_WB * robot.R_BS;
  const Vec3& w = m.state.w_WB;
  const Vec3 r = m.state.R_WB * robot.p_BS;
  const Vec3 v_lever = w.cross(r);
  const Vec3 a = m.vd_WB + m.wd_WB.cross(r) + w.cross(v_lever) + Vec3(0.0, 0.0, kGravity_mps2);
  z.a_WS_S = R_WS.transpose() * a;
  z.w_WS_S = R_WS.transpose() * w;
  Vec6 a_B;
  a_B.head<3>() = m.vd_WB;
  a_B.tail<3>() = m.wd_WB;
  const core::MotorParams& motors = robot.config.motors;
  const double smooth_radps = ObserverParams{}.coulomb_smooth_radps;
  for (const Leg leg : kLegs) {
    const Vec3 sign = (m.state.qd[leg] / smooth_radps).array().tanh();
    const Vec3 friction = motors.damping_Nms_per_rad.cwiseProduct(m.state.qd[leg]) +
                          motors.friction_Nm.cwiseProduct(sign);
    z.tau_Nm[leg] = wb.H_Bl[leg].transpose() * a_B + wb.H_ll[leg] * m.qdd[leg] + wb.h_l[leg] +
                    friction - wb.J_ll[leg].transpose() * m.f_F_W[leg];
  }
  return z;
}

void Advance(Motion& m) {
  m.state.R_WB = core::ExpSo3(m.state.w_WB * kStep_s) * m.state.R_WB;
  m.state.w_WB += m.wd_WB * kStep_s;
  m.state.v_WB += m.vd_WB * kStep_s;
  for (const Leg leg : kLegs) {
    m.state.q[leg] += m.state.qd[leg] * kStep_s;
    m.state.qd[leg] += m.qdd[leg] * kStep_s;
  }
}

/// The forces that the observer reads after `ticks` of the motion.
LegArray<Vec3> Observe(const ObserverParams& params, Motion m, int ticks) {
  const core::RobotDescription& robot = test::Go2();
  const core::WholeBodyModel model(robot, kGravity_mps2);
  MomentumObserver observer(params, robot, kGravity_mps2);
  core::WholeBody wb;
  LegArray<Vec3> f = ZeroPerLeg();
  for (int i = 0; i < ticks; ++i) {
    model.Calc(m.state, wb);
    f = observer.Update({wb, Sense(robot, wb, m), kStep_s});
    Advance(m);
  }
  return f;
}

ObserverParams Prompt() {
  ObserverParams params;
  params.torque_delay_s = params.velocity_bandwidth_Hz = 0.0;
  return params;
}

double LargestError_N(const LegArray<Vec3>& f, const LegArray<Vec3>& expected) {
  double largest = 0.0;
  for (const Leg leg : kLegs) largest = std::max(largest, (f[leg] - expected[leg]).norm());
  return largest;
}

TEST(MomentumObserver, LegHangingUnderATiltedTrunkReadsNoForce) {
  Motion m;
  m.state = test::StandingState();
  m.state.R_WB = core::RotationFromRpy({0.4, -0.5, 1.0});
  EXPECT_LT(LargestError_N(Observe(Prompt(), m, 50), m.f_F_W), 1e-9);
}

TEST(MomentumObserver, FreeFallReadsNoForceWhereLegGravityAloneDoes) {
  Motion m;
  m.state = test::StandingState();
  m.vd_WB = Vec3(0.0, 0.0, -kGravity_mps2);
  EXPECT_LT(LargestError_N(Observe(Prompt(), m, 50), m.f_F_W), 1e-9);
  const core::WholeBodyModel model(test::Go2(), kGravity_mps2);
  core::WholeBody wb;
  model.Calc(m.state, wb);
  const SensorFrame z = Sense(test::Go2(), wb, m);
  EXPECT_GT(LargestError_N(CalcQuasiStaticForces(wb, z.tau_Nm, 0.03), m.f_F_W), 3.0);
}

TEST(MomentumObserver, ShakenTrunkReadsNoForce) {
  Motion m;
  m.state = test::StandingState();
  m.vd_WB = Vec3(5.0, -4.0, 6.0);
  m.wd_WB = Vec3(20.0, -15.0, 10.0);
  // The low passes lag the motion's change by a few milliseconds.
  EXPECT_LT(LargestError_N(Observe(Prompt(), m, 40), m.f_F_W), 0.5);
}

TEST(MomentumObserver, FindsForcesInAnyMotion) {
  core::Rng rng(7, 0, core::Stream::kSensor);
  for (int trial = 0; trial < 20; ++trial) {
    Motion m;
    m.state = test::RandomState(rng);
    for (const Leg leg : kLegs) {
      for (int k = 0; k < 3; ++k) {
        m.f_F_W[leg][k] = rng.NextUniform(-80.0, 80.0);
        m.qdd[leg][k] = rng.NextUniform(-40.0, 40.0);
      }
    }
    m.wd_WB = Vec3(3.0, -2.0, 1.0);
    ObserverParams params = Prompt();
    params.cutoff_Hz = 200.0;
    // Legs swing at 4 rad/s meanwhile, so that lag costs some of the force.
    EXPECT_LT(LargestError_N(Observe(params, m, 20), m.f_F_W), 2.0) << trial;
  }
}

/// How the readings of a swinging leg lag.
struct Lag {
  double loop_Hz = 1e4;          // of the tracking loop that gives the speeds
  std::size_t torque_ticks = 0;  // age of the torques
};

/// Largest force read off a leg that swings to and fro in the air.
double LargestSwingForce_N(const ObserverParams& params, const Lag& lag) {
  constexpr double kSwing_radps = 2.0 * M_PI * 5.0;
  const Vec3 amplitude_rad(0.0, 0.4, -0.6);
  const core::RobotDescription& robot = test::Go2();
  const core::WholeBodyModel model(robot, kGravity_mps2);
  MomentumObserver observer(params, robot, kGravity_mps2);
  core::WholeBody wb;
  const double share = 1.0 - std::exp(-2.0 * M_PI * lag.loop_Hz * kStep_s);
  Vec3 first = Vec3::Zero(), second = Vec3::Zero();
  std::vector<LegArray<Vec3>> torques;
  Motion standing;
  standing.state = test::StandingState();
  double largest_N = 0.0;
  for (int i = 0; i < 600; ++i) {
    const double angle = kSwing_radps * kStep_s * i;
    Motion m = standing;
    m.state.q[Leg::kFR] += amplitude_rad * (1.0 - std::cos(angle));
    m.state.qd[Leg::kFR] = amplitude_rad * kSwing_radps * std::sin(angle);
    m.qdd[Leg::kFR] = amplitude_rad * kSwing_radps * kSwing_radps * std::cos(angle);
    model.Calc(m.state, wb);
    SensorFrame z = Sense(robot, wb, m);
    torques.push_back(z.tau_Nm);
    z.tau_Nm =
        torques[torques.size() > lag.torque_ticks ? torques.size() - 1 - lag.torque_ticks : 0];
    first += share * (z.qd[Leg::kFR] - first);
    second += share * (first - second);
    z.qd[Leg::kFR] = second;
    const Vec3 f = observer.Update({wb, z, kStep_s})[Leg::kFR];
    if (i > 100) largest_N = std::max(largest_N, f.norm());
  }
  return largest_N;
}

TEST(MomentumObserver, MotionWaitsForOlderTorques) {
  Lag lag;
  lag.torque_ticks = 2;
  ObserverParams matched = Prompt();
  matched.torque_delay_s = 0.002;
  EXPECT_LT(LargestSwingForce_N(matched, lag), 0.5 * LargestSwingForce_N(Prompt(), lag));
}

TEST(MomentumObserver, LaggingSpeedsMeetTorquesThatLagAlike) {
  Lag lag;
  lag.loop_Hz = 60.0;
  ObserverParams matched = Prompt();
  matched.velocity_bandwidth_Hz = lag.loop_Hz;
  EXPECT_LT(LargestSwingForce_N(matched, lag), 0.5 * LargestSwingForce_N(Prompt(), lag));
}

TEST(MomentumObserver, SampleThatIsNotFiniteLeavesTheForces) {
  Motion m;
  m.state = test::StandingState();
  m.f_F_W = LegArray<Vec3>(Vec3(3.0, -2.0, 40.0));
  const core::WholeBodyModel model(test::Go2(), kGravity_mps2);
  MomentumObserver observer(Prompt(), test::Go2(), kGravity_mps2);
  core::WholeBody wb;
  model.Calc(m.state, wb);
  const SensorFrame good = Sense(test::Go2(), wb, m);
  SensorFrame bad = good;
  bad.tau_Nm[Leg::kHL].y() = std::numeric_limits<double>::quiet_NaN();
  for (const SensorFrame& z : {good, bad, good}) {
    EXPECT_LT(LargestError_N(observer.Update({wb, z, kStep_s}), m.f_F_W), 1e-9);
  }
}

TEST(CalcFootForce, IsExactAwayFromTheSingularityAndBoundedInIt) {
  constexpr double kLimit_m = 0.03;
  const core::LegDescription& leg = test::Go2().legs[Leg::kFL];
  const Vec3 f(5.0, -8.0, 60.0);
  const Mat3 bent = core::CalcLegKinematics(leg, Vec3(0.1, 0.8, -1.6)).J;
  EXPECT_LT((CalcFootForce(bent, bent.transpose() * f, kLimit_m) - f).norm(), 1e-9);
  // With the least singular value s below the limit, gain is at most 1 / limit.
  for (const double knee_rad : {0.0, -1e-3, -0.05}) {
    const Mat3 straight = core::CalcLegKinematics(leg, Vec3(0.0, 0.0, knee_rad)).J;
    const Vec3 noise(0.1, -0.1, 0.1);
    const double bound_N = noise.norm() / kLimit_m;
    EXPECT_LT(CalcFootForce(straight, noise, kLimit_m).norm(), bound_N) << knee_rad;
  }
}

// --- Fusion -------------------------------------------------------------------------------------

TEST(CalcPhaseProbability, IsPeriodicAndHalfAtTheTransitions) {
  constexpr double kDuty = 0.6, kSigma = 0.04;
  EXPECT_NEAR(CalcPhaseProbability(0.0, kDuty, kSigma), 0.5, 1e-6);
  EXPECT_NEAR(CalcPhaseProbability(kDuty, kDuty, kSigma), 0.5, 1e-6);
  EXPECT_NEAR(CalcPhaseProbability(1.0 - 1e-12, kDuty, kSigma), 0.5, 1e-6);
  EXPECT_NEAR(CalcPhaseProbability(0.3, kDuty, kSigma), 1.0, 1e-6);
  EXPECT_NEAR(CalcPhaseProbability(0.8, kDuty, kSigma), 0.0, 1e-6);
  EXPECT_EQ(CalcPhaseProbability(0.8, 1.0, kSigma), 1.0);
}

TEST(CalcContactProbability, ForceOutweighsPhaseAndHeightTogether) {
  const FusionParams params;
  const double above = 0.5 + params.hysteresis, below = 0.5 - params.hysteresis;
  FusionInput in;
  in.phase = 0.8;
  in.duty = 0.6;
  in.height_m = 0.1;
  in.force = 0.3;
  EXPECT_GT(CalcContactProbability(params, in), above) << "early, on a rock";
  in.phase = 0.3;
  in.height_m = -0.1;
  in.force = 0.0;
  EXPECT_LT(CalcContactProbability(params, in), below) << "late, over a hole";
}

TEST(AdvancePhase, WrapsAndStandsWithoutAGait) {
  ContactPlan plan;
  EXPECT_TRUE(AdvancePhase(plan, Leg::kFL, 0.3).IsStance());
  plan.standing = false;
  plan.period_s = 0.5;
  plan.duty = LegArray<double>(0.6);
  plan.phase = LegArray<double>(0.55);
  EXPECT_TRUE(AdvancePhase(plan, Leg::kFL, 0.02).IsStance());
  EXPECT_FALSE(AdvancePhase(plan, Leg::kFL, 0.03).IsStance());
  EXPECT_TRUE(AdvancePhase(plan, Leg::kFL, 0.23).IsStance());
}

// --- Foot sensor --------------------------------------------------------------------------------

constexpr int Ticks(double seconds) { return static_cast<int>(seconds / kStep_s + 0.5); }

TEST(FootSensor, HysteresisHoldsAgainstNoise) {
  const FootSensorParams params;
  FootSensor sensor(params, kStep_s);
  const double threshold = params.initial_threshold_counts, half = 0.5 * params.hysteresis_counts;
  EXPECT_FALSE(sensor.Update(threshold + half, false));
  EXPECT_TRUE(sensor.Update(threshold + 3.0 * half, false));
  EXPECT_TRUE(sensor.Update(threshold - half, false));
  EXPECT_FALSE(sensor.Update(threshold - 3.0 * half, false));
}

TEST(FootSensor, ThresholdFollowsTheReadingInTheAir) {
  const FootSensorParams params;
  FootSensor sensor(params, kStep_s);
  for (int i = 0; i < Ticks(2.0); ++i) {
    const bool air = i % Ticks(0.5) < Ticks(0.2);
    (void)sensor.Update(air ? 30.0 : 90.0, air);
  }
  EXPECT_DOUBLE_EQ(sensor.threshold_counts(), 30.0 + params.margin_counts);
  ASSERT_TRUE(sensor.zero_counts());
  EXPECT_DOUBLE_EQ(*sensor.zero_counts(), 30.0);
}

TEST(FootSensor, StandingForAMinuteStaysContact) {
  core::Rng rng(1, 0, core::Stream::kSensor);
  FootSensor sensor({}, kStep_s);
  for (int i = 0; i < Ticks(0.5); ++i) (void)sensor.Update(12.0, true);
  for (int i = 0; i < Ticks(60.0); ++i) {
    ASSERT_TRUE(sensor.Update(60.0 + 4.0 * rng.NextNormal(), false)) << i;
  }
}

TEST(FootSensor, HangingForAMinuteStaysAir) {
  core::Rng rng(1, 0, core::Stream::kSensor);
  FootSensor sensor({}, kStep_s);
  for (int i = 0; i < Ticks(60.0); ++i) {
    ASSERT_FALSE(sensor.Update(12.0 + std::round(0.5 * rng.NextNormal()), true)) << i;
  }
}

TEST(FootSensor, ReadingThatIsNotFiniteIsNoContactAndForgotten) {
  FootSensor sensor({}, kStep_s);
  EXPECT_TRUE(sensor.Update(80.0, false));
  EXPECT_FALSE(sensor.Update(std::numeric_limits<double>::quiet_NaN(), false));
  EXPECT_TRUE(sensor.Update(80.0, false));
}

// --- Estimator ----------------------------------------------------------------------------------

/// A Go2 that trots on the spot: torques and foot sensors as the planned contacts ask for, trunk
/// and joints at rest.
class Trot {
 public:
  static constexpr double kPeriod_s = 0.5, kDuty = 0.6, kLoad_N = 75.0, kRise_s = 0.005;
  static constexpr double kZero_counts = 12.0, kGain_counts_per_N = 0.5;
  using Fault = double (*)(double counts, double since_s);

  explicit Trot(const ContactParams& params = {}, const core::RobotDescription& robot = test::Go2())
      : estimator(params, robot, kGravity_mps2, kStep_s),
        robot_(robot),
        rng_(3, 0, core::Stream::kSensor) {
    const core::WholeBodyModel model(robot_, kGravity_mps2);
    motion_.state = test::StandingState();
    model.Calc(motion_.state, wb_);
    plan_.duty = LegArray<double>(kDuty);
    plan_.period_s = kPeriod_s;
    plan_.standing = false;
  }

  const ContactEstimate& Step() {
    const double t_s = tick_ * kStep_s;
    for (const Leg leg : kLegs) {
      const bool diagonal = leg == Leg::kFL || leg == Leg::kHR;
      const double turns = t_s / kPeriod_s + (diagonal ? 0.0 : 0.5);
      plan_.phase[leg] = standing ? 0.3 : turns - std::floor(turns);
      contact[leg] = plan_.phase[leg] < kDuty;
      const double stance_s = plan_.phase[leg] * kPeriod_s;
      motion_.f_F_W[leg].z() = contact[leg] ? kLoad_N * std::min(1.0, stance_s / kRise_s) : 0.0;
    }
    plan_.standing = standing;
    SensorFrame z = Sense(robot_, wb_, motion_);
    for (const Leg leg : kLegs) {
      const double load_N = motion_.f_F_W[leg].z();
      z.foot_force_raw[leg] =
          std::round(kZero_counts + kGain_counts_per_N * load_N + noise_counts * rng_.NextNormal());
    }
    if (fault != nullptr) {
      z.foot_force_raw[Leg::kFL] = fault(z.foot_force_raw[Leg::kFL], fault_tick_ * kStep_s);
      ++fault_tick_;
    } else {
      fault_tick_ = 0;
    }
    if (give_truth) z.truth = SensorFrame::Truth{motion_.state, contact};
    ++tick_;
    out_ = estimator.Update({z, wb_, plan_, 0.0, {}, robot_.legs[Leg::kFL].foot_radius_m});
    return out_;
  }

  void Run(double seconds) {
    for (int i = 0; i < Ticks(seconds); ++i) (void)Step();
  }
  /// Time until the front left sensor's health is `wanted`; no more than `limit_s`.
  double TimeUntilHealth(bool wanted, double limit_s) {
    int ticks = 0;
    while (ticks < Ticks(limit_s) && Step().sensor_healthy[Leg::kFL] != wanted) ++ticks;
    return ticks * kStep_s;
  }
  [[nodiscard]] const ContactEstimate& out() const { return out_; }

  ContactEstimator estimator;
  LegArray<bool> contact;
  Fault fault = nullptr;
  bool standing = false, give_truth = false;
  double noise_counts = 0.8;

 private:
  core::RobotDescription robot_;
  core::Rng rng_;
  Motion motion_;
  core::WholeBody wb_;
  ContactPlan plan_;
  ContactEstimate out_;
  int tick_ = 0, fault_tick_ = 0;
};

ContactParams Choosing(ContactChoice type) {
  ContactParams params;
  params.source = type;
  return params;
}

double Stuck(double, double) { return 37.0; }
double Dropout(double, double) { return 0.0; }
double NotANumber(double, double) { return std::numeric_limits<double>::quiet_NaN(); }
double Packed(double counts, double) { return std::max(counts, 45.0) + counts / 16.0; }
double FastDrift(double counts, double since_s) { return counts + 100.0 * since_s; }
double SlowDrift(double counts, double since_s) { return counts + 1.0 * since_s; }

TEST(ContactEstimator, HealthySensorsAreTrustedAndRight) {
  Trot trot;
  int wrong = 0;
  trot.Run(1.0);
  for (int i = 0; i < Ticks(20.0); ++i) {
    const ContactEstimate& out = trot.Step();
    for (const Leg leg : kLegs) {
      ASSERT_TRUE(out.sensor_healthy[leg]) << i;
      ASSERT_EQ(out.source[leg], ContactSource::kSensor);
      wrong += out.contact[leg] != trot.contact[leg] ? 1 : 0;
    }
  }
  EXPECT_LT(wrong, Ticks(20.0) * kNumLegs / 100);
}

TEST(ContactEstimator, CountsThatRestInTheAirAreNotStuck) {
  Trot trot;
  trot.noise_counts = 0.0;
  for (int i = 0; i < Ticks(20.0); ++i) {
    const ContactEstimate& out = trot.Step();
    for (const Leg leg : kLegs) ASSERT_TRUE(out.sensor_healthy[leg]) << i;
  }
}

TEST(ContactEstimator, FaultsAreNoticedWithinHalfASecondAndOnThatFootOnly) {
  for (const Trot::Fault fault : {Stuck, Dropout, NotANumber, Packed, FastDrift}) {
    for (const double start_s : {3.0, 3.1, 3.2, 3.3, 3.4}) {
      Trot trot;
      trot.Run(start_s);
      trot.fault = fault;
      EXPECT_LT(trot.TimeUntilHealth(false, 1.0), 0.5) << start_s;
      for (int i = 0; i < Ticks(2.0); ++i) {
        const ContactEstimate& out = trot.Step();
        ASSERT_EQ(out.source[Leg::kFL], ContactSource::kObserver);
        for (const Leg leg : {Leg::kFR, Leg::kHL, Leg::kHR}) {
          ASSERT_EQ(out.source[leg], ContactSource::kSensor);
        }
      }
    }
  }
}

TEST(ContactEstimator, SlowDriftIsFollowedUntilItsLimit) {
  const HealthParams params;
  Trot trot;
  trot.Run(3.0);
  trot.fault = SlowDrift;
  const double limit_s = params.drift_counts;  // at one count a second
  EXPECT_NEAR(trot.TimeUntilHealth(false, 2.0 * limit_s), limit_s, 2.0);
}

TEST(ContactEstimator, SensorReturnsAfterAgreementAndTime) {
  const HealthParams params;
  Trot trot;
  trot.Run(3.0);
  trot.fault = Dropout;
  trot.Run(1.0);
  trot.fault = nullptr;
  const double back_s = trot.TimeUntilHealth(true, 20.0);
  EXPECT_GE(back_s, params.recover_s - kStep_s);
  // The window of least readings must forget the fault's zeros first.
  EXPECT_LT(back_s, FootSensorParams{}.min_window_s + params.recover_s + Trot::kPeriod_s);
  EXPECT_EQ(trot.out().source[Leg::kFL], ContactSource::kSensor);
}

TEST(ContactEstimator, SensorDoesNotReturnWithoutSteps) {
  Trot trot;
  trot.Run(3.0);
  trot.fault = Packed;
  trot.Run(1.0);
  trot.fault = nullptr;
  trot.standing = true;
  EXPECT_GE(trot.TimeUntilHealth(true, 20.0), 20.0 - kStep_s);
}

TEST(ContactEstimator, StandingForAMinuteStaysHealthyContact) {
  Trot trot;
  trot.standing = true;
  for (int i = 0; i < Ticks(60.0); ++i) {
    const ContactEstimate& out = trot.Step();
    for (const Leg leg : kLegs) ASSERT_TRUE(out.contact[leg] && out.sensor_healthy[leg]) << i;
  }
}

TEST(ContactEstimator, WithoutFootSensorsTheObserverSpeaks) {
  core::RobotDescription robot = test::Go2();
  robot.config.has_foot_sensors = false;
  for (const ContactChoice type : {ContactChoice::kHierarchy, ContactChoice::kSensor}) {
    Trot trot(Choosing(type), robot);
    int wrong = 0;
    for (int i = 0; i < Ticks(2.0); ++i) {
      const ContactEstimate& out = trot.Step();
      for (const Leg leg : kLegs) {
        ASSERT_FALSE(out.sensor_healthy[leg]);
        ASSERT_EQ(out.source[leg], ContactSource::kObserver);
        wrong += out.contact[leg] != trot.contact[leg] ? 1 : 0;
      }
    }
    EXPECT_LT(wrong, Ticks(2.0) * kNumLegs * 3 / 100);
  }
}

TEST(ContactEstimator, GaitPhaseIsThePlanWhateverTheFeetFeel) {
  Trot trot(Choosing(ContactChoice::kGaitPhase));
  for (int i = 0; i < Ticks(1.0); ++i) {
    const ContactEstimate& out = trot.Step();
    for (const Leg leg : kLegs) ASSERT_EQ(out.contact[leg], trot.contact[leg]);
  }
}

TEST(ContactEstimator, TruthComesLateAsAskedAndStaysWhereMissing) {
  ContactParams params = Choosing(ContactChoice::kTruth);
  params.touchdown_delay_s = 0.01;
  Trot trot(params);
  trot.give_truth = true;
  LegArray<int> touching;
  for (int i = 0; i < Ticks(1.0); ++i) {
    const ContactEstimate& out = trot.Step();
    for (const Leg leg : kLegs) {
      touching[leg] = trot.contact[leg] ? touching[leg] + 1 : 0;
      ASSERT_EQ(out.contact[leg], touching[leg] > Ticks(0.01));
    }
  }
  const LegArray<bool> last = trot.out().contact;
  trot.give_truth = false;
  trot.Run(0.33);
  EXPECT_EQ(trot.out().contact, last);
}

TEST(ContactEstimator, ChangeOfChoiceFindsEverySourceSettled) {
  Trot by_truth(Choosing(ContactChoice::kTruth)), by_hierarchy;
  by_truth.give_truth = true;
  by_truth.Run(5.0);
  by_hierarchy.Run(5.0);
  by_truth.estimator.SetChoice(ContactChoice::kHierarchy);
  by_truth.Run(kStep_s);
  by_hierarchy.Run(kStep_s);
  EXPECT_EQ(by_truth.out(), by_hierarchy.out());
}

TEST(ContactEstimator, UpdateDoesNotAllocate) {
  Trot trot;
  trot.give_truth = true;
  const test::AllocationGuard guard;
  if (!test::AllocationGuard::IsArmed()) GTEST_SKIP();
  trot.Run(1.0);
  EXPECT_EQ(guard.count(), 0);
}

TEST(ContactEstimator, OnlyTruthNeedsTruth) {
  EXPECT_TRUE(NeedsTruth(Choosing(ContactChoice::kTruth)));
  EXPECT_FALSE(NeedsTruth(ContactParams{}));
  EXPECT_FALSE(NeedsTruth(Choosing(ContactChoice::kGaitPhase)));
}

TEST(ContactParams, AreWrittenAndReadBack) {
  ContactParams params;
  params.source = ContactChoice::kMomentumObserver;
  params.observer.cutoff_Hz = 55.0;
  params.health.recover_transitions = 9;
  const auto again = core::ReadConfig<ContactParams>(core::WriteConfig(params));
  EXPECT_EQ(again.source, params.source);
  EXPECT_EQ(again.observer.cutoff_Hz, params.observer.cutoff_Hz);
  EXPECT_EQ(again.health.recover_transitions, params.health.recover_transitions);
}

}  // namespace
}  // namespace scoria::controller
