// SPDX-License-Identifier: BSD-3-Clause
// A log of ours, read as a bag of the reference framework: the rows of the mapping are our own.
#include <cmath>

#include <gtest/gtest.h>

#include "app/episode/function_observer.h"
#include "app/episode/record.h"
#include "app/episode/run_episode.h"
#include "core/robot_files/load.h"
#include "logs/mapping/any_rows.h"
#include "terrains/generator.h"
#include "tests/support/logs.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// Walks a few seconds. @returns its rows; the log is at `path`.
std::vector<logs::Row> RecordWalk(const fs::path& path) {
  const Scenario scenario = test::LoadScenario(
      "rough", {"duration_s=4", "log.keep=full", "controller.adaptation.type=kf_plus"});
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const terrains::Heightfield ground =
      terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
  FileSink file(path, scenario, robot, {{"version", "test"}});
  std::vector<logs::Row> rows;
  Recorder recorder(file, scenario);
  FunctionObserver observer;
  observer.on_row = [&](const StepRecord&, const logs::Row& row) { rows.push_back(row); };
  (void)RunEpisode(scenario, robot, ground, {&recorder, &observer});
  file.Close();
  return rows;
}

template <std::size_t N>
void ExpectNear(const std::array<double, N>& a, const std::array<double, N>& b, double tolerance,
                const char* what) {
  for (std::size_t k = 0; k < N; ++k) EXPECT_NEAR(a[k], b[k], tolerance) << what << " " << k;
}

constexpr double kRounding = 1e-12;  // of a quaternion in place of its angles, and back
constexpr double kFloat = 1e-5;      // battery values are float32

/// Signals of the topics that every row has.
void ExpectSameEverywhere(const logs::Row& own, const logs::Row& mapped) {
  EXPECT_NEAR(own.time_s, mapped.time_s, 1e-9);
  EXPECT_EQ(own.measured->q_rad, mapped.measured->q_rad);
  EXPECT_EQ(own.measured->qd_radps, mapped.measured->qd_radps);
  EXPECT_EQ(own.measured->tau_Nm, mapped.measured->tau_Nm);
  EXPECT_EQ(own.measured->a_WS_S_mps2, mapped.measured->a_WS_S_mps2);
  EXPECT_EQ(own.measured->w_WS_S_radps, mapped.measured->w_WS_S_radps);
  EXPECT_EQ(own.measured->foot_force_counts, mapped.measured->foot_force_counts);
  EXPECT_EQ(own.estimate->p_WB_m, mapped.estimate->p_WB_m);
  EXPECT_EQ(own.estimate->v_WB_mps, mapped.estimate->v_WB_mps);
  ExpectNear(own.estimate->rpy_rad, mapped.estimate->rpy_rad, kRounding, "rpy");
  EXPECT_EQ(own.contacts->contact, mapped.contacts->contact);
  EXPECT_EQ(own.contacts->f_F_W_N, mapped.contacts->f_F_W_N);
  EXPECT_EQ(own.solve_times->mpc_s, mapped.solve_times ? mapped.solve_times->mpc_s : std::nullopt);
  EXPECT_EQ(own.solve_times->wbc_s, mapped.solve_times ? mapped.solve_times->wbc_s : std::nullopt);
}

/// Signals of the topics that come with the MPC.
void ExpectSameWithMpc(const logs::Row& own, const logs::Row& mapped) {
  EXPECT_EQ(own.command, mapped.command);
  EXPECT_EQ(own.plan->period_s, mapped.plan->period_s);
  EXPECT_EQ(own.plan->duty, mapped.plan->duty);
  EXPECT_EQ(own.plan->phase, mapped.plan->phase);
  EXPECT_EQ(own.plan->stance, mapped.plan->stance);
  EXPECT_EQ(own.plan->foot_target_m, mapped.plan->foot_target_m);
  EXPECT_NEAR(*own.measured->battery_V, *mapped.measured->battery_V, kFloat);
  EXPECT_NEAR(*own.measured->battery_A, *mapped.measured->battery_A, kFloat);
}

TEST(MappedLog, OfOurOwnInTheReferencesTopicsHasOurOwnRows) {
  const test::TemporaryFolder folder;
  const fs::path all = folder.path() / "all.mcap", bag = folder.path() / "bag.mcap";
  const std::vector<logs::Row> own = RecordWalk(all);
  test::CopyLog(all, bag, [](const std::string& topic) { return !topic.starts_with("/scoria/"); });
  std::vector<logs::Row> mapped;
  const logs::RowsReport report =
      logs::ForEachRow({bag}, {}, [&](const logs::Row& row) { mapped.push_back(row); });
  ASSERT_TRUE(report.mapping);
  EXPECT_EQ(report.problem, "");
  EXPECT_EQ(report.mapping->mapping, "dfki_quad");
  EXPECT_TRUE(report.mapping->absent.empty()) << report.mapping->absent.front();
  ASSERT_EQ(mapped.size(), own.size());
  int with_mpc = 0, with_model = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    ASSERT_TRUE(mapped[i].measured && mapped[i].estimate && mapped[i].contacts);
    ExpectSameEverywhere(own[i], mapped[i]);
    if (own[i].solve_times->mpc_s) {
      ++with_mpc;
      ASSERT_TRUE(mapped[i].plan && mapped[i].command);
      ExpectSameWithMpc(own[i], mapped[i]);
    }
    const bool is_slow_tick = std::abs(std::remainder(own[i].time_s, 0.5)) < 1e-6;
    if (is_slow_tick && own[i].model->learned && mapped[i].model) {
      ++with_model;
      EXPECT_EQ(own[i].model->used_mass_kg, mapped[i].model->used_mass_kg);
      EXPECT_EQ(own[i].model->learned->p_BC_m, mapped[i].model->learned->p_BC_m);
    }
    if (testing::Test::HasFailure()) FAIL() << "in row " << i;
  }
  EXPECT_GT(with_mpc, 300);  // of 100 Hz; lying it solves none
  EXPECT_GT(with_model, 2);
}

TEST(MappedLog, OwnRowsAreTakenWhereTheLogHasThem) {
  const test::TemporaryFolder folder;
  const std::vector<logs::Row> own = RecordWalk(folder.path() / "all.mcap");
  std::size_t i = 0;
  const logs::RowsReport report =
      logs::ForEachRow({folder.path() / "all.mcap"}, {},
                       [&](const logs::Row& row) { EXPECT_TRUE(row == own[i++]); });
  EXPECT_FALSE(report.mapping);
  EXPECT_EQ(report.problem, "");
  EXPECT_EQ(i, own.size());
}

}  // namespace
}  // namespace scoria::app
