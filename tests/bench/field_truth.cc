// SPDX-License-Identifier: BSD-3-Clause
// Analyses the logs of a campaign (log.topics=reference) as those of a robot, and compares with the
// truth that the episodes' results hold; also with every log cut into one for each placement of the
// robot.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/metrics/registry.h"
#include "app/analyze/analyze_log.h"
#include "app/export/export_mcap.h"
#include "core/files.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using analysis::EpisodeMetrics;
using nlohmann::json;

EpisodeMetrics AnalyzeWhole(const fs::path& log) {
  EpisodeMetrics metrics = AnalyzeLog({log}, "log", "", {}).log.metrics;
  metrics.episodes = 1;
  return metrics;
}

/// Every piece is a log of its own, from a placement to the next.
EpisodeMetrics AnalyzePieces(const fs::path& log, const std::vector<double>& cuts_s) {
  const test::TemporaryFolder folder;
  std::optional<EpisodeMetrics> sum;
  double from_s = 0.0;
  for (std::size_t i = 0; i <= cuts_s.size(); ++i) {
    ExportOptions what;
    what.log = log;
    what.out = folder.path() / fmt::format("piece_{}.mcap", i);
    what.from_s = from_s;
    if (i < cuts_s.size()) what.to_s = cuts_s[i];
    constexpr double kStep_s = 1e-4;
    if (i < cuts_s.size()) from_s = cuts_s[i] + kStep_s;
    (void)ExportMcap(what);
    EpisodeMetrics piece;
    try {
      piece = AnalyzeWhole(what.out);
    } catch (const std::exception& e) {
      fmt::print("  piece {}: {}\n", i, e.what());
      continue;
    }
    fs::remove(what.out);
    if (sum) {
      *sum += piece;
    } else {
      sum = piece;
    }
  }
  sum->episodes = 1;  // of one walk
  sum->cot = CalcCostOfTransport(*sum);
  return *sum;
}

struct Difference {
  int falls = 0;
  double metres_pct = 0.0, mech_abs_pct = 0.0, mech_pos_pct = 0.0, electrical_pct = 0.0;
  double stride_ms = 0.0, stance_ms = 0.0;  // the largest of the legs, signed
};

Difference Compare(const EpisodeMetrics& found, const json& truth) {
  const analysis::Metrics all = analysis::AllMetrics();
  const auto values = analysis::ValuesOf(all, found);
  const auto get = [&](const std::string& key) {
    return std::pair(analysis::Find(values, key).value_or(NAN),
                     truth.at(key).is_null() ? NAN : truth.at(key).get<double>());
  };
  const auto percent = [&](const std::string& key) {
    const auto [mine, theirs] = get(key);
    return 100.0 * (mine / theirs - 1.0);
  };
  Difference d;
  d.falls = static_cast<int>(get("falls").first - get("falls").second);
  d.metres_pct = percent("distance_m");
  d.mech_abs_pct = percent("cot_mech_abs");
  d.mech_pos_pct = percent("cot_mech_pos");
  d.electrical_pct = percent("cot_electrical");
  for (const char* leg : {"fl", "fr", "hl", "hr"}) {
    const auto worse = [&](double& worst, const std::string& key) {
      const auto [mine, theirs] = get(key);
      const double ms = 1e3 * (mine - theirs);
      if (!(std::abs(ms) <= std::abs(worst))) worst = ms;
    };
    worse(d.stride_ms, fmt::format("stride_{}_s", leg));
    worse(d.stance_ms, fmt::format("stance_{}_s", leg));
  }
  return d;
}

/// What the differences must not exceed.
bool IsMet(const Difference& d) {
  constexpr double kMetres = 4.0, kCost = 4.0, kPositive = 8.0, kTime_ms = 5.0;
  return d.falls == 0 && std::abs(d.metres_pct) <= kMetres && std::abs(d.mech_abs_pct) <= kCost &&
         std::abs(d.electrical_pct) <= kCost && std::abs(d.mech_pos_pct) <= kPositive &&
         std::abs(d.stride_ms) <= kTime_ms && std::abs(d.stance_ms) <= kTime_ms;
}

std::string Text(const Difference& d) {
  return fmt::format("{:+3d} {:+7.2f} {:+8.2f} {:+8.2f} {:+10.2f} {:+9.1f} {:+9.1f}", d.falls,
                     d.metres_pct, d.mech_abs_pct, d.mech_pos_pct, d.electrical_pct, d.stride_ms,
                     d.stance_ms);
}

int Run(const fs::path& campaign) {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(campaign / "episodes")) {
    if (fs::exists(entry.path() / "log.mcap") && fs::exists(entry.path() / "result.json"))
      folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  fmt::print(
      "{:28} {:>5} {:>5}  log: falls metres% mech_abs% mech_pos% electrical% stride ms stance ms\n",
      "walk", "falls", "m");
  int falls = 0, equal = 0, met = 0;
  for (const fs::path& folder : folders) {
    const json result = json::parse(core::ReadText(folder / "result.json"));
    const json& truth = result.at("metrics").at("scalars");
    std::vector<double> cuts_s;
    constexpr double kLie_s = 0.5;  // fall.lie_s
    for (const json& fall : result.at("metrics").at("falls"))
      cuts_s.push_back(fall.at("time_s").get<double>() + kLie_s);
    const Difference whole = Compare(AnalyzeWhole(folder / "log.mcap"), truth);
    const Difference cut = Compare(AnalyzePieces(folder / "log.mcap", cuts_s), truth);
    falls += result.at("falls").get<int>();
    equal += whole.falls == 0 && cut.falls == 0 ? 1 : 0;
    met += IsMet(whole) && IsMet(cut) ? 1 : 0;
    fmt::print("{:28} {:5} {:5.1f} whole {}\n{:40} cut   {}\n", folder.filename().string(),
               result.at("falls").get<int>(), truth.at("distance_m").get<double>(), Text(whole), "",
               Text(cut));
    std::fflush(stdout);
  }
  fmt::print("{} walks with {} falls: falls equal in {}, everything within bounds in {}\n",
             folders.size(), falls, equal, met);
  return 0;
}

}  // namespace
}  // namespace scoria::app

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: field_truth CAMPAIGN-FOLDER\n", stderr);
    return 2;
  }
  return scoria::app::Run(argv[1]);
}
