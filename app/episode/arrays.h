// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>

#include "core/robot/legs.h"

/// As messages and rows hold vectors and legs.
namespace scoria::app {

template <class T>
[[nodiscard]] std::array<T, 4> ToArray(const LegArray<T>& v) {
  std::array<T, 4> out{};
  std::copy(v.begin(), v.end(), out.begin());
  return out;
}

[[nodiscard]] inline std::array<double, 3> ToArray(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace scoria::app
