// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/contact_estimator.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/config/archive.h"
#include "core/rng.h"
#include "core/robot/whole_body.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/go1_log.h"
#include "tests/support/robots.h"
#include "tests/support/trot.h"

namespace scoria::controller {
namespace {

using test::kGravity_mps2;
using test::kStep_s;
using test::LogTick;
using test::Ticks;
using test::Trot;

ContactParams Choosing(ContactChoice type) {
  ContactParams params;
  params.source = type;
  return params;
}

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
  if (!test::AllocationGuard::IsArmed()) GTEST_SKIP() << "the sanitizer owns the allocator";
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

// --- A Go1 of another team's simulator ----------------------------------------------------------

/// Sensors with the errors of real ones: torque gain, offset, noise and delay, encoders of 14 bit
/// with a tracking loop for the speed, noise of the IMU.
class RealisticSensors {
 public:
  explicit RealisticSensors(std::uint64_t seed) : rng_(seed, 0, core::Stream::kSensor) {
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

TEST(Go1Log, WithRealisticSensorsContactsAreRightAndInTime) {
  const std::optional<std::filesystem::path> folder = test::Go1Folder();
  if (!folder) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const core::RobotDescription robot = test::LoadGo1(*folder);
  const std::vector<LogTick> log = test::ReadGo1Log(*folder, robot);
  const core::WholeBodyModel model(robot, kGravity_mps2);
  constexpr int kEdge = 15, kClean = 50;  // ticks
  double right = 0.0, n = 0.0;
  std::vector<int> delays;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    RealisticSensors sensors(seed);
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
      said.push_back(estimator.Update({z, wb, no_plan, 0.0, {}, test::kGo1FootRadius_m}).observer);
    }
    for (const Leg leg : kLegs) {
      const std::vector<int> edge = TicksToEdge(log, leg);
      for (std::size_t i = test::kGo1SettleTicks; i < log.size(); ++i) {
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

}  // namespace
}  // namespace scoria::controller
