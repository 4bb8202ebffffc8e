// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/contact_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace scoria::analysis {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kReach_s = 0.015;  // of a true edge: within it nobody is judged
constexpr double kRun_s = 0.010;    // shorter true contacts are scuffs, shorter gaps bounces
constexpr double kSameInstant_s = 1e-9;

double Share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? kNan : static_cast<double>(part) / static_cast<double>(whole);
}

/// The bin of a number in the middle of which lies 0; NaN goes to the first.
std::size_t CentredBin(double bins_from_zero) {
  constexpr std::size_t kMiddle = Evidence::kBins / 2;
  const double bin = std::floor(bins_from_zero) + static_cast<double>(kMiddle);
  if (!(bin > 0.0)) return 0;
  return static_cast<std::size_t>(std::min(bin, static_cast<double>(Evidence::kBins - 1)));
}

}  // namespace

double ContactQuality::Accuracy() const noexcept {
  return Share(stance_right + swing_right, stance_rows + swing_rows);
}

double ContactQuality::TruePositiveRate() const noexcept {
  return Share(stance_right, stance_rows);
}

double ContactQuality::FalsePositiveRate() const noexcept {
  return Share(swing_rows - swing_right, swing_rows);
}

ContactQuality& ContactQuality::operator+=(const ContactQuality& other) noexcept {
  reported = reported || other.reported;
  differed = differed || other.differed;
  stance_rows += other.stance_rows;
  stance_right += other.stance_right;
  swing_rows += other.swing_rows;
  swing_right += other.swing_right;
  touchdown += other.touchdown;
  liftoff += other.liftoff;
  return *this;
}

std::size_t Evidence::BinOfProbability(double probability) noexcept {
  constexpr double kBinsPerLogOdds = 5.0;
  return CentredBin(kBinsPerLogOdds * std::log(probability / (1.0 - probability)));
}

std::size_t Evidence::BinOfCounts(double counts) noexcept {
  constexpr double kBinsPerOctave = 8.0;
  return CentredBin(kBinsPerOctave * std::copysign(std::log2(1.0 + std::abs(counts)), counts));
}

std::vector<RocPoint> Evidence::Curve() const {
  const std::uint64_t in_stance = stance.Total(), in_swing = swing.Total();
  if (in_stance == 0 || in_swing == 0) return {};
  std::vector<RocPoint> curve = {{}};
  std::uint64_t above_stance = 0, above_swing = 0;
  for (std::size_t bin = kBins; bin-- > 0;) {
    if (stance.counts[bin] + swing.counts[bin] == 0) continue;
    above_stance += stance.counts[bin];
    above_swing += swing.counts[bin];
    curve.push_back({Share(above_swing, in_swing), Share(above_stance, in_stance)});
  }
  if (curve.size() < 3) return {};
  return curve;
}

double Evidence::Area() const {
  const std::vector<RocPoint> curve = Curve();
  if (curve.empty()) return kNan;
  double area = 0.0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    area += 0.5 * (curve[i].true_positive_rate + curve[i - 1].true_positive_rate) *
            (curve[i].false_positive_rate - curve[i - 1].false_positive_rate);
  }
  return area;
}

Evidence& Evidence::operator+=(const Evidence& other) noexcept {
  stance += other.stance;
  swing += other.swing;
  return *this;
}

bool ContactMetrics::HasDetection() const noexcept {
  return of(ContactDetector::kSensor).reported || of(ContactDetector::kObserver).reported ||
         (of(ContactDetector::kFused).reported && of(ContactDetector::kFused).differed);
}

ContactMetrics& ContactMetrics::operator+=(const ContactMetrics& other) noexcept {
  for (std::size_t i = 0; i < detectors.size(); ++i) detectors[i] += other.detectors[i];
  sensor += other.sensor;
  observer += other.observer;
  leg_rows += other.leg_rows;
  for (std::size_t i = 0; i < fused_from.size(); ++i) fused_from[i] += other.fused_from[i];
  distrusted_rows += other.distrusted_rows;
  distrusted_times += other.distrusted_times;
  sensor_rows += other.sensor_rows;
  return *this;
}

void ContactAccumulator::Break() noexcept {
  window_.clear();
  first_ = judged_ = 0;
  has_judged_ = false;
  for (LegMatchers& leg : matchers_) {
    for (EdgeMatcher& m : leg.touchdown) m.Reset();
    for (EdgeMatcher& m : leg.liftoff) m.Reset();
  }
  healthy_.fill(true);
}

void ContactAccumulator::CountSources(const logs::ContactsRow& contacts) noexcept {
  for (std::size_t leg = 0; leg < 4; ++leg) {
    ++metrics_.leg_rows;
    if (contacts.source) ++metrics_.fused_from[std::min<std::size_t>((*contacts.source)[leg], 3)];
    if (contacts.sensor) ++metrics_.sensor_rows;
    const bool healthy = !contacts.sensor || contacts.sensor->healthy[leg];
    if (!healthy) ++metrics_.distrusted_rows;
    if (!healthy && healthy_[leg]) ++metrics_.distrusted_times;
    healthy_[leg] = healthy;
  }
}

void ContactAccumulator::AddRow(const logs::Row& row) {
  if (!row.contacts) return;
  CountSources(*row.contacts);
  if (!row.true_contacts) return;
  Sample& sample = window_.emplace_back();
  sample.time_s = row.time_s;
  sample.truth = row.true_contacts->contact;
  sample.reports[static_cast<std::size_t>(ContactDetector::kFused)] = row.contacts->contact;
  if (const auto& sensor = row.contacts->sensor) {
    sample.reports[static_cast<std::size_t>(ContactDetector::kSensor)] = sensor->contact;
    sample.sensor_counts = sensor->counts;
  }
  if (const auto& observer = row.contacts->observer) {
    sample.reports[static_cast<std::size_t>(ContactDetector::kObserver)] = observer->contact;
    sample.observer_probability = observer->probability;
  }
  if (row.plan) sample.reports[static_cast<std::size_t>(ContactDetector::kPlan)] = row.plan->stance;
  while (window_[judged_].time_s + kReach_s - kSameInstant_s <= row.time_s) JudgeNext();
}

void ContactAccumulator::JudgeNext() noexcept {
  const double from_s = window_[judged_].time_s - kReach_s + kSameInstant_s;
  while (first_ < judged_ && window_[first_ + 1].time_s <= from_s) ++first_;
  if (window_[first_].time_s <= from_s) {  // else too near to the start of the stretch
    if (!has_judged_) debounced_ = window_[judged_].truth;
    has_judged_ = true;
    for (std::size_t leg = 0; leg < 4; ++leg) Judge(leg);
  }
  ++judged_;
  Compact();
}

/// Forgets rows that are done with, many at a time.
void ContactAccumulator::Compact() noexcept {
  constexpr std::size_t kMany = 256;
  if (first_ < kMany) return;
  window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(first_));
  judged_ -= first_;
  first_ = 0;
}

/// Follows the truth where its new state lasts.
void ContactAccumulator::UpdateDebounced(std::size_t leg) noexcept {
  const bool now = window_[judged_].truth[leg];
  const double until_s = window_[judged_].time_s + kRun_s - kSameInstant_s;
  for (std::size_t i = judged_; i < window_.size() && window_[i].time_s < until_s; ++i) {
    if (window_[i].truth[leg] != now) return;
  }
  debounced_[leg] = now;
}

void ContactAccumulator::Judge(std::size_t leg) noexcept {
  UpdateDebounced(leg);
  bool any_contact = false, any_swing = false;
  for (std::size_t i = first_; i < window_.size(); ++i)
    (window_[i].truth[leg] ? any_contact : any_swing) = true;
  if (any_contact != any_swing) JudgeSteady(leg);
  const Sample& now = window_[judged_];
  for (std::size_t k = 0; k < kNumContactDetectors; ++k) {
    if (!now.reports[k]) continue;
    ContactQuality& q = metrics_.detectors[k];
    const bool contact = (*now.reports[k])[leg], on = debounced_[leg];
    q.reported = q.reported || contact;
    q.differed = q.differed || contact != now.truth[leg];
    matchers_[leg].touchdown[k].Update({now.time_s, on, any_contact, contact}, q.touchdown);
    matchers_[leg].liftoff[k].Update({now.time_s, !on, any_swing, !contact}, q.liftoff);
  }
}

/// A row away from the true edges.
void ContactAccumulator::JudgeSteady(std::size_t leg) noexcept {
  const Sample& now = window_[judged_];
  const bool stance = now.truth[leg];
  for (std::size_t k = 0; k < kNumContactDetectors; ++k) {
    if (!now.reports[k]) continue;
    ContactQuality& q = metrics_.detectors[k];
    ++(stance ? q.stance_rows : q.swing_rows);
    if ((*now.reports[k])[leg] == stance) ++(stance ? q.stance_right : q.swing_right);
  }
  const auto add = [stance](Evidence& e, std::size_t bin) {
    ++(stance ? e.stance : e.swing).counts[bin];
  };
  if (now.sensor_counts) add(metrics_.sensor, Evidence::BinOfCounts((*now.sensor_counts)[leg]));
  if (now.observer_probability)
    add(metrics_.observer, Evidence::BinOfProbability((*now.observer_probability)[leg]));
}

/// One line of "bin:count" pairs without the empty bins, so that a result stays readable.
template <std::size_t N>
void to_json(nlohmann::json& j, const BinCounts<N>& b) {
  std::string pairs;
  for (std::size_t i = 0; i < N; ++i) {
    if (b.counts[i] > 0) pairs += fmt::format("{}{}:{}", pairs.empty() ? "" : " ", i, b.counts[i]);
  }
  j = pairs;
}

template <std::size_t N>
void from_json(const nlohmann::json& j, BinCounts<N>& b) {
  b = {};
  std::istringstream pairs(j.get<std::string>());
  for (std::string text; pairs >> text;) {
    std::istringstream pair(text);
    std::size_t bin = 0;
    char colon = ' ';
    std::uint64_t count = 0;
    if (!(pair >> bin >> colon >> count) || colon != ':' || bin >= N)
      throw std::runtime_error(
          fmt::format("bins: \"{}\": expected bin:count with bin < {}", text, N));
    b.counts[bin] = count;
  }
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DelayHistogram, bins)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EdgeQuality, delays, missed, false_alarms)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Evidence, stance, swing)

void to_json(nlohmann::json& j, const ContactQuality& q) {
  j = {{"reported", q.reported},       {"differed", q.differed},
       {"stance_rows", q.stance_rows}, {"stance_right", q.stance_right},
       {"swing_rows", q.swing_rows},   {"swing_right", q.swing_right},
       {"touchdown", q.touchdown},     {"liftoff", q.liftoff}};
}

void from_json(const nlohmann::json& j, ContactQuality& q) {
  j.at(j.contains("spoke") ? "spoke" : "reported").get_to(q.reported);
  j.at("differed").get_to(q.differed);
  j.at("stance_rows").get_to(q.stance_rows);
  j.at("stance_right").get_to(q.stance_right);
  j.at("swing_rows").get_to(q.swing_rows);
  j.at("swing_right").get_to(q.swing_right);
  j.at("touchdown").get_to(q.touchdown);
  j.at("liftoff").get_to(q.liftoff);
}

void to_json(nlohmann::json& j, const ContactMetrics& m) {
  j = {{"sensor_evidence", m.sensor},
       {"observer_evidence", m.observer},
       {"leg_rows", m.leg_rows},
       {"sensor_rows", m.sensor_rows},
       {"fused_from", m.fused_from},
       {"distrusted_rows", m.distrusted_rows},
       {"distrusted_times", m.distrusted_times}};
  for (const auto& [detector, name] : EnumNames(ContactDetector{}))
    j["detectors"][name] = m.of(detector);
}

/// Results of version 0.1.0 have "words" of "counted" for the detectors and the fused contact.
void from_json(const nlohmann::json& j, ContactMetrics& m) {
  j.at("sensor_evidence").get_to(m.sensor);
  j.at("observer_evidence").get_to(m.observer);
  j.at("leg_rows").get_to(m.leg_rows);
  j.at("distrusted_rows").get_to(m.distrusted_rows);
  j.at("distrusted_times").get_to(m.distrusted_times);
  const bool older = j.contains("words");
  if (!older) j.at("sensor_rows").get_to(m.sensor_rows);
  j.at(older ? "counted_from" : "fused_from").get_to(m.fused_from);
  const nlohmann::json& detectors = j.at(older ? "words" : "detectors");
  for (const auto& [detector, name] : EnumNames(ContactDetector{})) {
    const bool renamed = older && detector == ContactDetector::kFused;
    detectors.at(renamed ? "counted" : std::string(name))
        .get_to(m.detectors[static_cast<std::size_t>(detector)]);
  }
}

}  // namespace scoria::analysis
