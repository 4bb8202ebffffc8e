// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "controller/estimation/force_match.h"
#include "core/config/field.h"

namespace scoria::controller {

struct FootSensorParams {
  double update_s = 0.05;
  double margin_counts = 6.5;
  double min_window_s = 3.0;
  double max_window_s = 2.0;
  double initial_threshold_counts = 18.5;
  double max_threshold_counts = 80.0;
  double noise_counts = 3.0;
  double hysteresis_counts = 1.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("update_s", update_s,
            {.min = 0.01,
             .max = 1.0,
             .doc = "period at which the threshold is set anew",
             .scale = core::dimension::kTime});
    a.Field(
        "margin_counts", margin_counts,
        {.min = 0.0,
         .max = 1000.0,
         .doc = "threshold over the least reading and below the largest, the lower of the two"});
    a.Field("min_window_s", min_window_s,
            {.min = 0.1,
             .max = 5.0,
             .doc = "of the least reading of the foot in the air",
             .scale = core::dimension::kTime});
    a.Field(
        "max_window_s", max_window_s,
        {.min = 0.1, .max = 5.0, .doc = "of the largest reading", .scale = core::dimension::kTime});
    a.Field("initial_threshold_counts", initial_threshold_counts,
            {.min = 0.0, .max = 1e5, .doc = "until the foot was in the air once"});
    a.Field("max_threshold_counts", max_threshold_counts,
            {.min = 0.0, .max = 1e5, .doc = "the threshold never rises beyond"});
    a.Field(
        "noise_counts", noise_counts,
        {.min = 0.0,
         .max = 1000.0,
         .doc = "least distance of the threshold from the reading in the air, however small the "
                "readings' range"});
    a.Field("hysteresis_counts", hysteresis_counts,
            {.min = 0.0, .max = 1000.0, .doc = "contact begins so far above, ends so far below"});
  }
  bool operator==(const FootSensorParams&) const = default;
};

/// Extremum over a moving window, in buckets of update_s; a bucket without samples says nothing.
class WindowExtremum {
 public:
  static constexpr std::size_t kMaxBuckets = 500;
  /// @param sign  +1: maximum, −1: minimum.
  WindowExtremum(std::size_t buckets, double sign) noexcept;
  /// Closes the current bucket with its extremum, or empty.
  void Push(std::optional<double> value) noexcept;
  [[nodiscard]] std::optional<double> value() const noexcept;

 private:
  static constexpr double kEmpty = -std::numeric_limits<double>::infinity();
  std::array<double, kMaxBuckets> signed_;
  std::size_t buckets_, next_ = 0;
  double sign_;
};

/// One foot's pressure sensor: counts of unknown zero and gain to contact.
///
/// Every update_s: threshold = min(least over min_window_s + margin, largest over max_window_s −
/// margin), the reference framework's rule. Differs: the least reading is taken only while the foot
/// is known to be in the air, else the last one stays, so that standing for long, which raises the
/// least reading to the load, does not turn into "no contact"; the threshold stays noise_counts
/// above that least reading, so that a foot that hangs for long does not read as contact, and at
/// most max_threshold_counts; extrema cover all samples, not one per update; and there is
/// hysteresis.
class FootSensor {
 public:
  FootSensor(const FootSensorParams& params, double step_s) noexcept;

  /// @param in_air  other evidence is sure that the foot is unloaded.
  /// @returns contact. A reading that is not finite is none, and changes nothing else.
  bool Update(double raw_counts, bool in_air) noexcept;

  [[nodiscard]] double threshold_counts() const noexcept { return threshold_; }
  /// Reading in the air: of the newest update period that was all in the air. Empty before any.
  [[nodiscard]] std::optional<double> zero_counts() const noexcept { return newest_zero_; }

 private:
  void CloseBucket() noexcept;

  FootSensorParams params_;
  int bucket_ticks_, ticks_ = 0;
  double least_in_air_, largest_;  // of the open bucket
  bool all_in_air_ = true;
  WindowExtremum min_, max_;
  std::optional<double> zero_, newest_zero_;
  double threshold_;
  bool contact_ = false;
};

struct HealthParams {
  double stuck_s = 0.1;
  double stuck_force_N = 25.0;
  double saturated_counts = 1023.0;
  double transition_s = 0.025;
  double sure = 0.75;
  double moving_mps = 0.8;
  double disagree_s = 0.1;
  double forgive = 0.25;
  double drift_counts = 25.0;
  ForceMatchParams match;
  double recover_s = 3.0;
  int recover_transitions = 6;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("stuck_s", stuck_s,
            {.min = 0.0,
             .max = 10.0,
             .doc = "the very same count for so long is suspicious",
             .scale = core::dimension::kTime});
    a.Field("stuck_force_N", stuck_force_N,
            {.min = 0.0,
             .max = 1e4,
             .doc = "and means a stuck sensor if the observer's force has become so different "
                    "meanwhile, for longer than a transition",
             .scale = core::dimension::kForce});
    a.Field("saturated_counts", saturated_counts,
            {.min = 0.0,
             .max = 1e6,
             .doc = "readings from here on may stay the same, and do not tell the gain"});
    a.Field("transition_s", transition_s,
            {.min = 0.0,
             .max = 0.5,
             .doc = "around touchdown and lift-off sensor and observer may differ",
             .scale = core::dimension::kTime});
    a.Field("sure", sure,
            {.min = 0.5,
             .max = 1.0,
             .doc = "the observer disagrees only when its probability is beyond this, or below 1 - "
                    "this"});
    a.Field("moving_mps", moving_mps,
            {.min = 0.0,
             .max = 100.0,
             .doc = "a foot faster than this is not on the ground",
             .scale = core::dimension::kSpeed});
    a.Field("disagree_s", disagree_s,
            {.min = 0.0,
             .max = 10.0,
             .doc = "disagreement, summed up, that discredits the sensor",
             .scale = core::dimension::kTime});
    a.Field(
        "forgive", forgive,
        {.min = 0.0, .max = 10.0, .doc = "disagreement that is forgotten per time in agreement"});
    a.Field("drift_counts", drift_counts,
            {.min = 0.0,
             .max = 1e5,
             .doc = "change of the reading in the air since the start that discredits the sensor"});
    a.Field("match", match);
    a.Field("recover_s", recover_s,
            {.min = 0.0,
             .max = 1e4,
             .doc = "least time without a fault until it is trusted again",
             .scale = core::dimension::kTime});
    a.Field("recover_transitions", recover_transitions,
            {.min = 0,
             .max = 1000,
             .doc = "touchdowns and lift-offs in a row that it must have told in time meanwhile"});
  }
  bool operator==(const HealthParams&) const = default;
};

/// What the health monitor compares in one tick.
struct HealthInput {
  double raw_counts = 0.0;
  bool sensor = false, observer = false;  // contact, by each
  double probability = 0.0;               // of contact, the observer's
  double force_N = 0.0;                   // normal, the observer's
  double foot_speed_mps = 0.0;            // in W
  std::optional<double> zero_counts;      // reading in the air
};

/// Whether one foot's sensor can be believed.
class SensorHealth {
 public:
  SensorHealth(const HealthParams& params, double step_s) noexcept
      : params_(params), step_s_(step_s), match_(params.match, step_s) {}
  /// @returns healthy.
  bool Update(const HealthInput& in) noexcept;

 private:
  [[nodiscard]] bool IsStuck(const HealthInput& in) noexcept;
  [[nodiscard]] bool HasDrifted(const HealthInput& in) noexcept;
  [[nodiscard]] bool Disagrees(const HealthInput& in) noexcept;
  [[nodiscard]] bool Mismatches(const HealthInput& in) noexcept;
  [[nodiscard]] bool IsSaturated(const HealthInput& in) const noexcept;
  [[nodiscard]] bool SurelyDown(const HealthInput& in) const noexcept;
  [[nodiscard]] bool SurelyUp(const HealthInput& in) const noexcept;
  void TrackTransitions(const HealthInput& in) noexcept;

  static constexpr double kLongAgo_s = 1e9;
  HealthParams params_;
  double step_s_;
  double frozen_counts_ = std::numeric_limits<double>::quiet_NaN();
  double frozen_s_ = 0.0, changed_s_ = 0.0;  // the count; the force all the same
  double frozen_force_N_ = 0.0;              // of the observer, once settled
  std::optional<double> first_zero_;
  bool sensor_ = false, observer_ = false;  // of the last tick
  double since_sensor_s_ = kLongAgo_s, since_observer_s_ = kLongAgo_s;
  double disagreement_s_ = 0.0;
  ForceMatch match_;
  int transitions_ = 0;
  double faultless_s_ = 0.0;
  bool healthy_ = true;
};

}  // namespace scoria::controller
