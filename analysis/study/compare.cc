// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/compare.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "analysis/study/fall_groups.h"

namespace scoria::analysis {
namespace {

bool IsBroken(const EpisodeRecord& e) {
  return !e.has_metrics || e.end == "crashed" || e.end == "non_finite" || e.end == "missing";
}

RateEstimate PoolFalls(const CampaignResults& results, const std::string& arm,
                       const std::vector<std::string>& point) {
  long falls = 0;
  double metres = 0.0;
  for (const EpisodeRecord& e : results.episodes) {
    if (!Belongs(e, arm, point) || !e.has_metrics || !e.metrics.outcome) continue;
    falls += e.metrics.outcome->falls;
    metres += e.metrics.distance_m;
  }
  return EstimateRate(falls, metres);
}

std::string Verdict(const Comparison& c, const std::string& where) {
  for (const auto& [arm, falls] : {std::pair(c.a, c.falls_a), std::pair(c.b, c.falls_b)}) {
    if (falls.exposure <= 0.0)
      return fmt::format("{}: falls of {} and {} are not compared: {} has no metres.", where, c.a,
                         c.b, arm);
  }
  const long total = c.falls_a.events + c.falls_b.events;
  if (total == 0) {
    return fmt::format(
        "{}: neither {} nor {} fell; a rate below one fall per {:.0f} m is all that can be said.",
        where, c.a, c.b, 1.0 / c.falls_a.interval.high);
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
  const std::string counts =
      fmt::format("{} fell {} in {:.0f} m, {} {} in {:.0f} m", c.a, times(c.falls_a.events),
                  c.falls_a.exposure, c.b, times(c.falls_b.events), c.falls_b.exposure);
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

/// By seed: a seed is a terrain, shared by the arms.
std::vector<PairedCounts> CountByTerrain(const CampaignResults& results, const std::string& a,
                                         const std::string& b,
                                         const std::vector<std::string>& point) {
  std::map<std::uint64_t, PairedCounts> by_seed;
  for (const EpisodeRecord& e : results.episodes) {
    if (!e.has_metrics || !e.metrics.outcome) continue;
    PairedCounts& pair = by_seed[e.seed];
    if (Belongs(e, a, point)) {
      pair.events_a += e.metrics.outcome->falls;
      pair.exposure_a += e.metrics.distance_m;
    } else if (Belongs(e, b, point)) {
      pair.events_b += e.metrics.outcome->falls;
      pair.exposure_b += e.metrics.distance_m;
    }
  }
  std::vector<PairedCounts> terrains;
  for (const auto& [seed, pair] : by_seed) {
    if (pair.exposure_a > 0.0 && pair.exposure_b > 0.0) terrains.push_back(pair);
  }
  return terrains;
}

}  // namespace

bool Belongs(const EpisodeRecord& e, const std::string& arm,
             const std::vector<std::string>& point) {
  return e.arm == arm && (point.empty() || e.point == point);
}

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

std::string MetresPerFall(const Cell& cell) {
  return cell.values.contains("falls") ? MetresPerFall(cell.falls) : "–";
}

std::string FormatDifference(const MeanEstimate& e, double scale, int digits) {
  if (e.count == 0) return "–";
  if (e.count == 1) return fmt::format("{:.{}f}", scale * e.mean, digits);
  return fmt::format("{:+.{}f} (95 %: {:+.{}f} to {:+.{}f})", scale * e.mean, digits,
                     scale * e.interval.low, digits, scale * e.interval.high, digits);
}

Cell PoolCell(const CampaignResults& results, const std::string& arm,
              const std::vector<std::string>& point, const Metrics& metrics) {
  Cell cell;
  cell.arm = arm;
  cell.point = point;
  cell.falls = PoolFalls(results, arm, point);
  std::vector<const EpisodeMetrics*> episodes;
  for (const EpisodeRecord& e : results.episodes) {
    if (!Belongs(e, arm, point)) continue;
    ++cell.episodes;
    if (IsBroken(e)) ++cell.broken;
    if (!e.has_metrics) continue;
    episodes.push_back(&e.metrics);
    cell.models.push_back(e.metrics.model);
    if (cell.sum) {
      *cell.sum += e.metrics;
    } else {
      cell.sum = e.metrics;
    }
  }
  if (cell.sum) cell.values = PoolValues(metrics, *cell.sum, episodes);
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
  c.falls_a = PoolFalls(results, a, point);
  c.falls_b = PoolFalls(results, b, point);
  c.ratio = EstimateRateRatio(c.falls_a, c.falls_b);
  const std::vector<PairedCounts> terrains = CountByTerrain(results, a, b, point);
  constexpr std::uint64_t kBootstrapSeed = 20251017;
  c.terrains = terrains.size();
  c.dispersion = CheckShares(terrains);
  c.bootstrap = BootstrapRateRatio(terrains, kBootstrapSeed);
  const double lower_rate = std::min(c.falls_a.rate, c.falls_b.rate);
  const double reference = lower_rate > 0.0 ? lower_rate : std::max(c.falls_a.rate, c.falls_b.rate);
  c.detectable = DetectableRatio(reference, std::min(c.falls_a.exposure, c.falls_b.exposure));
  c.places =
      DescribeGroups(GroupFalls(results, {a, b}, point), CountGrounds(results, {a, b}, point));
  c.verdict = Verdict(c, point.empty() ? "Whole sweep" : PointName(results.axes, point));
  return c;
}

std::vector<Cell> AllCells(const CampaignResults& results, const Metrics& metrics) {
  std::vector<Cell> cells;
  for (const auto& point : AllPoints(results.axes)) {
    for (const std::string& arm : results.arms)
      cells.push_back(PoolCell(results, arm, point, metrics));
  }
  return cells;
}

std::vector<std::vector<std::string>> SweepAndPoints(const std::vector<Axis>& axes) {
  std::vector<std::vector<std::string>> points = {{}};
  if (axes.empty()) return points;
  const auto each = AllPoints(axes);
  points.insert(points.end(), each.begin(), each.end());
  return points;
}

std::vector<Comparison> AllComparisons(const CampaignResults& results) {
  std::vector<Comparison> all;
  for (const auto& point : SweepAndPoints(results.axes)) {
    for (std::size_t a = 1; a < results.arms.size(); ++a)
      all.push_back(Compare(results, results.arms[0], results.arms[a], point));
  }
  return all;
}

}  // namespace scoria::analysis
