// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "analysis/plots/roc_plot.h"
#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"
#include "core/robot/contact.h"

namespace scoria::analysis {
namespace {

/// Contact of the episodes of a cell, added up.
const ContactMetrics& ContactOf(const Cell& c) { return c.sum->estimation.contact; }

/// How a source of contact is named and drawn.
struct SourceLook {
  const char* title;
  Symbol symbol;
};
SourceLook LookOf(ContactDetector source) {
  constexpr std::array<SourceLook, kNumContactDetectors> kLooks = {
      {{"fused contact", Symbol::kDiamond},
       {"foot sensor", Symbol::kDisc},
       {"momentum observer", Symbol::kTriangle},
       {"gait plan", Symbol::kSquare}}};
  return kLooks[static_cast<std::size_t>(source)];
}

/// One source of an arm at a point.
struct SourceLine {
  std::string arm;
  std::vector<std::string> point;
  ContactDetector source;
  const ContactMetrics* metrics;
  [[nodiscard]] const ContactQuality& quality() const { return metrics->of(source); }
};

std::string Delays(const DelayHistogram& delays) {
  const bool any = delays.count() > 0;
  return NumberText(When(any, 1e3 * delays.Quantile(0.5)), 0) + " / " +
         NumberText(When(any, 1e3 * delays.Quantile(0.95)), 0);
}

/// Missed edges in % of the true ones, and false ones per hundred true ones.
std::string Mistakes(const EdgeQuality& q) {
  return ShareText(q.missed, q.true_edges(), 1) + " / " +
         ShareText(q.false_alarms, q.true_edges(), 1);
}

std::string Area(const SourceLine& l) {
  if (l.source == ContactDetector::kSensor) return NumberText(l.metrics->sensor.Area(), 4);
  if (l.source == ContactDetector::kObserver) return NumberText(l.metrics->observer.Area(), 4);
  return "–";
}

using S = SourceLine;
constexpr std::array<Column<S>, 10> kSourceColumns = {{
    {"source", [](const S& l) { return std::string(LookOf(l.source).title); }},
    {"accuracy [%]", [](const S& l) { return NumberText(100.0 * l.quality().Accuracy(), 2); }},
    {"stance seen [%]",
     [](const S& l) { return NumberText(100.0 * l.quality().TruePositiveRate(), 2); }},
    {"swing called stance [%]",
     [](const S& l) { return NumberText(100.0 * l.quality().FalsePositiveRate(), 2); }},
    {"true touchdowns",
     [](const S& l) { return std::to_string(l.quality().touchdown.true_edges()); }},
    {"touchdown delay, median / 95 % [ms]",
     [](const S& l) { return Delays(l.quality().touchdown.delays); }},
    {"touchdowns missed / false [%]", [](const S& l) { return Mistakes(l.quality().touchdown); }},
    {"lift-off delay, median / 95 % [ms]",
     [](const S& l) { return Delays(l.quality().liftoff.delays); }},
    {"lift-offs missed / false [%]", [](const S& l) { return Mistakes(l.quality().liftoff); }},
    {"AUC", Area},
}};

/// Share of the time that the fused contact was of a source.
std::string UseText(const Cell& c, ContactSource source) {
  const ContactMetrics& m = ContactOf(c);
  return ShareText(m.fused_from[static_cast<std::size_t>(source)], m.leg_rows, 1);
}

std::string DistrustedTimes(const Cell& c) {
  const ContactMetrics& m = ContactOf(c);
  return m.of(ContactDetector::kSensor).reported ? std::to_string(m.distrusted_times) : "–";
}

constexpr std::array<Column<Cell>, 5> kUseColumns = {{
    {"sensor [% of the time]", [](const Cell& c) { return UseText(c, ContactSource::kSensor); }},
    {"observer [%]", [](const Cell& c) { return UseText(c, ContactSource::kObserver); }},
    {"gait plan [%]", [](const Cell& c) { return UseText(c, ContactSource::kGaitPhase); }},
    {"truth [%]", [](const Cell& c) { return UseText(c, ContactSource::kTruth); }},
    {"times that a sensor was distrusted", DistrustedTimes},
}};

RocCurve CurveOf(const std::string& label, const Evidence& evidence, bool dashed) {
  RocCurve curve{label, {}, evidence.Area(), dashed};
  for (const RocPoint& p : evidence.Curve())
    curve.samples.push_back({p.false_positive_rate, p.true_positive_rate});
  return curve;
}

RocSeries RocOf(const Cell& cell) {
  const ContactMetrics& m = ContactOf(cell);
  RocSeries series;
  series.curves = {CurveOf(cell.arm + ", sensor", m.sensor, false),
                   CurveOf(cell.arm + ", observer", m.observer, true)};
  std::erase_if(series.curves, [](const RocCurve& c) { return c.samples.empty(); });
  for (const auto& [source, name] : EnumNames(ContactDetector{})) {
    const ContactQuality& q = m.of(source);
    if (!q.reported || q.stance_rows == 0 || q.swing_rows == 0) continue;
    series.marks.push_back({{q.FalsePositiveRate(), q.TruePositiveRate()}, LookOf(source).symbol});
  }
  return series;
}

void AppendRoc(const ReportInput& input, Blocks& blocks) {
  RocPlot plot{"contact_roc",
               "Contact detection",
               "swing called stance (false positive rate)",
               "stance seen (true positive rate)",
               {}};
  bool any = false;
  for (const Cell& cell : input.pooled) {
    if (!cell.sum) continue;
    plot.series.push_back(RocOf(cell));
    any = any || !plot.series.back().curves.empty();
  }
  if (!any) return;
  blocks.push_back(CaptionedFigure{
      DrawRoc(plot),
      "Rows outside ±15 ms of the true edges, pooled over the sweep. Lines: threshold on the "
      "sensor's counts (solid) and on the observer's probability (dashed). Points: the sources as "
      "they are used, with their hysteresis: sensor (disc), observer (triangle), gait plan "
      "(square), fused contact (diamond)."});
}

std::optional<std::string> WhyNoContactDetection(const ReportInput& input) {
  if (!input.HasMetrics()) return "no episode left numbers";
  const bool any = std::any_of(input.cells.begin(), input.cells.end(),
                               [](const Cell& c) { return c.sum && ContactOf(c).HasDetection(); });
  if (any) return std::nullopt;
  if (auto reason = WhyNotValid(input, Groups({logs::RowGroup::kTrueContacts}))) return reason;
  return "no source of contact but the truth was used";
}

Blocks BuildContactDetection(const ReportInput& input) {
  std::vector<SourceLine> sources;
  std::vector<Cell> cells;
  for (const Cell& c : input.cells) {
    if (!c.sum || !ContactOf(c).HasDetection()) continue;
    const ContactMetrics& m = ContactOf(c);
    cells.push_back(c);
    for (const auto& [source, name] : EnumNames(ContactDetector{})) {
      if (m.of(source).reported) sources.push_back({c.arm, c.point, source, &m});
    }
  }
  const std::vector<Axis>& axes = input.results.axes;
  Blocks blocks = {
      WithMetrics(PointTable(axes, cells, kUseColumns), cells,
                  MetricsOf(input.metrics, MetricFamily::kContact)),
      Note{
          "Where the fused contact was from, how right it was, and how often the foot sensors were "
          "distrusted."},
      PointTable(axes, sources, kSourceColumns),
      Note{"Against contact of more than 5 N (Go2) in the simulator. Accuracy and AUC outside ±15 "
           "ms of "
           "the true edges; contacts and gaps below 10 ms are no edges to be reported. Delays are "
           "negative where a source was early. Missed and false edges in % of the true ones."}};
  AppendRoc(input, blocks);
  return blocks;
}

}  // namespace

Section ContactDetectionSection() {
  return {"contact_detection", "Contact detection", WhyNoContactDetection, BuildContactDetection};
}

}  // namespace scoria::analysis
