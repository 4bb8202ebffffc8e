// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"

namespace scoria::analysis {
namespace {

std::optional<std::string> WhyNoFailures(const ReportInput& /*input*/) { return std::nullopt; }

/// Nothing where nobody counted.
std::optional<long> CountStuck(const CampaignResults& results) {
  std::optional<long> stuck;
  for (const EpisodeRecord& e : results.episodes) {
    const auto& outcome = e.metrics.outcome;
    if (outcome && outcome->stuck) stuck = stuck.value_or(0) + *outcome->stuck;
  }
  return stuck;
}

/// Broken episodes first, then falls by cause, then what was met without falling.
Blocks BuildFailures(const ReportInput& input) {
  const std::vector<std::string>& arms = input.results.arms;
  Blocks blocks;
  Table broken{{"episode", "ended", "message"}, {}};
  ArmCounts causes, counters;
  for (const EpisodeRecord& e : input.results.episodes) {
    if (e.end != "completed" || !e.message.empty()) broken.rows.push_back({e.id, e.end, e.message});
    for (const FallEvent& f : e.metrics.falls)
      ++causes[f.cause.substr(0, f.cause.find(' '))][e.arm];
    for (const auto& [what, times] : e.counters) {
      if (times > 0) counters[what][e.arm] += times;
    }
  }
  if (broken.rows.empty()) {
    blocks.push_back(Paragraph{"Every episode walked its whole distance."});
  } else {
    blocks.push_back(broken);
  }
  if (!causes.empty()) blocks.push_back(CountTable("cause of fall", causes, arms));
  const std::optional<long> stuck = CountStuck(input.results);
  std::string text = stuck ? fmt::format("Stuck {} times.", *stuck) : "";
  if (counters.empty()) {
    if (stuck) blocks.push_back(Paragraph{text});
  } else {
    text += stuck ? " " : "";
    blocks.push_back(Paragraph{text + "What the controller met and how it fell back:"});
    blocks.push_back(CountTable("contacts, solver failures and fallbacks", counters, arms));
  }
  return blocks;
}

}  // namespace

Section FailuresSection() { return {"failures", "Failures", WhyNoFailures, BuildFailures}; }

}  // namespace scoria::analysis
