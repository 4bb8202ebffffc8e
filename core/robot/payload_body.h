// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/config/field.h"
#include "core/math/spatial_inertia.h"

namespace scoria::core {

/// A body that the trunk can carry.
struct PayloadParams {
  std::string name;
  double mass_kg = 0.0;
  Vec3 p_BP_m = Vec3::Zero();
  Vec3 rpy_rad = Vec3::Zero();
  Vec3 size_m = Vec3::Zero();
  Vec3 inertia_kgm2 = Vec3::Zero();
  template <class Archive>
  void Serialize(Archive& a) {
    constexpr double kNone = 0.0;
    a.Required("name", name);
    a.Required("mass_kg", mass_kg, {.min = 0.001, .max = 50.0});
    a.Field("p_BP_m", p_BP_m, {.min = -2.0, .max = 2.0, .doc = "its centre of mass in B"});
    a.Field("rpy_rad", rpy_rad, {.doc = "roll, pitch, yaw of its axes in B"});
    a.Field("size_m", size_m,
            {.min = kNone, .max = 2.0, .doc = "edges of a solid box; zeros: a point mass"});
    a.Field(
        "inertia_kgm2", inertia_kgm2,
        {.min = kNone,
         .max = 50.0,
         .doc = "principal moments along its axes, about its centre of mass; zeros: the box's"});
  }
  [[nodiscard]] std::string Problem() const;
  bool operator==(const PayloadParams&) const = default;
};

/// Of the payload's body, in B.
[[nodiscard]] SpatialInertia ToInertia(const PayloadParams& payload) noexcept;

}  // namespace scoria::core
