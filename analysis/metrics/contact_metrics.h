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

/// Who is judged on whether a foot is on the ground: the fused contact, on which the controller
/// acts, and its sources.
enum class ContactDetector { kFused, kSensor, kObserver, kPlan };
inline constexpr std::size_t kNumContactDetectors = 4;
constexpr std::array<std::pair<ContactDetector, std::string_view>, kNumContactDetectors> EnumNames(
    ContactDetector) {
  return {{{ContactDetector::kFused, "fused"},
           {ContactDetector::kSensor, "sensor"},
           {ContactDetector::kObserver, "observer"},
           {ContactDetector::kPlan, "gait_plan"}}};
}

/// One detector against the truth, all legs together.
struct ContactQuality {
  bool reported = false;  // contact, ever
  bool differed = false;  // from the truth, ever
  // Rows of legs outside ±15 ms of the true edges, and those on which the detector was right.
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
  std::array<ContactQuality, kNumContactDetectors> detectors;
  Evidence sensor, observer;
  std::uint64_t leg_rows = 0;
  std::array<std::uint64_t, 4> fused_from{};  // leg rows by ContactSource
  std::uint64_t sensor_rows = 0;              // leg rows with a foot sensor
  std::uint64_t distrusted_rows = 0, distrusted_times = 0;
  [[nodiscard]] const ContactQuality& of(ContactDetector detector) const noexcept {
    return detectors[static_cast<std::size_t>(detector)];
  }
  /// Something else than the truth was reported, so that there is something to judge.
  [[nodiscard]] bool HasDetection() const noexcept;
  ContactMetrics& operator+=(const ContactMetrics& other) noexcept;
  bool operator==(const ContactMetrics&) const = default;
};

/// Accumulates rows of any rate while the walking controller is in charge. Looks 15 ms back and
/// ahead, so the first and last 15 ms of a stretch are not judged.
class ContactAccumulator {
 public:
  /// Rows without estimated contacts are left out; without true ones only their sources count.
  void AddRow(const logs::Row& row);
  /// Rows before and after belong to different stretches.
  void Break() noexcept;
  [[nodiscard]] const ContactMetrics& metrics() const noexcept { return metrics_; }

 private:
  struct Sample {
    double time_s = 0.0;
    logs::PerLeg<bool> truth{};
    std::array<std::optional<logs::PerLeg<bool>>, kNumContactDetectors> reports{};
    std::optional<logs::PerLeg<double>> sensor_counts, observer_probability;
  };
  struct LegMatchers {
    std::array<EdgeMatcher, kNumContactDetectors> touchdown, liftoff;
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
