// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/robot/description.h"

namespace scoria::core {

/// Edges of the box around a shape, in its own frame, m; of a mesh for drawing its scale.
[[nodiscard]] Vec3 ExtentOf(const Shape& shape);

/// From a front hip to the hind one across, and the leg's length, m.
[[nodiscard]] double RobotSize(const RobotDescription& robot);

inline constexpr const char* kScaleHint =
    "; a mesh in millimetres needs scale=\"0.001 0.001 0.001\", one in metres none";

}  // namespace scoria::core
