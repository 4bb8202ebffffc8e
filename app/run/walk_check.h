// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "app/episode/episode_result.h"
#include "app/episode/operator.h"

namespace scoria::app {

/// The way that the operator commands in the time that a robot has once it stands, m. One that
/// never stands was commanded it all the same.
[[nodiscard]] double CommandedWay(const OperatorParams& operation, double duration_s);

/// Why an episode was no walk, in words; empty if it was one.
[[nodiscard]] std::string DescribeFailure(const EpisodeResult& result, double commanded_m);

}  // namespace scoria::app
