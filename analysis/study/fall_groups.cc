// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/fall_groups.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace scoria::analysis {
namespace {

constexpr double kSamePlace_m = 1.0;

bool Touches(const FallGroup& group, const std::string& ground, const Vec2& p_WB) {
  return group.ground == ground &&
         std::any_of(group.p_WB.begin(), group.p_WB.end(),
                     [&](const Vec2& other) { return (other - p_WB).norm() <= kSamePlace_m; });
}

/// Adds a fall and merges the groups that it joins.
void AddFall(std::vector<FallGroup>& groups, const std::string& ground, const Vec2& p_WB,
             const std::string& arm) {
  FallGroup joined{ground, {p_WB}, {arm}};
  std::erase_if(groups, [&](const FallGroup& group) {
    if (!Touches(group, ground, p_WB)) return false;
    joined.p_WB.insert(joined.p_WB.end(), group.p_WB.begin(), group.p_WB.end());
    joined.arm.insert(joined.arm.end(), group.arm.begin(), group.arm.end());
    return true;
  });
  groups.push_back(std::move(joined));
}

std::string Count(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

}  // namespace

std::vector<FallGroup> GroupFalls(const CampaignResults& results,
                                  const std::vector<std::string>& arms,
                                  const std::vector<std::string>& point) {
  std::vector<FallGroup> groups;
  for (const EpisodeRecord& e : results.episodes) {
    const bool wanted = arms.empty() || std::find(arms.begin(), arms.end(), e.arm) != arms.end();
    if (!wanted || (!point.empty() && e.point != point)) continue;
    for (const FallEvent& fall : e.metrics.falls) {
      if (fall.p_WB) AddFall(groups, e.ground, *fall.p_WB, e.arm);
    }
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const FallGroup& a, const FallGroup& b) { return a.size() > b.size(); });
  return groups;
}

std::string DescribeGroups(const std::vector<FallGroup>& groups, std::size_t grounds_walked) {
  if (groups.empty()) return "";
  std::size_t falls = 0;
  std::set<std::string> grounds;
  for (const FallGroup& g : groups) {
    falls += g.size();
    grounds.insert(g.ground);
  }
  std::string text = fmt::format("the {} at {}, on {} of {}",
                                 falls == 1 ? "fall lies" : fmt::format("{} falls lie", falls),
                                 Count(groups.size(), "place", "places"), grounds.size(),
                                 Count(grounds_walked, "ground", "grounds"));
  // The fewest places that hold more than half of the falls.
  std::size_t places = 0, held = 0;
  while (2 * held <= falls) held += groups[places++].size();
  constexpr std::size_t kFew = 3, kFallsEach = 3;
  const bool few = places < groups.size() && places <= kFew && held >= kFallsEach * places;
  if (few)
    text +=
        fmt::format("; {} of them", places == 1 ? fmt::format("one place makes {}", held)
                                                : fmt::format("{} places make {}", places, held));
  return text;
}

}  // namespace scoria::analysis
