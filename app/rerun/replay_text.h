// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "app/rerun/replay_variants.h"

namespace scoria::app {

/// The log, and a table of scores with a column per variant.
[[nodiscard]] std::string DescribeReplay(const ReplayReport& report);

/// The same as JSON; scores that a log cannot give are null.
[[nodiscard]] nlohmann::json ReplayJson(const ReplayReport& report);

}  // namespace scoria::app
