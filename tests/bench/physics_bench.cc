// SPDX-License-Identifier: BSD-3-Clause
// One physics step of a Go2 that trots in place on rough ground, here and in MuJoCo, in one run:
// joint losses, rotors, and every collision shape on a 20 m heightfield of 2.5 cm in both.
#include <numbers>

#include <benchmark/benchmark.h>

#include "sim/world.h"
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

void Scoria(benchmark::State& state) {
  sim::World world(test::Go2(), Ground(), {}, {0.0, 0.0, -9.81});
  int step = 0;
  std::int64_t iterations = 0;
  for (auto _ : state) {
    if (step % kEpisode == 0) world.Reset(Start());
    world.Step(Trot(world.truth().state, 0.001 * step));
    iterations += world.solver_iterations();
    ++step;
  }
  state.counters["solver_iterations"] =
      static_cast<double>(iterations) / static_cast<double>(state.iterations());
  state.counters["height_m"] = world.truth().state.p_WB.z();
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

BENCHMARK(Scoria)->Unit(benchmark::kMicrosecond)->Iterations(30000);
BENCHMARK(Mujoco)->Unit(benchmark::kMicrosecond)->Iterations(30000);

}  // namespace
}  // namespace scoria

BENCHMARK_MAIN();
