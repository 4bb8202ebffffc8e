// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/study/results.h"

namespace scoria::analysis {

/// Falls that happened at one place: each is within 1 m of another of the group, on one ground.
struct FallGroup {
  std::string ground;            // EpisodeRecord::ground
  std::vector<Vec2> p_WB;        // m, of the falls
  std::vector<std::string> arm;  // of each fall
  [[nodiscard]] std::size_t size() const noexcept { return p_WB.size(); }
};

/// Largest first. Falls without a place (results of older versions) belong to no group.
/// @param arms whose falls count; empty takes all. @param point empty takes the whole sweep.
[[nodiscard]] std::vector<FallGroup> GroupFalls(const CampaignResults& results,
                                                const std::vector<std::string>& arms = {},
                                                const std::vector<std::string>& point = {});

/// "the 44 falls lie at 4 places, on 2 of 5 grounds", and, where a few places hold most of the
/// falls,
/// "; 3 places make 43 of them". Empty without a fall that has a place.
[[nodiscard]] std::string DescribeGroups(const std::vector<FallGroup>& groups,
                                         std::size_t grounds_walked);

}  // namespace scoria::analysis
