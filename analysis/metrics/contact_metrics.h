// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "analysis/statistics/histogram.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Who is judged on whether a foot is on the ground.
enum class ContactWord { kCounted, kSensor, kObserver, kPlan };
inline constexpr std::size_t kNumContactWords = 4;
constexpr std::array<std::pair<ContactWord, std::string_view>, kNumContactWords> EnumNames(
    ContactWord) {
  return {{{ContactWord::kCounted, "counted"},
           {ContactWord::kSensor, "sensor"},
           {ContactWord::kObserver, "observer"},
           {ContactWord::kPlan, "gait_plan"}}};
}

/// Delays on the grid of the rows, negative when early; beyond ±0.25 s they count at the end.
class DelayHistogram {
 public:
  static constexpr double kBin_s = 0.002;
  static constexpr std::size_t kBins = 251;

  void Add(double delay_s) noexcept;
  /// @param share in [0, 1]. @returns 0 without delays.
  [[nodiscard]] double Quantile(double share) const noexcept;
  [[nodiscard]] std::uint64_t count() const noexcept { return bins.Total(); }
  DelayHistogram& operator+=(const DelayHistogram& other) noexcept;
  bool operator==(const DelayHistogram&) const = default;

  BinCounts<kBins> bins;
};

/// How one kind of edge, touchdown or lift-off, was reported.
struct EdgeQuality {
  DelayHistogram delays;  // reported minus true
  std::uint64_t missed = 0, false_alarms = 0;
  [[nodiscard]] std::uint64_t true_edges() const noexcept { return delays.count() + missed; }
  EdgeQuality& operator+=(const EdgeQuality& other) noexcept;
  bool operator==(const EdgeQuality&) const = default;
};

/// One source's word against the truth, all legs together.
struct ContactQuality {
  bool spoke = false;     // it ever said "contact"
  bool differed = false;  // it ever said anything but the truth
  // Rows of legs outside ±15 ms of the true edges, and those on which the source was right.
  std::uint64_t stance_rows = 0, stance_right = 0, swing_rows = 0, swing_right = 0;
  EdgeQuality touchdown, liftoff;
  /// @returns NaN without rows; likewise the two below.
  [[nodiscard]] double Accuracy() const noexcept;
  [[nodiscard]] double TruePositiveRate() const noexcept;
  [[nodiscard]] double FalsePositiveRate() const noexcept;
  ContactQuality& operator+=(const ContactQuality& other) noexcept;
  bool operator==(const ContactQuality&) const = default;
};

/// A point of the receiver operating characteristic.
struct RocPoint {
  double false_positive_rate = 0.0, true_positive_rate = 0.0;
};

/// A source's continuous evidence for contact, counted apart for true stance and true swing. The
/// curve does not change under monotone maps of the evidence, so the bins are spaced to separate
/// values at both ends: probabilities by log-odds, sensor counts by octaves.
struct Evidence {
  static constexpr std::size_t kBins = 256;
  BinCounts<kBins> stance, swing;
  [[nodiscard]] static std::size_t BinOfProbability(double probability) noexcept;
  [[nodiscard]] static std::size_t BinOfCounts(double counts) noexcept;
  /// From (0, 0) to (1, 1), the threshold falling; empty without stance or without swing, or if the
  /// evidence never varied.
  [[nodiscard]] std::vector<RocPoint> Curve() const;
  /// Area under the curve: the probability that stance shows more evidence than swing, ties half.
  /// @returns NaN where there is no curve.
  [[nodiscard]] double Area() const;
  Evidence& operator+=(const Evidence& other) noexcept;
  bool operator==(const Evidence&) const = default;
};

/// Contact detection of an episode, or of several added up.
struct ContactMetrics {
  std::array<ContactQuality, kNumContactWords> words;
  Evidence sensor, observer;
  std::uint64_t leg_rows = 0;
  std::array<std::uint64_t, 4> counted_from{};  // leg rows by ContactSource
  std::uint64_t distrusted_rows = 0, distrusted_times = 0;
  [[nodiscard]] const ContactQuality& of(ContactWord word) const noexcept {
    return words[static_cast<std::size_t>(word)];
  }
  /// Something else than the truth was heard, so that there is something to judge.
  [[nodiscard]] bool HasDetection() const noexcept;
  ContactMetrics& operator+=(const ContactMetrics& other) noexcept;
  bool operator==(const ContactMetrics&) const = default;
};

/// Matches a source's edges with the true ones, one leg and one kind of edge. Written for
/// touchdowns; lift-offs are the touchdowns of the inverted signals.
///   touchdown seen:  the source says contact at the true touchdown, since a moment in this swing
///                    (early), or begins to say so before the foot lifts off (late)
///   missed:          neither
///   false:           the source says contact and takes it back within one true swing, unless the
///                    foot truly touched within 15 ms of it
class EdgeMatcher {
 public:
  struct Instant {
    double time_s = 0.0;
    bool on = false;       // truth, without runs below 10 ms
    bool near_on = false;  // truth with them, anywhere within 15 ms
    bool word = false;
  };
  void Update(const Instant& now, EdgeQuality& quality) noexcept;
  void Reset() noexcept { *this = {}; }

 private:
  bool started_ = false, on_ = false, word_ = false;
  bool swing_seen_ = false;  // from its beginning
  bool rose_ = false;        // in this swing
  bool rose_near_ = false;   // the foot's true touch
  bool waiting_ = false;     // for the word, since the true touchdown
  double rise_s_ = 0.0, touchdown_s_ = 0.0;
};

/// Accumulates rows of any rate while the walking controller is in charge. Looks 15 ms back and
/// ahead, so the first and last 15 ms of a stretch are not judged.
class ContactAccumulator {
 public:
  void AddRow(const logs::LogRow& row);
  /// Rows before and after belong to different stretches.
  void Break() noexcept;
  [[nodiscard]] const ContactMetrics& metrics() const noexcept { return metrics_; }

 private:
  struct Sample {
    double time_s = 0.0;
    std::array<bool, 4> truth{};
    std::array<std::array<bool, 4>, kNumContactWords> words{};
    std::array<double, 4> sensor_counts{}, observer_probability{};
  };
  struct LegMatchers {
    std::array<EdgeMatcher, kNumContactWords> touchdown, liftoff;
  };
  void JudgeNext() noexcept;
  void Compact() noexcept;
  void CountSources(const logs::LogRow& row) noexcept;
  void Judge(std::size_t leg) noexcept;
  void JudgeSteady(std::size_t leg) noexcept;
  void UpdateDebounced(std::size_t leg) noexcept;

  ContactMetrics metrics_;
  std::vector<Sample> window_;  // rows of this stretch; those before first_ are done with
  std::size_t first_ = 0;       // the last row 15 ms before the judged one
  std::size_t judged_ = 0;      // the row to be judged next
  bool has_judged_ = false;     // a row of this stretch
  std::array<LegMatchers, 4> matchers_{};
  std::array<bool, 4> debounced_{};
  std::array<bool, 4> healthy_{true, true, true, true};
};

void to_json(nlohmann::json& j, const ContactMetrics& m);
void from_json(const nlohmann::json& j, ContactMetrics& m);

}  // namespace scoria::analysis
