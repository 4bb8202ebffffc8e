// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "analysis/metrics/estimation_metrics.h"
#include "analysis/signals/motion.h"
#include "analysis/study/compare.h"
#include "core/files.h"
#include "core/robot/contact.h"

namespace scoria::analysis {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Points that agree with `fixed` in every axis but `free`, in the order of the free axis' values.
std::vector<std::vector<std::string>> Along(const std::vector<Axis>& axes, std::size_t free,
                                            const std::vector<std::string>& fixed) {
  std::vector<std::vector<std::string>> points;
  for (const std::string& value : axes[free].values) {
    points.push_back(fixed);
    points.back()[free] = value;
  }
  return points;
}

std::string Others(const std::vector<Axis>& axes, std::size_t free,
                   const std::vector<std::string>& point) {
  std::string name;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (i != free)
      name += fmt::format("{}{} {}", name.empty() ? "" : ", ", axes[i].label, point[i]);
  }
  return name;
}

CaptionedFigure FallFigure(const CampaignResults& results, std::size_t axis,
                           const std::vector<std::string>& fixed) {
  const std::string others = Others(results.axes, axis, fixed);
  const std::string title = others.empty() ? "Falls per metre" : "Falls per metre, " + others;
  Figure figure(
      "falls_" + core::FileNameOf(results.axes[axis].key + (others.empty() ? "" : "_" + others)),
      title);
  std::string plots, arrows;
  double smallest = 1.0;
  bool any = false;
  for (std::size_t a = 0; a < results.arms.size(); ++a) {
    std::vector<std::vector<double>> seen, none;
    const auto points = Along(results.axes, axis, fixed);
    double spacing = 0.0;
    if (points.size() > 1) {
      spacing = (std::stod(points.back()[axis]) - std::stod(points.front()[axis])) /
                static_cast<double>(points.size() - 1);
    }
    for (const auto& point : points) {
      const Cell cell = PoolCell(results, results.arms[a], point);
      if (cell.falls.exposure <= 0.0) continue;
      any = true;
      // Arms are set side by side so that their intervals do not cover each other.
      const double x =
          std::stod(point[axis]) +
          0.06 * spacing *
              (static_cast<double>(a) - 0.5 * static_cast<double>(results.arms.size() - 1));
      const Interval& i = cell.falls.interval;
      if (cell.falls.events > 0) {
        seen.push_back({x, cell.falls.rate, i.low, i.high});
        smallest = std::min(smallest, i.low);
      } else {
        none.push_back({x, i.high});
        smallest = std::min(smallest, 0.3 * i.high);
      }
    }
    const std::string id = fmt::format("a{}", a), colour = ArmColour(a),
                      label = Escape(results.arms[a]);
    if (seen.empty()) seen.push_back({kNan, kNan, kNan, kNan});
    if (none.empty()) none.push_back({kNan, kNan});
    figure.Data(id, seen);
    figure.Data(id + "n", none);
    plots += fmt::format(
        "{}${} u 1:2:3:4 w yerrorlines lc rgb '{}' pt 7 ps 0.8 lw 1.5 t '{}', ${}n u 1:2 w p pt 11 "
        "ps 1.2 lc rgb '{}' notitle",
        a > 0 ? ", " : "", id, colour, label, id, colour);
  }
  figure.Line("set key top left; set logscale y; set format y '%g'");
  figure.Line(fmt::format("set yrange [{:.3g}:*]; set offsets graph 0.04, graph 0.04, 0, 0",
                          0.7 * smallest));
  figure.Line(fmt::format("set xlabel '{}'; set ylabel 'falls per metre'",
                          Escape(results.axes[axis].label)));
  figure.Line(fmt::format("set title '{}'", Escape(title)));
  figure.Line(any ? "plot " + plots
                  : std::string("unset logscale; set label 1 'nothing walked' at graph 0.5, graph "
                                "0.5 center; plot [0:1][0:1] NaN notitle"));
  return {std::move(figure),
          "Bars: exact 95 % Poisson intervals. A triangle marks an arm that did not fall there: it "
          "points at the upper bound of its rate."};
}

/// The terms that an arm's windows carry, 1 to 3: commanded speeds, in steps of 0.1 m/s, that hold
/// at least a twentieth of the windows each.
int CurveTerms(const std::vector<double>& commands) {
  std::map<long, std::size_t> counts;
  for (const double v : commands) ++counts[std::lround(10.0 * v)];
  const auto frequent = std::count_if(counts.begin(), counts.end(), [&](const auto& c) {
    return 20 * c.second >= commands.size();
  });
  return std::clamp(static_cast<int>(frequent), 1, 3);
}

CaptionedFigure CostFigure(const CampaignResults& results, const char* name, const char* label,
                           double SpeedWindow::*cost) {
  Figure figure(fmt::format("cot_{}", name), fmt::format("Cost of transport, {}", label));
  std::string plots, fits, formulas;
  for (std::size_t a = 0; a < results.arms.size(); ++a) {
    std::vector<CurvePoint> points;
    std::vector<double> commands;
    std::vector<std::vector<double>> rows;
    for (std::size_t episode = 0; episode < results.episodes.size(); ++episode) {
      const EpisodeRecord& e = results.episodes[episode];
      if (e.arm != results.arms[a]) continue;
      for (const SpeedWindow& w : e.metrics.windows) {
        if (w.v_mps < 0.02) continue;
        commands.push_back(w.command_mps);
        points.push_back({w.v_mps, w.*cost, episode});
        rows.push_back({w.v_mps, w.*cost});
      }
    }
    if (rows.empty()) continue;
    const std::string colour = ArmColour(a), arm = Escape(results.arms[a]);
    figure.Data(fmt::format("p{}", a), rows);
    const int terms = CurveTerms(commands);
    const CurveFit fit = FitCostCurve(points, terms, 1);
    std::string title = arm;
    if (fit.valid) {
      std::vector<std::vector<double>> curve;
      for (std::size_t i = 0; i < fit.x.size(); ++i)
        curve.push_back({fit.x[i], fit.y[i], fit.low.empty() ? kNan : fit.low[i],
                         fit.high.empty() ? kNan : fit.high[i]});
      figure.Data(fmt::format("f{}", a), curve);
      title += fmt::format(" (r^2 = {:.2f}, n = {})", fit.r2, rows.size());
      formulas += fmt::format("{}{}: {}", formulas.empty() ? "" : "; ", results.arms[a],
                              CostCurveFormula(terms));
      fits += fmt::format(
          "{}$f{} u 1:3:4 w filledcurves fc rgb '{}' fs transparent solid 0.2 notitle, $f{} u 1:2 "
          "w l lw 2 lc rgb '{}' t '{}'",
          fits.empty() ? "" : ", ", a, colour, a, colour, title);
      title.clear();
    }
    plots += fmt::format("{}$p{} u 1:2 w p pt 7 ps 0.35 lc rgb '{}' {}", plots.empty() ? "" : ", ",
                         a, colour, title.empty() ? "notitle" : "t '" + title + "'");
  }
  figure.Line("set key top right");
  figure.Line(
      fmt::format("set xlabel 'speed [m/s]'; set ylabel 'cost of transport, {}'", Escape(label)));
  figure.Line(fmt::format("set title 'Cost of transport: {}'; set yrange [0:*]", Escape(label)));
  if (plots.empty()) {
    figure.Line(
        "set label 1 'no steady walking' at graph 0.5, graph 0.5 center; plot [0:1][0:1] NaN "
        "notitle");
  } else {
    figure.Line("plot " + plots + (fits.empty() ? "" : ", " + fits));
  }
  return {
      std::move(figure),
      fmt::format(
          "One point per steady five-second window (a speed v). Fitted robustly: {}. Band: 95 % by "
          "resampling episodes of the same speed; none with too few of them.",
          formulas.empty() ? "nothing" : formulas)};
}

CaptionedFigure TrackingFigure(const CampaignResults& results) {
  Figure figure("tracking", "Tracking errors", 900, 420);
  std::vector<std::vector<double>> rows;
  for (std::size_t a = 0; a < results.arms.size(); ++a) {
    const Cell cell = PoolCell(results, results.arms[a], {});
    rows.push_back({static_cast<double>(a), cell.tracking.velocity_rmse_mps * 1e3,
                    cell.tracking.height_rmse_m * 1e3, cell.tracking.roll_rmse_rad * kDegrees,
                    cell.tracking.pitch_rmse_rad * kDegrees});
  }
  figure.Data("t", rows);
  std::string ticks;
  for (std::size_t a = 0; a < results.arms.size(); ++a)
    ticks += fmt::format("{}'{}' {}", a > 0 ? ", " : "", Escape(results.arms[a]), a);
  figure.Line(
      "set multiplot layout 1,4 title 'RMS tracking errors over steady walking'; set style fill "
      "solid 0.8; set boxwidth 0.7; unset key");
  figure.Line(fmt::format("set xtics ({}) rotate by -30; set yrange [0:*]; set xrange [-0.6:{}]",
                          ticks, static_cast<double>(results.arms.size()) - 0.4));
  const std::array<const char*, 4> titles = {"velocity [mm/s], stride mean", "height [mm]",
                                             "roll [deg]", "pitch [deg]"};
  for (std::size_t k = 0; k < titles.size(); ++k) {
    figure.Line(
        fmt::format("set title '{}'; plot $t u 1:{} w boxes lc rgb '#0072b2'", titles[k], k + 2));
  }
  figure.Line("unset multiplot");
  return {std::move(figure),
          "Against the controller's reference, pooled over the sweep; the first three seconds "
          "after each change of command are left out."};
}

CaptionedFigure SolveTimeFigure(const CampaignResults& results) {
  Figure figure("solve_times", "Solve times", 900, 420);
  std::vector<std::vector<double>> rows;
  std::string ticks;
  for (std::size_t a = 0; a < results.arms.size(); ++a) {
    const Cell cell = PoolCell(results, results.arms[a], {});
    rows.push_back({static_cast<double>(a), cell.mpc_median_s * 1e6, cell.mpc_p99_s * 1e6,
                    cell.wbc_median_s * 1e6, cell.wbc_p99_s * 1e6});
    ticks += fmt::format("{}'{}' {}", a > 0 ? ", " : "", Escape(results.arms[a]), a);
  }
  figure.Data("s", rows);
  figure.Line(
      "set multiplot layout 1,2; set style fill solid 0.8; set boxwidth 0.35; set key top center "
      "horizontal; set offsets 0, 0, graph 0.15, 0");
  figure.Line(fmt::format("set xtics ({}); set yrange [0:*]; set xrange [-0.6:{}]", ticks,
                          static_cast<double>(results.arms.size()) - 0.4));
  figure.Line(
      "set title 'MPC [us]'; plot $s u ($1-0.18):2 w boxes lc rgb '#0072b2' t 'median', $s u "
      "($1+0.18):3 w boxes lc rgb '#d55e00' t 'p99'");
  figure.Line(
      "set title 'WBC [us]'; plot $s u ($1-0.18):4 w boxes lc rgb '#0072b2' t 'median', $s u "
      "($1+0.18):5 w boxes lc rgb '#d55e00' t 'p99'");
  figure.Line("unset multiplot");
  return {std::move(figure),
          "Wall clock of one solve with its set-up: mean of the episodes' medians, worst of their "
          "99th percentiles."};
}

/// Height of the centre of mass and of its reference over the ground, m.
std::array<double, 2> HeightsOf(const logs::Row& r) {
  if (!r.truth || !r.truth->ground_z_m) return {kNan, kNan};
  const double ground_z_m = *r.truth->ground_z_m;
  return {r.true_mass ? r.true_mass->p_WC_z_m - ground_z_m : kNan,
          r.reference ? r.reference->p_WC_m[2] - HeightDrift(r).value_or(0.0) - ground_z_m : kNan};
}

/// Forward speed, m/s, roll and pitch, degrees: by the truth, or for want of it by the estimate.
std::array<double, 3> MotionOf(const logs::Row& r) {
  const auto motion = FindMotion(r);
  if (!motion) return {kNan, kNan, kNan};
  const double yaw_rad = motion->rpy_rad.z();
  return {std::cos(yaw_rad) * motion->v_WB.x() + std::sin(yaw_rad) * motion->v_WB.y(),
          motion->rpy_rad.x() * kDegrees, motion->rpy_rad.y() * kDegrees};
}

bool BearsWeight(const logs::Row& r, std::size_t leg) {
  if (r.true_contacts) return r.true_contacts->f_F_W_N[3 * leg + 2] > 5.0;
  return r.contacts && r.contacts->contact[leg];
}

/// Whether a foot's sensor is unhealthy and the momentum observer stands in for it.
bool HasSensorFallback(const logs::Row& r, std::size_t leg) {
  return r.contacts && r.contacts->source && r.contacts->sensor &&
         static_cast<ContactSource>((*r.contacts->source)[leg]) == ContactSource::kObserver &&
         !r.contacts->sensor->healthy[leg];
}

/// Columns of the time figure. Feet and stages are lines at their own height, or nothing.
std::vector<double> TimeRow(const logs::Row& r) {
  const auto [height_m, reference_m] = HeightsOf(r);
  const auto [speed_mps, roll_deg, pitch_deg] = MotionOf(r);
  std::vector<double> row = {
      r.time_s, height_m, reference_m, speed_mps, r.command ? r.command->v_x_mps : kNan,
      roll_deg, pitch_deg};
  bool sensor_given_up = false;
  for (std::size_t leg = 0; leg < 4; ++leg) {
    row.push_back(BearsWeight(r, leg) ? 4.0 - static_cast<double>(leg) : kNan);
    sensor_given_up |= HasSensorFallback(r, leg);
  }
  row.push_back(r.plan ? r.plan->period_s : kNan);
  row.push_back(sensor_given_up ? 7.0 : kNan);
  const auto fallen_back = r.supervision ? r.supervision->fallen_back : std::array<bool, 6>{};
  for (std::size_t i = 0; i < fallen_back.size(); ++i)
    row.push_back(fallen_back[i] ? 6.0 - static_cast<double>(i) : kNan);
  return row;
}

}  // namespace

std::vector<CaptionedFigure> FallFigures(const CampaignResults& results) {
  std::vector<CaptionedFigure> figures;
  for (std::size_t axis = 0; axis < results.axes.size(); ++axis) {
    if (!results.axes[axis].IsNumeric() || results.axes[axis].values.size() < 2) continue;
    std::vector<Axis> others = results.axes;
    others[axis].values = {results.axes[axis].values.front()};
    for (const auto& fixed : AllPoints(others)) figures.push_back(FallFigure(results, axis, fixed));
  }
  return figures;
}

std::vector<CaptionedFigure> CostFigures(const CampaignResults& results) {
  return {CostFigure(results, "mech_abs", "mechanical Σ|τω|", &SpeedWindow::cot_mech_abs),
          CostFigure(results, "electrical", "electrical with idle power",
                     &SpeedWindow::cot_electrical)};
}

std::vector<CaptionedFigure> ArmFigures(const CampaignResults& results) {
  return {TrackingFigure(results), SolveTimeFigure(results)};
}

CaptionedFigure TimeFigure(const logs::LogContent& log, const std::string& name) {
  Figure figure("time_" + core::FileNameOf(name), "Course of " + name, 1000, 1100);
  constexpr std::size_t kMaxPoints = 4000;
  const std::size_t every = std::max<std::size_t>(1, log.rows.size() / kMaxPoints);
  std::vector<std::vector<double>> rows;
  double previous_s = 0.0;
  for (std::size_t i = 0; i < log.rows.size(); i += every) {
    const logs::Row& r = log.rows[i];
    if (!rows.empty() && r.time_s - previous_s > 1.0)
      rows.push_back(std::vector<double>(TimeRow({}).size(), kNan));  // a gap is no line
    previous_s = r.time_s;
    rows.push_back(TimeRow(r));
  }
  figure.Data("d", rows);
  for (std::size_t i = 0; i < log.falls_s.size(); ++i) {
    figure.Line(
        fmt::format("set arrow {} from {},graph 0 to {},graph 1 nohead lc rgb '#d55e00' dt 2",
                    i + 1, log.falls_s[i], log.falls_s[i]));
  }
  if (!rows.empty())
    figure.Line(fmt::format("set xrange [{}:{}]", rows.front()[0], rows.back()[0]));
  figure.Line(
      fmt::format("set multiplot layout 5,1 title '{}' margins 0.09,0.97,0.07,0.94 spacing 0,0.045",
                  Escape(name)));
  figure.Line("set key top right horizontal; set format x ''");
  figure.Line(
      "set ylabel 'height [m]'; plot $d u 1:2 w l lc rgb '#0072b2' t 'COM over ground', $d u 1:3 w "
      "l dt 2 lc rgb '#d55e00' t 'reference'");
  figure.Line(
      "set ylabel 'speed [m/s]'; plot $d u 1:4 w l lc rgb '#0072b2' t 'forward', $d u 1:5 w l dt 2 "
      "lc rgb '#d55e00' t 'commanded'");
  figure.Line(
      "set ylabel 'angle [deg]'; plot $d u 1:6 w l lc rgb '#009e73' t 'roll', $d u 1:7 w l lc rgb "
      "'#cc79a7' t 'pitch'");
  figure.Line(
      "set ylabel 'stance'; unset key; set yrange [0.5:4.5]; set ytics ('FL' 4, 'FR' 3, 'HL' 2, "
      "'HR' 1)");
  figure.Line("plot for [k=8:11] $d u 1:k w l lw 6 lc rgb '#444444'");
  figure.Line(
      "set format x '%g'; set xlabel 'time [s]'; set ylabel 'given up'; set yrange [0.5:7.5]; set "
      "ytics ('sensor' 7, 'mpc' 6, 'body' 5, 'estimator' 4, 'contact' 3, 'footing' 2, 'load' "
      "1)");
  figure.Line("plot for [k=13:19] $d u 1:k w l lw 6 lc rgb '#d55e00'");
  figure.Line("unset multiplot");
  return {std::move(figure),
          "Vertical dashes mark falls. Stance: normal force above 5 N. Given up: a foot sensor for "
          "the momentum observer, stages by the supervisor."};
}

}  // namespace scoria::analysis
