// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "analysis/report/metric_table.h"
#include "analysis/report/sections/model_course.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"
#include "analysis/study/adaptation.h"

namespace scoria::analysis {
namespace {

/// "15.02", or a range where the episodes differ.
std::string MassRange(const std::vector<ModelInterval>& intervals) {
  double low_kg = intervals.front().mass_kg, high_kg = low_kg;
  for (const ModelInterval& i : intervals) {
    low_kg = std::min(low_kg, i.mass_kg);
    high_kg = std::max(high_kg, i.mass_kg);
  }
  const std::string low = fmt::format("{:.2f}", low_kg), high = fmt::format("{:.2f}", high_kg);
  return low == high ? low : low + " to " + high;
}

/// An arm at a point: its intervals of one number within their episodes, or all of them.
struct IntervalLine {
  std::string arm;
  std::vector<std::string> point;
  std::string name, mass;
  std::size_t episodes = 0;
  int judged = 0, settled = 0;  // intervals
  MetricValues values;
};

using I = IntervalLine;
constexpr std::array<Column<I>, 4> kIntervalColumns = {{
    {"interval", [](const I& l) { return l.name; }},
    {"true mass [kg]", [](const I& l) { return l.mass; }},
    {"episodes", [](const I& l) { return std::to_string(l.episodes); }},
    {"settled / judged", [](const I& l) { return fmt::format("{} / {}", l.settled, l.judged); }},
}};

/// The metrics of the registry, of these intervals alone.
MetricValues ValuesOfIntervals(const Metrics& metrics,
                               const std::vector<ModelInterval>& intervals) {
  EpisodeMetrics m;
  m.model.intervals = intervals;
  return ValuesOf(metrics, m);
}

/// One line per number of an interval within its episode, then one for all.
void AppendIntervalLines(const Cell& cell, const Metrics& metrics,
                         std::vector<IntervalLine>& lines) {
  std::vector<std::vector<ModelInterval>> by_number;
  std::vector<ModelInterval> all;
  std::size_t episodes = 0;
  for (const ModelMetrics& m : cell.models) {
    episodes += m.intervals.empty() ? 0 : 1;
    for (std::size_t i = 0; i < m.intervals.size(); ++i) {
      if (i >= by_number.size()) by_number.resize(i + 1);
      by_number[i].push_back(m.intervals[i]);
      all.push_back(m.intervals[i]);
    }
  }
  const auto append = [&](const std::string& name, std::size_t count,
                          const std::vector<ModelInterval>& intervals) {
    const ModelSummary s = SummariseModel(intervals);
    lines.push_back({cell.arm, cell.point, name, MassRange(intervals), count, s.judged, s.settled,
                     ValuesOfIntervals(metrics, intervals)});
  };
  for (std::size_t i = 0; i < by_number.size(); ++i)
    append(std::to_string(i + 1), by_number[i].size(), by_number[i]);
  if (by_number.size() > 1) append("all", episodes, all);
}

/// Late values of an arm at a point: means over intervals.
struct LateLine {
  std::string arm;
  std::vector<std::string> point;
  std::vector<double> bias_kg, noise_kg, com_x_bias_m, com_y_bias_m, com_x_noise_m, com_y_noise_m;
  std::vector<double> step_share;  // learned over true change of mass, between late values
  void Add(const ModelMetrics& m) {
    const ModelInterval* before = nullptr;
    for (const ModelInterval& i : m.intervals) {
      if (i.late_rows == 0) {
        before = nullptr;
        continue;
      }
      bias_kg.push_back(i.late_bias_kg);
      noise_kg.push_back(i.late_noise_kg);
      com_x_bias_m.push_back(i.late_com_x_bias_m);
      com_y_bias_m.push_back(i.late_com_y_bias_m);
      if (i.late_com_x_noise_m) com_x_noise_m.push_back(*i.late_com_x_noise_m);
      if (i.late_com_y_noise_m) com_y_noise_m.push_back(*i.late_com_y_noise_m);
      if (before != nullptr && i.step_kg != 0.0)
        step_share.push_back(1.0 + (i.late_bias_kg - before->late_bias_kg) / i.step_kg);
      before = &i;
    }
  }
};

std::string MeanText(const std::vector<double>& values, double scale, int digits) {
  const MeanEstimate e = EstimateMean(values);
  if (e.count == 0) return "–";
  const std::string mean = fmt::format("{:.{}f}", scale * e.mean, digits);
  return e.count == 1 ? mean : fmt::format("{} ± {:.{}f}", mean, scale * e.deviation, digits);
}

using T = LateLine;
constexpr std::array<Column<T>, 8> kLateColumns = {{
    {"intervals", [](const T& l) { return std::to_string(l.bias_kg.size()); }},
    {"late bias [kg]", [](const T& l) { return MeanText(l.bias_kg, 1.0, 3); }},
    {"noise [kg]", [](const T& l) { return MeanText(l.noise_kg, 1.0, 3); }},
    {"COM x bias [mm]", [](const T& l) { return MeanText(l.com_x_bias_m, 1e3, 1); }},
    {"COM y bias [mm]", [](const T& l) { return MeanText(l.com_y_bias_m, 1e3, 1); }},
    {"COM x noise [mm]", [](const T& l) { return MeanText(l.com_x_noise_m, 1e3, 1); }},
    {"COM y noise [mm]", [](const T& l) { return MeanText(l.com_y_noise_m, 1e3, 1); }},
    {"learned step [% of the true one]",
     [](const T& l) { return MeanText(l.step_share, 100.0, 1); }},
}};

/// Bias, noise and size of the step once ten seconds have passed since a change of mass.
void AppendLateValues(const ReportInput& input, Blocks& blocks) {
  std::vector<LateLine> lines;
  for (const Cell& cell : input.cells) {
    LateLine late;
    late.arm = cell.arm;
    late.point = cell.point;
    for (const ModelMetrics& m : cell.models) late.Add(m);
    if (!late.bias_kg.empty()) lines.push_back(std::move(late));
  }
  if (lines.empty()) return;
  blocks.push_back(PointTable(input.results.axes, lines, kLateColumns));
  blocks.push_back(Note{
      "From ten seconds after a change of mass on, settled or not: mean ± standard deviation over "
      "intervals. The learned step is the change of the late mean from one interval to the next."});
}

/// Of the first episode of each adapting arm that kept its log.
void AppendCourses(const ReportInput& input, Blocks& blocks) {
  constexpr int kEvery = 4;  // rows: 8 ms, finer than a line can show
  std::set<std::string> shown;
  for (const EpisodeRecord& e : input.results.episodes) {
    const auto log = e.folder / "log.mcap";
    if (!e.metrics.model.present || shown.contains(e.arm) || !std::filesystem::exists(log))
      continue;
    const logs::LogContent content = logs::ReadLog(log, kEvery);
    if (content.rows.empty()) continue;
    shown.insert(e.arm);
    blocks.push_back(ModelCourse(content, e.id));
  }
}

std::optional<std::string> WhyNoModelAdaptation(const ReportInput& input) {
  if (!input.HasMetrics()) return "no episode left numbers";
  if (auto reason = WhyNotValid(input, Groups({logs::RowGroup::kTrueMass}))) return reason;
  if (!AnyAdapts(input.results)) return "no arm adapted its model";
  const bool any = std::any_of(input.cells.begin(), input.cells.end(), [](const Cell& c) {
    return std::any_of(c.models.begin(), c.models.end(),
                       [](const ModelMetrics& m) { return !m.intervals.empty(); });
  });
  if (!any) return "no stretch of constant mass was long enough";
  return std::nullopt;
}

Blocks BuildModelAdaptation(const ReportInput& input) {
  std::vector<IntervalLine> lines;
  const Metrics metrics = MetricsOf(input.metrics, MetricFamily::kModel);
  for (const Cell& c : input.cells) AppendIntervalLines(c, metrics, lines);
  Blocks blocks = {
      WithMetrics(PointTable(input.results.axes, lines, kIntervalColumns), lines, metrics),
      Note{"Learned against true mass and centre of mass in intervals of constant true mass. "
           "Settled: within 0.25 kg or 10 % of the step, whichever is more, and staying there; one "
           "that never settles counts with its whole duration. Bias and RMSE are of the settled "
           "parts. The mass acted on is the one that gait, MPC and whole-body control used, "
           "without adaptation the nominal one."}};
  AppendLateValues(input, blocks);
  AppendCourses(input, blocks);
  return blocks;
}

}  // namespace

Section ModelAdaptationSection() {
  return {"model_adaptation", "Online model adaptation", WhyNoModelAdaptation,
          BuildModelAdaptation};
}

}  // namespace scoria::analysis
