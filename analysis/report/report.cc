// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "analysis/metrics/bias_budget.h"
#include "analysis/plots/fall_map.h"
#include "analysis/plots/figures.h"
#include "analysis/report/estimation_report.h"
#include "analysis/report/html.h"
#include "analysis/report/model_report.h"
#include "analysis/report/tables.h"
#include "analysis/study/compare.h"
#include "analysis/study/fall_groups.h"
#include "core/files.h"
#include "core/folder_lock.h"
#include "core/text.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;
constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string Summary(const CampaignResults& results) {
  double metres = 0.0;
  int falls = 0;
  for (const EpisodeRecord& e : results.episodes) {
    metres += e.metrics.distance_m;
    falls += e.falls;
  }
  std::string arms;
  for (const std::string& arm : results.arms) arms += (arms.empty() ? "" : ", ") + arm;
  std::string sweep;
  for (const Axis& axis : results.axes) {
    sweep += fmt::format("{}{} ({})", sweep.empty() ? " over " : " and ", axis.label,
                         fmt::join(axis.values, ", "));
  }
  return fmt::format("{}{}: {} episodes, {:.0f} m walked, {} falls.", arms, sweep,
                     results.episodes.size(), metres, falls);
}

/// A table of counts by name and arm; nothing where nothing was counted.
template <class Number>
void AddCounts(const std::string& title,
               const std::map<std::string, std::map<std::string, Number>>& counts,
               const std::vector<std::string>& arms, HtmlPage& page) {
  if (counts.empty()) return;
  std::vector<std::string> header = {title};
  header.insert(header.end(), arms.begin(), arms.end());
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, per_arm] : counts) {
    std::vector<std::string> row = {name};
    for (const std::string& arm : arms)
      row.push_back(std::to_string(per_arm.contains(arm) ? per_arm.at(arm) : 0));
    rows.push_back(row);
  }
  page.Table(header, rows);
}

/// What went wrong, first: broken episodes, then falls by cause.
void AddFailures(const CampaignResults& results, HtmlPage& page) {
  page.Heading("Failures");
  std::vector<std::vector<std::string>> broken;
  std::map<std::string, std::map<std::string, int>> causes;
  std::map<std::string, std::map<std::string, std::uint64_t>> counters;
  long stuck = 0;
  for (const EpisodeRecord& e : results.episodes) {
    if (e.end != "completed" || !e.message.empty()) broken.push_back({e.id, e.end, e.message});
    for (const FallEvent& f : e.metrics.falls)
      ++causes[f.cause.substr(0, f.cause.find(' '))][e.arm];
    stuck += e.stuck;
    for (const auto& [what, times] : e.counters) {
      if (times > 0) counters[what][e.arm] += times;
    }
  }
  if (broken.empty()) {
    page.Paragraph("Every episode walked its whole distance.");
  } else {
    page.Table({"episode", "ended", "message"}, broken);
  }
  AddCounts("cause of fall", causes, results.arms, page);
  page.Paragraph(
      fmt::format("Stuck {} times. What the controller met and how it fell back:", stuck));
  AddCounts("contacts, solver failures and fallbacks", counters, results.arms, page);
}

/// Metres, falls and metres per fall of every arm, over the whole sweep.
void AddArms(const CampaignResults& results, HtmlPage& page) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& arm : results.arms) {
    const RateEstimate falls = PoolCell(results, arm, {}).falls;
    rows.push_back({arm, fmt::format("{:.0f}", falls.exposure), std::to_string(falls.events),
                    MetresPerFall(falls)});
  }
  page.Table({"arm", "metres walked", "falls", "metres per fall"}, rows);
}

/// The first screen: who falls less, on how many metres, what this budget could have seen, in how
/// many places the falls lie; and a picture.
void AddHeadline(const CampaignResults& results, const std::vector<Comparison>& comparisons,
                 const std::optional<ReportPicture>& picture, HtmlPage& page) {
  page.OpenColumns();
  page.Paragraph(Summary(results));
  std::vector<std::string> pooled;
  double detectable = std::numeric_limits<double>::infinity();
  for (const Comparison& c : comparisons) {
    if (!c.point.empty()) continue;
    pooled.push_back(c.verdict);
    detectable = std::min(detectable, c.detectable);
  }
  if (!pooled.empty()) {
    page.Heading("Who falls less");
    page.List(pooled);
  }
  AddArms(results, page);
  std::vector<std::string> facts;
  if (std::isfinite(detectable))
    facts.push_back(fmt::format(
        "Smallest effect that this budget sees: a rate ratio of {:.2f} (power 80 %, level 5 %).",
        detectable));
  const std::vector<FallGroup> groups = GroupFalls(results);
  if (!groups.empty()) {
    std::string places = DescribeGroups(groups, CountGrounds(results, results.arms, {}));
    places.front() = 'T';
    facts.push_back(places + ".");
  }
  if (!facts.empty()) page.List(facts);
  page.NextColumn();
  if (picture) page.Image(picture->jpeg, picture->caption);
  page.CloseColumns();
}

void AddVerdicts(const std::vector<Comparison>& comparisons, HtmlPage& page) {
  if (comparisons.empty()) return;
  std::vector<std::string> points;
  for (const Comparison& c : comparisons) {
    if (!c.point.empty()) points.push_back(c.verdict);
  }
  if (!points.empty()) {
    page.Heading("Who falls less, at each point");
    page.List(points);
  }
  page.Note(
      "Ratios of falls per metre with exact intervals (conditional binomial). Where an arm's share "
      "of the falls differs between six or more terrains by more than chance (p < 0.05), the "
      "interval is widened to the one from resampling terrains. Intervals are not corrected for "
      "looking at many points: about one in twenty misses the truth by chance. Verdicts pool a "
      "sweep whose range was chosen by hand; read them with the single points. Falls within 1 m "
      "of each other on one ground are one place.");
}

std::string Value(double x, const char* format) {
  return std::isfinite(x) ? fmt::format(fmt::runtime(format), x) : "–";
}

void AddCells(const CampaignResults& results, const std::vector<Cell>& cells, HtmlPage& page) {
  page.Heading("Numbers");
  std::vector<std::string> header;
  for (const Axis& axis : results.axes) header.push_back(axis.label);
  for (const char* name : {"arm", "metres", "falls", "stuck", "metres per fall", "CoT mech_abs",
                           "CoT mech_pos", "CoT electrical", "CoT battery", "velocity RMSE [m/s]",
                           "height RMSE [mm]", "roll RMSE [deg]", "pitch RMSE [deg]",
                           "MPC median / p99 [µs]", "WBC median / p99 [µs]", "real-time factor"}) {
    header.emplace_back(name);
  }
  std::vector<std::vector<std::string>> rows;
  for (const Cell& c : cells) {
    std::vector<std::string> row = c.point;
    row.push_back(c.arm);
    row.push_back(Value(c.falls.exposure, "{:.0f}"));
    row.push_back(std::to_string(c.falls.events));
    row.push_back(std::to_string(c.stuck));
    row.push_back(MetresPerFall(c.falls));
    row.push_back(Value(c.cot_mech_abs, "{:.2f}"));
    row.push_back(Value(c.cot_mech_pos, "{:.2f}"));
    row.push_back(Value(c.cot_electrical, "{:.2f}"));
    row.push_back(Value(c.cot_battery, "{:.2f}"));
    row.push_back(Value(c.tracking.velocity_rmse_mps, "{:.3f}"));
    row.push_back(Value(c.tracking.height_rmse_m * 1e3, "{:.1f}"));
    row.push_back(Value(c.tracking.roll_rmse_rad * kDegrees, "{:.2f}"));
    row.push_back(Value(c.tracking.pitch_rmse_rad * kDegrees, "{:.2f}"));
    row.push_back(fmt::format("{:.0f} / {:.0f}", c.mpc_median_s * 1e6, c.mpc_p99_s * 1e6));
    row.push_back(fmt::format("{:.1f} / {:.1f}", c.wbc_median_s * 1e6, c.wbc_p99_s * 1e6));
    row.push_back(Value(c.real_time_factor, "{:.1f}"));
    rows.push_back(std::move(row));
  }
  page.Table(header, rows);
}

/// Where the motors' work went, per arm.
void AddEnergy(const CampaignResults& results, const std::vector<Cell>& cells, HtmlPage& page) {
  std::vector<std::vector<std::string>> rows;
  for (const Cell& c : cells) {
    const EnergyBudget& b = c.budget;
    if (b.motor_J == 0.0) continue;
    std::vector<std::string> row = c.point;
    row.push_back(c.arm);
    for (const double joules : {b.motor_J, b.external_J, b.joint_J, b.contact_J, b.stored_J})
      row.push_back(fmt::format("{:.0f}", joules));
    row.push_back(fmt::format("{:.2f}", 100.0 * b.error_J / std::abs(b.motor_J)));
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return;
  std::vector<std::string> header;
  for (const Axis& axis : results.axes) header.push_back(axis.label);
  for (const char* name : {"arm", "motors [J]", "outside [J]", "joints [J]", "ground [J]",
                           "stored [J]", "unexplained [% of motors]"}) {
    header.emplace_back(name);
  }
  page.Heading("Energy ledger");
  page.Table(header, rows);
  page.Note(
      "Net mechanical work on the robot; losses are negative. Stored is the change of kinetic and "
      "potential energy. What the works do not explain of it is the integrator's error.");
}

/// Range over the episodes of one number of the ground.
template <class Get>
std::string TerrainRange(const CampaignResults& results, const char* format, Get get) {
  double low = 1e300, high = -1e300;
  for (const EpisodeRecord& e : results.episodes) {
    const double value = get(e.terrain);
    if (!e.has_metrics || std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) return "–";
  const std::string from = fmt::format(fmt::runtime(format), low);
  const std::string to = fmt::format(fmt::runtime(format), high);
  return from == to ? from : from + " to " + to;
}

void AddTerrain(const CampaignResults& results, HtmlPage& page) {
  using terrains::TerrainStatistics;
  std::map<std::string, std::pair<double, int>> materials;  // sum of fractions, grounds with it
  for (const EpisodeRecord& e : results.episodes) {
    for (const auto& [name, fraction] : e.terrain.materials) {
      materials[name].first += fraction;
      ++materials[name].second;
    }
  }
  if (materials.empty()) return;
  page.Heading("Ground, as measured on its grids");
  const auto row = [&](const char* name, const char* format, auto get) {
    return std::vector<std::string>{name, TerrainRange(results, format, get)};
  };
  std::vector<std::vector<std::string>> rows = {
      row("RMS height difference at 0.1 m [m]", "{:.3f}",
          [](const TerrainStatistics& t) { return t.nu_10cm_m; }),
      row("at 0.25 m [m]", "{:.3f}", [](const TerrainStatistics& t) { return t.nu_25cm_m; }),
      row("at 1 m [m]", "{:.3f}", [](const TerrainStatistics& t) { return t.nu_1m_m; }),
      row("Hurst exponent", "{:.2f}", [](const TerrainStatistics& t) { return t.hurst; }),
      row("mean slope at the grid spacing [deg]", "{:.1f}",
          [](const TerrainStatistics& t) { return t.slope_mean_rad * kDegrees; }),
      row("95 % of slopes below [deg]", "{:.1f}",
          [](const TerrainStatistics& t) { return t.slope_95_rad * kDegrees; })};
  for (const auto& [name, sum] : materials)
    rows.push_back(
        {name + " [% of the area]", fmt::format("{:.1f}", 100.0 * sum.first / sum.second)});
  page.Table({"quantity", "value over the episodes"}, rows);
  page.Note(
      "Heights with their mean plane removed; materials in the mean of the grounds that have "
      "them.");
}

void AddFigures(const std::vector<CaptionedFigure>& figures, const fs::path& folder,
                HtmlPage& page) {
  for (const CaptionedFigure& f : figures) {
    try {
      f.figure.Render(folder);
      page.InlineSvg(core::ReadText(folder / (f.figure.name() + ".svg")), f.figure.title(),
                     f.caption);
    } catch (const std::exception& e) {
      page.Paragraph(fmt::format("{}: this figure could not be drawn: {}", f.figure.title(),
                                 core::PrintableText(e.what())));
    }
  }
}

/// The course of single episodes: all of a single run, the first falls of a campaign.
void AddCourses(const CampaignResults& results, const fs::path& figures, HtmlPage& page) {
  constexpr std::size_t kMost = 2;
  std::vector<CaptionedFigure> courses;
  for (const EpisodeRecord& e : results.episodes) {
    const fs::path log = e.folder / "log.mcap";
    const bool wanted = results.single_run || !e.metrics.falls.empty();
    if (!wanted || !fs::exists(log) || courses.size() >= kMost) continue;
    const logs::LogContent content = logs::ReadLog(log, 4);
    if (!content.problem.empty()) page.Note(content.problem);
    if (!content.rows.empty()) courses.push_back(TimeFigure(content, e.id));
  }
  if (courses.empty()) return;
  page.Heading(results.single_run ? "Course" : "The first falls");
  AddFigures(courses, figures, page);
}

/// Wall-clock time of a step by stage, mean over the episodes of each arm.
void AddTimes(const CampaignResults& results, HtmlPage& page) {
  std::map<std::string, std::map<std::string, double>> us;  // by stage and arm
  std::map<std::string, double> episodes, total;
  for (const EpisodeRecord& e : results.episodes) {
    if (!e.has_metrics) continue;
    episodes[e.arm] += 1.0;
    for (const auto& [stage, time_us] : e.us_per_step) {
      us[stage][e.arm] += time_us;
      total[e.arm] += time_us;
    }
  }
  std::vector<std::string> header = {"stage [us per step, share]"};
  header.insert(header.end(), results.arms.begin(), results.arms.end());
  std::vector<std::vector<std::string>> rows;
  for (const auto& [stage, per_arm] : us) {
    std::vector<std::string> row = {stage};
    for (const std::string& arm : results.arms) {
      const double time_us = per_arm.contains(arm) ? per_arm.at(arm) : 0.0;
      row.push_back(episodes[arm] == 0.0 ? "-"
                                         : fmt::format("{:.2f} ({:.0f} %)", time_us / episodes[arm],
                                                       100.0 * time_us / total[arm]));
    }
    rows.push_back(row);
  }
  page.Heading("Where the time goes");
  page.Table(header, rows);
}

void AddVideos(const fs::path& folder, HtmlPage& page) {
  std::vector<std::pair<std::string, std::string>> links;
  for (const auto& entry :
       fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied)) {
    const bool unfinished = entry.path().stem().extension() == ".part";
    if (entry.path().extension() != ".mp4" || unfinished) continue;
    links.emplace_back("../" + fs::relative(entry.path(), folder).string(),
                       entry.path().stem().string());
  }
  if (links.empty()) return;
  std::sort(links.begin(), links.end());
  page.Heading("Videos");
  for (const auto& [path, name] : links) page.Video(path, name);
}

}  // namespace

fs::path WriteReport(const fs::path& folder, const std::optional<ReportPicture>& picture) {
  const CampaignResults results = LoadResults(folder);
  const fs::path out = folder / "report", figures = out / "figures";
  const core::FolderLock lock(out);
  core::CreateFolders(figures);
  const std::vector<Cell> cells = AllCells(results);

  HtmlPage page(results.name);
  std::vector<Comparison> comparisons;
  if (results.arms.size() > 1) comparisons = AllComparisons(results);
  AddHeadline(results, comparisons, picture, page);
  AddVerdicts(comparisons, page);
  AddFailures(results, page);
  auto falls = FallFigures(results);
  for (CaptionedFigure& map : FallMaps(results)) falls.push_back(std::move(map));
  if (!falls.empty()) page.Heading("Falls");
  AddFigures(falls, figures, page);
  page.Heading("Cost of transport");
  AddFigures(CostFigures(results), figures, page);
  page.Heading("Tracking and time");
  AddFigures(ArmFigures(results), figures, page);
  AddCells(results, cells, page);
  AddStateEstimation(results, cells, page);
  AddContactDetection(results, cells, page);
  AddFigures(ContactFigures(results), figures, page);
  AddModelAdaptation(results, cells, page);
  AddBiasBudget(results, page);
  AddFigures(ModelFigures(results), figures, page);
  AddAdaptedTracking(results, page);
  AddEnergy(results, cells, page);
  AddTimes(results, page);
  AddTerrain(results, page);
  AddCourses(results, figures, page);
  AddVideos(folder, page);
  page.Note(
      "Definitions of every number: docs/METRICS.md. Data: metrics.csv (episodes), metrics.json "
      "(cells, comparisons); figures with "
      "their gnuplot scripts: figures/.");
  const fs::path file = out / "report.html";
  core::WriteText(file, page.Finish());
  WriteTables(results, cells, out);
  return file;
}

}  // namespace scoria::analysis
