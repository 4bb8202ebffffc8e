// SPDX-License-Identifier: BSD-3-Clause
#include "sim/plant/plant.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "controller/stand_up.h"
#include "core/config/archive.h"
#include "core/math/so3.h"
#include "core/robot/whole_body.h"
#include "core/robot_files/load.h"
#include "tests/support/engines.h"
#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

using EveryEngine = test::EngineTest;
INSTANTIATE_TEST_SUITE_P(Engines, EveryEngine, test::AllEngines(), test::EngineOf);

const Vec3 kGravity(0.0, 0.0, -9.81);

/// Joint PD that holds a pose.
LegArray<Vec3> Hold(const RobotState& s, const LegArray<Vec3>& q, double kp = 100.0,
                    double kd = 3.0) {
  LegArray<Vec3> tau = ZeroPerLeg();
  for (const Leg leg : kLegs) tau[leg] = kp * (q[leg] - s.q[leg]) - kd * s.qd[leg];
  return tau;
}

TEST_P(EveryEngine, FootForcesSumToTheWeightAtRest) {
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, Physics(), kGravity);
  const RobotState start = test::StandingState();
  plant.Reset(start);
  for (int i = 0; i < 3000; ++i) plant.Step(Hold(plant.truth().state, start.q));
  Vec3 sum = Vec3::Zero();
  for (const Leg leg : kLegs) sum += plant.truth().f_F_W[leg];
  const double tolerance_N = IsBullet() ? 0.1 : 0.05;
  EXPECT_NEAR(sum.z(), test::Go2().total_mass_kg() * 9.81, tolerance_N);
  EXPECT_NEAR(sum.head<2>().norm(), 0.0, tolerance_N);
  EXPECT_EQ(plant.truth().trunk_force_N, 0.0);
}

// A robot that slides down a flat tilted heightfield with locked legs: the stock heightfield shape
// kicks each foot by 40 N here, at every edge between triangles.
TEST_P(EveryEngine, SlidingFootFeelsNoKicks) {
  const terrains::Heightfield ground = test::FlatGround(0.25, 60.0);
  const double slope = 0.35;
  Plant plant(test::Go2(), ground, Physics(), 9.81 * Vec3(-std::sin(slope), 0.0, -std::cos(slope)));
  const RobotState start = test::StandingState();
  plant.Reset(start);
  double sum = 0.0, squares = 0.0;
  const int kSettle = 500, kSteps = 1500;
  for (int i = 0; i < kSteps; ++i) {
    plant.Step(Hold(plant.truth().state, start.q, 400.0, 6.0));
    if (i < kSettle) continue;
    const double f = plant.truth().f_F_W[Leg::kFL].z();
    sum += f;
    squares += f * f;
  }
  const double n = kSteps - kSettle, mean = sum / n;
  EXPECT_LT(plant.truth().state.p_WB.x(), -0.5) << "it does slide";
  EXPECT_GT(mean, 5.0);
  EXPECT_LT(std::sqrt(std::max(0.0, squares / n - mean * mean)), 0.5);
}

/// A low stance, so that no slope tips the robot over.
RobotState LowStance() {
  RobotState s = test::StandingState();
  s.q = controller::StandingPose(test::Go2(), 0.15);
  s.p_WB.z() = 0.15 + test::Go2().legs[Leg::kFL].foot_radius_m;
  return s;
}

// The friction cone is Coulomb's, in any direction: a robot with locked legs holds where the slope
// is 0.99 of mu, and slides where it is 1.01, with the acceleration of a block.
TEST_P(EveryEngine, FrictionConeIsExactOnSlopes) {
  constexpr double kSeconds = 3.0;
  for (const double mu : {0.2, 0.3, 0.45, 0.6, 0.75, 0.9}) {
    for (const double direction : {0.0, 0.7}) {
      for (const double share : {0.99, 1.01}) {
        const terrains::Heightfield ground = test::FlatGround(mu, 40.0);
        const double slope = std::atan(share * mu);
        const Vec3 downhill(std::cos(direction), std::sin(direction), 0.0);
        Plant plant(test::Go2(), ground, Physics(),
                    9.81 * (std::sin(slope) * downhill - std::cos(slope) * Vec3::UnitZ()));
        const RobotState start = LowStance();
        plant.Reset(start);
        for (int i = 0; i < std::lround(kSeconds / 0.001); ++i)
          plant.Step(Hold(plant.truth().state, start.q, 1500.0, 20.0));
        const double speed = plant.truth().state.v_WB.dot(downhill);
        if (share < 1.0) {
          EXPECT_LT(std::abs(speed), 1e-4) << mu;
        } else {
          const double block = 9.81 * (std::sin(slope) - mu * std::cos(slope)) * kSeconds;
          EXPECT_GT(speed, 0.5 * block) << mu;
          EXPECT_LT(speed, 1.5 * block) << mu;
        }
      }
    }
  }
}

// The scale moves the cone's edge for all of the ground, at once and back.
TEST_P(EveryEngine, FrictionScaleMovesTheCone) {
  constexpr double kMu = 0.6, kScale = 0.5;
  const terrains::Heightfield ground = test::FlatGround(kMu, 40.0);
  for (const double share : {0.99, 1.01}) {
    const double slope = std::atan(share * kScale * kMu);
    Plant plant(test::Go2(), ground, Physics(),
                9.81 * Vec3(std::sin(slope), 0.0, -std::cos(slope)));
    const RobotState start = LowStance();
    plant.Reset(start);
    const auto speed_after_a_second = [&] {
      for (int i = 0; i < 1000; ++i) plant.Step(Hold(plant.truth().state, start.q, 1500.0, 20.0));
      return plant.truth().state.v_WB.x();
    };
    EXPECT_LT(std::abs(speed_after_a_second()), 1e-4);
    plant.SetFrictionScale(kScale);
    const double block = 9.81 * (std::sin(slope) - kScale * kMu * std::cos(slope));
    if (share < 1.0) {
      EXPECT_LT(std::abs(speed_after_a_second()), 1e-4);
    } else {
      EXPECT_NEAR(speed_after_a_second(), block, 0.5 * block);
    }
    plant.SetFrictionScale(1.0);
    EXPECT_LT(std::abs(speed_after_a_second()), 1e-4);
  }
}

// Damping acts implicitly and friction as a bounded impulse: while all joints move, one step gives
// (H + A + D dt)⁻¹(τ − friction − h − D qd).
TEST_P(EveryEngine, JointLossesActInsideTheStepExactly) {
  const core::RobotDescription& robot = test::Go2();
  const core::MotorParams& motors = robot.config.motors;
  const terrains::Heightfield ground = test::FlatGround();
  const PhysicsParams params = Physics();
  Plant plant(robot, ground, params, kGravity);
  const core::WholeBodyModel model(robot, 9.81);
  core::Rng rng(7, 0, core::Stream::kSensor);
  for (int trial = 0; trial < 10; ++trial) {
    RobotState s = test::RandomState(rng);
    s.p_WB.z() = 5.0;
    LegArray<Vec3> tau = ZeroPerLeg();
    Vec18 generalised = Vec18::Zero();
    for (const Leg leg : kLegs) {
      for (int j = 0; j < 3; ++j) {
        tau[leg][j] = rng.NextUniform(-3.0, 3.0);
        s.qd[leg][j] += s.qd[leg][j] > 0.0 ? 3.0 : -3.0;  // too fast to stop within the step
        generalised[6 + 3 * static_cast<int>(leg) + j] =
            tau[leg][j] - motors.damping_Nms_per_rad[j] * s.qd[leg][j] -
            std::copysign(motors.friction_Nm[j], s.qd[leg][j]);
      }
    }
    core::WholeBody wb;
    model.Calc(s, wb);
    Mat18 H = AssembleMassMatrix(wb);
    for (int j = 6; j < 18; ++j) H(j, j) += params.step_s * motors.damping_Nms_per_rad[(j - 6) % 3];
    const Vec18 expected = H.ldlt().solve(generalised - AssembleBias(wb));
    plant.Reset(s);
    plant.Step(tau);
    const RobotState& after = plant.truth().state;
    const double bound = 1e-6 * (1.0 + expected.norm());
    for (const Leg leg : kLegs) {
      const Vec3 qdd = (after.qd[leg] - s.qd[leg]) / params.step_s;
      EXPECT_LT((qdd - expected.segment<3>(6 + 3 * static_cast<int>(leg))).norm(), bound) << trial;
    }
    EXPECT_LT(((after.w_WB - s.w_WB) / params.step_s - expected.segment<3>(3)).norm(), bound);
  }
}

TEST_P(EveryEngine, JointFrictionHoldsAJointThatIsPushedLessThanItsLimit) {
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, Physics(), Vec3::Zero());
  RobotState s = test::StandingState();
  s.p_WB.z() = 5.0;
  plant.Reset(s);
  LegArray<Vec3> tau = ZeroPerLeg();
  tau[Leg::kFL].z() = 0.19;
  for (int i = 0; i < 1000; ++i) plant.Step(tau);
  EXPECT_NEAR(plant.truth().state.q[Leg::kFL].z(), s.q[Leg::kFL].z(), 1e-6);
  tau[Leg::kFL].z() = 0.25;
  for (int i = 0; i < 1000; ++i) plant.Step(tau);
  EXPECT_GT(plant.truth().state.q[Leg::kFL].z(), s.q[Leg::kFL].z() + 0.1);
}

// B12's legs are light beside their rotors: as rows of the solver these couple so strongly that the
// iteration reached its limit in nine steps of ten.
TEST_P(EveryEngine, LightLegsWithRotorsConverge) {
  const core::RobotDescription robot = core::LoadRobot(core::ReadConfig<core::RobotConfig>(
      core::LoadConfig(test::SourcePath("robots/b12/b12.yaml"))));
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(robot, ground, Physics(), kGravity);
  RobotState start;
  start.q = controller::StandingPose(robot, robot.config.nominal_height_m);
  start.p_WB.z() = robot.config.nominal_height_m + robot.legs[Leg::kFL].foot_radius_m;
  plant.Reset(start);
  constexpr int kSteps = 2000;
  for (int i = 0; i < kSteps; ++i) {
    LegArray<Vec3> q = start.q;
    const bool first = std::sin(0.0126 * i) > 0.0;  // diagonal legs lift in turn
    for (const Leg leg : {first ? Leg::kFL : Leg::kFR, first ? Leg::kHR : Leg::kHL})
      q[leg] += std::abs(std::sin(0.0126 * i)) * Vec3(0.0, 0.35, -0.7);
    plant.Step(Hold(plant.truth().state, q, 90.0, 2.0));
  }
  EXPECT_LT(plant.unconverged_steps(), kSteps / 50);
}

// The integrator is of first order in the step, and these are its errors at 1 kHz: over a second of
// tumbling at 5 rad/s with legs held by their motors, 0.2 % of the kinetic energy and 0.1 % of the
// momenta; halving the step halves them.
TEST_P(EveryEngine, ThrownSpinningRobotKeepsMomentumAndEnergy) {
  const terrains::Heightfield ground = test::FlatGround();
  const core::RobotDescription& robot = test::Go2();
  const core::WholeBodyModel model(robot, 9.81);
  RobotState s = test::StandingState();
  s.p_WB.z() = 20.0;
  s.w_WB = {2.0, 3.0, 3.5};
  s.v_WB = {2.0, 0.0, 1.0};
  struct Errors {
    double energy, angular;
    Vec3 linear;
  };
  const auto fly = [&](double dt_s) {
    PhysicsParams params = Physics();
    params.step_s = dt_s;
    Plant plant(robot, ground, params, kGravity);
    plant.Reset(s);
    core::WholeBody wb;
    model.Calc(s, wb);
    const Vec6 before = CalcMomentum(wb);
    const double kinetic_J = plant.truth().energy.kinetic_J;
    constexpr double kFlight_s = 1.0;
    for (int i = 0; i < std::lround(kFlight_s / dt_s); ++i)
      plant.Step(Hold(plant.truth().state, s.q));
    model.Calc(plant.truth().state, wb);
    Vec6 change = CalcMomentum(wb) - before;
    change[2] += wb.mass_kg * 9.81 * kFlight_s;
    return Errors{plant.truth().energy.Error_J() / kinetic_J,
                  change.tail<3>().norm() / before.tail<3>().norm(),
                  change.head<3>() / before.head<3>().norm()};
  };
  const Errors coarse = fly(1e-3), fine = fly(5e-4);
  EXPECT_LT(std::abs(coarse.energy), 0.002) << coarse.energy;
  EXPECT_LT(coarse.angular, 0.001) << coarse.angular;
  EXPECT_LT(coarse.linear.norm(), 0.001) << coarse.linear.norm();
  EXPECT_LT(std::abs(fine.energy), 0.6 * std::abs(coarse.energy));
  EXPECT_LT(fine.angular, 0.6 * coarse.angular);
}

// A robot dropped with its joints held by springs: what the ledger cannot explain stays below 1 %
// of the energy that the ground took, and nothing is gained.
TEST_P(EveryEngine, DroppedRobotGainsNoEnergy) {
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, Physics(), kGravity);
  RobotState s = test::StandingState();
  s.p_WB.z() += 0.3;
  plant.Reset(s);
  double highest_J = -1e9;
  for (int i = 0; i < 3000; ++i) {
    plant.Step(Hold(plant.truth().state, s.q));
    const EnergyLedger& e = plant.truth().energy;
    highest_J = std::max(highest_J, e.kinetic_J + e.potential_J - e.initial_J - e.work.motor_J);
  }
  const EnergyLedger& e = plant.truth().energy;
  const double taken_J = -(e.work.contact_J + e.work.joint_J);
  EXPECT_GT(taken_J, 10.0);
  EXPECT_LT(std::abs(e.Error_J()), 0.01 * taken_J);
  EXPECT_LT(highest_J, 0.01 * taken_J);
  EXPECT_LT(e.kinetic_J, 1e-6);
}

/// Linear momentum, and angular momentum about W's origin.
Vec6 MomentumAboutOrigin(const core::WholeBodyModel& model, const RobotState& state) {
  core::WholeBody wb;
  model.Calc(state, wb);
  Vec6 momentum = CalcMomentum(wb);
  momentum.tail<3>() += wb.p_WC.cross(Vec3(momentum.head<3>()));
  return momentum;
}

// A plate that was at rest joins in flight: robot and plate have the momenta of the robot, and over
// the steps that follow keep them as well as the integrator does.
TEST_P(EveryEngine, PayloadFromRestKeepsTheMomenta) {
  const terrains::Heightfield ground = test::FlatGround();
  const core::RobotDescription& robot = test::Go2();
  Plant plant(robot, ground, Physics(), Vec3::Zero());
  core::WholeBodyModel model(robot, Vec3::Zero());
  RobotState s = test::StandingState();
  s.p_WB.z() = 5.0;
  s.v_WB = {1.0, 0.5, 0.0};
  s.w_WB = {0.5, 1.0, 1.5};
  plant.Reset(s);
  const Vec6 before = MomentumAboutOrigin(model, s);
  const std::vector<core::SpatialInertia> plate = {
      ToInertia({"plate", 5.0, {0.05, 0.02, 0.1}, Vec3::Zero(), {0.3, 0.2, 0.02}})};
  plant.SetTrunkParameters(AddBodies(robot.trunk, plate), AttachVelocity::kRest);
  for (int i = 0; i < 200; ++i) plant.Step(Hold(plant.truth().state, s.q));
  model.SetParameters({plant.truth().trunk});
  const Vec6 change = MomentumAboutOrigin(model, plant.truth().state) - before;
  EXPECT_LT(change.head<3>().norm(), 1e-3 * before.head<3>().norm());
  EXPECT_LT(change.tail<3>().norm(), 1e-3 * before.tail<3>().norm());
}

TEST_P(EveryEngine, StandingRobotStaysWhereItIs) {
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, Physics(), kGravity);
  const RobotState start = test::StandingState();
  plant.Reset(start);
  for (int i = 0; i < 2000; ++i) plant.Step(Hold(plant.truth().state, start.q));
  const Truth settled = plant.truth();
  for (int i = 0; i < 58000; ++i) plant.Step(Hold(plant.truth().state, start.q));
  EXPECT_LT((plant.truth().state.p_WB - settled.state.p_WB).norm(), 1e-6);
  EXPECT_LT(std::abs(plant.truth().energy.potential_J - settled.energy.potential_J), 1e-4);
  EXPECT_LT(plant.truth().energy.kinetic_J, 1e-12);
}

TEST_P(EveryEngine, TwoPlantsGiveTheSameBits) {
  const terrains::Heightfield ground = test::FlatGround();
  const auto run = [&] {
    Plant plant(test::Go2(), ground, Physics(), kGravity);
    RobotState start = test::StandingState();
    start.p_WB.z() += 0.05;
    start.v_WB = {0.3, 0.1, 0.0};
    plant.Reset(start);
    for (int i = 0; i < 400; ++i) plant.Step(Hold(plant.truth().state, start.q));
    return plant.truth();
  };
  EXPECT_EQ(run(), run());
}

TEST_P(EveryEngine, ResetForgetsTheOldContacts) {
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, Physics(), kGravity);
  const RobotState start = test::StandingState();
  const auto settle = [&] {
    plant.Reset(start);
    for (int i = 0; i < 200; ++i) plant.Step(Hold(plant.truth().state, start.q));
    return plant.truth();
  };
  EXPECT_EQ(settle(), settle());
}

TEST_P(EveryEngine, FallenRobotReportsTheTrunksForce) {
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, Physics(), kGravity);
  RobotState s = test::StandingState();
  s.p_WB.z() = 0.2;
  s.R_WB = core::RotationFromRpy({3.1, 0.0, 0.0});  // on its back
  plant.Reset(s);
  for (int i = 0; i < 1500; ++i) plant.Step(Hold(plant.truth().state, s.q));
  EXPECT_GT(plant.truth().trunk_force_N, 20.0);
}

}  // namespace
}  // namespace scoria::sim
