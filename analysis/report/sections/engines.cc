// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "analysis/metrics/metric_text.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"
#include "analysis/study/engine_agreement.h"

namespace scoria::analysis {
namespace {

/// What is told of every arm beside its falls: cost, tracking, and how feet are loaded.
constexpr std::array<std::string_view, 8> kMetrics = {
    "cot_mech_abs",  "cot_electrical", "velocity_rmse_mps", "height_rmse_m",
    "roll_rmse_rad", "pitch_rmse_rad", "foot_force_rms_N",  "peak_foot_force_N"};

std::string RatioText(const RatioEstimate& r) {
  if (std::isnan(r.ratio)) return "unknown";
  const auto text = [](double x) { return std::isinf(x) ? "∞" : NumberText(x, 2); };
  return fmt::format("{} ({} to {})", text(r.ratio), text(r.interval.low), text(r.interval.high));
}

std::string DifferenceText(const MetricDifference* d) {
  if (d == nullptr || d->pairs.difference.count < 2) return "–";
  const MeanEstimate& e = d->pairs.difference;
  const auto text = [d](double x) {
    return fmt::format("{:+.{}f}", d->metric.scale * x, d->metric.digits);
  };
  return fmt::format("{} ({} to {})", text(e.mean), text(e.interval.low), text(e.interval.high));
}

/// One sentence each of falls and of every metric, over the whole sweep.
BulletList Sentences(const EngineAgreement& agreement, const ArmInEngines& arm) {
  BulletList list;
  list.items.push_back(FallsInEngines(agreement, arm));
  for (const std::string_view key : kMetrics) {
    std::string sentence = MetricInEngines(agreement, arm, key);
    if (!sentence.empty()) list.items.push_back(std::move(sentence));
  }
  return list;
}

Table VerdictTable(const EngineAgreement& agreement) {
  Table table{{"at", "arms", "rate ratio in " + agreement.reference,
               "rate ratio in " + agreement.engine, "ratio of the two", "p"},
              {}};
  for (const VerdictInEngines& v : agreement.verdicts) {
    table.rows.push_back(
        {PointName(agreement.axes, v.point), fmt::format("{} : {}", v.in_engine.a, v.in_engine.b),
         RatioText(v.in_reference.rates.judged), RatioText(v.in_engine.rates.judged),
         RatioText(v.ratios.judged), PValueText(v.ratios.judged.p_value)});
  }
  return table;
}

/// Falls and differences of the metrics at every point.
Table PointsTable(const EngineAgreement& agreement, const Metrics& metrics) {
  Table table{{"at", "arm", "falls in " + agreement.engine, "falls in " + agreement.reference,
               "rate ratio"},
              {}};
  for (const std::string_view key : kMetrics) {
    if (const Metric* metric = FindMetric(metrics, key))
      table.header.push_back(TitleWithUnit(metric->info));
  }
  for (const ArmInEngines& arm : agreement.arms) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {PointName(agreement.axes, arm.point), arm.arm, CountText(arm.falls.falls_a),
           CountText(arm.falls.falls_b), RatioText(arm.falls.rates.judged)};
    for (const std::string_view key : kMetrics) {
      if (FindMetric(metrics, key) == nullptr) continue;
      row.push_back(DifferenceText(arm.metrics.Find(key)));
    }
  }
  return table;
}

std::optional<std::string> WhyNoEngines(const ReportInput& input) {
  for (const Axis& axis : input.results.axes) {
    if (axis.key != kEngineKey) continue;
    if (axis.values.size() < 2) return "the sweep names one physics engine";
    if (!input.HasMetrics()) return "no episode left numbers";
    return std::nullopt;
  }
  return "the physics engine was not swept";
}

Blocks BuildEngines(const ReportInput& input) {
  const EngineAgreement agreement = *CompareEngines(input.results, input.metrics);
  Blocks blocks;
  BulletList verdicts;
  for (const VerdictInEngines& v : agreement.verdicts) {
    if (v.point.empty()) verdicts.items.push_back(VerdictsInEngines(agreement, v));
  }
  if (!verdicts.items.empty()) {
    blocks.push_back(verdicts);
    blocks.push_back(VerdictTable(agreement));
  }
  for (const ArmInEngines& arm : agreement.arms) {
    if (!arm.point.empty()) continue;
    blocks.push_back(
        Heading{fmt::format("{}, {} against {}", arm.arm, agreement.engine, agreement.reference)});
    blocks.push_back(Sentences(agreement, arm));
  }
  blocks.push_back(
      Heading{fmt::format("{} minus {}, at each point", agreement.engine, agreement.reference)});
  blocks.push_back(PointsTable(agreement, input.metrics));
  blocks.push_back(Note{
      "Episodes of the same arm, seed and point in pairs, one in each engine; in brackets 95 % "
      "intervals. Falls: ratio of falls per metre, judged as those of arms. Metrics: mean over "
      "seeds of the differences, with Student's interval. Ratio of the two: by how much the rate "
      "ratio of two arms differs between the engines, exact given the margins of the table of "
      "falls (odds ratio), and from six terrains on widened to the interval from resampling "
      "terrains. Intervals are not corrected for looking at many numbers: about one in twenty "
      "misses the truth by chance. That no difference is shown does not say that there is none."});
  return blocks;
}

}  // namespace

Section EnginesSection() {
  return {"engines", "The same in both engines?", WhyNoEngines, BuildEngines};
}

}  // namespace scoria::analysis
