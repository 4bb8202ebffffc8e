// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/metrics/metrics.h"
#include "app/episode/route.h"
#include "core/robot/counters.h"
#include "core/stage_times.h"

namespace scoria::app {

enum class EpisodeEnd { kCompleted, kFallLimit, kTimedOut, kNonFinite, kCrashed, kInterrupted };
constexpr std::array<std::pair<EpisodeEnd, std::string_view>, 6> EnumNames(EpisodeEnd) {
  return {{{EpisodeEnd::kCompleted, "completed"},
           {EpisodeEnd::kFallLimit, "fall_limit"},
           {EpisodeEnd::kTimedOut, "timed_out"},
           {EpisodeEnd::kNonFinite, "non_finite"},
           {EpisodeEnd::kCrashed, "crashed"},
           {EpisodeEnd::kInterrupted, "interrupted"}}};
}

struct EpisodeResult {
  EpisodeEnd end = EpisodeEnd::kCompleted;
  double duration_s = 0.0;  // simulated
  double walked_m = 0.0;    // as the operator paces it: half-second chords, placements excluded
  int falls = 0, stuck = 0;
  std::vector<analysis::FallEvent> fall_events;  // as many as falls
  Route route;                                   // the operator's; empty without one
  std::uint64_t state_hash = 0;                  // over every state that was hashed on the way
  Counters counters, injected;                   // what did not go to plan; which of it was played
  std::int64_t unconverged_steps = 0;            // of the physics' contact solver
  core::StageTimes times;                        // wall clock, without set-up
};

}  // namespace scoria::app
