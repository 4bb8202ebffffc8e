// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/sections/adapted_tracking.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "analysis/report/sections/adaptation.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"
#include "analysis/study/compare.h"

namespace scoria::analysis {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

bool Walked(const CampaignResults& results, const std::string& arm) {
  return std::any_of(results.episodes.begin(), results.episodes.end(),
                     [&](const auto& e) { return e.arm == arm && e.has_metrics; });
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

/// A difference and what it is shown beside.
struct DifferenceLine {
  std::string at;
  TrackingDifference d;
};

std::string PairText(double value, double baseline, double scale, int digits) {
  return fmt::format("{:.{}f} / {:.{}f}", scale * value, digits, scale * baseline, digits);
}

using D = DifferenceLine;
constexpr std::array<Column<D>, 9> kColumns = {{
    {"at", [](const D& l) { return l.at; }},
    {"arms", [](const D& l) { return fmt::format("{} against {}", l.d.arm, l.d.baseline); }},
    {"seeds", [](const D& l) { return std::to_string(l.d.height_difference_m.count); }},
    {"height RMSE [mm]",
     [](const D& l) { return PairText(l.d.height_m, l.d.baseline_height_m, 1e3, 1); }},
    {"difference [mm]",
     [](const D& l) { return FormatDifference(l.d.height_difference_m, 1e3, 1); }},
    {"roll RMSE [deg]",
     [](const D& l) { return PairText(l.d.roll_rad, l.d.baseline_roll_rad, kDegrees, 2); }},
    {"difference [deg]",
     [](const D& l) { return FormatDifference(l.d.roll_difference_rad, kDegrees, 2); }},
    {"pitch RMSE [deg]",
     [](const D& l) { return PairText(l.d.pitch_rad, l.d.baseline_pitch_rad, kDegrees, 2); }},
    {"difference [deg]",
     [](const D& l) { return FormatDifference(l.d.pitch_difference_rad, kDegrees, 2); }},
}};

std::optional<std::string> WhyNot(const ReportInput& input) {
  if (!AnyAdapts(input.results)) return "no arm adapted its model";
  const auto& arms = input.results.arms;
  if (std::all_of(arms.begin(), arms.end(),
                  [&](const auto& a) { return Adapts(input.results, a); }))
    return "every arm adapted its model";
  if (!CompareTracking(input.results).empty()) return std::nullopt;
  return "no seed was walked steadily both with and without adaptation";
}

Blocks Build(const ReportInput& input) {
  std::vector<DifferenceLine> lines;
  for (const TrackingDifference& d : CompareTracking(input.results))
    lines.push_back({PointName(input.results.axes, d.point), d});
  return {TableOf(lines, kColumns),
          Note{"Episodes of the same seed in pairs; those that one of the arms did not walk are "
               "left out. Means over the seeds of the episodes' RMSE over steady walking, with "
               "Student's interval of the mean difference; negative is better than without "
               "adaptation."}};
}

}  // namespace

std::vector<TrackingDifference> CompareTracking(const CampaignResults& results) {
  std::vector<TrackingDifference> all;
  const auto baseline =
      std::find_if(results.arms.begin(), results.arms.end(),
                   [&](const auto& arm) { return Walked(results, arm) && !Adapts(results, arm); });
  if (!AnyAdapts(results) || baseline == results.arms.end()) return all;
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

Section AdaptedTrackingSection() {
  return {"adapted_tracking", "Tracking with and without adaptation", WhyNot, Build};
}

}  // namespace scoria::analysis
