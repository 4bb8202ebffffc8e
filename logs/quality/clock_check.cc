// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/clock_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scoria::logs {
namespace {

RowGroups AllGroups() { return RowGroups().set(); }

Finding ClockFinding(Severity severity, FindingKind kind) {
  Finding finding;
  finding.severity = severity;
  finding.kind = kind;
  finding.spoils = AllGroups();
  return finding;
}

Finding SpanFinding(Severity severity, FindingKind kind, const SpanList& spans) {
  Finding finding = ClockFinding(severity, kind);
  finding.spans = spans.spans();
  finding.count = spans.count();
  const TimeSpan longest = spans.longest();
  finding.size = longest.end_s - longest.begin_s;
  return finding;
}

}  // namespace

void ClockCheck::AddRow(const Row& row) {
  const Tick sample = MakeTick(row, subject_.robot);
  ++rows_;
  if (last_s_) {
    AddStep(row.time_s - *last_s_, row.time_s, sample);
  } else {
    first_s_ = row.time_s;
    continuity_.Add(sample, false);
  }
  last_s_ = row.time_s;
}

void ClockCheck::AddStep(double step_s, double time_s, const Tick& sample) {
  using Verdict = Continuity::Verdict;
  const bool is_pause = step_s > std::max(kShortestGap_s, 10.0 * period_s_) && period_s_ > 0.0;
  if (step_s == 0.0) ++repeated_;
  if (step_s >= 0.0 && !is_pause) {
    steps_.Add(std::llround(1e9 * step_s));
    period_s_ += period_s_ == 0.0 ? step_s : 0.02 * (std::min(step_s, 3.0 * period_s_) - period_s_);
    continuity_.Add(sample, true);
    return;
  }
  const Verdict verdict = continuity_.Judge(sample, std::abs(step_s) / std::max(period_s_, 1e-9));
  const TimeSpan span{time_s - step_s, time_s};
  if (verdict == Verdict::kContinues) {
    ++num_clock_steps_;
    if (clock_steps_.size() < kMostSpans) clock_steps_.push_back({time_s, step_s - period_s_});
  } else if (step_s < 0.0) {
    backwards_.Add({span.end_s, span.begin_s});
  } else {
    (verdict == Verdict::kJumps ? gaps_ : unsure_gaps_).Add(span);
    gap_s_ += step_s;
  }
  continuity_.Add(sample, false);
}

std::optional<Finding> ClockCheck::LostSamples() const {
  if (steps_.count() < 50) return std::nullopt;
  const double median_ns = steps_.Quantile_ns(0.5);
  constexpr double kWithin = 0.15;  // of a period
  std::uint64_t regular = 0, lost = 0;
  const int most = static_cast<int>(1e9 * kShortestGap_s / std::max(median_ns, 1.0));
  for (int k = 1; k <= std::clamp(most, 1, 200); ++k) {
    const std::uint64_t steps =
        steps_.CountWithin((k - kWithin) * median_ns, (k + kWithin) * median_ns);
    regular += steps;
    lost += static_cast<std::uint64_t>(k - 1) * steps;
  }
  const double share = static_cast<double>(lost) / static_cast<double>(lost + steps_.count());
  if (static_cast<double>(regular) < 0.95 * static_cast<double>(steps_.count()) || share < 1e-3)
    return std::nullopt;
  Finding finding =
      ClockFinding(share < 0.01 ? Severity::kNote : Severity::kWarning, FindingKind::kLostSamples);
  finding.count = lost;
  finding.size = share;
  finding.evidence = fmt::format(
      "{} samples, {:.2g} % of all, are lost: steps are {:.3g} ms and whole multiples of it", lost,
      100.0 * share, 1e-6 * median_ns);
  return finding;
}

std::optional<Finding> ClockCheck::IrregularTimes() const {
  if (steps_.count() < 50) return std::nullopt;
  const double low = steps_.Quantile_ns(0.05), median = steps_.Quantile_ns(0.5),
               high = steps_.Quantile_ns(0.95);
  if (low > 0.5 * median && high < 2.0 * median + 1.0) return std::nullopt;
  Finding finding = ClockFinding(Severity::kWarning, FindingKind::kIrregularTimes);
  const double span_s = std::max(1e-9, *last_s_ - first_s_ - gap_s_);
  finding.size = static_cast<double>(steps_.count()) / span_s;
  finding.evidence = fmt::format(
      "samples arrive in bursts: steps of {:.3g} to {:.3g} ms (5 to 95 %), median {:.3g} ms, "
      "{:.4g} "
      "samples a second",
      1e-6 * low, 1e-6 * high, 1e-6 * median, *finding.size);
  if (num_clock_steps_ > 0)
    finding.evidence += fmt::format(
        "; {} pauses, after which the robot moves on as if no time had passed: of the delivery, "
        "not "
        "of the log",
        num_clock_steps_);
  finding.repair = "mapping: time.stamp or time.counter, if the messages have a time of their own";
  return finding;
}

std::vector<Finding> ClockCheck::Gaps() const {
  std::vector<Finding> findings;
  if (gaps_.count() > 0) {
    Finding f = SpanFinding(Severity::kWarning, FindingKind::kGap, gaps_);
    f.evidence = fmt::format("{} gaps of together {:.3f} s, the longest {:.1f} ms", gaps_.count(),
                             gaps_.total_s(), 1e3 * *f.size);
    findings.push_back(f);
  }
  if (unsure_gaps_.count() > 0) {
    Finding f = SpanFinding(Severity::kWarning, FindingKind::kGap, unsure_gaps_);
    f.evidence = fmt::format(
        "{} pauses, the longest {:.1f} ms: gaps or steps of the clock, not enough motion to tell",
        unsure_gaps_.count(), 1e3 * *f.size);
    findings.push_back(f);
  }
  return findings;
}

std::vector<Finding> ClockCheck::Conclude(const std::vector<Finding>&) const {
  std::vector<Finding> findings = Gaps();
  const std::optional<Finding> irregular = IrregularTimes();
  for (const ClockStep& step : clock_steps_) {
    if (irregular) break;  // the delivery stops and catches up
    Finding f = ClockFinding(Severity::kError, FindingKind::kClockStep);
    const double before_s = step.time_s - step.size_s;
    f.spans = {{std::min(before_s, step.time_s), std::max(before_s, step.time_s)}};
    f.size = step.size_s;
    f.evidence = fmt::format(
        "the clock steps by {:+.3f} s at {:.3f} s: the robot moves on as if none had passed ({} "
        "steps in all)",
        step.size_s, step.time_s, num_clock_steps_);
    f.repair = "mapping: another clock (time.stamp, time.counter), or cut the log there";
    findings.push_back(f);
  }
  if (backwards_.count() > 0) {
    Finding f = SpanFinding(Severity::kError, FindingKind::kTimeBackwards, backwards_);
    f.evidence = fmt::format("times go back {} times, by {:.3f} s at most", f.count, *f.size);
    f.repair = "mapping: another clock (time.stamp, time.counter)";
    findings.push_back(f);
  }
  if (repeated_ > 0) {
    Finding f = ClockFinding(Severity::kWarning, FindingKind::kRepeatedTimes);
    f.count = repeated_;
    f.evidence = fmt::format("{} of {} rows have the time of the one before", repeated_, rows_);
    findings.push_back(f);
  }
  if (const auto f = LostSamples()) findings.push_back(*f);
  if (irregular) findings.push_back(*irregular);
  return findings;
}

}  // namespace scoria::logs
