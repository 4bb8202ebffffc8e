// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/world_shift.h"

#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "tests/support/robots.h"

namespace scoria::core {
namespace {

// The shift takes one to place and heading of the other, leaves its tilt and what it does in its
// own heading frame, and moves everything alike.
TEST(WorldShift, TakesPlaceAndHeadingAlone) {
  Rng rng(7, 0, Stream::kSensor);
  for (int trial = 0; trial < 50; ++trial) {
    const RobotState a = test::RandomState(rng), b = test::RandomState(rng);
    const WorldShift shift = WorldShift::Between(a, b);
    const RobotState moved = shift.Apply(a);
    EXPECT_LT((moved.p_WB - b.p_WB).norm(), 1e-12);
    EXPECT_NEAR(RpyFromRotation(moved.R_WB).z(), RpyFromRotation(b.R_WB).z(), 1e-9);
    EXPECT_LT((moved.R_WB.row(2) - a.R_WB.row(2)).norm(), 1e-12) << "tilt";
    EXPECT_LT((moved.R_WB.transpose() * moved.v_WB - a.R_WB.transpose() * a.v_WB).norm(), 1e-12);
    EXPECT_LT((moved.R_WB.transpose() * moved.w_WB - a.R_WB.transpose() * a.w_WB).norm(), 1e-12);
    RobotState ahead = a;
    ahead.p_WB += a.R_WB * Vec3(0.3, -0.2, 0.1);
    EXPECT_LT((shift.Apply(ahead).p_WB - moved.p_WB - moved.R_WB * Vec3(0.3, -0.2, 0.1)).norm(),
              1e-12);
  }
  const RobotState s = test::RandomState(rng);
  EXPECT_EQ(WorldShift::Between(s, s).Apply(s), s) << "bit for bit";
}

}  // namespace
}  // namespace scoria::core
