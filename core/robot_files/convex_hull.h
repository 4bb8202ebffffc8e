// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/math/types.h"

namespace scoria::core {

/// So many that contacts cost little more than those of boxes.
inline constexpr std::size_t kMaxHullPoints = 32;

/// Points that span nearly the convex hull of all: of each of kMaxHullPoints directions, evenly
/// spread and with both ways of every axis among them, the farthest one. So the box around them is
/// the box around all. In the order of `points`, each once.
[[nodiscard]] std::vector<Vec3> ReduceToHull(const std::vector<Vec3>& points);

/// What of the hull of `points` lies where normal . p <= offset_m, as points; empty if nothing.
/// @pre not many more than kMaxHullPoints, since every pair of them is looked at.
[[nodiscard]] std::vector<Vec3> CutHull(const std::vector<Vec3>& points, const Vec3& normal,
                                        double offset_m);

}  // namespace scoria::core
