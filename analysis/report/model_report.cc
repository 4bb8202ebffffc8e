// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/model_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/files.h"

namespace scoria::analysis {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegrees = 180.0 / std::numbers::pi;
using Row = std::vector<std::string>;

/// A dash where there is nothing to show.
std::string Number(bool any, double value, int digits) {
  return any && std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "–";
}

bool Adapts(const CampaignResults& results, const std::string& arm) {
  return std::any_of(results.episodes.begin(), results.episodes.end(),
                     [&](const auto& e) { return e.arm == arm && e.metrics.model.present; });
}

bool Walked(const CampaignResults& results, const std::string& arm) {
  return std::any_of(results.episodes.begin(), results.episodes.end(),
                     [&](const auto& e) { return e.arm == arm && e.has_metrics; });
}

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

Row ModelRow(const Cell& cell, const std::string& name, std::size_t seeds,
             const std::vector<ModelInterval>& intervals) {
  const ModelSummary s = SummariseModel(intervals);
  const bool judged = s.judged > 0, settled = s.settled > 0;
  Row row = cell.point;
  row.push_back(cell.arm);
  row.push_back(name);
  row.push_back(MassRange(intervals));
  row.push_back(std::to_string(seeds));
  row.push_back(Number(settled, s.median_bias_kg, 3));
  row.push_back(Number(settled, s.p95_bias_kg, 3));
  row.push_back(Number(settled, s.median_rmse_kg, 3));
  row.push_back(Number(judged, s.median_settling_s, 2));
  row.push_back(Number(settled, 1e3 * s.median_com_x_rmse_m, 1));
  row.push_back(Number(settled, 1e3 * s.median_com_y_rmse_m, 1));
  row.push_back(
      judged ? fmt::format("{:.0f} ({} of {})", 100.0 * s.settled / s.judged, s.settled, s.judged)
             : "–");
  row.push_back(Number(s.used > 0, s.median_used_bias_kg, 3));
  return row;
}

/// One line per number of an interval within its episode, then one for all.
void AppendModelRows(const Cell& cell, std::vector<Row>& rows) {
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
  if (all.empty()) return;
  for (std::size_t i = 0; i < by_number.size(); ++i)
    rows.push_back(ModelRow(cell, std::to_string(i + 1), by_number[i].size(), by_number[i]));
  if (by_number.size() > 1) rows.push_back(ModelRow(cell, "all", episodes, all));
}

/// Late values of an arm at a point: means over intervals.
struct LateValues {
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

Row LateRow(const Cell& cell, const LateValues& late) {
  const auto mean = [](const std::vector<double>& values, double scale, int digits) {
    const MeanEstimate e = EstimateMean(values);
    if (e.count == 0) return std::string("–");
    return e.count == 1 ? fmt::format("{:.{}f}", scale * e.mean, digits)
                        : fmt::format("{:.{}f} ± {:.{}f}", scale * e.mean, digits,
                                      scale * e.deviation, digits);
  };
  Row row = cell.point;
  row.push_back(cell.arm);
  row.push_back(std::to_string(late.bias_kg.size()));
  row.push_back(mean(late.bias_kg, 1.0, 3));
  row.push_back(mean(late.noise_kg, 1.0, 3));
  row.push_back(mean(late.com_x_bias_m, 1e3, 1));
  row.push_back(mean(late.com_y_bias_m, 1e3, 1));
  row.push_back(mean(late.com_x_noise_m, 1e3, 1));
  row.push_back(mean(late.com_y_noise_m, 1e3, 1));
  row.push_back(mean(late.step_share, 100.0, 1));
  return row;
}

/// Bias, noise and size of the step once ten seconds have passed since a change of mass.
void AddLateValues(const CampaignResults& results, const std::vector<Cell>& cells, HtmlPage& page) {
  std::vector<Row> rows;
  for (const Cell& cell : cells) {
    LateValues late;
    for (const ModelMetrics& m : cell.models) late.Add(m);
    if (!late.bias_kg.empty()) rows.push_back(LateRow(cell, late));
  }
  if (rows.empty()) return;
  Row header;
  for (const Axis& axis : results.axes) header.push_back(axis.label);
  for (const char* name :
       {"arm", "intervals", "late bias [kg]", "noise [kg]", "COM x bias [mm]", "COM y bias [mm]",
        "COM x noise [mm]", "COM y noise [mm]", "learned step [% of the true one]"}) {
    header.emplace_back(name);
  }
  page.Table(header, rows);
  page.Note(
      "From ten seconds after a change of mass on, settled or not: mean ± standard deviation over "
      "intervals. The learned step is the change of the late mean from one interval to the next.");
}

/// Time, learned mass, its band, used and true mass [kg], COM x learned and true, y [mm].
std::vector<double> ModelPoint(const logs::Row& r) {
  const bool operating = r.episode && r.episode->operating;
  const logs::LearnedModel* learned =
      operating && !r.episode->fallen ? FindLearnedModel(r) : nullptr;
  const logs::TrueMassRow truth = r.true_mass.value_or(logs::TrueMassRow{kNan, {kNan, kNan}});
  const logs::LearnedModel shown =
      learned != nullptr ? *learned : logs::LearnedModel{kNan, kNan, {kNan, kNan}};
  return {r.time_s,
          shown.mass_kg,
          shown.mass_kg - shown.sigma_kg,
          shown.mass_kg + shown.sigma_kg,
          operating && r.model ? r.model->used_mass_kg : kNan,
          truth.mass_kg,
          1e3 * shown.p_BC_m[0],
          1e3 * truth.p_BC_m[0],
          1e3 * shown.p_BC_m[1],
          1e3 * truth.p_BC_m[1]};
}

/// Stretches of constant mass above the smallest: gradual changes stay white.
std::vector<std::pair<double, double>> LoadedStretches(const std::vector<logs::Row>& rows) {
  constexpr double kLeastPayload_kg = 0.01, kLeast_s = 0.1;
  std::vector<std::pair<double, double>> stretches, masses;  // from, to; time, mass
  for (const logs::Row& r : rows) {
    if (r.true_mass) masses.emplace_back(r.time_s, r.true_mass->mass_kg);
  }
  if (masses.empty()) return stretches;
  double base_kg = masses.front().second;
  for (const auto& [time_s, mass_kg] : masses) base_kg = std::min(base_kg, mass_kg);
  std::size_t start = 0;
  for (std::size_t i = 1; i <= masses.size(); ++i) {
    if (i < masses.size() && masses[i].second == masses[start].second) continue;
    const double end_s = i < masses.size() ? masses[i].first : masses.back().first;
    const bool loaded = masses[start].second > base_kg + kLeastPayload_kg;
    if (loaded && end_s - masses[start].first >= kLeast_s)
      stretches.emplace_back(masses[start].first, end_s);
    start = i;
  }
  return stretches;
}

struct Errors {
  double height_m = 0.0, roll_rad = 0.0, pitch_rad = 0.0, episodes = 0.0;
  void Add(const TrackingErrors& t) {
    height_m += t.height_rmse_m;
    roll_rad += t.roll_rmse_rad;
    pitch_rad += t.pitch_rmse_rad;
    episodes += 1.0;
  }
};

/// RMSE of an arm by seed and point, of episodes that walked steadily.
std::map<std::pair<std::uint64_t, std::vector<std::string>>, TrackingErrors> TrackingOf(
    const CampaignResults& results, const std::string& arm) {
  std::map<std::pair<std::uint64_t, std::vector<std::string>>, TrackingErrors> tracking;
  for (const EpisodeRecord& e : results.episodes) {
    if (e.arm == arm && e.has_metrics && e.metrics.tracking.samples_s > 0.0)
      tracking[{e.seed, e.point}] = e.metrics.tracking;
  }
  return tracking;
}

/// @param point empty pools the sweep: a seed's episodes at different points are no independent
/// pairs, so their mean is one.
TrackingDifference CompareArms(const CampaignResults& results, const std::string& arm,
                               const std::string& baseline, const std::vector<std::string>& point) {
  TrackingDifference d;
  d.arm = arm;
  d.baseline = baseline;
  d.point = point;
  const auto tracking = TrackingOf(results, arm), reference = TrackingOf(results, baseline);
  std::map<std::uint64_t, std::pair<Errors, Errors>> by_seed;
  for (const auto& [key, errors] : tracking) {
    const auto other = reference.find(key);
    if (other == reference.end() || (!point.empty() && key.second != point)) continue;
    by_seed[key.first].first.Add(errors);
    by_seed[key.first].second.Add(other->second);
  }
  const auto n = static_cast<double>(by_seed.size());
  const auto compare = [&](double Errors::*error, double& mean, double& baseline_mean) {
    std::vector<double> differences;
    for (const auto& [seed, pair] : by_seed) {
      const double a = pair.first.*error / pair.first.episodes;
      const double b = pair.second.*error / pair.second.episodes;
      mean += a / n;
      baseline_mean += b / n;
      differences.push_back(a - b);
    }
    return EstimateMean(differences);
  };
  d.height_difference_m = compare(&Errors::height_m, d.height_m, d.baseline_height_m);
  d.roll_difference_rad = compare(&Errors::roll_rad, d.roll_rad, d.baseline_roll_rad);
  d.pitch_difference_rad = compare(&Errors::pitch_rad, d.pitch_rad, d.baseline_pitch_rad);
  return d;
}

Row TrackingRow(const CampaignResults& results, const TrackingDifference& d) {
  return {PointName(results.axes, d.point),
          fmt::format("{} against {}", d.arm, d.baseline),
          std::to_string(d.height_difference_m.count),
          fmt::format("{:.1f} / {:.1f}", 1e3 * d.height_m, 1e3 * d.baseline_height_m),
          FormatDifference(d.height_difference_m, 1e3, 1),
          fmt::format("{:.2f} / {:.2f}", kDegrees * d.roll_rad, kDegrees * d.baseline_roll_rad),
          FormatDifference(d.roll_difference_rad, kDegrees, 2),
          fmt::format("{:.2f} / {:.2f}", kDegrees * d.pitch_rad, kDegrees * d.baseline_pitch_rad),
          FormatDifference(d.pitch_difference_rad, kDegrees, 2)};
}

}  // namespace

void AddModelAdaptation(const CampaignResults& results, const std::vector<Cell>& cells,
                        HtmlPage& page) {
  const bool any = std::any_of(results.arms.begin(), results.arms.end(),
                               [&](const auto& arm) { return Adapts(results, arm); });
  if (!any) return;
  std::vector<Row> rows;
  for (const Cell& c : cells) AppendModelRows(c, rows);
  if (rows.empty()) return;
  Row header;
  for (const Axis& axis : results.axes) header.push_back(axis.label);
  for (const char* name :
       {"arm", "interval", "true mass [kg]", "episodes", "median |bias| [kg]", "95 % |bias| [kg]",
        "median RMSE [kg]", "median settling [s]", "COM x RMSE [mm]", "COM y RMSE [mm]",
        "settled [%]", "median |bias| of the mass acted on [kg]"}) {
    header.emplace_back(name);
  }
  page.Heading("Online model adaptation");
  page.Table(header, rows);
  page.Note(
      "Learned against true mass and centre of mass in intervals of constant true mass. Settled: "
      "within 0.25 kg or 10 % of the step, whichever is more, and staying there; one that never "
      "settles counts with its whole duration. Bias and RMSE are of the settled parts. The mass "
      "acted on is the one that gait, MPC and whole-body control used, without adaptation the "
      "nominal one.");
  AddLateValues(results, cells, page);
}

CaptionedFigure ModelFigure(const logs::LogContent& log, const std::string& name) {
  Figure figure("model_" + core::FileNameOf(name), "Learned mass of " + name, 1000, 760);
  constexpr std::size_t kMaxPoints = 4000;
  const std::size_t every = std::max<std::size_t>(1, log.rows.size() / kMaxPoints);
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < log.rows.size(); i += every) rows.push_back(ModelPoint(log.rows[i]));
  figure.Data("d", rows);
  int object = 0;
  for (const auto& [start_s, end_s] : LoadedStretches(log.rows)) {
    // Alternating, so that a payload exchanged for another is seen.
    figure.Line(fmt::format(
        "set object {} rect from {},graph 0 to {},graph 1 behind fs solid 1 noborder fc rgb '{}'",
        object + 1, start_s, end_s, object % 2 == 0 ? "#e4e4e4" : "#d2d2d2"));
    ++object;
  }
  if (!rows.empty())
    figure.Line(fmt::format("set xrange [{}:{}]", rows.front()[0], rows.back()[0]));
  figure.Line(
      fmt::format("set multiplot layout 3,1 title '{}' margins 0.09,0.97,0.08,0.93 spacing 0,0.05",
                  Escape(name)));
  figure.Line("set key top right horizontal; set format x ''; set offsets 0,0,graph 0.18,0");
  figure.Line(
      "set ylabel 'mass [kg]'; plot $d u 1:3:4 w filledcurves fs transparent solid 0.3 noborder lc "
      "rgb '#0072b2' t '±1 sigma', $d u 1:6 w l lw 1.5 lc rgb '#000000' t 'true', $d u 1:2 w l lw "
      "1.5 lc rgb '#0072b2' t 'learned', $d u 1:5 w l lw 1.5 dt 2 lc rgb '#d55e00' t 'acted on'");
  figure.Line(
      "set ylabel 'COM x [mm]'; plot $d u 1:8 w l lc rgb '#000000' t 'true', $d u 1:7 w l lw 1.5 "
      "lc rgb '#009e73' t 'learned'");
  figure.Line(
      "set format x '%g'; set xlabel 'time [s]'; set ylabel 'COM y [mm]'; plot $d u 1:10 w l lc "
      "rgb '#000000' t 'true', $d u 1:9 w l lw 1.5 lc rgb '#cc79a7' t 'learned'");
  figure.Line("unset multiplot");
  return {std::move(figure),
          "Mass of the whole robot and its centre of mass in the trunk's frame. Grey: the robot "
          "carries a payload. Learned values are shown from when the readings at the known mass "
          "were taken; acted on: by gait, MPC and whole-body control."};
}

std::vector<CaptionedFigure> ModelFigures(const CampaignResults& results) {
  constexpr int kEvery = 4;  // rows: 8 ms, finer than a line can show
  std::vector<CaptionedFigure> figures;
  std::set<std::string> shown;
  for (const EpisodeRecord& e : results.episodes) {
    const auto log = e.folder / "log.mcap";
    if (!e.metrics.model.present || shown.contains(e.arm) || !std::filesystem::exists(log))
      continue;
    const logs::LogContent content = logs::ReadLog(log, kEvery);
    if (content.rows.empty()) continue;
    shown.insert(e.arm);
    figures.push_back(ModelFigure(content, e.id));
  }
  return figures;
}

std::vector<TrackingDifference> CompareTracking(const CampaignResults& results) {
  std::vector<TrackingDifference> all;
  const auto baseline =
      std::find_if(results.arms.begin(), results.arms.end(),
                   [&](const auto& arm) { return Walked(results, arm) && !Adapts(results, arm); });
  const bool any = std::any_of(results.arms.begin(), results.arms.end(),
                               [&](const auto& arm) { return Adapts(results, arm); });
  if (!any || baseline == results.arms.end()) return all;
  std::vector<std::vector<std::string>> points = {{}};
  if (!results.axes.empty()) {
    const auto each = AllPoints(results.axes);
    points.insert(points.end(), each.begin(), each.end());
  }
  for (const auto& point : points) {
    for (const std::string& arm : results.arms) {
      if (arm == *baseline) continue;
      TrackingDifference d = CompareArms(results, arm, *baseline, point);
      if (d.height_difference_m.count > 0) all.push_back(std::move(d));
    }
  }
  return all;
}

void AddAdaptedTracking(const CampaignResults& results, HtmlPage& page) {
  std::vector<Row> rows;
  for (const TrackingDifference& d : CompareTracking(results))
    rows.push_back(TrackingRow(results, d));
  if (rows.empty()) return;
  page.Heading("Tracking with and without adaptation");
  page.Table({"at", "arms", "seeds", "height RMSE [mm]", "difference [mm]", "roll RMSE [deg]",
              "difference [deg]", "pitch RMSE [deg]", "difference [deg]"},
             rows);
  page.Note(
      "Episodes of the same seed in pairs; those that one of the arms did not walk are left out. "
      "Means over the seeds of the episodes' RMSE over steady walking, with Student's interval of "
      "the mean difference; negative is better than without adaptation.");
}

}  // namespace scoria::analysis
