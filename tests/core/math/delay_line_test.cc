// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/delay_line.h"

#include <gtest/gtest.h>

namespace scoria::core {
namespace {

TEST(DelayLine, GivesOlderValuesAndTheOldestWhereThereAreFewer) {
  DelayLine<int> line(32);
  for (int i = 0; i < 100; ++i) {
    line.Next() = i;
    EXPECT_EQ(line.Ago(0), i);
    EXPECT_EQ(line.Ago(3), std::max(0, i - 3));
  }
  EXPECT_EQ(line.Ago(1000), 99 - 32);
  line.Clear();
  line.Next() = 7;
  EXPECT_EQ(line.Ago(3), 7);
}

TEST(DelayLine, PassesTheValueOfItsLengthAgo) {
  DelayLine<int> none(0), two(2);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(none.Pass(i), i);
    EXPECT_EQ(two.Pass(i), std::max(0, i - 2));
  }
}

}  // namespace
}  // namespace scoria::core
