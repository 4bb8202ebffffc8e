// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "core/config/archive.h"
#include "sim/world.h"

namespace scoria::app {

/// When a robot counts as fallen or stuck.
struct FallParams {
  double trunk_force_N = 20.0, trunk_force_s = 0.1;
  double tilt_rad = 1.0472;
  double height_share = 0.4, height_s = 0.2;
  double stuck_distance_m = 0.5, stuck_s = 10.0;
  double lie_s = 0.5;
  double stand_s = 0.6;
  double stand_up_s = 3.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("trunk_force_N", trunk_force_N, {.min = 0.0, .max = 1e4});
    a.Field("trunk_force_s", trunk_force_s, {.min = 0.0, .max = 10.0});
    a.Field("tilt_rad", tilt_rad, {.min = 0.1, .max = 3.2});
    a.Field("height_share", height_share,
            {.min = 0.0, .max = 1.0, .doc = "of the nominal trunk height over the local ground"});
    a.Field("height_s", height_s, {.min = 0.0, .max = 10.0});
    a.Field("stuck_distance_m", stuck_distance_m, {.min = 0.0, .max = 10.0});
    a.Field("stuck_s", stuck_s, {.min = 1.0, .max = 1e4, .doc = "while commanded to walk"});
    a.Field("lie_s", lie_s,
            {.min = 0.0, .max = 10.0, .doc = "before the operator lifts the robot"});
    a.Field("stand_s", stand_s, {.min = 0.0, .max = 10.0, .doc = "standing before walking on"});
    a.Field("stand_up_s", stand_up_s,
            {.min = 0.0,
             .max = 600.0,
             .doc = "a robot that the controller has not taken over so long after the stand-up "
                    "should have ended has fallen"});
  }
};

enum class FallCause { kNone, kTrunkContact, kTilt, kLow, kNotStanding };
constexpr std::array<std::pair<FallCause, std::string_view>, 5> EnumNames(FallCause) {
  return {{{FallCause::kNone, "none"},
           {FallCause::kTrunkContact, "trunk_contact"},
           {FallCause::kTilt, "tilt"},
           {FallCause::kLow, "low"},
           {FallCause::kNotStanding, "not_standing"}}};
}

/// Watches the truth, every physics step.
class FallMonitor {
 public:
  FallMonitor(const FallParams& params, double nominal_trunk_height_m, double step_s) noexcept;

  /// @returns the cause in the step in which the robot counts as fallen, else kNone.
  [[nodiscard]] FallCause Update(const sim::Truth& truth, double ground_z_m) noexcept;

  /// The same before the controller is in charge, where a trunk on the ground is no fall.
  /// @param overdue_s time since the stand-up should have ended; negative before.
  [[nodiscard]] FallCause UpdateStandUp(const sim::Truth& truth, double overdue_s) const noexcept;

  /// @returns true once per stuck episode: less than stuck_distance in stuck_s while commanded to
  /// walk, or less than half of what a slow command asks for in that time. Turning in place is not
  /// walking.
  [[nodiscard]] bool UpdateStuck(const Vec3& p_WB, double commanded_mps) noexcept;

  /// After the robot was placed.
  void Reset() noexcept;

 private:
  [[nodiscard]] bool HasTipped(const sim::Truth& truth) const noexcept;

  FallParams params_;
  double nominal_height_m_, step_s_;
  double pressed_s_ = 0.0, low_s_ = 0.0, stuck_s_ = 0.0;
  Vec2 anchor_W_ = Vec2::Zero();
  bool anchored_ = false;
};

}  // namespace scoria::app
