// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/sensor_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "logs/quality/plausible.h"

namespace scoria::logs {
namespace {

constexpr std::size_t kJointQ = 0, kJointQd = 1, kFeet = 6;  // in kMeasuredSignals
static_assert(kMeasuredSignals[kJointQ] == SignalId::kJointQ &&
              kMeasuredSignals[kJointQd] == SignalId::kJointQd &&
              kMeasuredSignals[kFeet] == SignalId::kFootForce);

constexpr double kHeld_s = 0.25;           // longer runs of equal samples are a matter of their own
constexpr std::size_t kMostSentinels = 8;  // that are told apart, of a signal

bool CanStick(SignalId signal) {
  switch (signal) {
    case SignalId::kJointQ:
    case SignalId::kJointTau:
    case SignalId::kImuRate:
    case SignalId::kImuAcceleration:
    case SignalId::kFootForce:
    case SignalId::kTruthPosition:
      return true;
    default:
      return false;  // zero where nothing is told, or a flat world's share of one that can
  }
}

bool CanSaturate(SignalId signal) {
  return signal == SignalId::kImuRate || signal == SignalId::kImuAcceleration ||
         signal == SignalId::kJointTau;
}

/// Which leg and joint a number of a signal is of.
void SetPlace(SignalId signal, std::size_t i, Finding& finding) {
  const SignalShape shape = TraitsOf(signal).shape;
  if (shape == SignalShape::kPerJoint) {
    finding.leg = kLegs[i / kJointsPerLeg];
    finding.joint = static_cast<Joint>(i % kJointsPerLeg);
  } else if (shape == SignalShape::kPerLeg) {
    finding.leg = kLegs[i];
  }
}

std::string NameOfNumber(SignalId signal, std::size_t i) {
  const SignalShape shape = TraitsOf(signal).shape;
  if (shape == SignalShape::kVector) return fmt::format("{} ", "xyz"[i]);
  return "";
}

}  // namespace

void SensorCheck::AddRow(const Row& row) {
  if (rows_ == 0) first_s_ = row.time_s;
  step_s_ = rows_ == 0 ? 0.0 : row.time_s - last_s_;
  last_s_ = row.time_s;
  ++rows_;
  for (Signal s = 0; s < kNumSignals; ++s) {
    const std::span<const double> values = ValuesOf(row, kMeasuredSignals[s]);
    if (!values.empty()) AddValues(s, values, row.time_s);
  }
}

void SensorCheck::AddValues(Signal signal, std::span<const double> values, double time_s) {
  sizes_[signal] = values.size();
  AddRepeats(signal, values, time_s);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (IsPlausible(kMeasuredSignals[signal], values[i])) {
      AddValue(signal, i, values[i], time_s);
      continue;
    }
    auto& known = sentinels_[signal];
    // All that is no number counts as one value.
    const double value = std::isnan(values[i]) ? HUGE_VAL : values[i];
    if (!known.contains(value) && known.size() >= kMostSentinels) continue;
    auto [at, is_new] = known.try_emplace(value, Sentinel{value, time_s, time_s, 0});
    at->second.last_s = time_s;
    ++at->second.count;
  }
}

void SensorCheck::AddRepeats(Signal signal, std::span<const double> values, double time_s) {
  Repeats& r = repeats_[signal];
  if (std::equal(values.begin(), values.end(), r.last.begin(), r.last.end())) {
    ++r.run;
    return;
  }
  const double held_s = time_s - r.since_s;
  if (r.run > 0 && held_s >= 0.0 && held_s <= kHeld_s) {
    ++r.runs;
    r.rows += r.run;
    r.span_s += held_s;
  }
  r.last.assign(values.begin(), values.end());
  r.since_s = time_s;
  r.run = 1;
}

double SensorCheck::TravelOfOthers(Signal signal, std::size_t i) const {
  if (sizes_[kJointQ] == 0) return 0.0;
  double sum = 0.0;
  for (std::size_t j = 0; j < sizes_[kJointQ]; ++j) sum += courses_[kJointQ][j].path;
  if (signal != kJointQ) return sum / kNumJoints;
  return (sum - courses_[kJointQ][i].path) / (kNumJoints - 1);
}

bool SensorCheck::IsAtStop(Signal signal, std::size_t i, double value) const {
  if (subject_.robot == nullptr || signal != kJointQ) return false;
  const core::JointDescription& joint =
      subject_.robot->legs[kLegs[i / kJointsPerLeg]].joints[i % kJointsPerLeg];
  return value < joint.lower_rad + kAtStop_rad || value > joint.upper_rad - kAtStop_rad;
}

bool SensorCheck::IsStuck(Signal signal, std::size_t i, double time_s) const {
  const Course& c = courses_[signal][i];
  const bool is_foot = signal == kFeet;
  const double held_s = time_s - c.since_s, other_s = time_s - first_s_ - held_s;
  const double usual = other_s > 0.0 ? c.path / other_s * held_s : 0.0;
  const double least =
      std::max(kOwnTravel * (c.high - c.low), signal == kJointQ ? kOwnTravel_rad : 0.0);
  if (c.runs > 1 && !is_foot && usual < least) return false;
  return CanStick(kMeasuredSignals[signal]) && !IsAtStop(signal, i, c.last.value_or(0.0)) &&
         time_s - c.since_s >= (is_foot ? kFootStuck_s : kStuck_s) &&
         TravelOfOthers(signal, i) - c.travel_then_rad >= (is_foot ? kFootTravel_rad : kTravel_rad);
}

void SensorCheck::EndRun(Signal signal, std::size_t i, double time_s) {
  Course& c = courses_[signal][i];
  if (c.run >= 3 && c.runs > 0) {
    if (*c.last == c.low) ++c.low_runs, c.low_rows += c.run;
    if (*c.last == c.high) ++c.high_runs, c.high_rows += c.run;
  }
  if (IsStuck(signal, i, time_s)) c.stuck.Add({c.since_s, time_s});
}

void SensorCheck::AddValue(Signal signal, std::size_t i, double value, double time_s) {
  Course& c = courses_[signal][i];
  const bool goes_on = step_s_ >= 0.0 && step_s_ < kPause_s;
  if (c.last == value && goes_on) {
    ++c.run;
    return;
  }
  if (c.last) {
    EndRun(signal, i, time_s - step_s_);
    c.path += std::abs(value - *c.last);
  }
  if (!c.last || value < c.low) c.low = value, c.low_runs = 0, c.low_rows = 0;
  if (!c.last || value > c.high) c.high = value, c.high_runs = 0, c.high_rows = 0;
  c.last = value;
  c.since_s = time_s;
  c.travel_then_rad = TravelOfOthers(signal, i);
  c.run = 1;
  ++c.runs;
}

SpanList SensorCheck::StuckSpans(Signal signal, std::size_t i) const {
  const Course& c = courses_[signal][i];
  SpanList spans = c.stuck;
  if (c.last && IsStuck(signal, i, last_s_)) spans.Add({c.since_s, last_s_});  // not yet ended
  return spans;
}

Finding SensorCheck::StuckFinding(Signal signal, std::size_t i, const SpanList& spans) const {
  const SignalId id = kMeasuredSignals[signal];
  const Course& c = courses_[signal][i];
  const TimeSpan longest = spans.longest();
  const bool is_dead = longest.end_s == last_s_ && (c.runs <= 1 || signal == kFeet);
  Finding f = MakeFinding(Severity::kError,
                          is_dead ? FindingKind::kDeadSensor : FindingKind::kStuckSensor, id);
  SetPlace(id, i, f);
  f.spans = spans.spans();
  f.count = spans.count();
  f.size = longest.end_s - longest.begin_s;
  f.evidence = fmt::format("{}stays at {:.6g} for {:.3f} s while the robot moves",
                           NameOfNumber(id, i), *c.last, *f.size);
  if (!is_dead)
    f.evidence = fmt::format("{}does not change for {:.3f} s while the robot moves",
                             NameOfNumber(id, i), *f.size);
  return f;
}

std::vector<Finding> SensorCheck::StuckSensors() const {
  std::vector<Finding> findings;
  for (Signal s = 0; s < kNumSignals; ++s) {
    if (!CanStick(kMeasuredSignals[s])) continue;
    std::vector<Finding> of_signal;
    for (std::size_t i = 0; i < sizes_[s]; ++i) {
      if (const SpanList spans = StuckSpans(s, i); spans.count() > 0)
        of_signal.push_back(StuckFinding(s, i, spans));
    }
    if (of_signal.size() == sizes_[s] && sizes_[s] > 1) {
      Finding whole = of_signal.front();
      whole.leg.reset();
      whole.joint.reset();
      whole.evidence = "all of it: " + whole.evidence;
      if (s == kFeet && whole.kind == FindingKind::kDeadSensor) whole.severity = Severity::kWarning;
      of_signal = {whole};
    }
    findings.insert(findings.end(), of_signal.begin(), of_signal.end());
  }
  return findings;
}

std::vector<Finding> SensorCheck::Sentinels() const {
  std::vector<Finding> findings;
  for (Signal s = 0; s < kNumSignals; ++s) {
    const SignalId id = kMeasuredSignals[s];
    for (const auto& [value, sentinel] : sentinels_[s]) {
      Finding f = MakeFinding(Severity::kError, FindingKind::kSentinel, id);
      f.count = sentinel.count;
      f.spans = {{sentinel.first_s, sentinel.last_s}};
      const bool is_number = std::isfinite(value);
      f.evidence = is_number
                       ? fmt::format("{:.6g}, which no sensor measures, {} times", value, f.count)
                       : fmt::format("no finite number, {} times", f.count);
      if (is_number) f.repair = fmt::format("mapping: {}: {{absent: [{:.6g}]}}", f.signal, value);
      findings.push_back(f);
    }
  }
  return findings;
}

std::vector<Finding> SensorCheck::RepeatedSamples() const {
  std::vector<Finding> findings;
  for (Signal s = 0; s < kNumSignals; ++s) {
    const SignalId id = kMeasuredSignals[s];
    const Repeats& r = repeats_[s];
    // Counts of feet and battery are coarse, so that equal ones follow each other.
    if (id == SignalId::kFootForce || TraitsOf(id).shape == SignalShape::kScalar) continue;
    if (r.runs < 20 || r.span_s <= 0.0) continue;
    const double repeats = static_cast<double>(r.rows) / static_cast<double>(r.runs);
    if (repeats < 1.5) continue;
    Finding f = MakeFinding(repeats < 3.0 ? Severity::kNote : Severity::kWarning,
                            FindingKind::kRepeatedSamples, id);
    f.size = static_cast<double>(r.runs) / r.span_s;
    f.evidence =
        fmt::format("every sample is there {:.1f} times: the true rate is {:.1f} Hz, not {:.1f} Hz",
                    repeats, *f.size, repeats * *f.size);
    findings.push_back(f);
  }
  return findings;
}

std::vector<Finding> SensorCheck::Saturations() const {
  std::vector<Finding> findings;
  for (Signal s = 0; s < kNumSignals; ++s) {
    const SignalId id = kMeasuredSignals[s];
    if (!CanSaturate(id) || repeats_[s].runs == 0) continue;
    const double repeats =
        static_cast<double>(repeats_[s].rows) / static_cast<double>(repeats_[s].runs);
    for (std::size_t i = 0; i < sizes_[s]; ++i) {
      const Course& c = courses_[s][i];
      for (const auto& [value, runs, rows] : {std::tuple(c.low, c.low_runs, c.low_rows),
                                              std::tuple(c.high, c.high_runs, c.high_rows)}) {
        // Three times the end of the range, each for longer than a sample lasts.
        if (runs < 3 || static_cast<double>(rows) < 3.0 * repeats * static_cast<double>(runs) ||
            value == 0.0)
          continue;
        Finding f = MakeFinding(Severity::kWarning, FindingKind::kSaturation, id);
        SetPlace(id, i, f);
        f.count = runs;
        f.size = value;
        f.evidence = fmt::format("{}stays at its extreme {:.6g} {} times, for {} rows in all",
                                 NameOfNumber(id, i), value, runs, rows);
        findings.push_back(f);
      }
    }
  }
  return findings;
}

std::vector<Finding> SensorCheck::Conclude(const std::vector<Finding>&) const {
  std::vector<Finding> findings = Sentinels();
  for (const auto& some : {StuckSensors(), RepeatedSamples(), Saturations()})
    findings.insert(findings.end(), some.begin(), some.end());
  return findings;
}

}  // namespace scoria::logs
