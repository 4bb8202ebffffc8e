// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/estimation/rest_attitude.h"

namespace scoria::controller {

/// Dead reckoning: the baseline that a filter has to beat. It has nothing to tune.
struct LegOdometryParams {
  static constexpr const char* kType = "leg_odometry";
  RestParams rest;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("rest", rest);
  }
  bool operator==(const LegOdometryParams&) const = default;
};

}  // namespace scoria::controller
