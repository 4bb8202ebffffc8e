// SPDX-License-Identifier: BSD-3-Clause
#include "app/compare/compare_page.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "analysis/metrics/metric_text.h"
#include "core/config/field.h"

namespace scoria::app {
namespace {

using analysis::Blocks;
using analysis::SetDifference;
using analysis::TwoSamples;
using nlohmann::json;

std::vector<const SetDifference*> Different(const WalkComparison& c) {
  std::vector<const SetDifference*> found;
  for (const SetDifference& d : c.found.metrics) {
    if (analysis::IsDifferent(d, c.alpha)) found.push_back(&d);
  }
  std::ranges::sort(found, {}, [](const SetDifference* d) { return *d->p_adjusted; });
  return found;
}

std::size_t NumTested(const WalkComparison& c) {
  return static_cast<std::size_t>(std::ranges::count_if(
      c.found.metrics, [](const SetDifference& d) { return d.p_adjusted.has_value(); }));
}

std::string Verdict(const WalkComparison& c) {
  const std::size_t tested = NumTested(c), different = Different(c).size();
  if (tested == 0)
    return "No metric can be tested: it takes at least two walks on one side, and some scatter.";
  if (different == 0)
    return fmt::format(
        "No evidence of a difference in any of {} metrics, at {:.0f} % over all of "
        "them together.",
        tested, 100.0 * c.alpha);
  return fmt::format("{} of {} metrics differ, at {:.0f} % over all of them together.", different,
                     tested, 100.0 * c.alpha);
}

std::string SetText(const char* which, const WalkSet& set) {
  double distance_m = 0.0;
  for (const analysis::EpisodeMetrics& walk : set.walks) distance_m += walk.distance_m;
  return fmt::format("{}: {}, {} walk{}, {:.1f} m", which, set.name, set.walks.size(),
                     set.walks.size() == 1 ? "" : "s", distance_m);
}

std::vector<std::string> RowOf(const SetDifference& d) {
  const TwoSamples& s = d.samples;
  const auto shown = [&](double value) {
    return std::isfinite(value) ? analysis::ShownNumber(d.metric, value) : std::string("-");
  };
  return {analysis::TitleWithUnit(d.metric),
          shown(s.mean_a),
          shown(s.mean_b),
          shown(s.mean_b - s.mean_a),
          fmt::format("{} to {}", shown(s.difference.low), shown(s.difference.high)),
          s.effect ? fmt::format("{:.2f}", *s.effect) : "-",
          d.p_adjusted ? fmt::format("{:.2g}", *d.p_adjusted) : "-"};
}

analysis::Chapter FamilyChapter(const WalkComparison& c, analysis::MetricFamily family) {
  const std::string name(core::EnumName(family));
  analysis::Table table{
      {"metric", "first", "second", "difference", "95 % interval", "effect", "p, adjusted"}, {}};
  analysis::BulletList sentences;
  for (const SetDifference& d : c.found.metrics) {
    if (d.metric.family != family) continue;
    table.rows.push_back(RowOf(d));
    sentences.items.push_back(analysis::DescribeDifference(d, c.alpha));
  }
  if (table.rows.empty()) return {name, name, {}};
  return {name, name, {std::move(table), std::move(sentences)}};
}

json Finite(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

template <class T>
json OrNull(const std::optional<T>& value) {
  return value ? json(*value) : json(nullptr);
}

}  // namespace

WalkComparison CompareWalks(WalkSet a, WalkSet b, double alpha) {
  analysis::SetComparison found = analysis::CompareSets(a.walks, b.walks, analysis::AllMetrics());
  return {std::move(a), std::move(b), std::move(found), alpha};
}

analysis::Document ComparisonDocument(const WalkComparison& c) {
  analysis::Document page;
  page.title = fmt::format("{} beside {}", c.a.name, c.b.name);
  analysis::BulletList different;
  for (const SetDifference* d : Different(c))
    different.items.push_back(analysis::DescribeDifference(*d, c.alpha));
  page.head.text = {analysis::Paragraph{Verdict(c)},
                    analysis::BulletList{{SetText("First", c.a), SetText("Second", c.b)}}};
  if (!different.items.empty()) page.head.text.emplace_back(std::move(different));
  page.head.below = {analysis::Note{
      "A walk is one value, whatever its length. Welch's t-test between the sets; a set of one "
      "walk "
      "is tested as another walk of the other set. Effect: the difference over the deviation of a "
      "walk (Hedges). p is adjusted over all metrics by Holm."}};
  for (const auto& [family, name] : EnumNames(analysis::MetricFamily{})) {
    analysis::Chapter chapter = FamilyChapter(c, family);
    if (!chapter.blocks.empty()) page.chapters.push_back(std::move(chapter));
  }
  for (const analysis::MetricInfo& info : c.found.other_sources)
    page.not_shown.push_back(fmt::format(
        "{}: some walks have the truth, for others something stands in for it", info.title));
  return page;
}

json ComparisonJson(const WalkComparison& c) {
  json metrics = json::array();
  for (const SetDifference& d : c.found.metrics) {
    const TwoSamples& s = d.samples;
    metrics.push_back({{"key", d.metric.key},
                       {"unit", d.metric.unit},
                       {"count", {s.count_a, s.count_b}},
                       {"mean", {s.mean_a, s.mean_b}},
                       {"interval", {Finite(s.difference.low), Finite(s.difference.high)}},
                       {"effect", OrNull(s.effect)},
                       {"p", OrNull(s.p)},
                       {"p_adjusted", OrNull(d.p_adjusted)},
                       {"different", analysis::IsDifferent(d, c.alpha)},
                       {"sentence", analysis::DescribeDifference(d, c.alpha)}});
  }
  return {{"verdict", Verdict(c)},
          {"alpha", c.alpha},
          {"different", !Different(c).empty()},
          {"first", {{"name", c.a.name}, {"walks", c.a.ids}}},
          {"second", {{"name", c.b.name}, {"walks", c.b.ids}}},
          {"metrics", std::move(metrics)}};
}

}  // namespace scoria::app
