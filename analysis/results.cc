// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/results.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/terrain_view.h"
namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json ReadJson(const fs::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot read the file", path.string()));
  try {
    return json::parse(in);
  } catch (const json::exception& e) {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), e.what()));
  }
}

void ReadResult(const fs::path& folder, EpisodeRecord& episode) {
  episode.folder = folder;
  const fs::path file = folder / "result.json";
  if (!fs::exists(file)) {
    episode.end = "missing";
    return;
  }
  const json j = ReadJson(file);
  try {
    j.at("end").get_to(episode.end);
    episode.message = j.value("message", "");
    if (!j.contains("metrics")) return;
    j.at("falls").get_to(episode.falls);
    j.at("stuck").get_to(episode.stuck);
    j.at("walked_m").get_to(episode.walked_m);
    j.at("real_time_factor").get_to(episode.real_time_factor);
    j.at("counters").get_to(episode.counters);
    episode.us_per_step = j.value("us_per_step", episode.us_per_step);  // not in older results
    episode.terrain = StatisticsFromJson(j.at("terrain"));
    episode.metrics = j.at("metrics").get<EpisodeMetrics>();
    episode.ground = j.value("ground", std::to_string(episode.seed));  // not in older results
    for (const json& p : j.value("route", json::array()))
      episode.route.emplace_back(p.at(0).get<double>(), p.at(1).get<double>());
    episode.has_metrics = true;
  } catch (const json::exception& e) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), e.what()));
  }
}

}  // namespace

bool Axis::IsNumeric() const {
  return std::all_of(values.begin(), values.end(), [](const std::string& v) {
    double number;
    const auto [stop, error] = std::from_chars(v.data(), v.data() + v.size(), number);
    return error == std::errc{} && stop == v.data() + v.size();
  });
}

CampaignResults LoadResults(const fs::path& folder) {
  CampaignResults results;
  if (!fs::exists(folder / "campaign.json")) {
    if (!fs::exists(folder / "result.json")) {
      throw std::runtime_error(
          fmt::format("{}: holds neither campaign.json nor result.json", folder.string()));
    }
    const json j = ReadJson(folder / "result.json");
    EpisodeRecord episode;
    episode.id = episode.arm = results.name = j.value("scenario", "run");
    episode.seed = j.value("seed", std::uint64_t{0});
    ReadResult(folder, episode);
    results.arms = {episode.arm};
    results.episodes = {episode};
    results.single_run = true;
    return results;
  }
  const json j = ReadJson(folder / "campaign.json");
  j.at("name").get_to(results.name);
  j.at("arms").get_to(results.arms);
  for (const json& axis : j.at("sweep")) {
    results.axes.push_back({axis.at("key"), axis.at("label"),
                            axis.at("values").get<std::vector<std::string>>(),
                            axis.value("baseline", "")});  // not in older results
  }
  for (const json& e : j.at("episodes")) {
    EpisodeRecord episode;
    e.at("id").get_to(episode.id);
    e.at("arm").get_to(episode.arm);
    e.at("point").get_to(episode.point);
    e.at("seed").get_to(episode.seed);
    ReadResult(folder / "episodes" / episode.id, episode);
    results.episodes.push_back(std::move(episode));
  }
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
