// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "app/scenario/scenario.h"
#include "core/event_clock.h"
#include "core/rng.h"

namespace scoria::app {

/// Draws the faults that a scenario plays on the solvers, and counts those that met a tick.
class SolverFaultPlayer {
 public:
  SolverFaultPlayer(const SolverFaultParams& params, std::uint64_t seed)
      : params_(params),
        timers_(params.outages.size()),
        rng_(seed, 0, core::Stream::kSolverFault) {}

  /// To be called in every step, so that a controller that runs slower meets the same faults.
  [[nodiscard]] controller::SolverFaults Draw(const core::EventClock& now);
  void CountInjected(const controller::SolverFaults& faults,
                     const controller::ControlOutput& control);
  [[nodiscard]] const Counters& injected() const noexcept { return injected_; }

 private:
  [[nodiscard]] controller::SolverFaults DrawRandom();

  SolverFaultParams params_;
  std::vector<core::EventTimer> timers_;  // of the outages
  core::Rng rng_;
  Counters injected_;
};

}  // namespace scoria::app
