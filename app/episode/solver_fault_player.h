// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/scenario/scenario.h"
#include "core/rng.h"

namespace scoria::app {

/// Draws the faults that a scenario plays on the solvers, and counts those that met a tick.
class SolverFaultPlayer {
 public:
  SolverFaultPlayer(const SolverFaultParams& params, std::uint64_t seed)
      : params_(params), rng_(seed, 0, core::Stream::kSolverFault) {}

  /// To be called in every step, so that a controller that runs slower meets the same faults.
  /// @param clock_s on which outages are scheduled.
  [[nodiscard]] controller::SolverFaults Draw(double clock_s);
  void CountInjected(const controller::SolverFaults& faults,
                     const controller::ControlOutput& control);
  [[nodiscard]] const Counters& injected() const noexcept { return injected_; }

 private:
  [[nodiscard]] controller::SolverFaults DrawRandom();

  SolverFaultParams params_;
  core::Rng rng_;
  Counters injected_;
};

}  // namespace scoria::app
