// SPDX-License-Identifier: BSD-3-Clause
// A copy of world, sensors, motors and controller goes on with the bits of the original, whatever
// stages they are made of.
#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "tests/support/closed_loop.h"
#include "tests/support/robots.h"

namespace scoria {
namespace {

using namespace controller;  // NOLINT: of the variants that are named below
using test::ClosedLoop;
using test::LoopParams;

/// Stones of a few centimetres, sharp enough for shanks and trunk to touch when the robot falls.
terrains::Heightfield StonyGround(const terrains::Material& material = {}) {
  constexpr int kNodes = 401;
  constexpr double kSpacing_m = 0.025, kHeight_m = 0.012;
  std::vector<double> heights_m;
  for (int row = 0; row < kNodes; ++row) {
    for (int column = 0; column < kNodes; ++column)
      heights_m.push_back(kHeight_m * std::sin(0.9 * column) * std::cos(0.7 * row));
  }
  return terrains::Heightfield(kNodes, kSpacing_m, std::move(heights_m), material);
}

/// An episode that was never cloned, one that is cloned at `at`, and its clone, end alike; a clone
/// that is pushed ends otherwise and does not touch them.
void ExpectClonesAgree(const LoopParams& params, const terrains::Heightfield& ground, int at,
                       int steps, const core::RobotDescription& robot = test::Go2()) {
  ClosedLoop alone(params, robot, ground);
  alone.Run(steps);
  ClosedLoop original(params, robot, ground);
  original.Run(at);
  ClosedLoop clone = original, pushed = original;
  pushed.plant.SetTrunkWrench({40.0, -25.0, 0.0}, Vec3::Zero());
  for (int i = at; i < steps; ++i) {
    clone.Step();
    pushed.Step();
    original.Step();
    ASSERT_EQ(clone.hash(), original.hash()) << "step " << i << ", cloned at " << at;
  }
  EXPECT_EQ(original.hash(), alone.hash()) << "cloned at " << at;
  EXPECT_NE(pushed.hash(), alone.hash());
  EXPECT_EQ(original.controller.counters(), alone.controller.counters());
  EXPECT_EQ(clone.plant.truth(), alone.plant.truth());
}

/// Clones while the robot stands and at random steps while it walks.
void ExpectClonesAgree(const LoopParams& params,
                       const terrains::Heightfield& ground = StonyGround()) {
  constexpr int kSteps = 1100;
  core::Rng rng(11, 0, core::Stream::kOperator);
  ExpectClonesAgree(params, ground, 137, kSteps);
  for (int i = 0; i < 2; ++i)
    ExpectClonesAgree(params, ground, static_cast<int>(rng.NextUniform(500.0, 1000.0)), kSteps);
}

TEST(Clone, EveryGait) {
  SgsParams walk;
  walk.gait = NamedGait::kStaticWalk;
  for (const GaitParams& gait : {GaitParams(AgsParams{}), GaitParams(walk),
                                 GaitParams(SgsMatchedParams{}), GaitParams(BioParams{})}) {
    LoopParams params;
    params.controller.gait = gait;
    ExpectClonesAgree(params);
  }
}

TEST(Clone, EveryEstimator) {
  for (const EstimatorParams& estimator :
       {EstimatorParams(InekfEstimatorParams{}), EstimatorParams(LinearKfParams{}),
        EstimatorParams(LegOdometryParams{}), EstimatorParams(TruthEstimatorParams{})}) {
    LoopParams params;
    params.controller.estimator = estimator;
    ExpectClonesAgree(params);
  }
}

TEST(Clone, EveryContactSource) {
  for (const auto& [source, name] : EnumNames(ContactChoice{})) {
    SCOPED_TRACE(name);
    LoopParams params;
    params.controller.contact.source = source;
    params.controller.contact.touchdown_delay_s = 0.004;
    ExpectClonesAgree(params);
  }
}

TEST(Clone, EveryAdapter) {
  KfPlusParams kf_plus;
  kf_plus.tare.duration_s = 0.3;
  for (const AdapterParams& adaptation :
       {AdapterParams(NoAdaptationParams{}), AdapterParams(AdaptationKfParams{}),
        AdapterParams(RlsParams{}), AdapterParams(kf_plus)}) {
    LoopParams params;
    params.controller.adaptation = adaptation;
    ExpectClonesAgree(params);
  }
}

TEST(Clone, EveryBodyController) {
  std::vector<WbcParams> variants = {InverseDynamicsParams{}};
  for (const auto& [formulation, name] : EnumNames(TsidFormulation{}))
    variants.emplace_back(TsidParams{.formulation = formulation});
  for (const WbcParams& wbc : variants) {
    LoopParams params;
    params.controller.wbc = wbc;
    ExpectClonesAgree(params);
  }
}

TEST(Clone, MpcUnderWayOnItsThread) {
  LoopParams params;
  params.controller.mpc.threaded = true;
  for (const int latency_ticks : {0, 1, 5}) {
    params.controller.mpc.latency_ticks = latency_ticks;
    ExpectClonesAgree(params);
    // In the very step in which a problem was submitted.
    ExpectClonesAgree(params, StonyGround(), 611, 900);
  }
}

TEST(Clone, PlasticAndSoftGround) {
  LoopParams params;
  ExpectClonesAgree(params, StonyGround({.stiffness_N_per_m3 = 2e6, .depth_m = 0.05}));
  params.physics.ground = sim::PlasticGround{};
  ExpectClonesAgree(params, StonyGround({.stiffness_N_per_m3 = 2e6, .depth_m = 0.05}));
}

TEST(Clone, PayloadsThatSlideComeAndGo) {
  LoopParams params;
  params.sliding =
      sim::SlidingPayloadParams{.name = "box", .mass_kg = 1.5, .p_BP_m = {0.0, 0.0, 0.1}};
  sim::PayloadEvent add, shed;
  add.at_s = 0.45;
  add.body =
      sim::PayloadParams{"plate", 2.0, {0.02, 0.05, 0.09}, {0.1, 0.2, 0.3}, {0.2, 0.2, 0.02}};
  add.duration_s = 0.3;
  shed.at_s = 0.8;
  shed.action = sim::PayloadAction::kShed;
  shed.payload = "plate";
  shed.share = 0.5;
  shed.duration_s = 0.2;
  params.payloads = {add, shed};
  ExpectClonesAgree(params);
}

TEST(Clone, SensorAndSolverFaults) {
  using Kind = sim::SensorFaultKind;
  LoopParams params;
  params.sensor_faults = {
      {.at_s = 0.3, .kind = Kind::kImuDropout, .legs = {}, .magnitude = 0.3},
      {.at_s = 0.4, .kind = Kind::kFootDrift, .legs = {"FL"}, .magnitude = 60.0},
      {.at_s = 0.5, .duration_s = 0.3, .kind = Kind::kFootStuck, .legs = {"HR"}},
      {.at_s = 0.6, .kind = Kind::kImuTemperature, .legs = {}, .magnitude = 10.0}};
  params.fault_share = 0.3;
  ExpectClonesAgree(params);
}

TEST(Clone, DelaysOfCommandsAndSamples) {
  core::RobotDescription robot = test::Go2();
  robot.config.motors.delay_s = 0.003;
  LoopParams params;
  auto& sensors = std::get<sim::RealisticSensors>(params.sensors);
  sensors.imu.sampling = {.rate_Hz = 500.0, .latency_s = 0.003};
  sensors.encoders.sampling.latency_s = 0.001;
  for (const int at : {137, 611, 845}) ExpectClonesAgree(params, StonyGround(), at, 1100, robot);
}

// A robot that is thrown down on stones: trunk, thighs and shanks touch, and Bullet's cached points
// matter. On level ground shapes come near and leave, and their order matters.
TEST(Clone, RobotThatTumbles) {
  for (const bool stony : {true, false}) {
    const terrains::Heightfield ground = stony ? StonyGround() : test::FlatGround();
    LoopParams params;
    ClosedLoop alone(params, test::Go2(), ground);
    RobotState thrown = test::StandingState();
    thrown.R_WB = core::ExpSo3(Vec3(1.9, 0.3, 0.0));
    thrown.w_WB = {-3.0, 2.0, 1.0};
    alone.plant.Reset(thrown);
    ClosedLoop original = alone;
    alone.Run(1500);
    EXPECT_GT(alone.plant.truth().trunk_force_N, 0.0) << "it lies";
    std::vector<ClosedLoop> clones;
    for (int step = 0; step < 1500; ++step) {
      if (step % 100 == 70) clones.push_back(original);
      original.Step();
      for (ClosedLoop& clone : clones) {
        clone.Step();
        ASSERT_EQ(clone.hash(), original.hash()) << step;
      }
    }
    EXPECT_EQ(original.hash(), alone.hash());
  }
}

TEST(Clone, RobotThatStandsUp) {
  LoopParams params;
  params.pose = Start::Pose::kLying;
  const terrains::Heightfield ground = StonyGround();
  for (const int at : {1, 400, 1200}) ExpectClonesAgree(params, ground, at, 2400);
}

// What was changed while walking stays in the clone, and a change of the clone stays there.
TEST(Clone, ReconfiguredController) {
  const terrains::Heightfield ground = StonyGround();
  LoopParams params;
  ClosedLoop original(params, test::Go2(), ground);
  original.Run(700);
  ClosedLoop clone = original, changed = original;
  ControllerParams other = params.controller;
  other.gait = SgsParams{};
  other.wbc = InverseDynamicsParams{};
  other.mpc.threaded = true;
  changed.controller.Reconfigure(other);
  ClosedLoop changed_clone = changed;
  for (ClosedLoop* loop : {&original, &clone, &changed, &changed_clone}) loop->Run(300);
  EXPECT_EQ(clone.hash(), original.hash());
  EXPECT_EQ(changed_clone.hash(), changed.hash());
  EXPECT_NE(changed.hash(), original.hash());
}

}  // namespace
}  // namespace scoria
