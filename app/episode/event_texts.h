// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "app/episode/placement.h"
#include "app/scenario/scenario.h"

namespace scoria::app {

/// What the events of an episode say in their detail.
[[nodiscard]] std::string DescribePush(const Push& push);
[[nodiscard]] std::string DescribeChange(const ControllerChange& change);
[[nodiscard]] std::string DescribeSource(Leg leg, ContactSource source);
[[nodiscard]] std::string DescribeTransition(const controller::Transition& transition);
[[nodiscard]] std::string DescribePoorGround(const Place& place);

}  // namespace scoria::app
