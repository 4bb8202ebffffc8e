// SPDX-License-Identifier: BSD-3-Clause
// One physics step of a Go2 that trots in place on rough ground, here and in MuJoCo, in one run:
// joint losses, rotors, and every collision shape on a 20 m heightfield of 2.5 cm in both.
#include <numbers>

#include <benchmark/benchmark.h>

#include "sim/plant/plant.h"
#include "terrains/generator.h"
#include "tests/support/mujoco.h"
#include "tests/support/robots.h"

namespace scoria {
namespace {

const terrains::Heightfield& Ground() {
  static const terrains::Heightfield kGround = [] {
    terrains::TerrainParams params;
    params.size_m = 20.0;
    params.substrate.friction = 0.8;
    params.roughness.nu_1m_m = 0.05;
    return terrains::GenerateTerrain(params, 1, 0);
  }();
  return kGround;
}

RobotState Start() {
  RobotState s = test::StandingState();
  s.p_WB.z() += Ground().HeightAt(0.0, 0.0) + 0.03;
  return s;
}

/// Diagonal legs lift in turn, twice a second.
LegArray<Vec3> Trot(const RobotState& s, double time_s) {
  static const LegArray<Vec3> kStand = test::StandingState().q;
  LegArray<Vec3> tau = ZeroPerLeg();
  for (const Leg leg : kLegs) {
    const bool first = leg == Leg::kFL || leg == Leg::kHR;
    const double lift =
        std::max(0.0, std::sin(2.0 * std::numbers::pi * (2.0 * time_s + (first ? 0.0 : 0.5))));
    const Vec3 q = kStand[leg] + lift * Vec3(0.0, 0.35, -0.7);
    tau[leg] = 120.0 * (q - s.q[leg]) - 3.0 * s.qd[leg];
  }
  return tau;
}

constexpr int kEpisode = 3000;  // steps, then from the start again

/// Which rows the solver has beside the contacts.
struct JointLosses {
  bool rotors = true, friction = true;
};

core::RobotDescription Go2With(const JointLosses& losses) {
  core::RobotDescription robot = test::Go2();
  core::MotorParams& motors = robot.config.motors;
  if (!losses.rotors) {
    motors.armature_kgm2.setZero();
    motors.damping_Nms_per_rad.setZero();
  }
  if (!losses.friction) motors.friction_Nm.setZero();
  return robot;
}

void Walk(benchmark::State& state, const sim::EngineParams& engine, const JointLosses& losses) {
  const core::RobotDescription robot = Go2With(losses);
  sim::PhysicsParams physics;
  physics.engine = engine;
  sim::Plant plant(robot, Ground(), physics, {0.0, 0.0, -9.81});
  int step = 0;
  std::int64_t iterations = 0;
  for (auto _ : state) {
    if (step % kEpisode == 0) plant.Reset(Start());
    plant.Step(Trot(plant.truth().state, 0.001 * step));
    iterations += plant.solver_iterations();
    ++step;
  }
  state.counters["solver_iterations"] =
      static_cast<double>(iterations) / static_cast<double>(state.iterations());
  state.counters["height_m"] = plant.truth().state.p_WB.z();
}

void Mujoco(benchmark::State& state) {
  test::MujocoModel mujoco(test::Go2(), {.joint_losses = true, .ground = &Ground()});
  int step = 0;
  for (auto _ : state) {
    if (step % kEpisode == 0) mujoco.Set(Start());
    mujoco.SetTorques(Trot(mujoco.state(), 0.001 * step));
    mj_step(mujoco.model.get(), mujoco.data.get());
    ++step;
  }
  state.counters["height_m"] = mujoco.state().p_WB.z();
}

BENCHMARK_CAPTURE(Walk, scoria, sim::ScoriaDynamics{}, JointLosses{})
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(30000);
BENCHMARK_CAPTURE(Walk, bullet, sim::BulletDynamics{}, JointLosses{})
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(30000);
BENCHMARK_CAPTURE(Walk, bullet_without_friction_rows, sim::BulletDynamics{},
                  JointLosses{.friction = false})
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(30000);
BENCHMARK_CAPTURE(Walk, bullet_contacts_alone, sim::BulletDynamics{},
                  JointLosses{.rotors = false, .friction = false})
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(30000);
BENCHMARK(Mujoco)->Unit(benchmark::kMicrosecond)->Iterations(30000);

}  // namespace
}  // namespace scoria

BENCHMARK_MAIN();
