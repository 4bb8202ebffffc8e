// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/config/field.h"

namespace scoria::controller {

/// In what the controller's model of the robot differs from the robot's description, for tests of
/// what a wrong model does. The trunk's centre of mass and its inertia about it stay.
struct ModelParams {
  double mass_offset_kg = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("mass_offset_kg", mass_offset_kg,
            {.min = -100.0,
             .max = 100.0,
             .doc = "added to the trunk's mass that gait, MPC and WBC act on; an adaptation starts "
                    "from it",
             .scale = core::dimension::kMass});
  }
  bool operator==(const ModelParams&) const = default;
};

}  // namespace scoria::controller
