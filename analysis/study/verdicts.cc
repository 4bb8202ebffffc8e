// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/verdicts.h"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace scoria::analysis {
namespace {

std::string Times(long n) { return n == 1 ? "once" : fmt::format("{} times", n); }

std::string Number(double x) { return std::isinf(x) ? "∞" : fmt::format("{:.2f}", x); }

/// "rate ratio 0.92 (95 %: 0.41 to 2.04, by terrain, which differ)".
std::string RatioText(const Comparison& c) {
  const RatioEstimate& judged = c.rates.judged;
  return fmt::format("rate ratio {} (95 %: {} to {}{})", Number(judged.ratio),
                     Number(judged.interval.low), Number(judged.interval.high),
                     c.rates.over_dispersed ? ", by terrain, which differ" : "");
}

std::string CountsText(const Comparison& c) {
  return fmt::format("{} fell {} in {:.0f} m, {} {} in {:.0f} m", c.a, Times(c.falls_a.events),
                     c.falls_a.exposure, c.b, Times(c.falls_b.events), c.falls_b.exposure);
}

/// What there is to say before any test; empty where falls can be compared.
std::string WhyNotCompared(const Comparison& c) {
  for (const auto& [arm, falls] : {std::pair(c.a, c.falls_a), std::pair(c.b, c.falls_b)}) {
    if (falls.exposure <= 0.0)
      return fmt::format("falls of {} and {} are not compared: {} has no metres", c.a, c.b, arm);
  }
  if (c.falls_a.events + c.falls_b.events > 0) return "";
  return fmt::format(
      "no evidence: neither {} nor {} fell; a rate below one fall per {:.0f} m is all that can be "
      "said",
      c.a, c.b, 1.0 / c.falls_a.interval.high);
}

/// "a, b, c, d and 12 more".
std::string ListText(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 6;
  const std::size_t shown = names.size() <= kMost + 1 ? names.size() : kMost;
  const std::vector<std::string> first(names.begin(),
                                       names.begin() + static_cast<std::ptrdiff_t>(shown));
  const std::string list = fmt::format("{}", fmt::join(first, ", "));
  return shown == names.size() ? list : fmt::format("{} and {} more", list, names.size() - shown);
}

}  // namespace

std::string FallVerdict(const Comparison& c, const std::string& where) {
  if (const std::string why = WhyNotCompared(c); !why.empty())
    return fmt::format("{}: {}.", where, why);
  const std::string places = c.places.empty() ? "" : fmt::format("; {}", c.places);
  if (ShowsDifference(c)) {
    const char* more = c.rates.judged.interval.high < 1.0 ? "less" : "more";
    return fmt::format("{}: {} falls {} than {}: {}, {}{}.", where, c.a, more, c.b, CountsText(c),
                       RatioText(c), places);
  }
  return fmt::format(
      "{}: no evidence that {} falls more or less than {}: {}, {}; this budget would have seen a "
      "ratio of {}{}.",
      where, c.a, c.b, CountsText(c), RatioText(c), Number(c.detectable), places);
}

std::string NoEvidenceVerdict(std::span<const Comparison> comparisons, const std::string& where) {
  std::vector<const Comparison*> none;
  for (const Comparison& c : comparisons) {
    if (!ShowsDifference(c)) none.push_back(&c);
  }
  if (none.empty()) return "";
  if (none.size() == 1) return FallVerdict(*none.front(), where);
  std::string list;
  for (const Comparison* c : none) {
    const std::string why = WhyNotCompared(*c);
    list += fmt::format("{}{}", list.empty() ? "" : "; ",
                        why.empty() ? fmt::format("{} against {}: {}, {}", c->a, c->b,
                                                  CountsText(*c), RatioText(*c))
                                    : why);
  }
  return fmt::format("{}: no evidence of a difference in falls: {}.", where, list);
}

std::string MetricVerdict(const ArmDifferences& d) {
  std::vector<std::string> better, worse;
  int none = 0;
  for (const MetricDifference& m : d.metrics) {
    const Judgement judgement = Judge(m);
    if (judgement == Judgement::kBetter) better.emplace_back(m.metric.title);
    if (judgement == Judgement::kWorse) worse.emplace_back(m.metric.title);
    if (judgement == Judgement::kNoneShown) ++none;
  }
  if (better.empty() && worse.empty() && none == 0) return "";
  std::string text = fmt::format("{} against {}: ", d.arm, d.baseline);
  if (!better.empty()) text += fmt::format("better in {}; ", ListText(better));
  if (!worse.empty()) text += fmt::format("worse in {}; ", ListText(worse));
  const bool some = !better.empty() || !worse.empty();
  return text + fmt::format("no evidence of a difference in {} {}metrics (5 %, Holm).", none,
                            some ? "other " : "");
}

}  // namespace scoria::analysis
