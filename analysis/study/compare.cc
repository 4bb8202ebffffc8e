// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/compare.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "analysis/statistics/multiplicity.h"
#include "analysis/statistics/sequential_sign_test.h"
#include "analysis/study/fall_groups.h"
#include "analysis/study/lifetimes.h"
#include "analysis/study/verdicts.h"

namespace scoria::analysis {
namespace {

bool IsBroken(const EpisodeRecord& e) {
  return !e.has_metrics || e.end == "crashed" || e.end == "non_finite" || e.end == "missing";
}

/// In the order of the seeds, which is that of a campaign.
double TestAnyTime(const std::vector<PairedCounts>& terrains) {
  SequentialSignTest test;
  for (const PairedCounts& terrain : terrains) test.Add(ExcessOfA(terrain));
  return test.evidence().p_value();
}

/// Those over the whole sweep are one family of tests, those at its points another.
void AdjustForMany(std::vector<Comparison>& all, bool whole_sweep) {
  std::vector<Comparison*> family;
  std::vector<double> p;
  for (Comparison& c : all) {
    if (c.point.empty() != whole_sweep) continue;
    family.push_back(&c);
    p.push_back(c.rates.judged.p_value);
  }
  const std::vector<double> holm = AdjustHolm(p), false_discovery = AdjustFalseDiscovery(p);
  for (std::size_t i = 0; i < family.size(); ++i) {
    family[i]->holm = holm[i];
    family[i]->false_discovery = false_discovery[i];
  }
}

}  // namespace

bool Belongs(const EpisodeRecord& e, const std::string& arm,
             const std::vector<std::string>& point) {
  return e.arm == arm && (point.empty() || e.point == point);
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
                   const std::vector<std::string>& point, const TestGoal& goal) {
  Comparison c;
  c.a = a;
  c.b = b;
  c.point = point;
  c.falls_a = PoolFalls(results, a, point);
  c.falls_b = PoolFalls(results, b, point);
  const std::vector<PairedCounts> terrains = CountByTerrain(results, a, b, point);
  c.terrains = terrains.size();
  c.rates = CompareRates(c.falls_a, c.falls_b, terrains);
  c.p_any_time = TestAnyTime(terrains);
  c.log_rank = CompareLifetimes(results, a, b, point);
  c.detectable = DetectableRatio(LowerRate(c), std::min(c.falls_a.exposure, c.falls_b.exposure),
                                 goal, c.rates.over_dispersed ? c.rates.dispersion.index : 1.0);
  c.places =
      DescribeGroups(GroupFalls(results, {a, b}, point), CountGrounds(results, {a, b}, point));
  c.verdict = FallVerdict(c, point.empty() ? "Whole sweep" : PointName(results.axes, point));
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

std::vector<Comparison> AllComparisons(const CampaignResults& results, const TestGoal& goal) {
  std::vector<Comparison> all;
  for (const auto& point : SweepAndPoints(results.axes)) {
    for (std::size_t a = 1; a < results.arms.size(); ++a)
      all.push_back(Compare(results, results.arms[0], results.arms[a], point, goal));
  }
  AdjustForMany(all, true);
  AdjustForMany(all, false);
  return all;
}

double LowerRate(const Comparison& c) noexcept {
  const double lower = std::min(c.falls_a.rate, c.falls_b.rate);
  return lower > 0.0 ? lower : std::max(c.falls_a.rate, c.falls_b.rate);
}

bool ShowsDifference(const Comparison& c) noexcept {
  return !c.rates.judged.interval.Contains(1.0);
}

}  // namespace scoria::analysis
