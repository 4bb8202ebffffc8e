// SPDX-License-Identifier: BSD-3-Clause
#include "logs/csv_line.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace scoria::logs {
namespace {

TEST(CsvLine, QuotesWhatWouldNotReadBack) {
  const std::vector<std::string> cells = {"1.5", "", "a b", "a,b", "say \"x\"", "two\nlines"};
  EXPECT_EQ(CsvLine(cells), "1.5,,a b,\"a,b\",\"say \"\"x\"\"\",\"two\nlines\"\n");
}

TEST(CsvLine, SecondsKeepEveryNanosecond) {
  EXPECT_EQ(SecondsText(1'700'000'000'000'000'001), "1700000000.000000001");
  EXPECT_EQ(SecondsText(-1), "-0.000000001");
  EXPECT_EQ(SecondsText(0), "0.000000000");
  EXPECT_EQ(SecondsText(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808");
}

}  // namespace
}  // namespace scoria::logs
