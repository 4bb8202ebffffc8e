// SPDX-License-Identifier: BSD-3-Clause
#include "app/inspect/bench_logs.h"

#include <gtest/gtest.h>

namespace scoria::app {
namespace {

TEST(BenchLogs, EveryFormatIsReadWhole) {
  const std::vector<LogBenchmark> all = BenchmarkLogFormats(1);
  ASSERT_EQ(all.size(), 4u);
  for (const LogBenchmark& b : all) {
    EXPECT_NEAR(static_cast<double>(b.message_bytes), 1e6, 3000.0) << b.name;
    EXPECT_GT(b.file_bytes, b.message_bytes / 2) << b.name;
    EXPECT_GT(b.messages, 2000u) << b.name;
    EXPECT_GT(b.MBPerS(), 0.0) << b.name;
  }
  EXPECT_LT(all[2].file_bytes, all[0].file_bytes) << "zstd packs";
}

}  // namespace
}  // namespace scoria::app
