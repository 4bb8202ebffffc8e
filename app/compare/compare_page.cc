// SPDX-License-Identifier: BSD-3-Clause
#include "app/compare/compare_page.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "analysis/metrics/metric_text.h"
#include "analysis/plots/distribution_plot.h"
#include "core/config/field.h"

namespace scoria::app {
namespace {

using analysis::Blocks;
using analysis::SetDifference;
using analysis::SignalDifference;
using analysis::TwoSamples;
using nlohmann::json;

/// What differs, the clearest first, in a sentence each.
std::vector<std::string> Different(const WalkComparison& c) {
  std::vector<std::pair<double, std::string>> found;
  const auto add = [&](const auto& differences) {
    for (const auto& d : differences) {
      if (analysis::IsDifferent(d.p_adjusted, c.alpha))
        found.emplace_back(*d.p_adjusted, analysis::DescribeDifference(d, c.alpha));
    }
  };
  add(c.found.metrics);
  add(c.found.signals);
  std::ranges::stable_sort(found, {}, &std::pair<double, std::string>::first);
  std::vector<std::string> sentences;
  for (auto& [p, sentence] : found) sentences.push_back(std::move(sentence));
  return sentences;
}

std::size_t NumTested(const auto& differences) {
  return static_cast<std::size_t>(
      std::ranges::count_if(differences, [](const auto& d) { return d.p_adjusted.has_value(); }));
}

std::string Verdict(const WalkComparison& c) {
  const std::size_t metrics = NumTested(c.found.metrics), signals = NumTested(c.found.signals);
  if (metrics + signals == 0)
    return "Nothing can be tested: it takes at least two walks on one side, and some scatter.";
  const std::string looked_at = fmt::format("{} metrics and {} distributions", metrics, signals);
  const std::size_t different = Different(c).size();
  if (different == 0)
    return fmt::format(
        "No evidence of a difference in any of {}, at {:.0f} % over all of them "
        "together.",
        looked_at, 100.0 * c.alpha);
  return fmt::format("{} of {} differ, at {:.0f} % over all of them together.", different,
                     looked_at, 100.0 * c.alpha);
}

std::string SetText(const char* which, const WalkSet& set) {
  double distance_m = 0.0;
  for (const analysis::ComparedWalk& walk : set.walks) distance_m += walk.metrics.distance_m;
  return fmt::format("{}: {}, {} walk{}, {:.1f} m", which, set.name, set.walks.size(),
                     set.walks.size() == 1 ? "" : "s", distance_m);
}

/// The columns of a comparison of two samples.
std::vector<std::string> Columns() {
  return {"first", "second", "difference", "95 % interval", "effect"};
}

std::vector<std::string> CellsOf(const analysis::MetricInfo& info, const TwoSamples& s) {
  const auto shown = [&](double value) {
    return std::isfinite(value) ? analysis::ShownNumber(info, value) : std::string("-");
  };
  return {shown(s.mean_a), shown(s.mean_b), shown(s.mean_b - s.mean_a),
          fmt::format("{} to {}", shown(s.difference.low), shown(s.difference.high)),
          s.effect ? fmt::format("{:.2f}", *s.effect) : "-"};
}

std::vector<std::string> RowOf(std::string first, std::vector<std::string> cells,
                               std::string last) {
  cells.insert(cells.begin(), std::move(first));
  cells.push_back(std::move(last));
  return cells;
}

std::string ShownP(const std::optional<double>& p) { return p ? fmt::format("{:.2g}", *p) : "-"; }

analysis::Chapter FamilyChapter(const WalkComparison& c, analysis::MetricFamily family) {
  const std::string name(core::EnumName(family));
  analysis::Table table{RowOf("metric", Columns(), "p, adjusted"), {}};
  analysis::BulletList sentences;
  for (const SetDifference& d : c.found.metrics) {
    if (d.metric.family != family) continue;
    table.rows.push_back(RowOf(analysis::TitleWithUnit(d.metric), CellsOf(d.metric, d.samples),
                               ShownP(d.p_adjusted)));
    sentences.items.push_back(analysis::DescribeDifference(d, c.alpha));
  }
  if (table.rows.empty()) return {name, name, {}};
  return {name, name, {std::move(table), std::move(sentences)}};
}

/// Values at shares from 0 to 1, as they are shown, of each walk that has the signal.
analysis::DistributionSeries CurvesOf(std::string label, const WalkSet& set,
                                      analysis::Signal signal) {
  constexpr int kSteps = 200;
  analysis::DistributionSeries series{std::move(label), {}};
  const double scale = analysis::InfoOf(signal).scale;
  for (const analysis::ComparedWalk& walk : set.walks) {
    const auto found = walk.signals.find(signal);
    if (found == walk.signals.end()) continue;
    analysis::QuantileCurve curve;
    for (int i = 0; i <= kSteps; ++i)
      curve.push_back(scale * found->second.Quantile(static_cast<double>(i) / kSteps));
    series.walks.push_back(std::move(curve));
  }
  return series;
}

analysis::CaptionedFigure FigureOf(const WalkComparison& c, const SignalDifference& d) {
  const analysis::DistributionPlot plot{
      fmt::format("distribution_{}", d.info.key),
      fmt::format("Distribution of {}", d.info.title),
      analysis::TitleWithUnit(d.info),
      {CurvesOf("first", c.a, d.signal), CurvesOf("second", c.b, d.signal)}};
  return {analysis::DrawDistributions(plot),
          fmt::format("{} A thin line is a walk, a thick one the mean of a set's quantiles.",
                      d.info.definition)};
}

Blocks SignalBlocks(const WalkComparison& c, const SignalDifference& d) {
  analysis::Table table{RowOf("quantile", Columns(), "p"), {}};
  for (const analysis::QuantileDifference& q : d.quantiles)
    table.rows.push_back(RowOf(fmt::format("{:.0f} %", 100.0 * q.share), CellsOf(d.info, q.samples),
                               ShownP(q.samples.p)));
  return {analysis::Heading{analysis::TitleWithUnit(d.info)},
          analysis::Paragraph{analysis::DescribeDifference(d, c.alpha)}, FigureOf(c, d),
          std::move(table)};
}

analysis::Chapter SignalChapter(const WalkComparison& c) {
  Blocks blocks;
  for (const SignalDifference& d : c.found.signals) {
    Blocks of_signal = SignalBlocks(c, d);
    std::ranges::move(of_signal, std::back_inserter(blocks));
  }
  return {"distributions", "Distributions", std::move(blocks)};
}

json Finite(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json OrNull(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

json JsonOf(const analysis::MetricInfo& info) { return {{"key", info.key}, {"unit", info.unit}}; }

json JsonOf(const TwoSamples& s) {
  return {{"count", {s.count_a, s.count_b}},
          {"mean", {s.mean_a, s.mean_b}},
          {"interval", {Finite(s.difference.low), Finite(s.difference.high)}},
          {"effect", OrNull(s.effect)},
          {"p", OrNull(s.p)}};
}

/// What the family of all tests says of a metric or a signal.
json Conclusion(const auto& difference, double alpha) {
  return {{"p_adjusted", OrNull(difference.p_adjusted)},
          {"different", analysis::IsDifferent(difference.p_adjusted, alpha)},
          {"sentence", analysis::DescribeDifference(difference, alpha)}};
}

json Joined(json first, const json& second, const json& third) {
  first.update(second);
  if (!third.is_null()) first.update(third);
  return first;
}

/// The values that were compared, walk by walk: another test can be made of them.
json JsonOf(const WalkSet& set) {
  const analysis::Metrics metrics = analysis::AllMetrics();
  json walks = json::array();
  for (std::size_t i = 0; i < set.walks.size(); ++i) {
    const analysis::ComparedWalk& walk = set.walks[i];
    json quantiles = json::object();
    for (const auto& [signal, distribution] : walk.signals) {
      for (const double share : analysis::kComparedShares)
        quantiles[std::string(core::EnumName(signal))].push_back(distribution.Quantile(share));
    }
    walks.push_back(
        {{"id", set.ids[i]},
         {"metrics", analysis::ToJson(metrics, analysis::ValuesOf(metrics, walk.metrics))},
         {"quantiles", std::move(quantiles)}});
  }
  return {{"name", set.name}, {"walks", std::move(walks)}};
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
  different.items = Different(c);
  page.head.text = {analysis::Paragraph{Verdict(c)},
                    analysis::BulletList{{SetText("First", c.a), SetText("Second", c.b)}}};
  if (!different.items.empty()) page.head.text.emplace_back(std::move(different));
  page.head.below = {analysis::Note{
      "A walk is one value, whatever its length; of a distribution, one value of each quantile. "
      "Welch's t-test between the sets; a set of one walk is tested as another walk of the other "
      "set. Effect: the difference over the deviation of a walk (Hedges). Errors, costs and "
      "signals "
      "are compared by their logarithms, unless one is zero: their means are geometric. p is "
      "adjusted over all metrics and distributions by Holm; of a distribution the least p of its "
      "quantiles counts, times their number."}};
  for (const auto& [family, name] : EnumNames(analysis::MetricFamily{})) {
    analysis::Chapter chapter = FamilyChapter(c, family);
    if (!chapter.blocks.empty()) page.chapters.push_back(std::move(chapter));
  }
  analysis::Chapter signals = SignalChapter(c);
  if (!signals.blocks.empty()) page.chapters.push_back(std::move(signals));
  for (const analysis::MetricInfo& info : c.found.other_sources)
    page.not_shown.push_back(fmt::format(
        "{}: some walks have the truth, for others something stands in for it", info.title));
  return page;
}

json ComparisonJson(const WalkComparison& c) {
  json metrics = json::array(), signals = json::array();
  for (const SetDifference& d : c.found.metrics)
    metrics.push_back(Joined(JsonOf(d.metric), JsonOf(d.samples), Conclusion(d, c.alpha)));
  for (const SignalDifference& d : c.found.signals) {
    json quantiles = json::array();
    for (const analysis::QuantileDifference& q : d.quantiles)
      quantiles.push_back(Joined({{"share", q.share}}, JsonOf(q.samples), {}));
    signals.push_back(
        Joined(JsonOf(d.info), {{"quantiles", std::move(quantiles)}}, Conclusion(d, c.alpha)));
  }
  return {{"verdict", Verdict(c)},
          {"alpha", c.alpha},
          {"different", !Different(c).empty()},
          {"shares", analysis::kComparedShares},
          {"first", JsonOf(c.a)},
          {"second", JsonOf(c.b)},
          {"metrics", std::move(metrics)},
          {"distributions", std::move(signals)}};
}

}  // namespace scoria::app
