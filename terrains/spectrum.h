// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/rng.h"
#include "terrains/grid.h"
#include "terrains/params.h"

namespace scoria::terrains {

/// RMS height difference at a lag that params ask for: of their spectrum without a longest wave.
[[nodiscard]] double TargetDeviation(const RoughnessParams& params, double lag_m);

/// Adds a Gaussian field with random phases so that the whole ground has the deviogram of
/// TargetDeviation. Other relief (forms, ripples, rocks) stands in `other` and takes its share: the
/// field's spectrum starts from the self-affine law and is fitted, within its band, to what is
/// missing at lags up to a quarter of the longest wave. Where other relief alone is rougher than
/// the target, the field fades.
void AddRoughness(Grid& heights, const RoughnessParams& params, const Grid& other, core::Rng rng);

/// Adds ropes of pahoehoe, in metres.
void AddRopes(Grid& heights, const RopeParams& params, core::Rng rng);

/// A smooth random field without mean, for the outlines of patches.
[[nodiscard]] Grid DrawPatchField(int nodes, double spacing_m, core::Rng rng);

}  // namespace scoria::terrains
