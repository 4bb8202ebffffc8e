// SPDX-License-Identifier: BSD-3-Clause
#include "controller/safety/supervisor.h"

#include <cmath>
#include <limits>
#include <tuple>

#include <gtest/gtest.h>

#include "controller/safety/stage_quality.h"

namespace scoria::controller {
namespace {

constexpr double kDt_s = 0.002;

Qualities AllSound() { return {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}; }

Qualities With(Monitor monitor, double quality) {
  Qualities q = AllSound();
  q[static_cast<std::size_t>(monitor)] = quality;
  return q;
}

/// Ticks until the first transition of `monitor`, or -1.
int TicksUntilTransition(Supervisor& supervisor, const Qualities& q, Monitor monitor, int limit) {
  for (int i = 1; i <= limit; ++i) {
    supervisor.Update(q, kDt_s);
    for (std::size_t k = 0; k < supervisor.transitions().count; ++k)
      if (supervisor.transitions().list[k].monitor == monitor) return i;
  }
  return -1;
}

class EveryWatch : public ::testing::TestWithParam<Monitor> {};

TEST_P(EveryWatch, FallsBackAfterItsTimeAndComesBackWhenSoundAgain) {
  SupervisorParams params;
  for (MonitorParams* w : {&params.mpc, &params.body, &params.estimator, &params.contact,
                           &params.footing, &params.load})
    *w = {.least_quality = 0.5, .after_s = 0.1, .recover_s = 0.3};
  Supervisor supervisor(params);
  EXPECT_EQ(TicksUntilTransition(supervisor, AllSound(), GetParam(), 1000), -1);
  EXPECT_NEAR(TicksUntilTransition(supervisor, With(GetParam(), 0.4), GetParam(), 1000), 51, 1);
  EXPECT_TRUE(supervisor.HasFallenBack(GetParam()));
  const Transition& t = supervisor.transitions().list[0];
  EXPECT_TRUE(t.fell_back);
  EXPECT_EQ(t.quality, 0.4);
  EXPECT_EQ(t.least_quality, 0.5);
  EXPECT_NEAR(TicksUntilTransition(supervisor, AllSound(), GetParam(), 1000), 150, 1);
  EXPECT_FALSE(supervisor.HasFallenBack(GetParam()));
  EXPECT_FALSE(FallbackName(GetParam()).empty());
}

INSTANTIATE_TEST_SUITE_P(Monitors, EveryWatch,
                         ::testing::Values(Monitor::kMpc, Monitor::kBody, Monitor::kEstimator,
                                           Monitor::kContact, Monitor::kFooting, Monitor::kLoad),
                         [](const auto& test) { return std::string(core::EnumName(test.param)); });

TEST(Supervisor, AQualityThatIsNotANumberIsUnsound) {
  Supervisor supervisor({});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_GT(TicksUntilTransition(supervisor, With(Monitor::kBody, nan), Monitor::kBody, 1000), 0);
}

TEST(Supervisor, OneBadTickAmongGoodOnesIsNoReason) {
  Supervisor supervisor({});
  for (int i = 0; i < 5000; ++i) {
    supervisor.Update(i % 3 == 0 ? With(Monitor::kFooting, 0.0) : AllSound(), kDt_s);
    ASSERT_EQ(supervisor.transitions().count, 0u);
  }
}

TEST(Supervisor, SwitchedOffItDoesNothing) {
  SupervisorParams params;
  params.enabled = false;
  Supervisor supervisor(params);
  for (int i = 0; i < 5000; ++i) supervisor.Update(Qualities{}, kDt_s);
  EXPECT_FALSE(supervisor.HasFallenBack(Monitor::kMpc));
  EXPECT_EQ(supervisor.care(), 0.0);
  EXPECT_EQ(supervisor.crouch(), 0.0);
}

TEST(Supervisor, TempersTheCommandWithoutAStep) {
  const SupervisorParams params;
  Supervisor supervisor(params);
  Command command;
  command.v_x_mps = 0.5;
  double before = 0.5;
  for (int i = 0; i < 2000; ++i) {
    supervisor.Update(With(Monitor::kFooting, 0.0), kDt_s);
    const double now = supervisor.Temper(command, 0.3).v_x_mps;
    ASSERT_LT(std::abs(now - before), 0.001);
    before = now;
  }
  EXPECT_NEAR(before, 0.5 * params.careful_speed_share, 1e-9);
  for (int i = 0; i < 5000; ++i) supervisor.Update(With(Monitor::kLoad, 0.0), kDt_s);
  const Command loaded = supervisor.Temper(command, 0.3);
  EXPECT_NEAR(loaded.v_x_mps, 0.0, 1e-9);
  EXPECT_NEAR(loaded.height_m, 0.3 * params.crouch_share, 1e-9);
}

/// Reports of a robot that is well.
struct Well {
  LegPhases legs;
  LegArray<bool> contact;
  [[nodiscard]] StageReports Report() const {
    return {.legs = legs, .contact = contact, .foot_lag_m = {}};
  }
};

double QualityOf(const Qualities& q, Monitor monitor) {
  return q[static_cast<std::size_t>(monitor)];
}

TEST(StageQuality, IsOneWhereAllIsWell) {
  const Well well;
  StageQuality quality({});
  for (int i = 0; i < 1000; ++i)
    for (const double q : quality.Update(well.Report(), kDt_s)) ASSERT_NEAR(q, 1.0, 1e-12);
}

TEST(StageQuality, ASpeedAtOddsWithTheAccelerometerDiscreditsTheEstimate) {
  const Well well;
  StageQuality quality({});
  StageReports reports = well.Report();
  // A real acceleration is seen by both.
  for (int i = 0; i < 1000; ++i) {
    reports.a_W = {0.5, 0.0, 0.0};
    reports.v_W.x() += 0.5 * kDt_s;
    std::ignore = quality.Update(reports, kDt_s);
  }
  EXPECT_GT(QualityOf(quality.qualities(), Monitor::kEstimator), 0.95);
  // An attitude that is off by 5 degrees turns gravity into an acceleration that nobody sees.
  for (int i = 0; i < 1000; ++i) {
    reports.a_W = {9.81 * std::sin(5.0 * M_PI / 180.0), 0.0, 0.0};
    std::ignore = quality.Update(reports, kDt_s);
  }
  EXPECT_LT(QualityOf(quality.qualities(), Monitor::kEstimator), 0.5);
}

TEST(StageQuality, StumblesAreSwingFeetThatTouchAndLagBehind) {
  Well well;
  well.legs.mode[Leg::kFL] = LegMode::kSwing;
  well.contact[Leg::kFL] = true;
  StageQuality quality({});
  StageReports reports = well.Report();
  for (int i = 0; i < 10; ++i) std::ignore = quality.Update(reports, kDt_s);
  EXPECT_EQ(QualityOf(quality.qualities(), Monitor::kFooting), 1.0) << "a foot that still touches";
  reports.foot_lag_m[Leg::kFL] = 0.06;
  for (int i = 0; i < 10; ++i) std::ignore = quality.Update(reports, kDt_s);
  const double once = QualityOf(quality.qualities(), Monitor::kFooting);
  EXPECT_NEAR(once, 1.0 - 1.0 / QualityParams{}.stumbles, 0.02) << "counts once a swing";
}

TEST(StageQuality, TiltAndSpentTorqueLowerTheirQualities) {
  const Well well;
  StageQuality quality({});
  StageReports reports = well.Report();
  reports.tilt_error_rad = 0.5 * QualityParams{}.tilt_rad;
  reports.torque_shortfall = QualityParams{}.load_shortfall;
  for (int i = 0; i < 3000; ++i) std::ignore = quality.Update(reports, kDt_s);
  EXPECT_NEAR(QualityOf(quality.qualities(), Monitor::kFooting), 0.5, 1e-9);
  EXPECT_LT(QualityOf(quality.qualities(), Monitor::kLoad), 0.01);
}

}  // namespace
}  // namespace scoria::controller
