// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/math/types.h"
#include "logs/row_groups.h"

namespace scoria::logs {

[[nodiscard]] inline Vec3 ToVec3(const Array3& v) { return {v[0], v[1], v[2]}; }
[[nodiscard]] inline Array3 ToArray(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace scoria::logs
