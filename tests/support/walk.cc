// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/walk.h"

#include "app/episode/function_observer.h"
#include "core/robot_files/load.h"
#include "terrains/generator.h"

namespace scoria::test {

WalkOutcome Walk(const app::Scenario& scenario,
                 const std::function<void(const logs::Row&)>& on_row) {
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const terrains::Heightfield ground =
      terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
  analysis::MetricsAccumulator accumulator(scenario.gravity_mps2);
  app::FunctionObserver observer;
  observer.on_row = [&](const app::StepRecord&, const logs::Row& row) {
    accumulator.AddRow(row);
    if (on_row) on_row(row);
  };
  WalkOutcome out;
  out.result = app::RunEpisode(scenario, robot, ground, {&observer});
  out.metrics = accumulator.Finish();
  return out;
}

}  // namespace scoria::test
