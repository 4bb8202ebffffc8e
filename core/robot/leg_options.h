// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/config/field.h"

namespace scoria::core {

/// The way a knee bends, seen from the hip of a standing robot.
enum class KneeBend { kAuto, kBack, kForward };
constexpr std::array<std::pair<KneeBend, std::string_view>, 3> EnumNames(KneeBend) {
  return {{{KneeBend::kAuto, "auto"}, {KneeBend::kBack, "back"}, {KneeBend::kForward, "forward"}}};
}

/// Of the front and of the hind legs.
struct KneeParams {
  KneeBend front = KneeBend::kAuto, hind = KneeBend::kAuto;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("front", front,
            {.doc = "auto: as the limits of the KFE joints have it; where they allow both, as the "
                    "knee is bent at the URDF's zero; else back"});
    a.Field("hind", hind,
            {.doc = "as front; where nothing else tells, forward if the hind shanks are mirror "
                    "images of the front ones, else as the front knees"});
  }
};

/// What stands for the limits that a URDF gives one joint of every leg; absent: the URDF's.
struct JointLimitParams {
  std::optional<double> lower_rad, upper_rad, effort_Nm, velocity_radps;
  template <class Archive>
  void Serialize(Archive& a) {
    constexpr double kTurn_rad = 6.2832, kNone = 0.0;
    a.Field("lower_rad", lower_rad, {.min = -kTurn_rad, .max = kTurn_rad});
    a.Field("upper_rad", upper_rad, {.min = -kTurn_rad, .max = kTurn_rad});
    a.Field("effort_Nm", effort_Nm, {.min = kNone, .max = 1e4});
    a.Field("velocity_radps", velocity_radps, {.min = kNone, .max = 1e3});
  }
  [[nodiscard]] std::string Problem() const {
    return lower_rad && upper_rad && *lower_rad >= *upper_rad ? "lower_rad must be below upper_rad"
                                                              : "";
  }
};

/// In the canonical joint convention: HAA about +x, HFE and KFE about +y, zero where the leg hangs
/// straight.
struct LegLimitParams {
  JointLimitParams haa, hfe, kfe;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("haa", haa, {.doc = "of the left legs; mirrored to the right"});
    a.Field("hfe", hfe,
            {.doc = "of the front legs; mirrored where the hind knees bend the other way"});
    a.Field("kfe", kfe, {.doc = "as hfe"});
  }
};

}  // namespace scoria::core
