// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/quantile.h"

#include <gtest/gtest.h>

namespace scoria::core {
namespace {

TEST(SampleQuantile, LiesBetweenOrderedValues) {
  EXPECT_EQ(SampleQuantile({7.0}, 0.3), 7.0);
  EXPECT_EQ(SampleQuantile({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(SampleQuantile({4.0, 1.0, 2.0, 3.0}, 0.5), 2.5);
  EXPECT_EQ(SampleQuantile({4.0, 1.0, 2.0, 3.0}, 0.0), 1.0);
  EXPECT_EQ(SampleQuantile({4.0, 1.0, 2.0, 3.0}, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(SampleQuantile({10.0, 20.0, 30.0, 40.0, 50.0}, 0.99), 49.6);
}

}  // namespace
}  // namespace scoria::core
