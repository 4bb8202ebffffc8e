// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "analysis/signals/contact_edges.h"
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

/// Accumulates rows of any rate while the walking controller is in charge. Looks 15 ms back and
/// ahead, so the first and last 15 ms of a stretch are not judged.
class ContactAccumulator {
 public:
  /// Rows without true or estimated contacts are left out.
  void AddRow(const logs::Row& row);
  /// Rows before and after belong to different stretches.
  void Break() noexcept;
  [[nodiscard]] const ContactMetrics& metrics() const noexcept { return metrics_; }

 private:
  struct Sample {
    double time_s = 0.0;
    logs::PerLeg<bool> truth{};
    std::array<std::optional<logs::PerLeg<bool>>, kNumContactWords> words{};
    std::optional<logs::PerLeg<double>> sensor_counts, observer_probability;
  };
  struct LegMatchers {
    std::array<EdgeMatcher, kNumContactWords> touchdown, liftoff;
  };
  void JudgeNext() noexcept;
  void Compact() noexcept;
  void CountSources(const logs::ContactsRow& contacts) noexcept;
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
