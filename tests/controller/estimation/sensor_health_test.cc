// SPDX-License-Identifier: BSD-3-Clause
// SensorHealth by a foot whose contact word stays right, so that only its counts can betray it.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "controller/estimation/foot_sensor.h"
#include "core/rng.h"
#include "tests/support/motion.h"

namespace scoria::controller {
namespace {

using test::kStep_s;
using test::Ticks;
constexpr double kStance_s = 0.6, kSwing_s = 0.2;

/// What becomes of a sensor: counts of gain · (share · force + offset).
struct Fault {
  double offset_N = 0.0, share = 1.0;
  friend void PrintTo(const Fault& f, std::ostream* out) {
    *out << f.offset_N << " N, " << f.share;
  }
};
constexpr Fault kNoFoot, kPacked{60.0, 0.5};

/// One foot that walks: 42 N in stance, 76 N while the other diagonal swings.
class Foot {
 public:
  explicit Foot(const HealthParams& params = {}) : health_(params, kStep_s) {}

  bool Step() {
    const double cycle_s = std::fmod(tick_++ * kStep_s, kStance_s + kSwing_s);
    const bool down = standing || cycle_s < kStance_s;
    const bool loaded = cycle_s > 0.2 && cycle_s < 0.4;
    const double force_N = payload_share * (!down ? 0.0 : loaded ? 76.0 : 42.0);
    HealthInput in;
    in.raw_counts = Counts(force_N);
    in.sensor = in.observer = down;
    in.probability = down ? 0.95 : 0.05;
    in.force_N = observer_share * force_N + observer_offset_N + 5.0 * rng_.NextNormal();
    return health_.Update(in);
  }
  /// @returns whether it was believed throughout.
  bool Run(double seconds) {
    bool healthy = true;
    for (int i = 0; i < Ticks(seconds); ++i) healthy = Step() && healthy;
    return healthy;
  }
  /// @returns time until the health is `wanted`, no more than `limit_s`.
  double TimeUntil(bool wanted, double limit_s) {
    int ticks = 0;
    while (ticks < Ticks(limit_s) && Step() != wanted) ++ticks;
    return ticks * kStep_s;
  }

  Fault fault;
  double gain_per_N = 0.8, zero_counts = 12.0, dead_band_N = 5.0, limit_counts = 1023.0;
  double observer_share = 1.0, observer_offset_N = 0.0, payload_share = 1.0;
  bool standing = false;

 private:
  double Counts(double force_N) {
    const double sensed_N = fault.share * force_N + fault.offset_N - dead_band_N;
    const double counts =
        gain_per_N * std::max(0.0, sensed_N) + zero_counts + 0.5 * rng_.NextNormal();
    return std::clamp(std::round(counts), 0.0, limit_counts);
  }
  SensorHealth health_;
  core::Rng rng_{7, 0, core::Stream::kSensor};
  int tick_ = 0;
};

constexpr double kLearning_s = 8.0;  // ten strides

TEST(SensorHealth, BelievesAHealthySensorOfAnyGainAndZero) {
  for (const double gain_per_N : {0.1, 0.8, 5.0}) {
    for (const double zero_counts : {0.0, 100.0}) {
      Foot foot;
      foot.gain_per_N = gain_per_N;
      foot.zero_counts = zero_counts;
      EXPECT_TRUE(foot.Run(60.0)) << gain_per_N << ", " << zero_counts;
    }
  }
}

TEST(SensorHealth, AJumpOfTheCountsIsNoticedInTheMiddleOfAStance) {
  for (const Fault fault : {kPacked, Fault{40.0, 1.0}, Fault{0.0, 2.0}}) {
    Foot foot;
    ASSERT_TRUE(foot.Run(kLearning_s + 0.1));
    foot.fault = fault;
    EXPECT_LT(foot.TimeUntil(false, 5.0), 0.1) << ::testing::PrintToString(fault);
  }
}

TEST(SensorHealth, AJumpOfTheCountsIsNoticedInTheFirstSwing) {
  for (const Fault fault : {kPacked, Fault{30.0, 0.7}, Fault{30.0, 1.0}}) {
    Foot foot;
    ASSERT_TRUE(foot.Run(kLearning_s + kStance_s));
    foot.fault = fault;
    EXPECT_LT(foot.TimeUntil(false, 5.0), 0.1) << ::testing::PrintToString(fault);
  }
}

TEST(SensorHealth, AJumpIsNoticedWhileStandingForAMinute) {
  Foot foot;
  ASSERT_TRUE(foot.Run(kLearning_s));
  foot.standing = true;
  ASSERT_TRUE(foot.Run(60.0));
  foot.fault = kPacked;
  EXPECT_LT(foot.TimeUntil(false, 5.0), 0.25);
}

TEST(SensorHealth, ASlowDriftIsFollowed) {
  Foot foot;
  ASSERT_TRUE(foot.Run(kLearning_s));
  for (int i = 0; i < Ticks(60.0); ++i) {
    foot.zero_counts += 1.0 * kStep_s;
    ASSERT_TRUE(foot.Step()) << i;
  }
}

TEST(SensorHealth, NothingIsJudgedBeforeTheFootWasInTheAirAndOnTheGround) {
  Foot foot;
  foot.standing = true;
  ASSERT_TRUE(foot.Run(kLearning_s));
  foot.fault = kPacked;
  EXPECT_TRUE(foot.Run(kLearning_s));
}

TEST(SensorHealth, TheObserversOwnErrorsAreTolerated) {
  Foot foot;
  ASSERT_TRUE(foot.Run(kLearning_s));
  for (const double share : {0.75, 2.0}) {  // a stance on a slope, a leg nearly stretched
    foot.observer_share = share;
    EXPECT_TRUE(foot.Run(kStance_s + kSwing_s)) << share;
  }
  foot.observer_share = 1.0;
  ASSERT_TRUE(foot.Run(0.1));
  foot.fault = {500.0, 1.0};  // an impact that the observer has not seen yet
  EXPECT_TRUE(foot.Run(0.006));
  foot.fault = kNoFoot;
  EXPECT_TRUE(foot.Run(10.0));
}

TEST(SensorHealth, AnObserverThatFallsBehindAHighLoadOrPullsAtTheFootIsTolerated) {
  Foot foot;
  ASSERT_TRUE(foot.Run(kLearning_s));
  foot.payload_share = 3.0;
  foot.observer_share = 0.6;
  EXPECT_TRUE(foot.Run(0.3));
  foot.payload_share = foot.observer_share = 1.0;
  ASSERT_TRUE(foot.Run(0.3));
  foot.observer_offset_N = -100.0;  // in the air
  EXPECT_TRUE(foot.Run(kSwing_s));
}

TEST(SensorHealth, ASaturatedSensorIsStillASensor) {
  HealthParams params;
  params.saturated_counts = 44.0;  // 45 N
  Foot foot(params);
  foot.limit_counts = params.saturated_counts;
  EXPECT_TRUE(foot.Run(kLearning_s));
  foot.payload_share = 3.0;  // always at the limit
  EXPECT_TRUE(foot.Run(kLearning_s));
  foot.payload_share = 1.0;
  EXPECT_TRUE(foot.Run(kLearning_s));
  foot.fault = kPacked;
  EXPECT_LT(foot.TimeUntil(false, 5.0), kStance_s + 0.1);  // saturated, it shows in the air only
}

TEST(SensorHealth, ComesBackOnceTheFaultHasEndedAndNotBefore) {
  const HealthParams params;
  Foot foot(params);
  ASSERT_TRUE(foot.Run(kLearning_s + 0.1));
  foot.fault = kPacked;
  ASSERT_LT(foot.TimeUntil(false, 5.0), 0.5);
  ASSERT_GE(foot.TimeUntil(true, 30.0), 30.0 - kStep_s);
  foot.fault = kNoFoot;
  const double back_s = foot.TimeUntil(true, 30.0);
  EXPECT_GE(back_s, params.recover_s - kStep_s);
  EXPECT_LT(back_s, params.recover_s + 2.0 * (kStance_s + kSwing_s));
  EXPECT_TRUE(foot.Run(30.0));
}

}  // namespace
}  // namespace scoria::controller
