// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/results.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/terrain/terrain_view.h"
#include "core/files.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void FillMetrics(const json& j, EpisodeRecord& episode) {
  EpisodeOutcome outcome;
  j.at("falls").get_to(outcome.falls);
  outcome.stuck = j.at("stuck").get<int>();
  outcome.real_time_factor = j.at("real_time_factor").get<double>();
  j.at("walked_m").get_to(episode.walked_m);
  episode.engine = j.value("engine", "");  // not in older results
  j.at("counters").get_to(episode.counters);
  episode.events = j.value("events", episode.events);  // not in older results
  episode.state_hash = j.value("state_hash", episode.state_hash);
  episode.us_per_step = j.value("us_per_step", episode.us_per_step);  // not in older results
  episode.terrain = StatisticsFromJson(j.at("terrain"));
  episode.metrics = j.at("metrics").get<EpisodeMetrics>();
  episode.metrics.outcome = outcome;
  episode.ground = j.value("ground", std::to_string(episode.seed));  // not in older results
  for (const json& p : j.value("route", json::array()))
    episode.route.emplace_back(p.at(0).get<double>(), p.at(1).get<double>());
  episode.has_metrics = true;
}

/// A result that cannot be read is a crashed episode.
void ReadResult(const fs::path& folder, EpisodeRecord& episode) {
  episode.folder = folder;
  const fs::path file = folder / "result.json";
  if (!fs::exists(file)) {
    episode.end = "missing";
    return;
  }
  EpisodeRecord read = episode;
  try {
    const json j = json::parse(core::ReadText(file));
    j.at("end").get_to(read.end);
    read.message = j.value("message", "");
    episode.end = read.end;
    episode.message = read.message;
    if (!j.contains("metrics")) return;
    FillMetrics(j, read);
    episode = std::move(read);
  } catch (const std::exception& e) {
    if (episode.end.empty() || episode.end == "completed") episode.end = "crashed";
    episode.message = fmt::format("{}result.json cannot be read: {}",
                                  episode.message.empty() ? "" : episode.message + "; ", e.what());
  }
}

/// The results of a single run, as a campaign of one.
CampaignResults LoadRun(const fs::path& folder) {
  CampaignResults results;
  EpisodeRecord episode;
  const json j = json::parse(core::ReadText(folder / "result.json"), nullptr, false);
  const auto find = [&](const char* key) { return j.is_object() ? j.find(key) : j.end(); };
  const auto name = find("scenario"), seed = find("seed"), end = j.end();
  if (seed != end && seed->is_number_unsigned()) episode.seed = seed->get<std::uint64_t>();
  ReadResult(folder, episode);
  results.name = name != end && name->is_string() ? name->get<std::string>()
                                                  : fs::absolute(folder).filename().string();
  episode.id = episode.arm = results.name;
  results.arms = {episode.arm};
  results.episodes = {episode};
  results.single_run = true;
  return results;
}

/// The index of a campaign, without what its episodes left.
CampaignResults ReadIndex(const fs::path& file) {
  CampaignResults results;
  try {
    const json j = json::parse(core::ReadText(file));
    j.at("name").get_to(results.name);
    j.at("arms").get_to(results.arms);
    for (const json& axis : j.at("sweep")) {
      results.axes.push_back({axis.at("key"), axis.at("label"),
                              axis.at("values").get<std::vector<std::string>>(),
                              axis.value("baseline", "")});  // not in older results
    }
    if (j.contains("design")) results.design = DesignFromJson(j.at("design"));
    if (j.contains("stop")) results.stop = StopFromJson(j.at("stop"));
    for (const json& e : j.at("episodes")) {
      EpisodeRecord& episode = results.episodes.emplace_back();
      e.at("id").get_to(episode.id);
      e.at("arm").get_to(episode.arm);
      e.at("point").get_to(episode.point);
      e.at("seed").get_to(episode.seed);
    }
  } catch (const json::exception& e) {
    throw std::runtime_error(
        fmt::format("{}: cannot be read; the same campaign command writes it anew ({})",
                    file.string(), e.what()));
  }
  return results;
}

}  // namespace

bool Axis::IsNumeric() const {
  return std::all_of(values.begin(), values.end(), [](const std::string& v) {
    double number;
    const auto [stop, error] = std::from_chars(v.data(), v.data() + v.size(), number);
    return error == std::errc{} && stop == v.data() + v.size();
  });
}

EpisodeRecord LoadEpisode(const fs::path& folder, EpisodeRecord index) {
  ReadResult(folder, index);
  return index;
}

CampaignResults LoadResults(const fs::path& folder) {
  if (!fs::exists(folder / "campaign.json")) {
    if (fs::exists(folder / "result.json")) return LoadRun(folder);
    throw std::runtime_error(
        fmt::format("{}: holds neither campaign.json nor result.json", folder.string()));
  }
  CampaignResults results = ReadIndex(folder / "campaign.json");
  for (EpisodeRecord& episode : results.episodes)
    ReadResult(folder / "episodes" / episode.id, episode);
  return results;
}

std::vector<std::vector<std::string>> AllPoints(const std::vector<Axis>& axes) {
  std::vector<std::vector<std::string>> points = {{}};
  for (const Axis& axis : axes) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& point : points) {
      for (const std::string& value : axis.values) {
        longer.push_back(point);
        longer.back().push_back(value);
      }
    }
    points = std::move(longer);
  }
  return points;
}

}  // namespace scoria::analysis
