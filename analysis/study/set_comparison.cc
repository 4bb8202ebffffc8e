// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/set_comparison.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "analysis/metrics/metric_text.h"
#include "analysis/statistics/multiplicity.h"

namespace scoria::analysis {
namespace {

/// Commands are asked of a walk: they are no outcome of it, and equal ones do not vary.
bool IsCompared(const MetricInfo& info) {
  return info.pooling != Pooling::kSum && info.family != MetricFamily::kTiming &&
         !info.key.starts_with("command_");
}

/// A mean that follows a command, and is compared less that: walks with other commands differ in
/// what was asked of them.
struct Commanded {
  std::string_view key, command, title;
};
constexpr std::array<Commanded, 3> kCommanded = {
    {{"velocity_x_mps", "command_x_mps", "forward velocity less its command"},
     {"velocity_y_mps", "command_y_mps", "lateral velocity less its command"},
     {"yaw_rate_radps", "command_yaw_radps", "yaw rate less its command"}}};

/// A metric as it is compared.
struct Compared {
  MetricInfo info;
  const Metric& metric;
  const Metric* command = nullptr;  // null: it follows none
};

Compared AsCompared(const Metric& metric, const Metrics& metrics) {
  const auto commanded = std::ranges::find(kCommanded, metric.info.key, &Commanded::key);
  if (commanded == kCommanded.end()) return {metric.info, metric};
  const auto command =
      std::ranges::find(metrics, commanded->command, [](const Metric& m) { return m.info.key; });
  if (command == metrics.end()) return {metric.info, metric};
  Compared compared{metric.info, metric, &*command};
  compared.info.title = commanded->title;
  return compared;
}

std::vector<double> ValuesOf(std::span<const ComparedWalk> walks, const Compared& compared) {
  std::vector<double> values;
  for (const ComparedWalk& walk : walks) {
    std::optional<double> value = ValueOf(compared.metric, walk.metrics);
    if (value && compared.command != nullptr)
      *value -= ValueOf(*compared.command, walk.metrics).value_or(0.0);
    if (value) values.push_back(*value);
  }
  return values;
}

/// Phases of the gait: shares of a turn, of which 0 and 1 are the same.
bool IsOnCircle(const MetricInfo& info) { return info.key.starts_with("phase_"); }

/// Turns values until all lie within half a turn of the mean direction, which is in (-1/2, 1/2].
void Unwrap(std::vector<double>& a, std::vector<double>& b) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  std::complex<double> sum;
  for (const std::vector<double>* values : {&a, &b}) {
    for (const double value : *values) sum += std::polar(1.0, kTurn_rad * value);
  }
  const double mean = std::arg(sum) / kTurn_rad;
  for (std::vector<double>* values : {&a, &b}) {
    for (double& value : *values) value -= std::round(value - mean);
  }
}

/// Of the walks that have the signal.
std::vector<double> QuantilesOf(std::span<const ComparedWalk> walks, Signal signal, double share) {
  std::vector<double> values;
  for (const ComparedWalk& walk : walks) {
    const auto found = walk.signals.find(signal);
    if (found != walk.signals.end()) values.push_back(found->second.Quantile(share));
  }
  return values;
}

/// Groups that the logs of some walks have, and something else stands in for in others.
logs::RowGroups MixedSources(std::span<const ComparedWalk> a, std::span<const ComparedWalk> b) {
  logs::RowGroups stand_in, own;
  for (const auto& walks : {a, b}) {
    for (const ComparedWalk& walk : walks) {
      logs::RowGroups replaced;
      for (const auto& [group, source] : walk.metrics.substitutes)
        replaced.set(static_cast<std::size_t>(group));
      stand_in |= replaced;
      own |= ~replaced;
    }
  }
  return stand_in & own;
}

/// Errors and costs, of which less is better, and signals are magnitudes. One that is zero in some
/// walk, as falls are, has no logarithm.
TwoSamples CompareValues(const std::vector<double>& a, const std::vector<double>& b,
                         bool is_magnitude) {
  const auto positive = [](double value) { return value > 0.0; };
  return is_magnitude && std::ranges::all_of(a, positive) && std::ranges::all_of(b, positive)
             ? CompareMagnitudes(a, b)
             : CompareSamples(a, b);
}

std::optional<SignalDifference> CompareSignal(std::span<const ComparedWalk> a,
                                              std::span<const ComparedWalk> b, Signal signal) {
  SignalDifference out{
      .signal = signal, .info = InfoOf(signal), .quantiles = {}, .p = {}, .p_adjusted = {}};
  double tested = 0.0;
  for (const double share : kComparedShares) {
    const std::vector<double> of_a = QuantilesOf(a, signal, share),
                              of_b = QuantilesOf(b, signal, share);
    if (of_a.empty() || of_b.empty()) return std::nullopt;
    out.quantiles.push_back({share, CompareValues(of_a, of_b, true)});
    if (out.quantiles.back().samples.p) ++tested;
  }
  if (const QuantileDifference* strongest = out.Strongest())
    out.p = std::min(1.0, tested * *strongest->samples.p);
  return out;
}

/// The p-values of all that is tested become those of one family.
void AdjustFamily(SetComparison& all) {
  std::vector<double> p;
  const auto for_each = [&](const auto& take) {
    for (SetDifference& d : all.metrics) take(d.samples.p, d.p_adjusted);
    for (SignalDifference& d : all.signals) take(d.p, d.p_adjusted);
  };
  for_each([&](const std::optional<double>& own, std::optional<double>&) {
    if (own) p.push_back(*own);
  });
  const std::vector<double> adjusted = AdjustHolm(p);
  auto next = adjusted.begin();
  for_each([&](const std::optional<double>& own, std::optional<double>& of_family) {
    if (own) of_family = *next++;
  });
}

std::string Shown(const MetricInfo& info, double value) {
  const std::string_view unit = ShownUnit(info);
  return ShownNumber(info, value) + (unit.empty() ? "" : fmt::format(" {}", unit));
}

/// Why there is no test.
std::string DescribeUntested(std::string_view title, const TwoSamples& s, const std::string& a,
                             const std::string& b) {
  if (s.count_a + s.count_b < 3)
    return fmt::format("{}: {} and {}; with a walk on each side, how much walks vary is not known",
                       title, a, b);
  return fmt::format(
      "{}: {} and {}; it does not vary within the sets, so that there is nothing to test with",
      title, a, b);
}

}  // namespace

const QuantileDifference* SignalDifference::Strongest() const noexcept {
  const QuantileDifference* strongest = nullptr;
  for (const QuantileDifference& q : quantiles) {
    if (q.samples.p && (strongest == nullptr || *q.samples.p < *strongest->samples.p))
      strongest = &q;
  }
  return strongest;
}

SetComparison CompareSets(std::span<const ComparedWalk> a, std::span<const ComparedWalk> b,
                          const Metrics& metrics) {
  const logs::RowGroups mixed = MixedSources(a, b);
  SetComparison out;
  for (const Metric& metric : metrics) {
    if (!IsCompared(metric.info)) continue;
    const Compared compared = AsCompared(metric, metrics);
    std::vector<double> of_a = ValuesOf(a, compared), of_b = ValuesOf(b, compared);
    if (of_a.empty() || of_b.empty()) continue;
    if (IsOnCircle(metric.info)) Unwrap(of_a, of_b);
    if ((metric.info.needs & mixed).any()) {
      out.other_sources.push_back(metric.info);
    } else {
      out.metrics.push_back(
          {compared.info, CompareValues(of_a, of_b, metric.info.better == Better::kLower), {}});
    }
  }
  for (const auto& [signal, name] : EnumNames(Signal{})) {
    std::optional<SignalDifference> found = CompareSignal(a, b, signal);
    if (!found) continue;
    if ((found->info.needs & mixed).any()) {
      out.other_sources.push_back(found->info);
    } else {
      out.signals.push_back(std::move(*found));
    }
  }
  AdjustFamily(out);
  return out;
}

bool IsDifferent(const std::optional<double>& p_adjusted, double alpha) noexcept {
  return p_adjusted && *p_adjusted <= alpha;
}

std::string DescribeDifference(const SetDifference& d, double alpha) {
  const TwoSamples& s = d.samples;
  const std::string a = Shown(d.metric, s.mean_a), b = Shown(d.metric, s.mean_b);
  if (!s.p) return DescribeUntested(d.metric.title, s, a, b);
  if (!IsDifferent(d.p_adjusted, alpha))
    return fmt::format("{}: no evidence of a difference, {} and {} (p = {:.2g} over all)",
                       d.metric.title, a, b, *d.p_adjusted);
  return fmt::format(
      "{} is {} in the second: {}, not {} ({:.1f} deviations of a walk, p = {:.2g} over all)",
      d.metric.title, s.mean_b > s.mean_a ? "larger" : "smaller", b, a, std::abs(*s.effect),
      *d.p_adjusted);
}

std::string DescribeDifference(const SignalDifference& d, double alpha) {
  const QuantileDifference* q = d.Strongest();
  const auto text = [&](double value) { return Shown(d.info, value); };
  if (q == nullptr) {
    const TwoSamples& median = d.quantiles[d.quantiles.size() / 2].samples;
    return DescribeUntested(fmt::format("distribution of {}, median", d.info.title), median,
                            text(median.mean_a), text(median.mean_b));
  }
  const TwoSamples& s = q->samples;
  const std::string of = fmt::format("{:.0f} % quantile of {}", 100.0 * q->share, d.info.title);
  if (!IsDifferent(d.p_adjusted, alpha))
    return fmt::format(
        "distribution of {}: no evidence of a difference; furthest apart is the {:.0f} % quantile, "
        "{} and {} (p = {:.2g} over all)",
        d.info.title, 100.0 * q->share, text(s.mean_a), text(s.mean_b), *d.p_adjusted);
  return fmt::format(
      "{} is {} in the second: {}, not {} ({:.1f} deviations of a walk, p = {:.2g} over all)", of,
      s.mean_b > s.mean_a ? "larger" : "smaller", text(s.mean_b), text(s.mean_a),
      std::abs(*s.effect), *d.p_adjusted);
}

}  // namespace scoria::analysis
