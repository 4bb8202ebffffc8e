// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/robot/description.h"

namespace scoria::test {

/// The Mini Cheetah of data/logs/minicheetah_raisim, from numbers: lengths and masses by
/// [Katz2019], the trunk's frame by the log's first row, whose feet and angles are known.
core::RobotDescription MakeMiniCheetah();

}  // namespace scoria::test
