// SPDX-License-Identifier: BSD-3-Clause
#include "controller/model/momentum_observer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "controller/estimation/contact_fusion.h"
#include "core/math/so3.h"
#include "core/rng.h"
#include "core/robot/whole_body.h"
#include "tests/support/go1_log.h"
#include "tests/support/motion.h"
#include "tests/support/robots.h"

namespace scoria::controller {
namespace {

using test::kGravity_mps2;
using test::kStep_s;
using test::LogTick;
using test::Motion;
using test::Sense;

void Advance(Motion& m) {
  m.state.R_WB = core::ExpSo3(m.state.w_WB * kStep_s) * m.state.R_WB;
  m.state.w_WB += m.wd_WB * kStep_s;
  m.state.v_WB += m.vd_WB * kStep_s;
  for (const Leg leg : kLegs) {
    m.state.q[leg] += m.state.qd[leg] * kStep_s;
    m.state.qd[leg] += m.qdd[leg] * kStep_s;
  }
}

struct Observed {
  LegArray<Vec3> f_F_W = ZeroPerLeg();
  Vec6 a_B = Vec6::Zero();
};

/// What the observer reads after `ticks` of the motion.
Observed Observe(const ObserverParams& params, Motion m, int ticks) {
  const core::RobotDescription& robot = test::Go2();
  const core::WholeBodyModel model(robot, kGravity_mps2);
  MomentumObserver observer(params, robot, kGravity_mps2);
  core::WholeBody wb;
  Observed out;
  for (int i = 0; i < ticks; ++i) {
    model.Calc(m.state, wb);
    out.f_F_W = observer.Update({wb, Sense(robot, wb, m), kStep_s});
    Advance(m);
  }
  out.a_B = observer.a_B();
  return out;
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
  EXPECT_LT(LargestError_N(Observe(Prompt(), m, 50).f_F_W, m.f_F_W), 1e-9);
}

TEST(MomentumObserver, FreeFallReadsNoForceWhereLegGravityAloneDoes) {
  Motion m;
  m.state = test::StandingState();
  m.vd_WB = Vec3(0.0, 0.0, -kGravity_mps2);
  EXPECT_LT(LargestError_N(Observe(Prompt(), m, 50).f_F_W, m.f_F_W), 1e-9);
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
  const Observed out = Observe(Prompt(), m, 40);
  // The low passes lag the motion's change by a few milliseconds.
  EXPECT_LT(LargestError_N(out.f_F_W, m.f_F_W), 0.5);
  EXPECT_LT((out.a_B.head<3>() - m.vd_WB).norm(), 0.02 * m.vd_WB.norm());
  EXPECT_LT((out.a_B.tail<3>() - m.wd_WB).norm(), 0.02 * m.wd_WB.norm());
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
    EXPECT_LT(LargestError_N(Observe(params, m, 20).f_F_W, m.f_F_W), 2.0) << trial;
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

// --- A Go1 of another team's simulator ----------------------------------------------------------

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

/// Contact by the fusion from any estimate of force, with no plan known (all feet planned to
/// stand).
class PlanlessFusion {
 public:
  bool Update(Leg leg, const core::WholeBody& wb, const Vec3& f_F_W) {
    FusionInput in;
    in.force = f_F_W.z() / (wb.mass_kg * kGravity_mps2);
    in.height_m = wb.p_WF[leg].z() - test::kGo1FootRadius_m;
    contact_[leg] = DecideContact(params_, CalcContactProbability(params_, in), contact_[leg]);
    return contact_[leg];
  }

 private:
  FusionParams params_;
  LegArray<bool> contact_;
};

TEST(Go1Log, ObserverFindsForcesAndContactsBetterThanQuasiStaticTorques) {
  const std::optional<std::filesystem::path> folder = test::Go1Folder();
  if (!folder) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const core::RobotDescription robot = test::LoadGo1(*folder);
  const std::vector<LogTick> log = test::ReadGo1Log(*folder, robot);
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
      if (i < test::kGo1SettleTicks) continue;
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

}  // namespace
}  // namespace scoria::controller
