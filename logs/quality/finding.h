// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/robot/legs.h"
#include "logs/mapping/signals.h"
#include "logs/row.h"

namespace scoria::logs {

/// What a finding means for numbers computed from the log. Error: those of what it spoils are
/// wrong. Warning: some of the log is lost, or they are less exact. Note: worth knowing.
enum class Severity { kNote, kWarning, kError };
constexpr std::array<std::pair<Severity, std::string_view>, 3> EnumNames(Severity) {
  return {
      {{Severity::kNote, "note"}, {Severity::kWarning, "warning"}, {Severity::kError, "error"}}};
}

/// What is the matter. docs/log_quality.md says of each by what it is found.
enum class FindingKind {
  kGap,
  kLostSamples,
  kClockStep,
  kTimeBackwards,
  kRepeatedTimes,
  kIrregularTimes,
  kReceiveTimes,
  kLostMessages,
  kRepeatedSamples,
  kStuckSensor,
  kDeadSensor,
  kSaturation,
  kSentinel,
  kDegrees,
  kMillimetres,
  kGravityUnit,
  kGravityMissing,
  kGravitySign,
  kGravitySize,
  kJointRate,
  kJointSign,
  kJointOffset,
  kJointOrder,
  kJointLimits,
  kTorqueSign,
  kTorqueScale,
  kLegOrder,
  kFootSensorOrder,
  kQuaternionOrder,
  kRollPitchSwapped,
  kAttitudeSign,
  kImuDelay,
  kAttitudeDelay,
  kVelocityFrame,
  kVelocity,
  kJump,
  kWalksBackwards,
  kMass,
  kNotJudged,
};
inline constexpr std::size_t kNumFindingKinds = 39;
constexpr std::array<std::pair<FindingKind, std::string_view>, kNumFindingKinds> EnumNames(
    FindingKind) {
  using K = FindingKind;
  return {{{K::kGap, "gap"},
           {K::kLostSamples, "lost_samples"},
           {K::kClockStep, "clock_step"},
           {K::kTimeBackwards, "time_backwards"},
           {K::kRepeatedTimes, "repeated_times"},
           {K::kIrregularTimes, "irregular_times"},
           {K::kReceiveTimes, "receive_times"},
           {K::kLostMessages, "lost_messages"},
           {K::kRepeatedSamples, "repeated_samples"},
           {K::kStuckSensor, "stuck_sensor"},
           {K::kDeadSensor, "dead_sensor"},
           {K::kSaturation, "saturation"},
           {K::kSentinel, "sentinel"},
           {K::kDegrees, "degrees"},
           {K::kMillimetres, "millimetres"},
           {K::kGravityUnit, "gravity_unit"},
           {K::kGravityMissing, "gravity_missing"},
           {K::kGravitySign, "gravity_sign"},
           {K::kGravitySize, "gravity_size"},
           {K::kJointRate, "joint_rate"},
           {K::kJointSign, "joint_sign"},
           {K::kJointOffset, "joint_offset"},
           {K::kJointOrder, "joint_order"},
           {K::kJointLimits, "joint_limits"},
           {K::kTorqueSign, "torque_sign"},
           {K::kTorqueScale, "torque_scale"},
           {K::kLegOrder, "leg_order"},
           {K::kFootSensorOrder, "foot_sensor_order"},
           {K::kQuaternionOrder, "quaternion_order"},
           {K::kRollPitchSwapped, "roll_pitch_swapped"},
           {K::kAttitudeSign, "attitude_sign"},
           {K::kImuDelay, "imu_delay"},
           {K::kAttitudeDelay, "attitude_delay"},
           {K::kVelocityFrame, "velocity_frame"},
           {K::kVelocity, "velocity"},
           {K::kJump, "jump"},
           {K::kWalksBackwards, "walks_backwards"},
           {K::kMass, "mass"},
           {K::kNotJudged, "not_judged"}}};
}

struct TimeSpan {
  double begin_s = 0.0, end_s = 0.0;
  bool operator==(const TimeSpan&) const = default;
};

/// Something that a log, or the mapping that it is read by, is likely to have wrong.
struct Finding {
  Severity severity = Severity::kNote;
  FindingKind kind = FindingKind::kNotJudged;
  std::string signal;  // as a mapping names it: "joints.q"; a topic; empty: the rows' times
  std::optional<Leg> leg = std::nullopt;
  std::optional<Joint> joint = std::nullopt;
  std::vector<TimeSpan> spans = {};  // where; the longest kMostSpans of them; none: all of the log
  std::uint64_t count = 1;           // of occurrences
  /// How large, in the unit that docs/log_quality.md names: s of a gap, delay or step, Hz of a true
  /// rate, a factor, a share.
  std::optional<double> size = std::nullopt;
  std::string evidence;   // numbers and words
  RowGroups spoils = {};  // of which metrics say what they need
  std::string repair;     // in words; of a mapping the key and its value; empty: none
  bool operator==(const Finding&) const = default;
};
inline constexpr std::size_t kMostSpans = 16;

/// The group of rows that a signal is in.
[[nodiscard]] RowGroup GroupOf(SignalId signal) noexcept;

/// A finding about a signal, which spoils its group.
[[nodiscard]] Finding MakeFinding(Severity severity, FindingKind kind, SignalId signal);

/// "error: leg_order of joints.q: EVIDENCE; REPAIR", on one line.
[[nodiscard]] std::string DescribeFinding(const Finding& finding);

/// Whether there is an error of one of these kinds.
[[nodiscard]] bool HasError(const std::vector<Finding>& findings,
                            std::initializer_list<FindingKind> kinds) noexcept;

}  // namespace scoria::logs
