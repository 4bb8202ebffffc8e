// SPDX-License-Identifier: BSD-3-Clause
// Closed-loop claims on short episodes; docs/results holds the long ones.
#include <algorithm>
#include <filesystem>
#include <functional>

#include <gtest/gtest.h>

#include "analysis/metrics/metrics.h"
#include "app/episode/function_observer.h"
#include "app/episode/run_episode.h"
#include "core/rng.h"
#include "core/robot_files/load.h"
#include "terrains/generator.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"
#include "tests/support/walk.h"

namespace scoria::app {
namespace {

using Outcome = test::WalkOutcome;
using test::Walk;

struct Case {
  const char* gait;
  double v_x, v_y, w_z;
  friend void PrintTo(const Case& c, std::ostream* out) {
    *out << fmt::format("{} at ({}, {}) m/s, {} rad/s", c.gait, c.v_x, c.v_y, c.w_z);
  }
};

class FlatGround : public ::testing::TestWithParam<Case> {};

TEST_P(FlatGround, WalksAsCommanded) {
  const Case c = GetParam();
  Scenario scenario =
      test::LoadScenario("flat", {std::string("controller.gait.type=") + c.gait, "duration_s=15"});
  scenario.operation = VelocityProgramme{{{0.0, c.v_x, c.v_y, c.w_z}}};
  const Outcome o = Walk(scenario);
  EXPECT_EQ(o.result.falls, 0);
  for (const Count failure : {Count::kMpcFailure, Count::kWbcFailure, Count::kPlanExpired})
    EXPECT_EQ(o.result.counters[failure], 0u) << core::EnumName(failure);
  const analysis::TrackingErrors& t = o.metrics.tracking;
  EXPECT_NEAR(t.velocity_x_mps, c.v_x, 0.03 * std::abs(c.v_x) + 0.01);
  EXPECT_NEAR(t.velocity_y_mps, c.v_y, 0.03 * std::abs(c.v_y) + 0.01);
  EXPECT_NEAR(t.yaw_rate_radps, c.w_z, 0.03 * std::abs(c.w_z) + 0.01);
  EXPECT_LT(t.velocity_rmse_mps.value(),
            std::max(std::abs(c.v_x), std::abs(c.v_y)) > 0.5 ? 0.08 : 0.04);
  EXPECT_LT(t.height_rmse_m.value(), 0.012);
  EXPECT_LT(t.roll_rmse_rad.value(), 0.0175);
  EXPECT_LT(t.pitch_rmse_rad.value(), 0.0175);
}

INSTANTIATE_TEST_SUITE_P(
    Gaits, FlatGround,
    ::testing::Values(Case{"ags", 0.1, 0, 0}, Case{"ags", 0.5, 0, 0}, Case{"ags", 1.0, 0, 0},
                      Case{"ags", 0, 0.3, 0}, Case{"ags", 0, 0, 0.8}, Case{"sgs", 0.1, 0, 0},
                      Case{"sgs", 0.5, 0, 0}, Case{"sgs", 1.0, 0, 0}, Case{"sgs", 0, 0.3, 0},
                      Case{"sgs", 0, 0, 0.8}, Case{"sgs_matched", 0.5, 0, 0}),
    [](const auto& test_info) {
      const Case& c = test_info.param;
      std::string name = fmt::format("{}_x{}_y{}_yaw{}", c.gait, c.v_x, c.v_y, c.w_z);
      std::replace(name.begin(), name.end(), '.', '_');
      return name;
    });

// Gaits of the reference's table at a natural speed. Bound and gallops have weights of their own.
struct TableGait {
  const char* name;
  double v_x_mps;
  const char* scenario = "flat";
  friend void PrintTo(const TableGait& g, std::ostream* out) {
    *out << g.name << " at " << g.v_x_mps << " m/s";
  }
};
class GaitTable : public ::testing::TestWithParam<TableGait> {};

TEST_P(GaitTable, Walks) {
  const auto [name, v_x_mps, scenario] = GetParam();
  // Gallops lose speed and direction to balance, and must last ten seconds.
  const bool gallops = std::string_view(scenario) == "gallop";
  const Outcome o = Walk(test::LoadScenario(
      scenario, {fmt::format("controller.gait={{type: sgs, gait: {}}}", name), "start=standing",
                 fmt::format("operator.steps=[{{at_s: 0, v_x_mps: {}}}]", v_x_mps),
                 fmt::format("duration_s={}", gallops ? 12 : 31)}));
  EXPECT_EQ(o.result.falls, 0);
  EXPECT_NEAR(o.metrics.tracking.velocity_x_mps, v_x_mps, (gallops ? 0.4 : 0.03) * v_x_mps + 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Reference, GaitTable,
                         ::testing::Values(TableGait{"stand", 0.0}, TableGait{"static_walk", 0.1},
                                           TableGait{"walking_trot", 0.3}, TableGait{"trot", 0.5},
                                           TableGait{"flying_trot", 0.6}, TableGait{"pace", 0.3},
                                           TableGait{"pronk", 0.3},
                                           TableGait{"bound", 1.0, "gallop"},
                                           TableGait{"rotary_gallop", 1.5, "gallop"},
                                           TableGait{"traverse_gallop", 1.0, "gallop"}),
                         [](const auto& test) { return std::string(test.param.name); });

// Trot, walk, pace and trot again while walking: no foot is lifted or put down out of its time, the
// new offsets are there after two cycles, and nobody falls.
TEST(PatternChange, WhileWalkingOnFlatAndRoughGround) {
  for (const char* ground : {"flat", "rough"}) {
    const Scenario scenario = test::LoadScenario(
        ground, {"start=standing", "duration_s=18", "controller.gait={type: ags}",
                 "operator={type: velocity, steps: [{at_s: 0, v_x_mps: 0.3, pattern: trot}, "
                 "{at_s: 4, v_x_mps: 0.3, pattern: walk}, {at_s: 8, v_x_mps: 0.3, pattern: pace}, "
                 "{at_s: 12, v_x_mps: 0.3, pattern: trot}]}"});
    std::array<double, 4> since_s{};
    std::array<bool, 4> stance{};
    double worst_flip_s = 1e9;
    const Outcome o = Walk(scenario, [&](const logs::Row& row) {
      if (row.time_s < 1.0) return;
      for (std::size_t i = 0; i < 4; ++i) {
        if (row.plan->stance[i] == stance[i]) continue;
        stance[i] = row.plan->stance[i];
        if (since_s[i] > 0.0) worst_flip_s = std::min(worst_flip_s, row.time_s - since_s[i]);
        since_s[i] = row.time_s;
      }
    });
    EXPECT_EQ(o.result.falls, 0) << ground;
    // A swing takes 0.2 s; an early touchdown may end it after half of that.
    EXPECT_GT(worst_flip_s, 0.09) << ground;
  }
}

// Every hundredth tick of MPC and WBC fails, returns NaN or is late: the robot walks on, and the
// controller counts what was played.
TEST(SolverFaults, OnRoughGroundAreMetAndCounted) {
  for (const char* gait : {"ags", "sgs"}) {
    const Scenario scenario =
        test::LoadScenario("rough", {fmt::format("controller.gait.type={}", gait),
                                     "solver_faults.share=0.01", "operator.distance_m=10"});
    bool finite = true;
    const Outcome o = Walk(scenario, [&](const logs::Row& row) {
      for (const double tau : row.true_joints->tau_Nm) finite = finite && std::isfinite(tau);
    });
    EXPECT_TRUE(finite);
    EXPECT_EQ(o.result.falls, 0) << gait;
    EXPECT_GE(o.result.walked_m, 9.9) << gait;
    for (const Count what :
         {Count::kMpcFailure, Count::kMpcLate, Count::kWbcFailure, Count::kWbcLate}) {
      EXPECT_GT(o.result.injected[what], 0u) << core::EnumName(what);
      EXPECT_EQ(o.result.counters[what], o.result.injected[what]) << core::EnumName(what);
    }
  }
}

// Other robots by their files alone: names, signs, zeros, masses of their own.
class OtherRobot : public ::testing::TestWithParam<const char*> {};

TEST_P(OtherRobot, WalksAsCommandedOnFlatGround) {
  for (const char* gait : {"ags", "sgs"}) {
    const Scenario scenario = test::LoadScenario(
        "flat", {fmt::format("robot={{base: {}}}", test::SourcePath(GetParam()).string()),
                 fmt::format("controller.gait.type={}", gait), "duration_s=15",
                 "operator.steps=[{at_s: 0, v_x_mps: 0.5}]"});
    const Outcome o = Walk(scenario);
    EXPECT_EQ(o.result.falls, 0) << gait;
    const analysis::TrackingErrors& t = o.metrics.tracking;
    EXPECT_NEAR(t.velocity_x_mps, 0.5, 0.025) << gait;
    EXPECT_LT(t.velocity_rmse_mps.value(), 0.04) << gait;
    EXPECT_LT(t.height_rmse_m.value(), 0.012) << gait;
    EXPECT_LT(t.roll_rmse_rad.value(), 0.0175) << gait;
    EXPECT_LT(t.pitch_rmse_rad.value(), 0.0175) << gait;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, OtherRobot,
                         ::testing::Values("robots/b12/b12.yaml",
                                           "tests/data/robots/mule/mule.yaml",
                                           "tests/data/robots/kid/kid.yaml"),
                         [](const auto& test) {
                           return std::filesystem::path(test.param).stem().string();
                         });

// Foot sensors fail in the middle of rough ground: the hierarchy turns to the momentum observer for
// just those feet within half a second, says so, and the robot walks on.
TEST(FootSensorFault, HierarchySwitchesWithinHalfASecondAndTheRobotWalksOn) {
  double at_s = 6.0;
  for (const char* kind : {"foot_dropout", "foot_stuck", "foot_packed, magnitude: 60"}) {
    for (const int feet : {1, 2, 4}) {
      const char* legs = feet == 1 ? "[FL]" : feet == 2 ? "[FL, HR]" : "[]";
      const Scenario scenario = test::LoadScenario(
          "rough",
          {fmt::format("sensor_faults=[{{at_s: {}, kind: {}, legs: {}}}]", at_s, kind, legs),
           "duration_s=11"});
      at_s += 0.1;  // another phase of the gait
      const core::RobotDescription robot = core::LoadRobot(scenario.robot);
      const terrains::Heightfield ground =
          terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
      double fault_s = 0.0, last_switch_s = 0.0;
      int switches = 0;
      FunctionObserver observer;
      observer.on_event = [&](const EpisodeEvent& event) {
        if (event.kind == "sensor_fault") fault_s = event.time_s;
        if (event.kind == "contact_source") {
          last_switch_s = event.time_s;
          ++switches;
        }
      };
      const EpisodeResult result = RunEpisode(scenario, robot, ground, {&observer});
      EXPECT_EQ(result.falls, 0) << kind << feet;
      EXPECT_EQ(switches, feet) << kind << feet;
      EXPECT_GT(fault_s, 0.0);
      EXPECT_LT(last_switch_s - fault_s, 0.5) << kind << feet;
    }
  }
}

// Every pair of variants of a stage, in both directions, is switched while the robot trots: it
// walks on, and no motor sees a larger step of torque than in its ordinary walk.
struct Variants {
  const char* stage;
  std::vector<std::string> settings;
  friend void PrintTo(const Variants& v, std::ostream* out) { *out << v.stage; }
};
class SwitchWhileWalking : public ::testing::TestWithParam<Variants> {};

/// A walk through all ordered pairs of n things: each is left for every other once.
std::vector<std::size_t> TourOfAllPairs(std::size_t n) {
  std::vector<std::vector<bool>> used(n, std::vector<bool>(n, false));
  std::vector<std::size_t> path = {0}, tour;
  while (!path.empty()) {  // Hierholzer
    const std::size_t from = path.back();
    std::size_t to = 0;
    while (to < n && (to == from || used[from][to])) ++to;
    if (to < n) {
      used[from][to] = true;
      path.push_back(to);
    } else {
      tour.push_back(from);
      path.pop_back();
    }
  }
  std::reverse(tour.begin(), tour.end());
  return tour;
}

TEST_P(SwitchWhileWalking, KeepsWalkingWithoutATorqueStep) {
  const Variants& variants = GetParam();
  constexpr double kFirst_s = 6.0, kEvery_s = 1.37;  // meets every phase of the gait
  Scenario scenario = test::LoadScenario("flat", {"start=standing"});
  const std::vector<std::size_t> tour = TourOfAllPairs(variants.settings.size());
  for (std::size_t i = 0; i < tour.size(); ++i)
    scenario.controller_changes.push_back(
        {kFirst_s + kEvery_s * static_cast<double>(i), {variants.settings[tour[i]]}});
  scenario.duration_s = kFirst_s + kEvery_s * static_cast<double>(tour.size()) + 2.0;

  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const terrains::Heightfield ground =
      terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
  constexpr double kAfter_s = 0.05;
  double ordinary_Nm = 0.0, switching_Nm = 0.0, switched_s = -1.0;
  std::array<double, kNumJoints> last{};
  std::size_t changes = 0;
  FunctionObserver observer;
  observer.on_event = [&](const EpisodeEvent& event) {
    if (event.kind != "controller_change") return;
    switched_s = event.time_s;
    ++changes;
  };
  observer.on_row = [&](const StepRecord&, const logs::Row& row) {
    double step_Nm = 0.0;
    for (std::size_t j = 0; j < last.size(); ++j)
      step_Nm = std::max(step_Nm, std::abs(row.true_joints->tau_Nm[j] - last[j]));
    last = row.true_joints->tau_Nm;
    if (row.time_s < 2.0) return;
    const bool after = switched_s >= 0.0 && row.time_s - switched_s < kAfter_s;
    double& largest = after ? switching_Nm : ordinary_Nm;
    largest = std::max(largest, step_Nm);
  };
  EXPECT_EQ(RunEpisode(scenario, robot, ground, {&observer}).falls, 0);
  EXPECT_EQ(changes, tour.size());
  EXPECT_LE(switching_Nm, ordinary_Nm);
}

INSTANTIATE_TEST_SUITE_P(
    Every, SwitchWhileWalking,
    ::testing::Values(
        Variants{"gait",
                 {"gait.type=ags", "gait.type=sgs", "gait.type=sgs_matched", "gait.type=bio"}},
        Variants{"mpc", {"mpc.horizon=10", "mpc.horizon=20", "mpc.latency_ticks=3"}},
        Variants{"wbc",
                 {"wbc={type: tsid}", "wbc={type: tsid, formulation: reduced}",
                  "wbc={type: tsid, formulation: full}", "wbc={type: inverse_dynamics}"}},
        Variants{"contact",
                 {"contact.source=hierarchy", "contact.source=sensor",
                  "contact.source=momentum_observer", "contact.source=gait_phase",
                  "contact.source=truth"}},
        Variants{
            "estimator",
            {"estimator.type=inekf", "estimator.type=linear_kf", "estimator.type=leg_odometry"}},
        Variants{"adaptation",
                 {"adaptation.type=none", "adaptation.type=kf", "adaptation.type=rls",
                  "adaptation.type=kf_plus"}}),
    [](const auto& test) { return std::string(test.param.stage); });

TEST(Slope, IsClimbedDescendedAndCrossed) {
  for (const double uphill_rad : {0.0, 1.5708, 3.1416}) {
    const Scenario scenario = test::LoadScenario(
        "slope", {fmt::format("terrain.slope_azimuth_rad={}", uphill_rad), "duration_s=12"});
    double worst_rad = 0.0;
    const Outcome o = Walk(scenario, [&](const logs::Row& row) {
      worst_rad = std::max(worst_rad, std::abs(row.truth->rpy_rad[2]));
    });
    EXPECT_EQ(o.result.falls, 0) << uphill_rad;
    EXPECT_NEAR(o.metrics.tracking.velocity_x_mps, 0.3, 0.03) << uphill_rad;
    EXPECT_NEAR(o.metrics.tracking.velocity_y_mps, 0.0, 0.03) << uphill_rad;
    EXPECT_LT(worst_rad, 10.0 / 57.3) << uphill_rad;
  }
}

TEST(Gravity, MarsAndMoonAreWalked) {
  for (const char* gravity : {"3.72", "1.62"}) {
    const Outcome o = Walk(test::LoadScenario(
        "flat", {std::string("gravity_mps2=") + gravity, "start=standing", "duration_s=15"}));
    EXPECT_EQ(o.result.falls, 0) << gravity;
    EXPECT_NEAR(o.metrics.tracking.velocity_x_mps, 0.3, 0.02) << gravity;
  }
}

TEST(Push, FifteenNewtonSecondsFromTheSideAreSurvived) {
  for (const char* gait : {"ags", "sgs"}) {
    for (const char* side : {"1.5708", "-1.5708"}) {
      std::vector<double> v_y;
      const Outcome o = Walk(
          test::LoadScenario("push", {std::string("controller.gait.type=") + gait,
                                      std::string("pushes.0.azimuth_rad=") + side, "duration_s=9"}),
          [&](const logs::Row& row) { v_y.push_back(std::abs(row.truth->v_WB_mps[1])); });
      EXPECT_EQ(o.result.falls, 0) << gait << side;
      EXPECT_GT(*std::max_element(v_y.begin(), v_y.end()), 0.4) << "the push moves the trunk";
    }
  }
}

TEST(Energy, LedgerClosesToAPercentOfMotorWork) {
  for (const auto& [name, ground] :
       {std::pair{"flat", "elastic"}, {"vulcano", "elastic"}, {"vulcano", "plastic"}}) {
    const Outcome o = Walk(
        test::LoadScenario(name, {"duration_s=15", fmt::format("physics.ground.type={}", ground)}));
    const analysis::EnergyBudget& b = o.metrics.budget;
    EXPECT_GT(b.motor_J, 50.0) << name;
    EXPECT_LT(b.error_J, 0.01 * b.motor_J) << name;
    EXPECT_LT(b.joint_J, 0.0) << name;
    EXPECT_LT(b.contact_J, 0.0) << name;
  }
}

/// Works since the start of a placement, by the meter and by the ledger.
struct PlacementWork {
  double meter_J = 0.0, ledger_J = 0.0;
};

std::vector<PlacementWork> WorksByPlacement(const Scenario& scenario) {
  std::vector<PlacementWork> works;
  logs::Row first;
  (void)Walk(scenario, [&](const logs::Row& row) {
    if (works.empty() || row.episode->segment != first.episode->segment) {
      works.emplace_back();
      first = row;
    }
    const auto net_J = [](const logs::Row& r) {
      return 2.0 * r.energy->mech_pos_J - r.energy->mech_abs_J;
    };
    works.back() = {net_J(row) - net_J(first), row.ledger->motor_J - first.ledger->motor_J};
  });
  return works;
}

// The ledger knows nothing of sensors and commands: impulses times the mean of the true speeds.
TEST(Energy, MeterCountsTheWorkOfTheTrueJoints) {
  for (const char* name : {"flat", "vulcano"}) {
    Scenario scenario = test::LoadScenario(name, {"duration_s=15"});
    scenario.pushes = {{5.0, 0.1, 120.0, 1.5708}};  // falls: a second placement
    const std::vector<PlacementWork> works = WorksByPlacement(scenario);
    EXPECT_GE(works.size(), 2u) << name;
    for (const PlacementWork& work : works) {
      EXPECT_GT(work.ledger_J, 10.0) << name;
      EXPECT_NEAR(work.meter_J, work.ledger_J, 0.01 * work.ledger_J) << name;
    }
  }
}

TEST(Energy, CostOfTransportDoesNotDependOnTheEncoders) {
  const auto cost = [](const char* sensors) {
    return Walk(test::LoadScenario(
                    "flat", {std::string("sensors.type=") + sensors, "duration_s=20",
                             "controller.estimator.type=truth", "controller.contact.source=truth"}))
        .metrics;
  };
  const analysis::EpisodeMetrics real = cost("realistic"), ideal = cost("ideal");
  const analysis::CostOfTransport& expected = ideal.cot.value();
  EXPECT_NEAR(real.cot.value().mech_abs, expected.mech_abs, 0.02 * expected.mech_abs);
  EXPECT_NEAR(real.cot.value().mech_pos, expected.mech_pos, 0.02 * expected.mech_pos);
  EXPECT_NEAR(real.cot.value().electrical, expected.electrical, 0.02 * expected.electrical);
}

TEST(Standing, DoesNotDrift) {
  const Outcome o = Walk(test::LoadScenario("flat", {"operator.steps=[]", "duration_s=20"}));
  EXPECT_EQ(o.result.falls, 0);
  EXPECT_LT(o.metrics.tracking.drift_m.value(), 0.005);
}

TEST(Rough, WalksSixMetresForEveryGaitAndLateContactOption) {
  for (const char* gait : {"ags", "sgs", "sgs_matched"}) {
    for (const char* late : {"stance", "lower"}) {
      const Outcome o = Walk(
          test::LoadScenario("rough", {std::string("controller.gait.type=") + gait,
                                       std::string("controller.legs.late_contact=") + late,
                                       "operator.distance_m=6", "terrain.roughness_scale=0.5"}));
      EXPECT_EQ(o.result.end, EpisodeEnd::kCompleted) << gait << " " << late;
      EXPECT_EQ(o.result.falls, 0) << gait << " " << late;
    }
  }
}

class DrawnPlaces : public ::testing::TestWithParam<const char*> {};

// Both robots are set down at 67 places drawn on each of three presets, or on the nearest good
// ground there, and stand for five seconds.
TEST_P(DrawnPlaces, CarryBothRobots) {
  constexpr int kPlaces = 67;
  constexpr double kEdge_m = 5.0;
  const std::string terrain = fmt::format("terrains/{}.yaml", GetParam());
  core::Rng rng(20251017, 0, core::Stream::kOperator);
  std::array<VelocityProgramme, kPlaces> places;
  std::optional<terrains::Heightfield> ground;
  for (const char* robot_file : {"robots/go2/go2.yaml", "robots/b12/b12.yaml"}) {
    Scenario scenario = test::LoadScenario(
        "flat", {fmt::format("terrain={{base: {}}}", test::SourcePath(terrain).string()),
                 fmt::format("robot={{base: {}}}", test::SourcePath(robot_file).string()),
                 "start=standing", "duration_s=5"});
    const core::RobotDescription robot = core::LoadRobot(scenario.robot);
    if (!ground) {
      ground = terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
      const double inside_m = ground->half_size_m() - kEdge_m;
      for (VelocityProgramme& place : places) {
        place.start_x_m = rng.NextUniform(-inside_m, inside_m);
        place.start_y_m = rng.NextUniform(-inside_m, inside_m);
        place.start_yaw_rad = rng.NextUniform(-3.14, 3.14);
      }
    }
    for (const VelocityProgramme& place : places) {
      scenario.operation = place;
      const EpisodeResult result = RunEpisode(scenario, robot, *ground);
      EXPECT_EQ(result.falls, 0) << fmt::format(
          "{} at {:.2f}, {:.2f}: {}", robot_file, place.start_x_m, place.start_y_m,
          result.fall_events.empty() ? "" : result.fall_events.front().cause);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, DrawnPlaces,
                         ::testing::Values("vulcano_crater_rim", "pahoehoe", "mars_vl1"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Recovery, FallenRobotIsSetOnItsFeetAndWalksOn) {
  Scenario scenario = test::LoadScenario("flat", {"duration_s=14"});
  scenario.pushes = {{2.0, 0.1, 90.0, 1.5708}};  // far beyond what anyone survives
  const Outcome o = Walk(scenario);
  EXPECT_EQ(o.result.falls, 1);
  EXPECT_EQ(o.result.end, EpisodeEnd::kCompleted);
  EXPECT_GT(o.metrics.distance_m, 1.5) << "it walked again afterwards";
}

}  // namespace
}  // namespace scoria::app
