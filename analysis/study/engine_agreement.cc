// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/engine_agreement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "analysis/metrics/metric_text.h"

namespace scoria::analysis {
namespace {

/// What remains of a campaign without its axis `k`.
CampaignResults WithoutAxis(const CampaignResults& results, std::size_t k) {
  CampaignResults rest;
  rest.name = results.name;
  rest.arms = results.arms;
  rest.axes = results.axes;
  rest.axes.erase(rest.axes.begin() + static_cast<std::ptrdiff_t>(k));
  return rest;
}

EpisodeRecord WithoutAxis(EpisodeRecord e, std::size_t k) {
  e.point.erase(e.point.begin() + static_cast<std::ptrdiff_t>(k));
  return e;
}

/// The campaign as it was walked in one engine.
CampaignResults InEngine(const CampaignResults& results, std::size_t k, const std::string& engine) {
  CampaignResults part = WithoutAxis(results, k);
  for (const EpisodeRecord& e : results.episodes) {
    if (e.point[k] == engine) part.episodes.push_back(WithoutAxis(e, k));
  }
  return part;
}

/// One arm's walks, with the engines as arms.
CampaignResults EnginesAsArms(const CampaignResults& results, std::size_t k,
                              const std::string& arm) {
  CampaignResults part = WithoutAxis(results, k);
  part.arms = results.axes[k].values;
  for (const EpisodeRecord& e : results.episodes) {
    if (e.arm != arm) continue;
    part.episodes.push_back(WithoutAxis(e, k));
    part.episodes.back().arm = e.point[k];
  }
  return part;
}

/// By seed, where both arms walked in both engines at the same point.
std::vector<CountsInTwoSettings> CountsOf(const CampaignResults& engine,
                                          const CampaignResults& reference,
                                          const VerdictInEngines& v) {
  std::map<std::uint64_t, CountsInTwoSettings> by_seed;
  const auto add = [&](const CampaignResults& from, PairedCounts CountsInTwoSettings::*setting) {
    for (const EpisodeRecord& e : from.episodes) {
      if (!e.has_metrics || !e.metrics.outcome) continue;
      PairedCounts& counts = by_seed[e.seed].*setting;
      if (Belongs(e, v.in_engine.a, v.point)) {
        counts.events_a += e.metrics.outcome->falls;
        counts.exposure_a += e.metrics.distance_m;
      } else if (Belongs(e, v.in_engine.b, v.point)) {
        counts.events_b += e.metrics.outcome->falls;
        counts.exposure_b += e.metrics.distance_m;
      }
    }
  };
  add(engine, &CountsInTwoSettings::first);
  add(reference, &CountsInTwoSettings::second);
  std::vector<CountsInTwoSettings> terrains;
  for (const auto& [seed, c] : by_seed) {
    if (std::min({c.first.exposure_a, c.first.exposure_b, c.second.exposure_a,
                  c.second.exposure_b}) > 0.0)
      terrains.push_back(c);
  }
  return terrains;
}

/// Every arm in one engine against the other.
std::vector<ArmInEngines> CompareArms(const CampaignResults& results, std::size_t k,
                                      const Metrics& metrics, const EngineAgreement& engines) {
  std::vector<ArmInEngines> arms;
  for (const std::string& arm : results.arms) {
    const CampaignResults both = EnginesAsArms(results, k, arm);
    const MetricComparer comparer(both, metrics);
    for (const auto& point : SweepAndPoints(both.axes)) {
      arms.push_back({arm, point, Compare(both, engines.engine, engines.reference, point),
                      comparer.Compare(engines.engine, engines.reference, point)});
    }
  }
  return arms;
}

/// The first arm against every other, in each engine.
std::vector<VerdictInEngines> CompareVerdicts(const CampaignResults& engine,
                                              const CampaignResults& reference) {
  std::vector<VerdictInEngines> verdicts;
  for (std::size_t arm = 1; arm < engine.arms.size(); ++arm) {
    for (const auto& point : SweepAndPoints(engine.axes)) {
      const auto compare = [&](const CampaignResults& part) {
        return Compare(part, part.arms[0], part.arms[arm], point);
      };
      VerdictInEngines v{compare(engine), compare(reference), point, {}};
      v.ratios = CompareRatios(CountsOf(engine, reference, v));
      verdicts.push_back(std::move(v));
    }
  }
  return verdicts;
}

std::string RatioText(const RatioEstimate& r) {
  if (std::isnan(r.ratio)) return "unknown";
  const auto number = [](double x) {
    return std::isinf(x) ? std::string("∞") : fmt::format("{:.2f}", x);
  };
  return fmt::format("{} (95 %: {} to {})", number(r.ratio), number(r.interval.low),
                     number(r.interval.high));
}

std::string FallsText(const RateEstimate& falls) {
  return fmt::format("{} in {:.0f} m", falls.events, falls.exposure);
}

/// "falls less than"; empty where nothing is shown.
std::string ShownText(const Comparison& c) {
  if (!ShowsDifference(c)) return "";
  return c.rates.judged.interval.high < 1.0 ? "falls less than" : "falls more than";
}

}  // namespace

std::optional<EngineAgreement> CompareEngines(const CampaignResults& results,
                                              const Metrics& metrics) {
  const auto axis = std::find_if(results.axes.begin(), results.axes.end(),
                                 [](const Axis& a) { return a.key == kEngineKey; });
  if (axis == results.axes.end() || axis->values.size() < 2) return std::nullopt;
  const auto k = static_cast<std::size_t>(axis - results.axes.begin());
  EngineAgreement all;
  all.reference = axis->baseline.empty() ? axis->values[0] : axis->baseline;
  all.engine = axis->values[axis->values[0] == all.reference ? 1 : 0];
  all.axes = WithoutAxis(results, k).axes;
  all.arms = CompareArms(results, k, metrics, all);
  all.verdicts =
      CompareVerdicts(InEngine(results, k, all.engine), InEngine(results, k, all.reference));
  return all;
}

std::string FallsInEngines(const EngineAgreement& agreement, const ArmInEngines& arm) {
  const Comparison& c = arm.falls;
  if (c.falls_a.events + c.falls_b.events == 0)
    return fmt::format("{} fell in neither engine.", arm.arm);
  const std::string engines =
      fmt::format("in {} than in {}", agreement.engine, agreement.reference);
  const std::string numbers = fmt::format("{} and {}, rate ratio {}", FallsText(c.falls_a),
                                          FallsText(c.falls_b), RatioText(c.rates.judged));
  if (!ShowsDifference(c))
    return fmt::format("That {} falls more or less {} is not shown: {}.", arm.arm, engines,
                       numbers);
  const char* more = c.rates.judged.interval.high < 1.0 ? "less" : "more";
  return fmt::format("{} falls {} {}: {}.", arm.arm, more, engines, numbers);
}

std::string MetricInEngines(const EngineAgreement& agreement, const ArmInEngines& arm,
                            std::string_view key) {
  const MetricDifference* d = arm.metrics.Find(key);
  if (d == nullptr) return "";
  const MeanEstimate& e = d->pairs.difference;
  const std::string numbers =
      fmt::format("{} in {}, {} in {}, difference {}", ShownNumber(d->metric, d->pairs.mean_a),
                  agreement.engine, ShownNumber(d->metric, d->pairs.mean_b), agreement.reference,
                  FormatDifference(e, d->metric.scale, d->metric.digits));
  const std::string what = fmt::format("{} of {}", TitleWithUnit(d->metric), arm.arm);
  if (e.count < 2 || e.interval.Contains(0.0))
    return fmt::format("{}: no difference is shown, {}.", what, numbers);
  return fmt::format("{} is {} in {}: {}.", what, e.mean < 0.0 ? "smaller" : "larger",
                     agreement.engine, numbers);
}

std::string VerdictsInEngines(const EngineAgreement& agreement, const VerdictInEngines& v) {
  const Comparison &one = v.in_reference, &other = v.in_engine;
  const std::string arms = fmt::format("{} and {}", one.a, one.b);
  const std::string numbers =
      fmt::format("rate ratio {} in {}, {} in {}; ratio of the two {}", RatioText(one.rates.judged),
                  agreement.reference, RatioText(other.rates.judged), agreement.engine,
                  RatioText(v.ratios.judged));
  if (std::isnan(v.ratios.judged.ratio))
    return fmt::format("Whether the verdict on {} depends on the engine is unknown: {}.", arms,
                       numbers);
  const std::string in_one = ShownText(one), in_other = ShownText(other);
  const bool opposite = in_one != in_other && !in_one.empty() && !in_other.empty();
  if (opposite || !v.ratios.judged.interval.Contains(1.0))
    return fmt::format("The verdict on {} depends on the engine: {}.", arms, numbers);
  if (in_one != in_other) {
    const bool first = !in_one.empty();
    return fmt::format("That {} {} {} is shown in {} alone; that the engines differ is not: {}.",
                       one.a, first ? in_one : in_other, one.b,
                       first ? agreement.reference : agreement.engine, numbers);
  }
  if (in_one.empty()) {
    return fmt::format(
        "In neither engine a difference in falls between {} is shown, nor that the engines differ: "
        "{}.",
        arms, numbers);
  }
  return fmt::format("Both engines show that {} {} {}; that they differ is not shown: {}.", one.a,
                     in_one, one.b, numbers);
}

}  // namespace scoria::analysis
