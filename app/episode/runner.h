// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>

#include "analysis/metrics/metrics.h"
#include "app/episode/record.h"
#include "app/scenario/scenario.h"
#include "logs/row.h"

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

/// Where an episode's facts go while it runs; all optional and borrowed.
struct EpisodeSinks {
  std::function<void(const logs::LogRow&, const logs::SolveTimes&)> on_row;
  std::function<void(double time_s, const std::string& kind, const std::string& detail)> on_event;
  std::function<void(const controller::Controller&, const controller::ControlOutput&)> on_control;
  MessageSink* messages = nullptr;
  std::function<void(double time_s)> on_progress;  // a few times per simulated second
  const std::atomic<bool>* interrupted = nullptr;
};

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

/// Walks one episode: sensors -> controller -> actuation -> world, every physics step. The same
/// scenario gives the same bits, whatever is recorded.
[[nodiscard]] EpisodeResult RunEpisode(const Scenario& scenario,
                                       const core::RobotDescription& robot,
                                       const terrains::Heightfield& ground,
                                       const EpisodeSinks& sinks);

}  // namespace scoria::app
