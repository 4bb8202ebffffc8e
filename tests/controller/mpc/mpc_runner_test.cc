// SPDX-License-Identifier: BSD-3-Clause
#include "controller/mpc/mpc_runner.h"

#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "tests/support/robots.h"

namespace scoria::controller {
namespace {

/// A trot that sways a little from tick to tick, so that no two problems are alike.
MpcInput InputAt(int tick) {
  RobotState state = test::StandingState();
  state.v_WB = {0.3, 0.05 * std::sin(0.3 * tick), 0.0};
  state.w_WB = {0.1 * std::cos(0.2 * tick), 0.0, 0.0};
  MpcInput in;
  core::WholeBodyModel(test::Go2(), 9.81).Calc(state, in.wb);
  in.contacts.standing = false;
  in.contacts.horizon = 10;
  for (auto& stage : in.footholds.stage) stage = in.wb.p_WF;
  for (std::size_t k = 0; k < in.contacts.stage_stance.size(); ++k) {
    const bool first = (k + static_cast<std::size_t>(tick) / 5) / 5 % 2 == 0;
    in.contacts.stage_stance[k] = {first, !first, !first, first};
  }
  for (auto& stage : in.reference.stages) {
    stage.p_WC = in.wb.p_WC;
    stage.v_WC = {0.3, 0.0, 0.0};
  }
  return in;
}

std::vector<Vec3> Forces(int latency_ticks, bool threaded) {
  MpcParams params;
  params.horizon = 10;
  params.latency_ticks = latency_ticks;
  params.threaded = threaded;
  MpcRunner runner(params, test::Go2(), 9.81);
  std::vector<Vec3> forces;
  for (int tick = 0; tick < 60; ++tick) {
    runner.input() = InputAt(tick);
    runner.Submit();
    const MpcRunner::Result& result = runner.Collect();
    EXPECT_EQ(result.tick, std::max(0, tick - latency_ticks));
    for (const Leg leg : kLegs) forces.push_back(result.mpc.plan.f_F_W[0][leg]);
  }
  return forces;
}

TEST(MpcRunner, ThreadGivesTheSameBitsForEveryLatency) {
  const std::vector<Vec3> at_once = Forces(0, false);
  for (int latency = 0; latency <= MpcRunner::kMaxLatency; ++latency) {
    const std::vector<Vec3> inline_forces = Forces(latency, false);
    EXPECT_EQ(Forces(latency, true), inline_forces) << latency;
    const auto later = 4 * static_cast<std::ptrdiff_t>(latency);
    EXPECT_TRUE(std::equal(inline_forces.begin() + later, inline_forces.end(), at_once.begin()))
        << "latency " << latency << " delays and changes nothing else";
  }
}

TEST(MpcRunner, EndsWithWorkUnderWay) {
  MpcParams params;
  params.threaded = true;
  params.latency_ticks = MpcRunner::kMaxLatency;
  MpcRunner runner(params, test::Go2(), 9.81);
  runner.input() = InputAt(0);
  runner.Submit();
}

}  // namespace
}  // namespace scoria::controller
