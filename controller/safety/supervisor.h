// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "core/config/field.h"
#include "core/robot/state.h"

namespace scoria::controller {

/// What can fail, and what the controller does then until it is sound again.
enum class Watch { kMpc, kBody, kEstimator, kContact, kFooting, kLoad };
constexpr std::array<std::pair<Watch, std::string_view>, 6> EnumNames(Watch) {
  return {{{Watch::kMpc, "mpc"},
           {Watch::kBody, "body"},
           {Watch::kEstimator, "estimator"},
           {Watch::kContact, "contact"},
           {Watch::kFooting, "footing"},
           {Watch::kLoad, "load"}}};
}
inline constexpr std::size_t kNumWatches = EnumNames(Watch{}).size();

/// What stands in for a stage that was given up.
[[nodiscard]] std::string_view FallbackName(Watch watch) noexcept;

/// How good each stage is by its own word: 1 as designed, 0 of no use.
using Qualities = std::array<double, kNumWatches>;

/// When one stage is given up, and when it is taken back.
struct WatchParams {
  bool enabled = true;
  double least_quality = 0.5;
  double after_s = 0.1, recover_s = 1.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("enabled", enabled);
    a.Field("least_quality", least_quality,
            {.min = 0.0, .max = 1.0, .doc = "what is worse counts as unsound"});
    a.Field("after_s", after_s,
            {.min = 0.0, .max = 60.0, .doc = "unsound for so long on balance: falls back"});
    a.Field("recover_s", recover_s,
            {.min = 0.0, .max = 600.0, .doc = "sound for so long without a break: comes back"});
  }
  bool operator==(const WatchParams&) const = default;
};

struct SupervisorParams {
  bool enabled = true;
  WatchParams mpc{.least_quality = 0.01, .after_s = 0.0, .recover_s = 0.05};
  WatchParams body{.least_quality = 0.1, .after_s = 0.02, .recover_s = 0.2};
  WatchParams estimator{.least_quality = 0.8, .after_s = 0.12, .recover_s = 2.0};
  WatchParams contact{.least_quality = 0.99, .after_s = 0.05, .recover_s = 3.0};
  WatchParams footing{.least_quality = 0.3, .after_s = 0.15, .recover_s = 4.0};
  WatchParams load{.least_quality = 0.85, .after_s = 1.0, .recover_s = 5.0};
  double careful_speed_share = 0.6, careful_duty = 0.75, careful_lift_m = 0.02;
  double crouch_share = 0.9;
  double doubt = 15.0;
  double ramp_s = 1.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("enabled", enabled,
            {.doc = "false: qualities are told all the same, nothing is done about them"});
    a.Field("mpc", mpc, {.doc = "share of safety.max_plan_age_s left; falls back on equal forces"});
    a.Field("body", body,
            {.doc = "share of ticks answered in time; falls back on inverse dynamics"});
    a.Field("estimator", estimator,
            {.doc = "fit of innovations and of speed to acceleration; falls back on the "
                    "tilt that gravity shows, wide covariances and new feet"});
    a.Field("contact", contact,
            {.doc = "share of feet whose chosen source is sound; falls back on the hierarchy"});
    a.Field("footing", footing,
            {.doc = "of tilt error, slips and stumbles; falls back on careful walking"});
    a.Field("load", load,
            {.doc = "share of ticks with torque to spare; falls back on standing, crouched"});
    a.Field("careful_speed_share", careful_speed_share, {.min = 0.0, .max = 1.0});
    a.Field("careful_duty", careful_duty,
            {.min = 0.0, .max = 0.95, .doc = "least duty factor, at the gait's own swing time"});
    a.Field("careful_lift_m", careful_lift_m,
            {.min = 0.0, .max = 0.3, .doc = "added to the swing's apex"});
    a.Field("crouch_share", crouch_share,
            {.min = 0.3, .max = 1.0, .doc = "of the height, when the load is too much"});
    a.Field("doubt", doubt,
            {.min = 1.0, .max = 1e3, .doc = "times that a re-initialised estimate is less sure"});
    a.Field("ramp_s", ramp_s, {.min = 0.0, .max = 10.0, .doc = "from one way to walk to another"});
  }
  bool operator==(const SupervisorParams&) const = default;
};

/// One stage given up or taken back, and why.
struct Transition {
  Watch watch = Watch::kMpc;
  bool fell_back = true;     // false: came back
  double quality = 1.0;      // now
  double least_quality = 0;  // that was asked for
  double lasted_s = 0.0;     // unsound, or sound
};
/// What happened in one tick; at most one transition per watch.
struct Transitions {
  std::array<Transition, kNumWatches> list;
  std::size_t count = 0;
};

/// Gives stages up when they report themselves unsound, and takes them back when they are sound.
/// Every watch is the same mechanism; what a fallback is, the controller knows.
/// Neither throws nor allocates.
class Supervisor {
 public:
  explicit Supervisor(const SupervisorParams& params) noexcept : params_(params) {}

  void Update(const Qualities& qualities, double dt_s) noexcept;

  [[nodiscard]] bool HasFallenBack(Watch watch) const noexcept {
    return states_[static_cast<std::size_t>(watch)].fallen_back;
  }
  /// Of the last Update.
  [[nodiscard]] const Transitions& transitions() const noexcept { return transitions_; }

  /// How careful to walk and how far to crouch, 0 to 1: ramps, so that nothing steps.
  [[nodiscard]] double care() const noexcept { return care_; }
  [[nodiscard]] double crouch() const noexcept { return crouch_; }
  /// The operator's command as it can be followed now: slower with poor footing, standing and
  /// crouched under too much load.
  [[nodiscard]] Command Temper(const Command& command, double nominal_height_m) const noexcept;

  void set_params(const SupervisorParams& params) noexcept { params_ = params; }

 private:
  struct State {
    bool fallen_back = false;
    double unsound_s = 0.0, sound_s = 0.0;
  };
  [[nodiscard]] const WatchParams& ParamsOf(Watch watch) const noexcept;
  void UpdateWatch(Watch watch, double quality, double dt_s) noexcept;
  void Note(Watch watch, const State& state, double quality) noexcept;

  SupervisorParams params_;
  std::array<State, kNumWatches> states_;
  Transitions transitions_;
  double care_ = 0.0, crouch_ = 0.0;
};

}  // namespace scoria::controller
