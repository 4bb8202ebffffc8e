// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/robot/description.h"

namespace scoria::core {

/// Cuts what of a collision shape comes nearer to level ground than half a foot's radius, while the
/// robot stands or swings the leg: it would stand on that instead of its foot. A shape of which
/// nothing is left is left out. Warnings of the robot say so.
/// @pre the joints are in the canonical joint convention, the defaults derived.
void CutBelowFeet(RobotDescription& robot);

}  // namespace scoria::core
