// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/rng.h"
#include "terrains/grid.h"
#include "terrains/params.h"

namespace scoria::terrains {

// Each adds one kind of relief in metres, before any scaling.
void AddGullies(Grid& heights, const GullyParams& params, double downhill_rad, core::Rng rng);
void AddCraters(Grid& heights, const CraterParams& params, core::Rng rng);
void AddCells(Grid& heights, const CellParams& params, core::Rng rng);
void AddRipples(Grid& heights, const RippleParams& params, const Grid& presence);

/// How low each node lies against its surroundings of some metres.
[[nodiscard]] Grid CalcHollows(const Grid& heights);

/// The share of a patch at every node, 0 to 1: where `field` is highest, on `fraction` of the area,
/// with edges that blend over `blend_m`.
[[nodiscard]] Grid CoverHighest(const Grid& field, double fraction, double blend_m);

/// Ramps of three nodes in place of steps.
[[nodiscard]] Grid SoftenEdges(const Grid& presence);

/// Lowers peaks until no two neighbours differ by more than the slope allows. @returns how many
/// nodes were lowered.
std::size_t LimitSlope(Grid& heights, double max_slope_rad);

}  // namespace scoria::terrains
