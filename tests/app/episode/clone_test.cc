// SPDX-License-Identifier: BSD-3-Clause
// A cloned episode goes on with the bits of the original, and an intervention concerns one alone.
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/episode/episode.h"
#include "core/rng.h"
#include "core/robot_files/load.h"
#include "terrains/generator.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

/// What an episode needs for its whole life.
struct Walk {
  explicit Walk(const std::vector<std::string>& set, const std::string& name = "rough")
      : scenario(test::LoadScenario(name, set)),
        robot(core::LoadRobot(scenario.robot)),
        ground(terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0)) {}
  [[nodiscard]] std::unique_ptr<Episode> Start() const {
    return std::make_unique<Episode>(scenario, robot, ground);
  }
  Scenario scenario;
  core::RobotDescription robot;
  terrains::Heightfield ground;
};

std::uint64_t RunToEnd(Episode& episode) {
  while (!episode.ended()) episode.Step();
  return episode.state_hash();
}

void RunTo(Episode& episode, std::int64_t step) {
  while (!episode.ended() && episode.step() < step) episode.Step();
}

const std::string kPlate =
    "{mass_kg: 4, name: plate, p_BP_m: [0, 0, 0.1], size_m: [0.3, 0.2, 0.02]}";

struct Case {
  const char* name;
  std::vector<std::string> set;
  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

std::vector<Case> Cases() {
  const std::string seconds = "duration_s=6";
  return {
      {"payload", {seconds, "payloads=[{at_s: 1, action: add, body: " + kPlate + "}]"}},
      {"sensor_faults",
       {seconds,
        "sensor_faults=[{at_s: 1, kind: foot_dropout, legs: [FL]}, {at_s: 1.5, kind: "
        "imu_dropout, magnitude: 0.2, duration_s: 1}]"}},
      {"threaded_mpc", {seconds, "controller.mpc.threaded=true", "controller.mpc.latency_ticks=2"}},
      {"supervisor",
       {seconds,
        "solver_faults={share: 0.02, outages: [{at_s: 1, duration_s: 1.5, solver: mpc}]}"}},
      {"bullet",
       {seconds, "physics.engine.type=bullet",
        "payloads=[{at_s: 1, action: add, duration_s: 0.5, body: " + kPlate + "}]"}},
      {"plastic_ground", {seconds, "physics.ground={type: plastic}"}},
      {"sliding_payload",
       {seconds, "sliding_payload={name: box, mass_kg: 2, p_BP_m: [0, 0, 0.1]}"}}};
}

class EpisodeClone : public ::testing::TestWithParam<Case> {};

TEST_P(EpisodeClone, GoesOnWithTheSameBits) {
  const Walk walk(GetParam().set);
  const auto never_cloned = walk.Start();
  const std::uint64_t expected = RunToEnd(*never_cloned);
  const std::int64_t last = never_cloned->step();
  core::Rng rng(7, 0, core::Stream::kBootstrap);
  std::vector<std::int64_t> steps(20);
  for (std::int64_t& step : steps)
    step = static_cast<std::int64_t>(rng.NextUniform() * static_cast<double>(last - 1));
  std::ranges::sort(steps);
  const auto original = walk.Start();
  std::vector<std::unique_ptr<Episode>> clones;
  for (const std::int64_t step : steps) {
    RunTo(*original, step);
    clones.push_back(original->Clone());
  }
  EXPECT_EQ(RunToEnd(*original), expected) << "the cloned one";
  for (std::size_t i = 0; i < clones.size(); ++i)
    EXPECT_EQ(RunToEnd(*clones[i]), expected) << "clone of step " << steps[i];
}

TEST_P(EpisodeClone, InterventionsConcernOneAlone) {
  const Walk walk(GetParam().set);
  const auto original = walk.Start();
  RunTo(*original, 2500);
  const auto changed = original->Clone(), left_alone = original->Clone();
  changed->Intervene(FrictionScale{0.3});
  const std::uint64_t hash = RunToEnd(*changed);
  const std::uint64_t expected = RunToEnd(*original);
  EXPECT_NE(hash, expected);
  EXPECT_EQ(RunToEnd(*left_alone), expected);
}

INSTANTIATE_TEST_SUITE_P(Every, EpisodeClone, ::testing::ValuesIn(Cases()),
                         [](const auto& test) { return std::string(test.param.name); });

// Each intervention changes the walk, is announced, and one that changes nothing leaves the bits.
TEST(Intervention, ChangesTheWalkAndSaysSo) {
  const Walk walk({"duration_s=5", "payloads=[{at_s: 0.5, action: add, body: " + kPlate + "}]",
                   "controller.adaptation.type=kf_plus"});
  const auto original = walk.Start();
  RunTo(*original, 2500);
  controller::ControllerParams slower = walk.scenario.controller;
  slower.gait = controller::SgsParams{};
  const std::vector<std::pair<Intervention, std::string>> changes = {
      {FrictionScale{0.5}, "friction x 0.5"},
      {TorqueLimitScale{0.3}, "torque limits x 0.3"},
      {PayloadOff{}, "payloads off"},
      {TruthFor{.state = true}, "truth for state"},
      {TruthFor{.contact = true}, "truth for contact"},
      {TruthFor{.model = true}, "truth for model"},
      {TruthFor{.ground = true}, "truth for ground"},
      {slower, "another controller"}};
  const std::uint64_t expected = RunToEnd(*original->Clone());
  for (const auto& [change, text] : changes) {
    const auto episode = original->Clone();
    episode->Intervene(change);
    EXPECT_EQ(episode->events().back().kind, "intervention");
    EXPECT_EQ(episode->events().back().detail, text);
    EXPECT_NE(RunToEnd(*episode), expected) << text;
  }
  for (const Intervention& nothing :
       {Intervention{FrictionScale{1.0}}, Intervention{TorqueLimitScale{1.0}},
        Intervention{TruthFor{}}, Intervention{walk.scenario.controller}}) {
    const auto episode = original->Clone();
    episode->Intervene(nothing);
    EXPECT_EQ(RunToEnd(*episode), expected) << Describe(nothing);
  }
}

}  // namespace
}  // namespace scoria::app
