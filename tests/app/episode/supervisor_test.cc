// SPDX-License-Identifier: BSD-3-Clause
// One scenario per transition of the supervisor: the event is there, the robot walks on and the
// stage is in use again; switched off, there is no event.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/episode/function_observer.h"
#include "app/episode/run_episode.h"
#include "core/robot_files/load.h"
#include "terrains/generator.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

struct Engagements {
  EpisodeEnd end = EpisodeEnd::kTimedOut;
  int falls = 0;
  std::vector<std::string> events;  // of the supervisor
  [[nodiscard]] bool Has(const std::string& beginning) const {
    return std::any_of(events.begin(), events.end(),
                       [&](const std::string& e) { return e.rfind(beginning, 0) == 0; });
  }
};

Engagements Walk(const std::string& monitor, bool enabled) {
  const Scenario scenario = test::LoadScenario(
      "supervisor/" + monitor, {fmt::format("controller.supervisor.enabled={}", enabled)});
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const terrains::Heightfield ground =
      terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
  Engagements out;
  FunctionObserver observer;
  observer.on_event = [&](const EpisodeEvent& event) {
    if (event.kind == "supervisor") out.events.push_back(event.detail);
  };
  const EpisodeResult result = RunEpisode(scenario, robot, ground, {&observer});
  out.end = result.end;
  out.falls = result.falls;
  return out;
}

class SupervisorScenario : public ::testing::TestWithParam<const char*> {};

TEST_P(SupervisorScenario, FallsBackWithItsReasonAndTheRobotWalksOn) {
  const std::string monitor = GetParam();
  const Engagements on = Walk(monitor, true);
  EXPECT_EQ(on.end, EpisodeEnd::kCompleted);
  // Ground on which feet stumble all the time lets the robot fall too, now and then.
  if (monitor != "footing") {
    EXPECT_EQ(on.falls, 0);
  }
  EXPECT_TRUE(on.Has(monitor + ": fallback engaged"))
      << fmt::format("{}", fmt::join(on.events, "; "));
  EXPECT_TRUE(on.Has(monitor + ": fallback released"));
  EXPECT_TRUE(Walk(monitor, false).events.empty());
}

INSTANTIATE_TEST_SUITE_P(Monitors, SupervisorScenario,
                         ::testing::Values("mpc", "body", "estimator", "contact", "footing",
                                           "load"),
                         [](const auto& test) { return std::string(test.param); });

// The gait changes while the contact stage is on its fallback: the fallback stays engaged.
TEST(SupervisorScenario, ChangeOfTheControllerKeepsTheContactFallback) {
  const Scenario scenario = test::LoadScenario(
      "supervisor/contact", {"controller_changes=[{at_s: 8, set: [gait.type=sgs]}, {at_s: 9, set: "
                             "[contact.touchdown_delay_s=0.003]}]",
                             "duration_s=12"});
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const terrains::Heightfield ground =
      terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
  long on_fallback = 0, by_failed_sensor = 0;
  bool engaged = false;  // before this row's contacts were found
  FunctionObserver observer;
  observer.on_row = [&](const StepRecord&, const logs::Row& row) {
    const bool was_engaged = engaged;
    engaged = row.supervision->fallen_back[static_cast<std::size_t>(controller::Monitor::kContact)];
    if (!was_engaged || !engaged) return;
    ++on_fallback;
    for (std::size_t leg = 0; leg < 4; ++leg) {
      const bool sensor = (*row.contacts->source)[leg] == static_cast<int>(ContactSource::kSensor);
      by_failed_sensor += sensor && !row.contacts->sensor->healthy[leg];
    }
  };
  (void)RunEpisode(scenario, robot, ground, {&observer});
  EXPECT_GT(on_fallback, 1000);
  EXPECT_EQ(by_failed_sensor, 0);
}

}  // namespace
}  // namespace scoria::app
