// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "tests/support/closed_loop.h"
#include "tests/support/robots.h"

namespace scoria::controller {
namespace {

using test::ClosedLoop;
using test::LoopParams;

double Yaw(const RobotState& s) { return core::RpyFromRotation(s.R_WB).z(); }

/// A vector of W as the robot's heading frame has it.
Vec3 InHeading(const RobotState& s, const Vec3& v_W) { return core::RotationZ(-Yaw(s)) * v_W; }

/// A controller whose stages have their errors.
LoopParams WithErrors() {
  LoopParams params;
  params.controller.estimator = LinearKfParams{};
  params.controller.contact.source = ContactChoice::kGaitPhase;
  params.controller.adaptation = NoAdaptationParams{};
  sim::PayloadEvent add;
  add.at_s = 0.0;
  add.body =
      sim::PayloadParams{"plate", 3.0, {0.02, 0.05, 0.09}, {0.0, 0.0, 0.0}, {0.2, 0.2, 0.02}};
  params.payloads = {add};
  return params;
}

// Where every stage has the truth already, the truth in its place changes no bit.
TEST(TrueInputs, OfStagesThatHaveTheTruthChangeNothing) {
  LoopParams params;
  params.controller.estimator = TruthEstimatorParams{};
  params.controller.contact.source = ContactChoice::kTruth;
  params.controller.adaptation = NoAdaptationParams{};
  const terrains::Heightfield ground = test::FlatGround();
  ClosedLoop plain(params, test::Go2(), ground), given(params, test::Go2(), ground);
  given.substitute = {.state = true, .contact = true, .trunk = true};
  plain.Run(1200);
  given.Run(1200);
  EXPECT_EQ(given.hash(), plain.hash());
}

TEST(TrueInputs, EmptyOnesChangeNothing) {
  const terrains::Heightfield ground = test::FlatGround();
  Controller plain({}, test::Go2(), 9.81, 0.001), given({}, test::Go2(), 9.81, 0.001);
  SensorFrame z;
  z.q = test::StandingState().q;
  z.a_WS_S = Vec3(0.0, 0.0, 9.81);
  for (int step = 0; step < 600; ++step) {
    z.step = step;
    z.imu_time_s = 0.001 * step;
    EXPECT_EQ(given.Step(z, {}, {}, TrueInputs{}).command, plain.Step(z, {}).command);
  }
}

// Tilt, velocities and joints are the true ones; place and heading go on from the estimate's.
TEST(TrueInputs, StateIsTheTrueOneInTheEstimatesWorld) {
  const terrains::Heightfield ground = test::FlatGround();
  ClosedLoop loop(WithErrors(), test::Go2(), ground);
  loop.Run(1500);
  RobotState believed = loop.control().estimate.state;
  const RobotState truth_then = loop.plant.truth().state;
  ASSERT_GT((believed.p_WB - truth_then.p_WB).norm(), 1e-3) << "the estimate has drifted";
  ClosedLoop given = loop;
  given.substitute.state = true;
  const RobotState true_start = given.plant.truth().state;
  given.Step();
  const RobotState start = given.control().estimate.state;
  EXPECT_LT((start.p_WB - believed.p_WB).norm(), 2e-3) << "no jump";
  EXPECT_NEAR(core::UnwrapNear(Yaw(start) - Yaw(believed), 0.0), 0.0, 2e-3);
  for (int i = 0; i < 300; ++i) {
    const RobotState truth = given.plant.truth().state;
    given.Step();
    const RobotState& now = given.control().estimate.state;
    ASSERT_LT((now.R_WB.row(2) - truth.R_WB.row(2)).norm(), 1e-9) << "tilt, step " << i;
    ASSERT_LT((InHeading(now, now.v_WB) - InHeading(truth, truth.v_WB)).norm(), 1e-9);
    ASSERT_LT((InHeading(now, now.w_WB) - InHeading(truth, truth.w_WB)).norm(), 1e-9);
    ASSERT_EQ(now.q, truth.q);
    ASSERT_LT((InHeading(start, now.p_WB - start.p_WB) -
               InHeading(true_start, truth.p_WB - true_start.p_WB))
                  .norm(),
              1e-9);
  }
  given.substitute.state = false;
  ClosedLoop plain = loop;
  EXPECT_NE(given.hash(), plain.hash());
}

TEST(TrueInputs, ContactIsTheTrueOneForAllThatFollows) {
  const terrains::Heightfield ground = test::FlatGround();
  ClosedLoop loop(WithErrors(), test::Go2(), ground);
  loop.Run(700);
  ClosedLoop given = loop;
  given.substitute.contact = true;
  int differences = 0;
  for (int i = 0; i < 600; ++i) {
    const LegArray<bool> truth = given.plant.truth().contact;
    given.Step();
    const ContactEstimate& contact = given.control().contact;
    ASSERT_EQ(contact.contact, truth);
    ASSERT_EQ(contact.source, LegArray<ContactSource>(ContactSource::kTruth));
    loop.Step();
    if (loop.control().contact.contact != truth) ++differences;
  }
  EXPECT_GT(differences, 0) << "the plan is not always right";
  EXPECT_NE(given.hash(), loop.hash());
}

TEST(TrueInputs, ModelIsTheTrueOneWhileItIsGiven) {
  const terrains::Heightfield ground = test::FlatGround();
  ClosedLoop loop(WithErrors(), test::Go2(), ground);
  loop.Run(100);
  const double nominal_kg = loop.control().model_mass_kg;
  EXPECT_NEAR(nominal_kg, test::Go2().total_mass_kg(), 1e-9);
  loop.substitute.trunk = true;
  loop.Step();
  EXPECT_NEAR(loop.control().model_mass_kg, nominal_kg + 3.0, 1e-9);
  EXPECT_EQ(loop.controller.model().trunk, loop.plant.truth().trunk);
  loop.substitute.trunk = false;
  loop.Step();
  EXPECT_EQ(loop.control().model_mass_kg, nominal_kg);
}

// On a ramp that begins under the robot, the plane through known ground follows at once; the one
// through past footholds lags.
TEST(TrueInputs, KnownGroundIsPlannedOn) {
  const terrains::Heightfield ground = test::TiltedGround(0.12, 0.9);
  LoopParams params;
  params.controller.estimator = TruthEstimatorParams{};
  ClosedLoop plain(params, test::Go2(), ground), given(params, test::Go2(), ground);
  given.substitute.ground = true;
  double worst_m = 0.0;
  for (ClosedLoop* loop : {&plain, &given}) loop->Run(400);
  for (int i = 0; i < 800; ++i) {
    given.Step();
    plain.Step();
    const Vec3& p_WC = given.plant.truth().p_WC;
    worst_m = std::max(worst_m,
                       std::abs(given.control().ground_z_m - ground.HeightAt(p_WC.x(), p_WC.y())));
  }
  EXPECT_LT(worst_m, 0.004) << "within the travel of a tick";
  EXPECT_NE(given.hash(), plain.hash());
}

}  // namespace
}  // namespace scoria::controller
