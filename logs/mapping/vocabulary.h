// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/robot/legs.h"

/// What people call legs and joints.
namespace scoria::logs {

/// The leg that a word means: "FL", "lf", "front_left", "rear right", "bl" …
[[nodiscard]] std::optional<Leg> LegNamed(std::string_view name);

struct JointName {
  Leg leg = Leg::kFL;
  Joint joint = Joint::kHAA;
  bool operator==(const JointName&) const = default;
};

/// The joints of a list of names, such as "FL_hip_joint", "LF_HAA", "fl.hx", "br_knee"; nothing for
/// those that are no joint of a leg. "hip" is HAA beside "thigh", and HFE beside "abad": so the
/// list counts as a whole.
[[nodiscard]] std::vector<std::optional<JointName>> JointsNamed(std::span<const std::string> names);

}  // namespace scoria::logs
