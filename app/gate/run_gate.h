// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/study/regression_evidence.h"
#include "app/campaign/baseline.h"

namespace scoria::app {

/// How a gate ended. Equal: the same bits. Worse: evidence at the level. Broken: an episode
/// crashed or was no walk that was one in the baseline. No evidence: the budget is spent.
enum class GateVerdict { kEqual, kWorse, kBroken, kNoEvidence, kInterrupted };
constexpr std::array<std::pair<GateVerdict, std::string_view>, 5> EnumNames(GateVerdict) {
  return {{{GateVerdict::kEqual, "equal"},
           {GateVerdict::kWorse, "worse"},
           {GateVerdict::kBroken, "broken"},
           {GateVerdict::kNoEvidence, "no_evidence"},
           {GateVerdict::kInterrupted, "interrupted"}}};
}

struct GateOptions {
  std::filesystem::path folder;        // for the episodes, a campaign's
  std::filesystem::path file;          // campaign YAML; empty: that of the baseline
  std::vector<std::string> overrides;  // of campaign keys, after those of the baseline
  /// Campaign that this build has walked already, elsewhere or before; empty: the gate walks.
  std::filesystem::path walked;
  /// Campaign of the baseline's build once more, by other bits of no consequence; empty: none.
  std::filesystem::path twin;
  double alpha = 0.01;
  int seeds = 0;    // budget; 0: those of the baseline
  int workers = 2;  // processes at a time
  std::string program;
  std::string baseline_program;  // walks further seeds of the baseline; empty: there are none
  const std::atomic<bool>* interrupted = nullptr;
  std::function<void(const std::string& line)> on_line;  // what is told on the way
};

struct GateResult {
  GateVerdict verdict = GateVerdict::kNoEvidence;
  int seeds = 0, episodes = 0;  // walked
  double p_value = 1.0;         // valid whenever one looks
  std::vector<analysis::RegressionEvidence::Line> lines;
  std::string sentence;      // the verdict in words
  std::string disk_problem;  // why it ended early, in words
};

/// Compares this build with a baseline: seed by seed in their order, until the bits are found
/// equal, there is evidence that something became worse, or the budget is spent. Errors:
/// core::ConfigError; std::runtime_error if the campaigns differ in arms or sweep, or the
/// baseline's program fails; core::FolderInUse, core::FileError.
[[nodiscard]] GateResult RunGate(const Baseline& baseline, const GateOptions& options);

}  // namespace scoria::app
