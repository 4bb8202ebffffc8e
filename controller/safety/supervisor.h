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
enum class Monitor { kMpc, kBody, kEstimator, kContact, kFooting, kLoad };
constexpr std::array<std::pair<Monitor, std::string_view>, 6> EnumNames(Monitor) {
  return {{{Monitor::kMpc, "mpc"},
           {Monitor::kBody, "body"},
           {Monitor::kEstimator, "estimator"},
           {Monitor::kContact, "contact"},
           {Monitor::kFooting, "footing"},
           {Monitor::kLoad, "load"}}};
}
inline constexpr std::size_t kNumMonitors = EnumNames(Monitor{}).size();

/// What stands in for a stage that is unsound.
[[nodiscard]] std::string_view FallbackName(Monitor monitor) noexcept;

/// How good each stage is by its own report: 1 as designed, 0 of no use.
using Qualities = std::array<double, kNumMonitors>;

/// When the fallback of one stage is engaged, and when it is released.
struct MonitorParams {
  bool enabled = true;
  double least_quality = 0.5;
  double after_s = 0.1, recover_s = 1.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("enabled", enabled);
    a.Field("least_quality", least_quality,
            {.min = 0.0, .max = 1.0, .doc = "what is worse counts as unsound"});
    a.Field("after_s", after_s,
            {.min = 0.0,
             .max = 60.0,
             .doc = "unsound for so long on balance: engaged",
             .scale = core::dimension::kTime});
    a.Field("recover_s", recover_s,
            {.min = 0.0,
             .max = 600.0,
             .doc = "sound for so long without a break: released",
             .scale = core::dimension::kTime});
  }
  bool operator==(const MonitorParams&) const = default;
};

struct SupervisorParams {
  bool enabled = true;
  MonitorParams mpc{.least_quality = 0.01, .after_s = 0.0, .recover_s = 0.05};
  MonitorParams body{.least_quality = 0.1, .after_s = 0.02, .recover_s = 0.2};
  MonitorParams estimator{.least_quality = 0.8, .after_s = 0.12, .recover_s = 2.0};
  MonitorParams contact{.least_quality = 0.99, .after_s = 0.05, .recover_s = 3.0};
  MonitorParams footing{.least_quality = 0.3, .after_s = 0.15, .recover_s = 4.0};
  MonitorParams load{.least_quality = 0.85, .after_s = 1.0, .recover_s = 5.0};
  double careful_speed_share = 0.6, careful_duty = 0.75, careful_lift_m = 0.02;
  double crouch_share = 0.9;
  double covariance_scale = 15.0;
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
            {.doc = "torque that stance legs lack; falls back on standing, crouched"});
    a.Field("careful_speed_share", careful_speed_share, {.min = 0.0, .max = 1.0});
    a.Field("careful_duty", careful_duty,
            {.min = 0.0, .max = 0.95, .doc = "least duty factor, at the gait's own swing time"});
    a.Field("careful_lift_m", careful_lift_m,
            {.min = 0.0,
             .max = 0.3,
             .doc = "added to the swing's apex",
             .scale = core::dimension::kLength});
    a.Field("crouch_share", crouch_share,
            {.min = 0.3, .max = 1.0, .doc = "of the height, when the load is too much"});
    a.Field("covariance_scale", covariance_scale,
            {.min = 1.0,
             .max = 1e3,
             .doc = "of the standard deviations of a re-initialised estimate",
             .was = "doubt"});
    a.Field("ramp_s", ramp_s,
            {.min = 0.0,
             .max = 10.0,
             .doc = "from one way to walk to another",
             .scale = core::dimension::kTime});
  }
  bool operator==(const SupervisorParams&) const = default;
};

/// A fallback engaged or released, and why.
struct Transition {
  Monitor monitor = Monitor::kMpc;
  bool fell_back = true;     // engaged; false: released
  double quality = 1.0;      // now
  double least_quality = 0;  // that was asked for
  double lasted_s = 0.0;     // unsound, or sound
};
/// What happened in one tick; at most one transition per monitor.
struct Transitions {
  std::array<Transition, kNumMonitors> list;
  std::size_t count = 0;
};

/// Engages the fallback of a stage that reports itself unsound, and releases it when it is sound.
/// Every monitor is the same mechanism; what a fallback is, the controller knows.
/// Neither throws nor allocates.
class Supervisor {
 public:
  explicit Supervisor(const SupervisorParams& params) noexcept : params_(params) {}

  void Update(const Qualities& qualities, double dt_s) noexcept;

  [[nodiscard]] bool HasFallenBack(Monitor monitor) const noexcept {
    return states_[static_cast<std::size_t>(monitor)].fallen_back;
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
  [[nodiscard]] const MonitorParams& ParamsOf(Monitor monitor) const noexcept;
  void UpdateMonitor(Monitor monitor, double quality, double dt_s) noexcept;
  void Note(Monitor monitor, const State& state, double quality) noexcept;

  SupervisorParams params_;
  std::array<State, kNumMonitors> states_;
  Transitions transitions_;
  double care_ = 0.0, crouch_ = 0.0;
};

}  // namespace scoria::controller
