// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "app/analyze/analyze_log.h"

namespace scoria::app {
namespace {

TEST(AnalyzedTruth, OfMarkersIsAlignedInTimeAndByItsLeverArm) {
  const char* root = std::getenv("SCORIA_REFERENCE_DATA");
  if (root == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const std::filesystem::path log = std::filesystem::path(root) / "logs/go2_vicon_orl/test_4";
  const LogAnalysis analysis = AnalyzeLog({log}, "test_4", "", {});
  ASSERT_TRUE(analysis.truth_alignment && analysis.truth_alignment->alignment);
  // The mean rate of the gyroscope comes 22 ms after that of the markers' attitude.
  EXPECT_NEAR(analysis.truth_alignment->alignment->offset.delay_s, -0.022, 0.003);
  EXPECT_TRUE(analysis.truth_alignment->alignment->lever_arm);
  const std::string remark = "a body of markers shows the truth: " +
                             analysis::DescribeAlignment(*analysis.truth_alignment);
  const auto& remarks = analysis.log.remarks;
  EXPECT_NE(std::find(remarks.begin(), remarks.end(), remark), remarks.end());
  ASSERT_TRUE(analysis.trajectory_error);
  EXPECT_EQ(analysis.trajectory_error->Refusal(),
            "the log has no instant with both truth and estimate");
  EXPECT_TRUE(analysis.log.metrics.falls.empty()) << "it lies, stands up, walks, and lies down";
  EXPECT_GT(analysis.log.metrics.walking_s, 20.0);
}

}  // namespace
}  // namespace scoria::app
