// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/solver_fault_player.h"

#include <array>

namespace scoria::app {

using controller::SolverFault, controller::SolverFaults;

SolverFaults SolverFaultPlayer::Draw(const core::EventClock& now) {
  SolverFaults faults = DrawRandom();
  for (std::size_t i = 0; i < timers_.size(); ++i) {
    const SolverOutage& outage = params_.outages[i];
    timers_[i].BeginAfter(outage.at_s, now);
    if (!timers_[i].Runs(outage.duration_s, now)) continue;
    (outage.solver == Solver::kMpc ? faults.mpc : faults.wbc) = outage.kind;
  }
  return faults;
}

SolverFaults SolverFaultPlayer::DrawRandom() {
  if (params_.share == 0.0) return {};
  constexpr std::array<SolverFault, 3> kKinds = {SolverFault::kFail, SolverFault::kNan,
                                                 SolverFault::kLate};
  const auto draw = [&] {
    const double u = rng_.NextUniform() / params_.share;
    return u < 1.0 ? kKinds[static_cast<std::size_t>(3.0 * u)] : SolverFault::kNone;
  };
  SolverFaults faults;
  faults.mpc = draw();
  faults.wbc = draw();
  return faults;
}

void SolverFaultPlayer::CountInjected(const SolverFaults& faults,
                                      const controller::ControlOutput& control) {
  const auto add = [&](SolverFault fault, Count failure, Count late) {
    if (fault != SolverFault::kNone) injected_.Add(fault == SolverFault::kLate ? late : failure);
  };
  if (control.mpc_updated) add(faults.mpc, Count::kMpcFailure, Count::kMpcLate);
  if (control.wbc_updated) add(faults.wbc, Count::kWbcFailure, Count::kWbcLate);
}

}  // namespace scoria::app
