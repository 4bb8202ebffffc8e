// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/sections/head.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "analysis/report/metric_table.h"
#include "analysis/report/table.h"
#include "analysis/study/fall_groups.h"

namespace scoria::analysis {
namespace {

/// "a, b over speed (0.3, 0.6): 12 episodes, 600 m walked, 4 falls."
std::string Summary(const ReportInput& input) {
  const CampaignResults& results = input.results;
  std::string sweep;
  for (const Axis& axis : results.axes) {
    sweep += fmt::format("{}{} ({})", sweep.empty() ? " over " : " and ", axis.label,
                         fmt::join(axis.values, ", "));
  }
  const std::string walked =
      results.logs.empty()
          ? fmt::format("{}{}: {} episodes", fmt::join(results.arms, ", "), sweep,
                        results.episodes.size())
          : fmt::format("{}{}: {} {} of robots", fmt::join(results.arms, ", "), sweep,
                        results.logs.size(), results.logs.size() == 1 ? "log" : "logs");
  const auto reason = WhyNotValid(input, "distance_m");
  if (reason) return fmt::format("{}. Way and falls are not valid here: {}.", walked, *reason);
  double metres = 0.0;
  int falls = 0;
  for (const EpisodeRecord& e : results.episodes) {
    metres += e.metrics.distance_m;
    falls += e.metrics.outcome ? e.metrics.outcome->falls : 0;
  }
  return fmt::format("{}, {:.0f} m walked, {} falls.", walked, metres, falls);
}

std::string DistanceText(const Cell& c) { return NumberText(Find(c.values, "distance_m"), 0); }
std::string FallsText(const Cell& c) { return NumberText(Find(c.values, "falls"), 0); }

constexpr std::array<Column<Cell>, 4> kArmColumns = {{
    {"arm", [](const Cell& c) { return c.arm; }},
    {"metres walked", [](const Cell& c) { return DistanceText(c); }},
    {"falls", [](const Cell& c) { return FallsText(c); }},
    {"metres per fall", [](const Cell& c) { return MetresPerFall(c); }},
}};

/// What the budget could see, and where the falls lie.
std::vector<std::string> Facts(const ReportInput& input) {
  std::vector<std::string> facts;
  double detectable = std::numeric_limits<double>::infinity();
  for (const Comparison& c : input.comparisons) {
    if (c.point.empty()) detectable = std::min(detectable, c.detectable);
  }
  if (detectable < std::numeric_limits<double>::infinity()) {
    facts.push_back(fmt::format(
        "Smallest effect that this budget sees: a rate ratio of {:.2f} (power 80 %, level 5 %).",
        detectable));
  }
  const std::vector<FallGroup> groups = GroupFalls(input.results);
  if (!groups.empty()) {
    std::string places =
        DescribeGroups(groups, CountGrounds(input.results, input.results.arms, {}));
    places.front() = 'T';
    facts.push_back(places + ".");
  }
  return facts;
}

}  // namespace

DocumentHead BuildHead(const ReportInput& input) {
  DocumentHead head;
  head.text.push_back(Paragraph{Summary(input)});
  BulletList verdicts;
  for (const Comparison& c : input.comparisons) {
    if (c.point.empty()) verdicts.items.push_back(c.verdict);
  }
  if (!verdicts.items.empty()) {
    head.text.push_back(Heading{"Who falls less"});
    head.text.push_back(verdicts);
    // With a sweep it stands below the verdicts at its points.
    if (input.results.axes.empty()) head.below.push_back(VerdictNote());
  }
  head.text.push_back(TableOf(input.pooled, kArmColumns));
  if (const BulletList facts{Facts(input)}; !facts.items.empty()) head.text.push_back(facts);
  head.picture = input.picture;
  return head;
}

Note VerdictNote() {
  return {
      "Ratios of falls per metre with exact intervals (conditional binomial). Where an arm's share "
      "of the falls differs between six or more terrains by more than chance (p < 0.05), the "
      "interval is widened to the one from resampling terrains. Intervals are not corrected for "
      "looking at many points: about one in twenty misses the truth by chance. Verdicts pool a "
      "sweep whose range was chosen by hand; read them with the single points. Falls within 1 m "
      "of each other on one ground are one place."};
}

}  // namespace scoria::analysis
