// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/sections/head.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "analysis/report/metric_table.h"
#include "analysis/report/table.h"
#include "analysis/study/fall_groups.h"
#include "analysis/study/verdicts.h"

namespace scoria::analysis {
namespace {

/// " over 125 points of speed (0.3 to 0.6) and slope (0 to 0.2)".
std::string DesignText(const Design& design) {
  std::string text = fmt::format(" over {} points of ", design.points.size());
  for (std::size_t k = 0; k < design.factors.size(); ++k) {
    const Factor& f = design.factors[k];
    text += fmt::format("{}{} ({} to {})", k > 0 ? " and " : "", f.label, f.from, f.to);
  }
  return text;
}

/// " in scoria", " in bullet and scoria"; empty where no episode says.
std::string EnginesText(const CampaignResults& results) {
  std::set<std::string> engines;
  for (const EpisodeRecord& e : results.episodes) {
    if (!e.engine.empty()) engines.insert(e.engine);
  }
  return engines.empty() ? "" : fmt::format(" in {}", fmt::join(engines, " and "));
}

/// "a, b over speed (0.3, 0.6): 12 episodes in scoria, 600 m walked, 4 falls."
std::string Summary(const ReportInput& input) {
  const CampaignResults& results = input.results;
  std::string sweep;
  for (const Axis& axis : results.axes) {
    sweep += fmt::format("{}{} ({})", sweep.empty() ? " over " : " and ", axis.label,
                         fmt::join(axis.values, ", "));
  }
  if (results.design) sweep = DesignText(*results.design);
  const std::string walked =
      results.logs.empty()
          ? fmt::format("{}{}: {} episodes{}", fmt::join(results.arms, ", "), sweep,
                        results.episodes.size(), EnginesText(results))
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

/// Over the whole sweep.
std::vector<Comparison> Pooled(const ReportInput& input) {
  std::vector<Comparison> pooled = input.comparisons;
  std::erase_if(pooled, [](const Comparison& c) { return !c.point.empty(); });
  return pooled;
}

/// Those that show something each, the others in one sentence.
BulletList Verdicts(const ReportInput& input) {
  BulletList verdicts;
  const std::vector<Comparison> pooled = Pooled(input);
  for (const Comparison& c : pooled) {
    if (ShowsDifference(c)) verdicts.items.push_back(c.verdict);
  }
  const std::string none = NoEvidenceVerdict(pooled, "Whole sweep");
  if (!none.empty()) verdicts.items.push_back(none);
  return verdicts;
}

/// What the budget could see, metrics, and where the falls lie.
std::vector<std::string> Facts(const ReportInput& input) {
  std::vector<std::string> facts;
  if (const auto& stop = input.results.stop)
    facts.push_back(DescribeStop(*stop) +
                    (stop->last_seed ? " Other p-values and intervals are those of an end that was "
                                       "planned, and do not hold for one that the data chose."
                                     : ""));
  double detectable = std::numeric_limits<double>::infinity();
  for (const Comparison& c : Pooled(input)) detectable = std::min(detectable, c.detectable);
  if (detectable < std::numeric_limits<double>::infinity()) {
    facts.push_back(fmt::format(
        "Smallest effect that this budget sees: a rate ratio of {:.2f} (power {:.0f} %, level {:g} "
        "%).",
        detectable, 100.0 * input.goal.power, 100.0 * input.goal.alpha));
  }
  for (const ArmDifferences& d : input.differences) {
    const std::string verdict = d.point.empty() ? MetricVerdict(d) : "";
    if (!verdict.empty()) facts.push_back(verdict);
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
  const BulletList verdicts = Verdicts(input);
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
      "of the falls differs between six or more terrains by more than chance (p < 0.2), the "
      "interval is widened to the one from resampling terrains. Intervals are not corrected for "
      "looking at many points: about one in twenty misses the truth by chance. Verdicts pool a "
      "sweep whose range was chosen by hand; read them with the single points. Falls within 1 m "
      "of each other on one ground are one place."};
}

}  // namespace scoria::analysis
