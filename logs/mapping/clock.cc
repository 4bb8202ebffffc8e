// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/clock.h"

#include <algorithm>

#include <fmt/format.h>

namespace scoria::logs {

void Reservoir::Add(std::int64_t value) {
  ++seen_;
  if (values_.size() < kMost) {
    values_.push_back(value);
    return;
  }
  const std::uint64_t at = random_() % seen_;
  if (at < kMost) values_[at] = value;
}

std::int64_t Reservoir::Quantile(double share) const {
  std::vector<std::int64_t> sorted = values_;
  const auto at = sorted.begin() +
                  static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1) + 0.5);
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

void ClockStatistics::Add(std::int64_t time_ns) {
  if (count_++ > 0) {
    const std::int64_t step = time_ns - last_ns_;
    if (step < 0) ++num_back_;
    largest_step_back_ns_ = std::max(largest_step_back_ns_, -step);
    steps_.Add(step);
  }
  if (count_ == 1) first_ns_ = time_ns;
  largest_ns_ = count_ == 1 ? time_ns : std::max(largest_ns_, time_ns);
  last_ns_ = time_ns;
}

std::optional<std::int64_t> ClockStatistics::MedianStep() const {
  if (steps_.IsEmpty()) return std::nullopt;
  return steps_.Quantile(0.5);
}

std::optional<std::int64_t> ClockStatistics::TypicalStep() const {
  const std::optional<std::int64_t> median = MedianStep();
  if (!median) return std::nullopt;
  const std::int64_t mean = (largest_ns_ - first_ns_) / static_cast<std::int64_t>(count_ - 1);
  return mean > 4 * *median ? mean : *median;
}

std::optional<double> ClockStatistics::Irregularity() const {
  const std::optional<std::int64_t> median = MedianStep();
  if (!median || *median <= 0) return std::nullopt;
  return static_cast<double>(steps_.Quantile(0.95) - steps_.Quantile(0.05)) /
         static_cast<double>(*median);
}

std::optional<ClockChoice> ChooseClock(ClockChoice told,
                                       const std::vector<ClockEvidence>& evidence) {
  const ClockEvidence* best = nullptr;
  for (const ClockChoice clock :
       {ClockChoice::kHeader, ClockChoice::kCounter, ClockChoice::kReceive, ClockChoice::kRow}) {
    for (const ClockEvidence& e : evidence) {
      if (e.clock != clock) continue;
      if (told == clock) return clock;
      const bool goes_back = 100 * e.num_back > e.count;
      if (told != ClockChoice::kAuto || goes_back || (e.count > 1 && !e.irregularity)) continue;
      const bool is_better =
          best == nullptr || e.irregularity.value_or(0.0) < best->irregularity.value_or(0.0);
      if (is_better) best = &e;
    }
  }
  if (best == nullptr) return std::nullopt;
  return best->clock;
}

std::string DescribeClocks(ClockChoice chosen, const std::vector<ClockEvidence>& evidence) {
  const auto describe = [](const ClockEvidence& e) {
    if (!e.step_s) return std::string("one message");
    std::string text = fmt::format("steps of {:.4g} ms", 1e3 * *e.step_s);
    if (e.irregularity) text += fmt::format(", irregularity {:.2g}", *e.irregularity);
    if (e.num_back > 0) text += fmt::format(", goes back {} times", e.num_back);
    return text;
  };
  std::string own, others;
  for (const ClockEvidence& e : evidence) {
    const std::string text = describe(e);
    if (e.clock == chosen) {
      own = text;
    } else {
      others += fmt::format("; {}: {}", core::EnumName(e.clock), text);
    }
  }
  return fmt::format("{} ({}{})", core::EnumName(chosen), own, others);
}

}  // namespace scoria::logs
