// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

namespace scoria::core {

inline constexpr double kDegreesPerRad = 180.0 / std::numbers::pi;

}  // namespace scoria::core
