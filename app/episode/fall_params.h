// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "analysis/signals/falls.h"
#include "analysis/signals/stuck.h"

namespace scoria::app {

/// When a robot counts as fallen or stuck, and how the operator sets it on its feet.
struct FallParams : analysis::FallParams, analysis::StuckParams {
  double lie_s = 0.5;
  double stand_s = 0.6;
  template <class Archive>
  void Serialize(Archive& a) {
    analysis::FallParams::Serialize(a);
    analysis::StuckParams::Serialize(a);
    a.Field("lie_s", lie_s,
            {.min = 0.0, .max = 10.0, .doc = "before the operator lifts the robot"});
    a.Field("stand_s", stand_s,
            {.min = 0.0,
             .max = 10.0,
             .doc = "standing before walking on",
             .scale = core::dimension::kTime});
  }
};

}  // namespace scoria::app
