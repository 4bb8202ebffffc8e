// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/judge.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "tests/logs/quality/quality_logs.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

/// A body on a circle, seen by motion capture alone, 200 Hz: yaw, velocity and position agree.
std::vector<Row> Circle(double duration_s = 6.0) {
  constexpr double kRate_radps = 0.6, kRadius_m = 1.0;
  std::vector<Row> rows;
  for (int k = 0; k * 0.005 < duration_s; ++k) {
    Row row;
    row.time_s = k * 0.005;
    const double yaw = kRate_radps * row.time_s, speed = kRate_radps * kRadius_m;
    row.truth.emplace();
    row.truth->p_WB_m = {kRadius_m * std::sin(yaw), kRadius_m * (1.0 - std::cos(yaw)), 0.3};
    row.truth->v_WB_mps = {speed * std::cos(yaw), speed * std::sin(yaw), 0.0};
    row.truth->w_WB_radps = {0.0, 0.0, kRate_radps};
    row.truth->rpy_rad = {0.0, 0.0, yaw};
    rows.push_back(row);
  }
  return rows;
}

/// The only finding of a kind; none if there are others of it.
std::optional<Finding> Find(const std::vector<Finding>& findings, FindingKind kind) {
  std::optional<Finding> found;
  for (const Finding& f : findings) {
    if (f.kind != kind) continue;
    if (found) return std::nullopt;
    found = f;
  }
  return found;
}

TEST(LogJudge, CircleHasNothingWrong) {
  for (const Finding& f : test::Judge(Circle(), nullptr))
    EXPECT_EQ(f.severity, Severity::kNote) << DescribeFinding(f);
}

TEST(LogJudge, EmptyLogHasNothingWrong) { EXPECT_TRUE(test::Judge({}, nullptr).empty()); }

TEST(LogJudge, VelocityInAxesOfTheTrunkIsToldByThePosition) {
  std::vector<Row> rows = Circle();
  for (Row& row : rows) row.truth->v_WB_mps = {0.6, 0.0, 0.0};
  const auto f = Find(test::Judge(rows, nullptr), FindingKind::kVelocityFrame);
  ASSERT_TRUE(f);
  EXPECT_EQ(f->signal, "truth.velocity");
  EXPECT_EQ(f->severity, Severity::kError);
  EXPECT_EQ(f->repair, "mapping: truth.velocity: {frame: body}");
  EXPECT_TRUE(f->spoils[static_cast<std::size_t>(RowGroup::kTruth)]);
  EXPECT_EQ(f->spoils.count(), 1u);
}

TEST(LogJudge, FrameOfAVelocityIsNotJudgedWithoutTurning) {
  std::vector<Row> rows = Circle();
  for (Row& row : rows) {
    row.truth->p_WB_m = {0.6 * row.time_s, 0.0, 0.3};
    row.truth->v_WB_mps = {0.6, 0.0, 0.0};
    row.truth->w_WB_radps = {};
    row.truth->rpy_rad = {};
  }
  bool is_told = false;
  for (const Finding& f : test::Judge(rows, nullptr)) {
    EXPECT_EQ(f.severity, Severity::kNote) << DescribeFinding(f);
    is_told = is_told || (f.kind == FindingKind::kNotJudged && f.signal == "truth.velocity");
  }
  EXPECT_TRUE(is_told);
}

TEST(LogJudge, WordsOfTheirOwnAreNoMeasurements) {
  std::vector<Row> rows = Circle();
  for (Row& row : rows) {
    row.measured.emplace();
    row.measured->q_rad.emplace();
    row.measured->q_rad->fill(0.1 * std::sin(3.0 * row.time_s));
  }
  for (int k = 100; k < 110; ++k) (*rows[static_cast<std::size_t>(k)].measured->q_rad)[4] = 2.146e9;
  (*rows[200].measured->q_rad)[5] = std::numeric_limits<double>::quiet_NaN();
  int sentinels = 0;
  for (const Finding& f : test::Judge(rows, nullptr)) {
    if (f.kind != FindingKind::kSentinel) continue;
    ++sentinels;
    EXPECT_EQ(f.signal, "joints.q");
    if (f.count == 1u) {
      EXPECT_EQ(f.evidence, "no finite number, 1 times");
      continue;
    }
    EXPECT_EQ(
        DescribeFinding(f),
        "error: sentinel of joints.q, at 0.500 to 0.545 s: 2.146e+09, which no sensor measures, "
        "10 times; mapping: joints.q: {absent: [2.146e+09]}");
  }
  EXPECT_EQ(sentinels, 2);
}

/// A Go2's legs on the move, one knee held for a second.
std::vector<Row> HeldKnee(const core::RobotDescription& robot, double held_rad) {
  std::vector<Row> rows = Circle();
  for (Row& row : rows) {
    logs::Array12& q_rad = row.measured.emplace().q_rad.emplace();
    for (std::size_t j = 0; j < q_rad.size(); ++j) {
      const core::JointDescription& joint = robot.legs[kLegs[j / 3]].joints[j % 3];
      const double middle_rad = 0.5 * (joint.lower_rad + joint.upper_rad);
      q_rad[j] = middle_rad + 0.4 * std::sin(6.0 * row.time_s + static_cast<double>(j));
    }
    if (row.time_s > 2.0 && row.time_s < 3.0) q_rad[5] = held_rad;
  }
  return rows;
}

TEST(LogJudge, JointOnItsStopIsNotStuck) {
  const core::RobotDescription robot = test::Go2();
  const core::JointDescription& knee = robot.legs[Leg::kFR].joints[2];
  const auto stuck =
      Find(test::Judge(HeldKnee(robot, knee.upper_rad - 0.05), &robot), FindingKind::kStuckSensor);
  ASSERT_TRUE(stuck);
  EXPECT_EQ(stuck->leg, Leg::kFR);
  for (const double stop_rad : {knee.upper_rad - 0.001, knee.lower_rad + 0.001}) {
    EXPECT_FALSE(Find(test::Judge(HeldKnee(robot, stop_rad), &robot), FindingKind::kStuckSensor));
  }
}

TEST(LogJudge, RateOfAJointHasTheSignOfItsDerivative) {
  std::vector<Row> rows = Circle();
  for (Row& row : rows) {
    row.measured.emplace();
    row.measured->q_rad.emplace().fill(0.1 * std::sin(6.0 * row.time_s));
    row.measured->qd_radps.emplace().fill(0.6 * std::cos(6.0 * row.time_s));
    (*row.measured->qd_radps)[7] *= -1.0;
  }
  const auto f = Find(test::Judge(rows, nullptr), FindingKind::kJointRate);
  ASSERT_TRUE(f);
  EXPECT_EQ(f->leg, Leg::kHL);
  EXPECT_EQ(f->joint, Joint::kHFE);
  EXPECT_NEAR(f->size.value(), -1.0, 0.01);
}

TEST(LogJudge, JumpOfAPositionIsNamedWithItsMoment) {
  std::vector<Row> rows = Circle();
  for (std::size_t k = 600; k < rows.size(); ++k) rows[k].truth->p_WB_m[0] += 1.0;
  const auto f = Find(test::Judge(rows, nullptr), FindingKind::kJump);
  ASSERT_TRUE(f);
  ASSERT_EQ(f->spans.size(), 1u);
  EXPECT_NEAR(f->spans[0].begin_s, 3.0, 0.02);
}

TEST(LogJudge, PlacementOfTheRobotIsNoJump) {
  std::vector<Row> rows = Circle();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].episode.emplace();
    rows[k].episode->segment = k < 600 ? 0 : 1;
    if (k >= 600) rows[k].truth->p_WB_m[0] += 1.0;
  }
  EXPECT_FALSE(Find(test::Judge(rows, nullptr), FindingKind::kJump));
}

TEST(LogJudge, StandingRobotsPauseMayBeAGapOrAStep) {
  std::vector<Row> rows = Circle();
  for (Row& row : rows) row.truth->p_WB_m = {0.0, 0.0, 0.3};
  for (std::size_t k = 600; k < rows.size(); ++k) rows[k].time_s += 1.0;
  const auto f = Find(test::Judge(rows, nullptr), FindingKind::kGap);
  ASSERT_TRUE(f);
  EXPECT_NE(f->evidence.find("not enough motion to tell"), std::string::npos) << f->evidence;
}

TEST(LogJudge, EqualTimesAndTimesThatGoBackAreNamed) {
  std::vector<Row> rows = Circle();
  rows[300].time_s = rows[299].time_s;
  for (std::size_t k = 600; k < 620; ++k) rows[k].time_s -= 0.5;
  const std::vector<Finding> findings = test::Judge(rows, nullptr);
  EXPECT_TRUE(Find(findings, FindingKind::kRepeatedTimes));
  bool goes_back = false;
  for (const Finding& f : findings)
    goes_back =
        goes_back || f.kind == FindingKind::kTimeBackwards || f.kind == FindingKind::kClockStep;
  EXPECT_TRUE(goes_back);
}

/// A trunk that turns to and fro, 200 Hz: a gyroscope, and an estimate that is late.
std::vector<Row> Swaying(double delay_s) {
  const auto R_WB = [](double t) {
    return core::RotationFromRpy(
        {0.1 * std::sin(7.0 * t), 0.08 * std::sin(5.0 * t + 1.0), 0.5 * std::sin(1.3 * t)});
  };
  std::vector<Row> rows;
  for (int k = 0; k < 1600; ++k) {
    Row row;
    row.time_s = k * 0.005;
    constexpr double kStep_s = 1e-4;
    const Vec3 w =
        core::LogSo3(R_WB(row.time_s - kStep_s).transpose() * R_WB(row.time_s + kStep_s)) /
        (2.0 * kStep_s);
    const Vec3 rpy = core::RpyFromRotation(R_WB(row.time_s - delay_s));
    row.measured.emplace().w_WS_S_radps = {w.x(), w.y(), w.z()};
    row.estimate.emplace().rpy_rad = {rpy.x(), rpy.y(), rpy.z()};
    rows.push_back(row);
  }
  return rows;
}

TEST(LogJudge, AttitudeThatIsLateIsNamedWithItsDelay) {
  const auto f = Find(test::Judge(Swaying(0.020), nullptr), FindingKind::kAttitudeDelay);
  ASSERT_TRUE(f);
  EXPECT_EQ(f->signal, "estimate.attitude");
  EXPECT_EQ(f->severity, Severity::kError);
  EXPECT_NEAR(f->size.value(), 0.020, 0.001);
  const auto less = Find(test::Judge(Swaying(0.011), nullptr), FindingKind::kAttitudeDelay);
  ASSERT_TRUE(less);
  EXPECT_EQ(less->severity, Severity::kWarning);
  const auto other = Find(test::Judge(Swaying(-0.020), nullptr), FindingKind::kImuDelay);
  ASSERT_TRUE(other);
  EXPECT_NEAR(other->size.value(), 0.020, 0.001);
  for (const double delay_s : {0.0, 0.004, -0.004}) {
    for (const Finding& f_of_none : test::Judge(Swaying(delay_s), nullptr))
      EXPECT_EQ(f_of_none.severity, Severity::kNote) << DescribeFinding(f_of_none);
  }
}

TEST(LogJudge, RateThatStaysAtItsExtremeIsSaturated) {
  std::vector<Row> rows = Swaying(0.0);
  EXPECT_FALSE(Find(test::Judge(rows, nullptr), FindingKind::kSaturation));
  constexpr double kEnd_radps = 0.4;  // of the sensor's range
  for (Row& row : rows) {
    double& w_x = (*row.measured->w_WS_S_radps)[0];
    w_x = std::min(w_x, kEnd_radps);
  }
  const auto f = Find(test::Judge(rows, nullptr), FindingKind::kSaturation);
  ASSERT_TRUE(f);
  EXPECT_EQ(f->severity, Severity::kWarning);
  EXPECT_EQ(f->signal, "imu.rate");
  EXPECT_EQ(f->size, kEnd_radps);
  EXPECT_GE(f->count, 8u);  // it sways at 1.1 Hz for 8 s
  EXPECT_TRUE(f->evidence.starts_with("x stays at its extreme 0.4 ")) << f->evidence;
}

TEST(LogJudge, JointBeyondItsLimitsIsNamedWithItsSize) {
  const core::RobotDescription& robot = test::Go2();
  const core::JointDescription& knee = robot.legs[Leg::kFR].joints[2];
  const auto rows_with = [&](double beyond_rad, double share) {
    std::vector<Row> rows = Circle();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      Array12& q = rows[k].measured.emplace().q_rad.emplace();
      for (std::size_t i = 0; i < q.size(); ++i)
        q[i] = std::array{0.0, 0.8, -1.5}[i % 3] + 0.1 * std::sin(3.0 * rows[k].time_s);
      if (static_cast<double>(k % 100) < 100.0 * share) q[5] = knee.upper_rad + beyond_rad;
    }
    return rows;
  };
  const auto f = Find(test::Judge(rows_with(0.3, 0.1), &robot), FindingKind::kJointLimits);
  ASSERT_TRUE(f);
  EXPECT_EQ(f->severity, Severity::kWarning);
  EXPECT_EQ(f->leg, Leg::kFR);
  EXPECT_EQ(f->joint, Joint::kKFE);
  EXPECT_NEAR(f->size.value(), 0.3, 1e-9);
  EXPECT_TRUE(f->evidence.starts_with("it is beyond its limits for 10 % of the time"))
      << f->evidence;
  EXPECT_FALSE(Find(test::Judge(rows_with(0.1, 0.1), &robot), FindingKind::kJointLimits));
  EXPECT_FALSE(Find(test::Judge(rows_with(-0.1, 0.1), &robot), FindingKind::kJointLimits));
}

}  // namespace
}  // namespace scoria::logs
