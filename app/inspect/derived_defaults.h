// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/similarity.h"

namespace scoria::app {

/// A scenario key whose default goes with the robot, as YAML text.
struct DerivedDefault {
  std::string key, of_go2, of_robot;
};

/// The keys whose defaults for a robot of this size are not the Go2's; of variants those of the
/// default choice. The law: core::Similarity.
[[nodiscard]] std::vector<DerivedDefault> DerivedDefaults(const core::Similarity& similarity);

}  // namespace scoria::app
