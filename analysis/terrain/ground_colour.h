// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrains/heightfield.h"

namespace scoria::analysis {

/// Red, green, blue in 0 to 1 of the substrate (0) and of the covers in their order (1 ...), in
/// pictures and videos alike. Rocks are the darkest.
[[nodiscard]] Vec3 MaterialColour(const terrains::Heightfield& ground, std::size_t index);

/// The materials' colours mixed by their shares at the nearest node.
[[nodiscard]] Vec3 GroundColour(const terrains::Heightfield& ground, const Vec2& p_W);

}  // namespace scoria::analysis
