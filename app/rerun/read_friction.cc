// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/read_friction.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/run/run_scenario.h"
#include "logs/format/temporary_folder.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

constexpr double kFrictions[] = {0.2, 0.35, 0.6, 1.0};
constexpr int kSeeds = 3;

std::optional<double> WalkOnce(const fs::path& draft, double friction, int seed) {
  constexpr double kLongest_s = 30.0;
  const logs::TemporaryFolder folder;
  Scenario scenario =
      LoadScenario(draft, {fmt::format("terrain.substrate.friction={}", friction),
                           fmt::format("seed={}", seed), "log={topics: reference}", "max_falls=1"});
  scenario.duration_s = std::min(scenario.duration_s, kLongest_s);
  RunOptions run;
  run.folder = folder.path();
  if (!RunToFolder(scenario, run).failure.empty()) return std::nullopt;
  return SlipOf(folder.path() / "log.mcap", {});
}

}  // namespace

std::optional<double> SlipOf(const fs::path& log, const AnalyzeOptions& options) {
  constexpr double kShare = 0.95, kLeastStances = 40.0;
  const analysis::SignalDistributions signals = AnalyzeLog({log}, "log", {}, options).signals;
  const auto slip = signals.find(analysis::Signal::kSlip);
  if (slip == signals.end() || slip->second.count() < kLeastStances) return std::nullopt;
  const double slip_m = slip->second.Quantile(kShare);
  return slip_m > 0.0 ? std::optional(slip_m) : std::nullopt;
}

std::vector<SlipOnFriction> WalkFrictions(const fs::path& draft) {
  std::vector<SlipOnFriction> walked;
  for (const double friction : kFrictions) {
    double sum = 0.0;
    int walks = 0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const std::optional<double> slip_m = WalkOnce(draft, friction, seed);
      if (!slip_m) continue;
      sum += std::log(*slip_m);
      ++walks;
    }
    if (walks > 0) walked.push_back({friction, std::exp(sum / walks)});
  }
  return walked;
}

std::optional<double> ReadFriction(const std::vector<SlipOnFriction>& walked, double slip_m) {
  if (walked.size() < 2) return std::nullopt;
  // The line through the two about it, or the first or last two.
  const auto slips_less =
      std::ranges::find_if(walked, [&](const SlipOnFriction& w) { return w.slip_m <= slip_m; });
  const auto high = std::clamp(slips_less, walked.begin() + 1, walked.end() - 1);
  const SlipOnFriction &less = *(high - 1), &more = *high;
  constexpr double kAlike = 1.1;  // about what walks scatter by
  if (less.slip_m < kAlike * more.slip_m) return std::nullopt;
  const double along = std::log(slip_m / less.slip_m) / std::log(more.slip_m / less.slip_m);
  constexpr double kLeast = 0.1, kMost = 1.2;
  return std::clamp(less.friction * std::pow(more.friction / less.friction, along), kLeast, kMost);
}

}  // namespace scoria::app
