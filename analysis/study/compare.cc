// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/compare.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "analysis/study/fall_groups.h"

namespace scoria::analysis {
namespace {

bool Belongs(const EpisodeRecord& e, const std::string& arm,
             const std::vector<std::string>& point) {
  return e.arm == arm && (point.empty() || e.point == point);
}

bool IsBroken(const EpisodeRecord& e) {
  return !e.has_metrics || e.end == "crashed" || e.end == "non_finite" || e.end == "missing";
}

std::string Verdict(const Comparison& c, const std::string& where) {
  const long total = c.cell_a.falls.events + c.cell_b.falls.events;
  if (total == 0) {
    return fmt::format(
        "{}: neither {} nor {} fell; a rate below one fall per {:.0f} m is all that can be said.",
        where, c.a, c.b, 1.0 / c.cell_a.falls.interval.high);
  }
  // Terrains that treat the arms differently widen the exact interval; nothing ever narrows it.
  constexpr std::size_t kEnoughTerrains = 6;
  const bool spread = c.dispersion.p_value < 0.05 && c.terrains >= kEnoughTerrains;
  Interval interval = c.ratio.interval;
  if (spread)
    interval = {std::min(interval.low, c.bootstrap.low), std::max(interval.high, c.bootstrap.high)};
  const auto times = [](long n) {
    return n == 1 ? std::string("once") : fmt::format("{} times", n);
  };
  const std::string counts = fmt::format("{} fell {} in {:.0f} m, {} {} in {:.0f} m", c.a,
                                         times(c.cell_a.falls.events), c.cell_a.falls.exposure, c.b,
                                         times(c.cell_b.falls.events), c.cell_b.falls.exposure);
  const std::string places = c.places.empty() ? "" : fmt::format("; {}", c.places);
  const auto number = [](double x) {
    return std::isinf(x) ? std::string("∞") : fmt::format("{:.2f}", x);
  };
  const std::string range =
      fmt::format("rate ratio {} (95 %: {} to {}{})", number(c.ratio.ratio), number(interval.low),
                  number(interval.high), spread ? ", by terrain, which differ" : "");
  if (interval.high < 1.0)
    return fmt::format("{}: {} falls less than {}: {}, {}{}.", where, c.a, c.b, counts, range,
                       places);
  if (interval.low > 1.0)
    return fmt::format("{}: {} falls more than {}: {}, {}{}.", where, c.a, c.b, counts, range,
                       places);
  return fmt::format(
      "{}: no difference shown between {} and {}: {}, {}; this budget would have seen a ratio of "
      "{}{}.",
      where, c.a, c.b, counts, range, number(c.detectable), places);
}

}  // namespace

std::string PointName(const std::vector<Axis>& axes, const std::vector<std::string>& point) {
  if (point.empty()) return "all";
  std::string name;
  for (std::size_t i = 0; i < point.size(); ++i) {
    name += fmt::format("{}{} {}", i > 0 ? ", " : "", axes[i].label, point[i]);
  }
  return name;
}

std::string MetresPerFall(const RateEstimate& falls) {
  if (falls.exposure <= 0.0) return "not walked";
  if (falls.events == 0) {
    return fmt::format("> {:.0f} m (no fall in {:.0f} m)", 1.0 / falls.interval.high,
                       falls.exposure);
  }
  return fmt::format("{:.1f} m (95 %: {:.1f} to {:.1f} m)", 1.0 / falls.rate,
                     1.0 / falls.interval.high, 1.0 / falls.interval.low);
}

std::string FormatDifference(const MeanEstimate& e, double scale, int digits) {
  if (e.count == 0) return "–";
  if (e.count == 1) return fmt::format("{:.{}f}", scale * e.mean, digits);
  return fmt::format("{:+.{}f} (95 %: {:+.{}f} to {:+.{}f})", scale * e.mean, digits,
                     scale * e.interval.low, digits, scale * e.interval.high, digits);
}

Cell PoolCell(const CampaignResults& results, const std::string& arm,
              const std::vector<std::string>& point) {
  Cell cell;
  cell.arm = arm;
  cell.point = point;
  long falls = 0;
  double metres = 0.0, work_J = 0.0, mech_abs = 0.0, mech_pos = 0.0, electrical = 0.0,
         battery = 0.0;
  TrackingErrors& t = cell.tracking;
  int counted = 0;
  for (const EpisodeRecord& e : results.episodes) {
    if (!Belongs(e, arm, point)) continue;
    ++cell.episodes;
    if (IsBroken(e)) ++cell.broken;
    if (!e.has_metrics) continue;
    const EpisodeMetrics& m = e.metrics;
    ++counted;
    falls += e.falls;
    cell.stuck += e.stuck;
    metres += m.distance_m;
    work_J += m.transport_J;
    mech_abs += m.energy.mech_abs_J;
    mech_pos += m.energy.mech_pos_J;
    electrical += m.energy.electrical_J;
    battery += m.energy.battery_J;
    cell.budget.motor_J += m.budget.motor_J;
    cell.budget.joint_J += m.budget.joint_J;
    cell.budget.contact_J += m.budget.contact_J;
    cell.budget.external_J += m.budget.external_J;
    cell.budget.stored_J += m.budget.stored_J;
    cell.budget.error_J += m.budget.error_J;
    cell.estimation += m.estimation;
    cell.models.push_back(m.model);
    const double w = m.tracking.samples_s;
    t.samples_s += w;
    const auto add = [w](double& sum, double rmse) { sum += w * rmse * rmse; };
    add(t.velocity_rmse_mps, m.tracking.velocity_rmse_mps);
    add(t.height_rmse_m, m.tracking.height_rmse_m);
    add(t.roll_rmse_rad, m.tracking.roll_rmse_rad);
    add(t.pitch_rmse_rad, m.tracking.pitch_rmse_rad);
    cell.mpc_median_s += m.mpc.median_s;
    cell.wbc_median_s += m.wbc.median_s;
    cell.mpc_p99_s = std::max(cell.mpc_p99_s, m.mpc.p99_s);
    cell.wbc_p99_s = std::max(cell.wbc_p99_s, m.wbc.p99_s);
    cell.real_time_factor += e.real_time_factor;
  }
  cell.falls = EstimateRate(falls, metres);
  if (work_J > 0.0 && metres > kLeastWay_m * counted) {
    cell.cot_mech_abs = mech_abs / work_J;
    cell.cot_mech_pos = mech_pos / work_J;
    cell.cot_electrical = electrical / work_J;
    cell.cot_battery = battery / work_J;
  }
  if (t.samples_s > 0.0) {
    for (double* sum :
         {&t.velocity_rmse_mps, &t.height_rmse_m, &t.roll_rmse_rad, &t.pitch_rmse_rad}) {
      *sum = std::sqrt(*sum / t.samples_s);
    }
  }
  if (counted > 0) {
    cell.mpc_median_s /= counted;
    cell.wbc_median_s /= counted;
    cell.real_time_factor /= counted;
  }
  return cell;
}

/// Grounds that the arms walked at a point.
std::size_t CountGrounds(const CampaignResults& results, const std::vector<std::string>& arms,
                         const std::vector<std::string>& point) {
  std::set<std::string> grounds;
  for (const EpisodeRecord& e : results.episodes) {
    const bool wanted = std::any_of(arms.begin(), arms.end(),
                                    [&](const std::string& arm) { return Belongs(e, arm, point); });
    if (wanted && e.has_metrics) grounds.insert(e.ground);
  }
  return grounds.size();
}

Comparison Compare(const CampaignResults& results, const std::string& a, const std::string& b,
                   const std::vector<std::string>& point) {
  Comparison c;
  c.a = a;
  c.b = b;
  c.point = point;
  c.cell_a = PoolCell(results, a, point);
  c.cell_b = PoolCell(results, b, point);
  c.ratio = EstimateRateRatio(c.cell_a.falls, c.cell_b.falls);
  std::map<std::uint64_t, PairedCounts> by_seed;  // a seed is a terrain, shared by the arms
  for (const EpisodeRecord& e : results.episodes) {
    if (!e.has_metrics) continue;
    PairedCounts& pair = by_seed[e.seed];
    if (Belongs(e, a, point)) {
      pair.events_a += e.falls;
      pair.exposure_a += e.metrics.distance_m;
    } else if (Belongs(e, b, point)) {
      pair.events_b += e.falls;
      pair.exposure_b += e.metrics.distance_m;
    }
  }
  std::vector<PairedCounts> terrains;
  for (const auto& [seed, pair] : by_seed) {
    if (pair.exposure_a <= 0.0 || pair.exposure_b <= 0.0) continue;
    terrains.push_back(pair);
  }
  constexpr std::uint64_t kBootstrapSeed = 20251017;
  c.terrains = terrains.size();
  c.dispersion = CheckShares(terrains);
  c.bootstrap = BootstrapRateRatio(terrains, kBootstrapSeed);
  const double lower_rate = std::min(c.cell_a.falls.rate, c.cell_b.falls.rate);
  const double reference =
      lower_rate > 0.0 ? lower_rate : std::max(c.cell_a.falls.rate, c.cell_b.falls.rate);
  c.detectable =
      DetectableRatio(reference, std::min(c.cell_a.falls.exposure, c.cell_b.falls.exposure));
  c.places =
      DescribeGroups(GroupFalls(results, {a, b}, point), CountGrounds(results, {a, b}, point));
  c.verdict = Verdict(c, point.empty() ? "Whole sweep" : PointName(results.axes, point));
  return c;
}

std::vector<Cell> AllCells(const CampaignResults& results) {
  std::vector<Cell> cells;
  for (const auto& point : AllPoints(results.axes)) {
    for (const std::string& arm : results.arms) cells.push_back(PoolCell(results, arm, point));
  }
  return cells;
}

std::vector<Comparison> AllComparisons(const CampaignResults& results) {
  std::vector<Comparison> all;
  std::vector<std::vector<std::string>> points = {{}};
  if (!results.axes.empty()) {
    const auto each = AllPoints(results.axes);
    points.insert(points.end(), each.begin(), each.end());
  }
  for (const auto& point : points) {
    for (std::size_t a = 1; a < results.arms.size(); ++a)
      all.push_back(Compare(results, results.arms[0], results.arms[a], point));
  }
  return all;
}

}  // namespace scoria::analysis
