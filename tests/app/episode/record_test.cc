// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/record.h"

#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "app/episode/function_observer.h"
#include "app/episode/run_episode.h"
#include "core/robot_files/load.h"
#include "logs/format/cdr.h"
#include "logs/read_rows.h"
#include "terrains/generator.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

/// Keeps the messages of one type.
template <class Message>
class Kept final : public MessageSink {
 public:
  struct Dated {
    double time_s;
    Message message;
  };
  void Write(const Topic& topic, std::int64_t time_ns,
             std::span<const std::byte> message) override {
    if (topic.type_name != Message::kTypeName) return;
    messages.push_back({1e-9 * static_cast<double>(time_ns), logs::DecodeCdr<Message>(message)});
  }
  void MarkFall(std::int64_t) override {}
  std::vector<Dated> messages;
};

template <class Message>
std::vector<typename Kept<Message>::Dated> Record(const Scenario& scenario) {
  Kept<Message> kept;
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const terrains::Heightfield ground =
      terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
  Recorder recorder(kept, scenario);
  (void)RunEpisode(scenario, robot, ground, {&recorder});
  return kept.messages;
}

TEST(Recorder, GaitSequencerIsThatOfTheControllerInForce) {
  Scenario scenario =
      test::LoadScenario("flat", {"duration_s=3", "start=standing", "controller.gait.type=ags"});
  scenario.controller_changes = {{1.0, {"gait.type=sgs"}}};
  int adaptive = 0, simple = 0;
  for (const auto& [time_s, gait] : Record<logs::msg::GaitState>(scenario)) {
    (gait.gait_sequencer == 1 ? adaptive : simple) += 1;
    EXPECT_TRUE(gait.gait_sequencer == 1 || adaptive > 0) << "ags comes first, at " << time_s;
    EXPECT_TRUE(gait.gait_sequencer == 0 || simple == 0) << "and does not return, at " << time_s;
  }
  EXPECT_GT(adaptive, 100);
  EXPECT_GT(simple, 50);
}

// From standing to walking, with every sample on record and an attitude without error: a tenth of a
// degree of it would be 0.07 m/s in four seconds.
TEST(Recorder, AccelerationAddsUpToTheChangeOfTheVelocity) {
  const auto states = Record<logs::msg::QuadState>(test::LoadScenario(
      "flat", {"duration_s=4", "start=standing", "sensors.type=ideal",
               "controller.rates.wbc_Hz=1000", "controller.estimator.type=truth"}));
  ASSERT_GT(states.size(), 1000u);
  logs::msg::Vector3 sum_mps;
  for (std::size_t i = 1; i < states.size(); ++i) {
    const logs::msg::Vector3& a_mps2 = states[i].message.acceleration.linear;
    const double dt_s = states[i].time_s - states[i - 1].time_s;
    sum_mps.x += dt_s * a_mps2.x;
    sum_mps.y += dt_s * a_mps2.y;
    sum_mps.z += dt_s * a_mps2.z;
  }
  const logs::msg::Vector3& first = states.front().message.twist.twist.linear;
  const logs::msg::Vector3& last = states.back().message.twist.twist.linear;
  EXPECT_GT(last.x - first.x, 0.2);
  constexpr double kRounding_mps = 1e-3;  // the state and the sample are of neighbouring steps
  EXPECT_NEAR(sum_mps.x, last.x - first.x, kRounding_mps);
  EXPECT_NEAR(sum_mps.y, last.y - first.y, kRounding_mps);
  EXPECT_NEAR(sum_mps.z, last.z - first.z, kRounding_mps);
}

// What the episode says while it runs is what its log says afterwards, to the last bit.
TEST(Recorder, RowsOfTheLogAreTheRowsOfTheEpisode) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "log.mcap";
  const Scenario scenario = test::LoadScenario("rough", {"duration_s=3", "log.keep=full"});
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
  std::size_t i = 0;
  EXPECT_EQ(logs::ForEachRow(path, [&](const logs::Row& row) { EXPECT_TRUE(row == rows.at(i++)); }),
            "");
  ASSERT_EQ(i, 1500u);
  logs::RowGroups groups = logs::GroupsOf(rows.back());
  EXPECT_FALSE(groups[static_cast<std::size_t>(logs::RowGroup::kJointCommand)])
      << "/joint_cmd has it";
  EXPECT_TRUE(groups.set(static_cast<std::size_t>(logs::RowGroup::kJointCommand)).all());
  EXPECT_TRUE(rows.back().estimate->P_tilt_v.has_value());
  EXPECT_TRUE(rows.back().contacts->sensor.has_value());
  EXPECT_FALSE(rows.back().model->learned.has_value()) << "nothing adapts";
  EXPECT_FALSE(rows[1].solve_times->mpc_s.has_value()) << "the MPC runs in every fifth";
}

}  // namespace
}  // namespace scoria::app
