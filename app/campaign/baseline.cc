// SPDX-License-Identifier: BSD-3-Clause
#include "app/campaign/baseline.h"

#include <fstream>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/files.h"

namespace scoria::app {

namespace fs = std::filesystem;
using nlohmann::json;

Baseline LoadBaseline(const fs::path& folder) {
  Baseline baseline;
  baseline.folder = folder;
  baseline.results = analysis::LoadResults(folder);
  const json index = json::parse(core::ReadText(folder / "campaign.json"), nullptr, false);
  if (!index.is_object() || !index.contains("file"))
    throw std::runtime_error(fmt::format(
        "{}: is no baseline: its campaign.json names no campaign file; walk it again with this "
        "version of scoria",
        folder.string()));
  baseline.file = index.at("file").get<std::string>();
  baseline.overrides = index.value("overrides", baseline.overrides);
  baseline.cpu = index.value("cpu", "");
  baseline.version = index.value("version", "");
  std::map<std::uint64_t, bool> whole;
  for (const analysis::EpisodeRecord& e : baseline.results.episodes)
    whole.try_emplace(e.seed, true).first->second &= e.has_metrics;
  for (const auto& [seed, is_whole] : whole) {
    if (is_whole) baseline.seeds.push_back(seed);
  }
  if (baseline.seeds.empty())
    throw std::runtime_error(fmt::format("{}: no seed was walked to its end", folder.string()));
  return baseline;
}

std::string CpuName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    return colon == std::string::npos ? "" : line.substr(colon + 2);
  }
  return "";
}

}  // namespace scoria::app
