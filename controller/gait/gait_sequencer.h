// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "controller/gait/phase_engine.h"
#include "core/config/field.h"
#include "core/robot/state.h"

namespace scoria::controller {

/// What a gait sequencer may know at one of its ticks.
struct GaitInput {
  Command command;
  double v_xy_mps = 0.0;  // horizontal speed of the COM
  double w_z_radps = 0.0;
  double height_m = 0.0;          // COM over the ground plane through the feet
  LegArray<bool> early_contact;   // swing feet that touched the ground before their time
  LegArray<double> foot_error_m;  // how far each foot is from its place under a standing body
  double least_duty = 0.0;        // when care is needed; the swing time stays
  double dt_s = 0.01;             // since the last tick
  int horizon = 10;
  double stage_s = 0.05;
};

/// When each foot shall be on the ground. One call per gait tick.
class GaitSequencer {
 public:
  virtual ~GaitSequencer() = default;
  [[nodiscard]] virtual ContactPlan Plan(const GaitInput& in) noexcept = 0;
  /// The phases now, and taking over those of another sequencer.
  [[nodiscard]] virtual const PhaseEngine& phases() const noexcept = 0;
  virtual void Continue(const PhaseEngine& phases) noexcept = 0;
  /// A copy that goes on with the same bits.
  [[nodiscard]] virtual std::unique_ptr<GaitSequencer> Clone() const = 0;
};

/// Stride law of the adaptive gait: l = 2.3 Fr^0.3 h with Fr = v²/(g h), T = l/v, constant swing
/// time, d = 1 − t_swing/T. Source: paper, adaptive gait sequencer, stage one. Beyond it: the
/// stance travel v d T is capped, and d is clamped.
struct StrideLaw {
  double swing_s = 0.2;
  double gravity_mps2 = 9.81;
  double max_stance_travel_m = 0.30;
  double min_duty = 0.5, max_duty = 0.95;
  double min_speed_mps = 0.01;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("swing_s", swing_s, {.min = 0.05, .max = 1.0, .scale = core::dimension::kTime});
    a.Field(
        "gravity_mps2", gravity_mps2,
        {.min = 0.1, .max = 30.0, .doc = "g of the Froude number, 9.81 in the paper everywhere"});
    a.Field("max_stance_travel_m", max_stance_travel_m,
            {.min = 0.02, .max = 2.0, .scale = core::dimension::kLength});
    a.Field("min_duty", min_duty, {.min = 0.2, .max = 0.95});
    a.Field("max_duty", max_duty, {.min = 0.3, .max = 0.98});
    a.Field("min_speed_mps", min_speed_mps,
            {.min = 1e-3, .max = 1.0, .scale = core::dimension::kSpeed});
  }
  [[nodiscard]] std::string Problem() const {
    return min_duty < max_duty ? "" : "min_duty must be below max_duty";
  }
  /// v²/(g h), with the law's least speed and height.
  [[nodiscard]] double Froude(double v_mps, double h_m) const noexcept;
  /// @param v_mps speed, @param h_m COM height. Offsets are left at their default.
  [[nodiscard]] GaitTiming Timing(double v_mps, double h_m) const noexcept;
  bool operator==(const StrideLaw&) const = default;
};

/// Gaits by name. Source: the reference framework's table; `walking_trot` is the paper's baseline.
enum class NamedGait {
  kStand,
  kStaticWalk,
  kWalkingTrot,
  kTrot,
  kFlyingTrot,
  kPace,
  kBound,
  kRotaryGallop,
  kTraverseGallop,
  kPronk
};
constexpr std::array<std::pair<NamedGait, std::string_view>, 10> EnumNames(NamedGait) {
  return {{{NamedGait::kStand, "stand"},
           {NamedGait::kStaticWalk, "static_walk"},
           {NamedGait::kWalkingTrot, "walking_trot"},
           {NamedGait::kTrot, "trot"},
           {NamedGait::kFlyingTrot, "flying_trot"},
           {NamedGait::kPace, "pace"},
           {NamedGait::kBound, "bound"},
           {NamedGait::kRotaryGallop, "rotary_gallop"},
           {NamedGait::kTraverseGallop, "traverse_gallop"},
           {NamedGait::kPronk, "pronk"}}};
}
[[nodiscard]] GaitTiming TimingOf(NamedGait gait) noexcept;

/// Simple gait sequencer: constant timing, of a named gait, of which single numbers may be
/// replaced.
struct SgsParams {
  static constexpr const char* kType = "sgs";
  NamedGait gait = NamedGait::kWalkingTrot;
  double period_scale = 1.0;
  std::optional<double> period_s, duty;
  std::optional<std::array<double, 4>> offset;
  StandParams stand;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("gait", gait);
    a.Field("period_scale", period_scale,
            {.min = 0.1,
             .max = 10.0,
             .doc = "times the period of the gait's table, which is the Go2's",
             .scale = core::dimension::kTime});
    a.Field("period_s", period_s, {.min = 0.1, .max = 5.0, .doc = "in place of the gait's own"});
    a.Field("duty", duty, {.min = 0.1, .max = 1.0, .doc = "in place of the gait's own; 1 stands"});
    a.Field("offset", offset,
            {.min = 0.0, .max = 1.0, .doc = "FL, FR, HL, HR, in place of the gait's own"});
    a.Field("stand", stand);
  }
  [[nodiscard]] GaitTiming Timing() const noexcept;
  bool operator==(const SgsParams&) const = default;
};

/// The speed that a gait adapts to: the largest of the filtered measured one, that of a foot at
/// `yaw_arm_m` while turning, and a share of the commanded one (else it would never start).
struct SpeedParams {
  int filter_samples = 20;
  double yaw_arm_m = 0.3;
  double command_share = 0.5;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("filter_samples", filter_samples,
            {.min = 1, .max = 100, .doc = "moving mean of the measured speed, in gait ticks"});
    a.Field("yaw_arm_m", yaw_arm_m,
            {.min = 0.0,
             .max = 1.0,
             .doc = "speed floor per yaw rate",
             .scale = core::dimension::kLength});
    a.Field("command_share", command_share,
            {.min = 0.0, .max = 1.0, .doc = "speed floor as a share of the command"});
  }
  bool operator==(const SpeedParams&) const = default;
};

/// Walking slower than a Froude number, the legs take the offsets of a walk. Source: the reference
/// framework's `switch_offsets`, which its real Go2 has on (0.02, 0.5 s); the paper trots only.
/// Differs: the speed must ask for the other offsets without a break; there, once is enough.
struct SlowWalkParams {
  double walk_below_froude = 0.0;
  double offset_delay_s = 0.5;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field(
        "walk_below_froude", walk_below_froude,
        {.min = 0.0, .max = 1.0, .doc = "v²/(g h) below which the offsets are a walk's; 0: never"});
    a.Field("offset_delay_s", offset_delay_s,
            {.min = 0.0,
             .max = 10.0,
             .doc = "for so long the speed must ask for the other offsets",
             .scale = core::dimension::kTime});
  }
  bool operator==(const SlowWalkParams&) const = default;
};

/// Adaptive gait sequencer of the paper.
struct AgsParams {
  static constexpr const char* kType = "ags";
  StrideLaw law;
  std::array<double, 4> offset = {0.0, 0.5, 0.5, 0.0};
  SlowWalkParams slow_walk;
  SpeedParams speed;
  StandParams stand;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("law", law);
    a.Field("offset", offset, {.min = 0.0, .max = 1.0, .doc = "FL, FR, HL, HR"});
    slow_walk.Serialize(a);
    a.Field("speed", speed);
    a.Field("stand", stand);
  }
  bool operator==(const AgsParams&) const = default;
};

/// Fixed at what the stride law gives for the commanded speed: isolates adaptation from slower
/// stepping.
struct SgsMatchedParams {
  static constexpr const char* kType = "sgs_matched";
  StrideLaw law;
  std::array<double, 4> offset = {0.0, 0.5, 0.5, 0.0};
  SlowWalkParams slow_walk;
  double yaw_arm_m = 0.3;
  StandParams stand;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("law", law);
    a.Field("offset", offset, {.min = 0.0, .max = 1.0, .doc = "FL, FR, HL, HR"});
    slow_walk.Serialize(a);
    a.Field("yaw_arm_m", yaw_arm_m,
            {.min = 0.0,
             .max = 1.0,
             .doc = "speed floor per yaw rate",
             .scale = core::dimension::kLength});
    a.Field("stand", stand);
  }
  bool operator==(const SgsMatchedParams&) const = default;
};

/// Gaits of the reference framework by bands of the Froude number, as animals change theirs, with
/// timing and offsets blended over the reference's number of cycles, 2 (1 − Fr) at the crossed
/// boundary. Source: the reference framework's table; differs: hysteresis at the boundaries, and a
/// change of mind starts from where the blend is.
struct BioParams {
  static constexpr const char* kType = "bio";
  double gravity_mps2 = 9.81;
  double hysteresis = 0.1;
  double period_scale = 1.0;
  SpeedParams speed;
  StandParams stand;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("gravity_mps2", gravity_mps2,
            {.min = 0.1, .max = 30.0, .doc = "g of the Froude number"});
    a.Field("period_scale", period_scale,
            {.min = 0.1,
             .max = 10.0,
             .doc = "times the periods of the table, which are the Go2's",
             .scale = core::dimension::kTime});
    a.Field("hysteresis", hysteresis,
            {.min = 0.0, .max = 0.9, .doc = "share by which a boundary must be passed"});
    a.Field("speed", speed);
    a.Field("stand", stand);
  }
  bool operator==(const BioParams&) const = default;
};

using GaitParams = std::variant<SgsParams, AgsParams, SgsMatchedParams, BioParams>;

/// @param nominal_height_m COM height that sgs_matched plans with.
[[nodiscard]] std::unique_ptr<GaitSequencer> MakeGaitSequencer(const GaitParams& params,
                                                               double nominal_height_m);

}  // namespace scoria::controller
