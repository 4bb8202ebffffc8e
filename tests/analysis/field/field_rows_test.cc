// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/field_rows.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/robots.h"

namespace scoria::analysis {
namespace {

constexpr double kStep_s = 0.01;

/// A robot that stands, with an estimate that moves along x and joints that do not.
logs::Row StandingRow(double time_s, double x_m, double roll_rad = 0.0) {
  logs::Row row;
  row.time_s = time_s;
  row.estimate.emplace().p_WB_m = {x_m, 0.0, 0.3};
  row.estimate->v_WB_mps = {0.3, 0.0, 0.0};
  row.estimate->rpy_rad = {roll_rad, 0.0, 0.0};
  row.measured.emplace();
  logs::Array12 q{}, tau{};
  for (std::size_t k = 0; k < q.size(); k += 3) {
    q[k + 1] = 0.8;
    q[k + 2] = -1.6;
    tau[k + 2] = 10.0;
  }
  row.measured->q_rad = q;
  row.measured->qd_radps.emplace();
  row.measured->tau_Nm = tau;
  row.contacts.emplace().contact = {true, true, true, true};
  row.contacts->f_F_W_N.emplace();
  for (const std::size_t z : {2U, 5U, 8U, 11U})
    (*row.contacts->f_F_W_N)[z] = test::Go2().total_mass_kg() * 9.81 / 4.0;
  return row;
}

/// Rolls over at 2 s and lies for a second.
double RollAt(double time_s) { return time_s < 2.0 || time_s > 3.0 ? 0.0 : 1.5; }

struct Completed {
  std::vector<logs::Row> rows;
  std::vector<FallEvent> falls;
};

FieldSetup MakeSetup(const core::RobotDescription& robot) {
  FieldSetup setup;
  setup.robot = &robot;
  setup.mass_kg = robot.total_mass_kg();
  setup.odometry = Odometry::kEstimate;
  setup.has_contacts = true;
  return setup;
}

Completed Complete(const FieldSetup& setup, const std::vector<logs::Row>& rows) {
  Completed completed;
  FieldRows field(
      setup, [&](const logs::Row& row, const logs::RowGroups&) { completed.rows.push_back(row); });
  for (const logs::Row& row : rows) field.Add(row);
  field.Finish();
  completed.falls = field.falls();
  return completed;
}

std::vector<logs::Row> Tumble() {
  std::vector<logs::Row> rows;
  for (int k = 0; k < 600; ++k)
    rows.push_back(StandingRow(kStep_s * k, 0.003 * k, RollAt(kStep_s * k)));
  return rows;
}

TEST(FieldRows, TiltIsAFallAndTheRobotWalksAgainASecondAfterItIsUpright) {
  const core::RobotDescription robot = test::Go2();
  const Completed c = Complete(MakeSetup(robot), Tumble());
  ASSERT_EQ(c.falls.size(), 1U);
  EXPECT_NEAR(c.falls[0].time_s, 2.0 + FallClues::kTilt_s, kStep_s);
  ASSERT_EQ(c.rows.size(), 600U);
  const auto state_at = [&](double time_s) {
    return *c.rows[static_cast<std::size_t>(std::lround(time_s / kStep_s))].episode;
  };
  EXPECT_FALSE(state_at(1.9).fallen);
  EXPECT_TRUE(state_at(2.5).fallen);
  EXPECT_TRUE(state_at(3.9).fallen);
  EXPECT_FALSE(state_at(4.2).fallen);
  EXPECT_NE(state_at(4.2).segment, state_at(1.9).segment);
}

TEST(FieldRows, WrongAttitudeOfAMomentIsNoFall) {
  const core::RobotDescription robot = test::Go2();
  std::vector<logs::Row> rows;
  for (int k = 0; k < 300; ++k)
    rows.push_back(StandingRow(kStep_s * k, 0.003 * k, k < 2 || k == 150 ? 3.1 : 0.0));
  EXPECT_TRUE(Complete(MakeSetup(robot), rows).falls.empty());
}

/// Tips to 72 degrees and back within 83 ms, over 60 degrees for 14 ms.
std::vector<FallEvent> FallsOfATip(bool has_gyroscope) {
  const core::RobotDescription robot = test::Go2();
  constexpr double kFine_s = 0.002, kTip_s = 1.0, kTip_rad = 1.25, kTurn_radps = 30.0;
  std::vector<logs::Row> rows;
  for (int k = 0; k < 1000; ++k) {
    const double time_s = kFine_s * k, since_s = time_s - kTip_s;
    const bool tips = std::abs(since_s) < kTip_rad / kTurn_radps;
    const double roll_rad = tips ? kTip_rad - kTurn_radps * std::abs(since_s) : 0.0;
    logs::Row row = StandingRow(time_s, 0.3 * time_s, roll_rad);
    if (has_gyroscope) {
      const double rate_radps = !tips ? 0.0 : since_s <= 0.0 ? kTurn_radps : -kTurn_radps;
      row.measured->w_WS_S_radps = {rate_radps, 0.0, 0.0};
    }
    rows.push_back(row);
  }
  return Complete(MakeSetup(robot), rows).falls;
}

TEST(FieldRows, TiltThatTheGyroscopeConfirmsNeedsNotLast) {
  EXPECT_TRUE(FallsOfATip(false).empty());
  EXPECT_EQ(FallsOfATip(true).size(), 1U);
}

TEST(FieldRows, EstimateThatIsLostWhileTheRobotLiesIsOneFall) {
  const core::RobotDescription robot = test::Go2();
  std::vector<logs::Row> rows = Tumble();
  for (std::size_t k = 220; k < 300; k += 20) rows[k].estimate->p_WB_m[1] = 3.0;
  EXPECT_EQ(Complete(MakeSetup(robot), rows).falls.size(), 1U);
}

/// The feet carry a third of the weight from 2 s on, over legs with that knee.
std::vector<FallEvent> FallsOfUnloadedFeet(double knee_rad) {
  const core::RobotDescription robot = test::Go2();
  std::vector<logs::Row> rows;
  for (int k = 0; k < 400; ++k) {
    logs::Row row = StandingRow(kStep_s * k, 0.003 * k);
    for (std::size_t j = 0; k >= 200 && j < 12; j += 3) {
      (*row.measured->q_rad)[j + 1] = -0.5 * knee_rad;
      (*row.measured->q_rad)[j + 2] = knee_rad;
    }
    for (const std::size_t z : {2U, 5U, 8U, 11U}) {
      if (k >= 200) (*row.contacts->f_F_W_N)[z] /= 3.0;
    }
    rows.push_back(row);
  }
  FieldSetup setup = MakeSetup(robot);
  setup.falls.trunk_force_N = 0.5 * robot.total_mass_kg() * 9.81;
  setup.falls.trunk_force_s = 0.2;
  return Complete(setup, rows).falls;
}

TEST(FieldRows, LoadThatTheFeetDoNotCarryIsAFallOfALowTrunk) {
  constexpr double kFolded_rad = -2.5, kStanding_rad = -1.6;  // 0.16 m and 0.32 m high
  const std::vector<FallEvent> low = FallsOfUnloadedFeet(kFolded_rad);
  ASSERT_EQ(low.size(), 1U);
  EXPECT_EQ(low[0].cause, "trunk_contact");
  EXPECT_NEAR(low[0].time_s, 2.35, 0.15) << "0.1 s of smoothing, 0.2 s of load";
  EXPECT_TRUE(FallsOfUnloadedFeet(kStanding_rad).empty()) << "knees may be on the ground";
}

/// Lies, stands up at 1 s, and is down again at 4 s, in `down_s`.
Completed StandUpAndGoDown(double down_s, double commanded_mps) {
  const core::RobotDescription robot = test::Go2();
  constexpr double kLying_rad = -2.72, kStanding_rad = -1.6;
  std::vector<logs::Row> rows;
  for (int k = 0; k < 800; ++k) {
    const double time_s = kStep_s * k;
    const double up = std::clamp(time_s - 1.0, 0.0, 1.0),
                 down = std::clamp((4.0 - time_s) / down_s, 0.0, 1.0);
    const double knee_rad = kLying_rad + std::min(up, down) * (kStanding_rad - kLying_rad);
    logs::Row row = StandingRow(time_s, 0.0);
    for (std::size_t j = 0; j < 12; j += 3) {
      (*row.measured->q_rad)[j + 1] = -0.5 * knee_rad;
      (*row.measured->q_rad)[j + 2] = knee_rad;
    }
    row.command.emplace().v_x_mps = commanded_mps;
    rows.push_back(row);
  }
  return Complete(MakeSetup(robot), rows);
}

TEST(FieldRows, StandingUpAndLyingDownAreNoFalls) {
  constexpr double kLiesDown_s = 1.0, kGivesWay_s = 0.2;
  const Completed c = StandUpAndGoDown(kLiesDown_s, 0.0);
  EXPECT_TRUE(c.falls.empty());
  const auto walks = [&](int k) { return c.rows[static_cast<std::size_t>(k)].episode->operating; };
  EXPECT_FALSE(walks(50));
  EXPECT_TRUE(walks(250));
  EXPECT_FALSE(walks(500));
  EXPECT_EQ(StandUpAndGoDown(kGivesWay_s, 0.0).falls.size(), 1U) << "its legs gave way";
  EXPECT_EQ(StandUpAndGoDown(kLiesDown_s, 0.3).falls.size(), 1U) << "it was told to walk";
}

TEST(FieldRows, JumpOfTheEstimateIsAPlacementAndNoFall) {
  const core::RobotDescription robot = test::Go2();
  std::vector<logs::Row> rows;
  for (int k = 0; k < 400; ++k)
    rows.push_back(StandingRow(kStep_s * k, 0.003 * k + (k < 200 ? 0.0 : 1.5)));
  const Completed c = Complete(MakeSetup(robot), rows);
  EXPECT_TRUE(c.falls.empty());
  EXPECT_EQ(c.rows[199].episode->segment + 1, c.rows[200].episode->segment);
}

TEST(FieldRows, LegsHandOnEveryRowOnceInOrderFromWhereTheEstimateBegins) {
  const core::RobotDescription robot = test::Go2();
  FieldSetup setup = MakeSetup(robot);
  setup.odometry = Odometry::kLegs;
  std::vector<logs::Row> rows;
  for (int k = 0; k < 6000; ++k) {  // a minute, put down elsewhere after half of it
    logs::Row row = StandingRow(kStep_s * k, k < 3000 ? 0.0 : 1.5);
    row.estimate->v_WB_mps = {};
    row.measured->w_WS_S_radps.emplace();
    row.measured->a_WS_S_mps2 = {0.0, 0.0, setup.gravity_mps2};
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (k == 1000) (*row.measured->q_rad)[4] = kNone;  // readings that are none
    if (k == 1010) (*row.measured->a_WS_S_mps2)[0] = kNone;
    rows.push_back(row);
  }
  const Completed c = Complete(setup, rows);
  ASSERT_EQ(c.rows.size(), rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    ASSERT_EQ(c.rows[k].time_s, rows[k].time_s);
    ASSERT_TRUE(c.rows[k].truth);
    EXPECT_NEAR(c.rows[k].truth->p_WB_m[0], k < 3000 ? 0.0 : 1.5, 1e-6) << "it stands";
  }
}

TEST(FieldRows, LabelsCorrectFalls) {
  const core::RobotDescription robot = test::Go2();
  FieldSetup setup = MakeSetup(robot);
  setup.labels = {{2.3, FallVerdict::kNotAFall}, {5.5, FallVerdict::kFall}};
  const Completed c = Complete(setup, Tumble());
  ASSERT_EQ(c.falls.size(), 1U);
  EXPECT_NEAR(c.falls[0].time_s, 5.5, kStep_s);
  EXPECT_EQ(c.falls[0].cause, "label");
  setup.labels = {{1.5, FallVerdict::kOperatorStop}};
  const Completed stopped = Complete(setup, Tumble());
  EXPECT_TRUE(stopped.falls.empty());
  EXPECT_TRUE(stopped.rows[170].episode->fallen) << "it is not walking on its own";
}

TEST(FieldRows, GapEndsAStretch) {
  const core::RobotDescription robot = test::Go2();
  std::vector<logs::Row> rows;
  for (int k = 0; k < 300; ++k)
    rows.push_back(StandingRow(kStep_s * k + (k < 150 ? 0.0 : 0.6), 0.003 * k));
  const Completed c = Complete(MakeSetup(robot), rows);
  EXPECT_NE(c.rows[149].episode->segment, c.rows[150].episode->segment);
  EXPECT_EQ(c.rows[149].energy, c.rows[150].energy) << "nothing is known of the gap";
}

TEST(FieldRows, WithoutThePlanTheControllerIsNotInCharge) {
  const core::RobotDescription robot = test::Go2();
  FieldSetup setup = MakeSetup(robot);
  setup.has_plan = true;
  std::vector<logs::Row> rows = {StandingRow(0.0, 0.0), StandingRow(kStep_s, 0.0)};
  rows[1].plan.emplace();
  const Completed c = Complete(setup, rows);
  EXPECT_FALSE(c.rows[0].episode->operating);
  EXPECT_TRUE(c.rows[1].episode->operating);
}

TEST(FieldRows, WhatTheLogHasIsLeftAsItIs) {
  const core::RobotDescription robot = test::Go2();
  logs::Row row = StandingRow(0.0, 0.0);
  row.truth.emplace().p_WB_m = {5.0, 0.0, 0.0};
  row.true_mass.emplace().mass_kg = 17.0;
  row.episode = logs::EpisodeRow{};
  const Completed c = Complete(MakeSetup(robot), {row});
  EXPECT_EQ(c.rows[0].truth, row.truth);
  EXPECT_EQ(c.rows[0].true_mass, row.true_mass);
  EXPECT_EQ(c.rows[0].episode, row.episode);
}

}  // namespace
}  // namespace scoria::analysis
