// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/config/archive.h"
#include "core/math/types.h"

namespace scoria::analysis {

/// When a robot counts as fallen.
struct FallParams {
  double trunk_force_N = 20.0, trunk_force_s = 0.1;
  double tilt_rad = 1.0472;
  double height_share = 0.4, height_s = 0.2;
  double stand_up_s = 3.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("trunk_force_N", trunk_force_N,
            {.min = 0.0, .max = 1e4, .scale = core::dimension::kForce});
    a.Field("trunk_force_s", trunk_force_s,
            {.min = 0.0, .max = 10.0, .scale = core::dimension::kTime});
    a.Field("tilt_rad", tilt_rad, {.min = 0.1, .max = 3.2});
    a.Field("height_share", height_share,
            {.min = 0.0, .max = 1.0, .doc = "of the nominal trunk height over the local ground"});
    a.Field("height_s", height_s, {.min = 0.0, .max = 10.0, .scale = core::dimension::kTime});
    a.Field("stand_up_s", stand_up_s,
            {.min = 0.0,
             .max = 600.0,
             .doc = "a robot that the controller has not taken over so long after the stand-up "
                    "should have ended has fallen",
             .scale = core::dimension::kTime});
  }
  bool operator==(const FallParams&) const = default;
};

enum class FallCause { kNone, kTrunkContact, kTilt, kLow, kNotStanding };
constexpr std::array<std::pair<FallCause, std::string_view>, 5> EnumNames(FallCause) {
  return {{{FallCause::kNone, "none"},
           {FallCause::kTrunkContact, "trunk_contact"},
           {FallCause::kTilt, "tilt"},
           {FallCause::kLow, "low"},
           {FallCause::kNotStanding, "not_standing"}}};
}

/// A fall: when, why, and where the trunk was. Results of older versions lack the place.
struct FallEvent {
  double time_s = 0.0;
  std::string cause;
  std::optional<Vec2> p_WB = std::nullopt;  // m, horizontal
};

/// What is known of the trunk at one instant; what is absent is no evidence.
struct FallSample {
  double dt_s = 0.0;                                   // since the sample before
  std::optional<double> tilt_rad = std::nullopt;       // of its z axis from that of W
  std::optional<double> height_m = std::nullopt;       // over the local ground
  std::optional<double> trunk_force_N = std::nullopt;  // that it bears
};

/// Upright, stumbling (a limit is exceeded, not long enough yet), fallen.
enum class FallState { kUpright, kStumbling, kFallen };

/// Finds falls in samples of any rate. Fallen is who tilts by more than `tilt_rad`, bears more than
/// `trunk_force_N` on the trunk for `trunk_force_s`, or is lower than `height_share` of the nominal
/// height for `height_s`; upright again is who was set on its feet (Reset), or exceeds no limit for
/// kRecover_s.
class FallDetector {
 public:
  static constexpr double kRecover_s = 1.0;

  FallDetector(const FallParams& params, double nominal_trunk_height_m) noexcept;

  /// @returns the cause with the sample in which the robot counts as fallen, else kNone.
  [[nodiscard]] FallCause Update(const FallSample& sample) noexcept;

  /// The same before the controller is in charge, where a trunk on the ground is no fall.
  /// @param overdue_s time since the stand-up should have ended; negative before.
  [[nodiscard]] FallCause UpdateStandUp(const FallSample& sample, double overdue_s) noexcept;

  [[nodiscard]] FallState state() const noexcept { return state_; }

  /// After the robot was placed.
  void Reset() noexcept;

 private:
  [[nodiscard]] FallCause Enter(FallCause cause) noexcept;

  FallParams params_;
  double nominal_height_m_;
  FallState state_ = FallState::kUpright;
  double pressed_s_ = 0.0, low_s_ = 0.0, sound_s_ = 0.0;
};

}  // namespace scoria::analysis
