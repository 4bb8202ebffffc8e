// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/lifetimes.h"

#include <map>
#include <optional>
#include <utility>

#include "analysis/study/compare.h"

namespace scoria::analysis {
namespace {

std::optional<Lifetime> LifetimeOf(const EpisodeRecord& e) {
  if (!e.has_metrics || !e.metrics.outcome) return std::nullopt;
  if (e.metrics.outcome->falls == 0) return Lifetime{e.metrics.distance_m, false};
  if (!e.metrics.first_fall_m) return std::nullopt;
  return Lifetime{*e.metrics.first_fall_m, true};
}

}  // namespace

std::vector<Lifetime> LifetimesOf(const CampaignResults& results, const std::string& arm,
                                  const std::vector<std::string>& point) {
  std::vector<Lifetime> lifetimes;
  for (const EpisodeRecord& e : results.episodes) {
    if (!Belongs(e, arm, point)) continue;
    if (const auto lifetime = LifetimeOf(e)) lifetimes.push_back(*lifetime);
  }
  return lifetimes;
}

LogRank CompareLifetimes(const CampaignResults& results, const std::string& a, const std::string& b,
                         const std::vector<std::string>& point) {
  std::map<std::pair<std::uint64_t, std::vector<std::string>>, SurvivalStratum> by_terrain;
  for (const EpisodeRecord& e : results.episodes) {
    const auto lifetime = LifetimeOf(e);
    if (!lifetime) continue;
    if (Belongs(e, a, point)) by_terrain[{e.seed, e.point}].a.push_back(*lifetime);
    if (Belongs(e, b, point)) by_terrain[{e.seed, e.point}].b.push_back(*lifetime);
  }
  std::vector<SurvivalStratum> strata;
  for (auto& [terrain, stratum] : by_terrain) strata.push_back(std::move(stratum));
  return TestLogRank(strata);
}

}  // namespace scoria::analysis
