// SPDX-License-Identifier: BSD-3-Clause
// Time offset and lever arm: put into the truth of walks of ours and of other simulators, whose
// truth has neither, and of a real robot, where both halves of a log have to agree.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "analysis/field/aligned_rows.h"
#include "analysis/field/truth_alignment.h"
#include "tests/logs/quality/quality_logs.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"
#include "tests/support/walk.h"

namespace scoria::analysis {
namespace {

using logs::Row;

/// The truth as cameras tell it that are late and see markers elsewhere.
void Inject(std::vector<Row>& rows, double delay_s, const Vec3& p_BM) {
  TruthAlignment opposite;
  opposite.offset.delay_s = -delay_s;
  opposite.lever_arm = LeverArm{.p_BM = -p_BM};
  std::vector<Row> out;
  AlignedRows late(opposite, [&](const Row& row) { out.push_back(row); });
  for (const Row& row : rows) late.Add(row);
  late.Finish();
  rows = out;
}

TruthAlignmentResult AlignInjected(const std::vector<Row>& rows,
                                   const core::RobotDescription& robot) {
  TruthAlignmentEstimator estimator(&robot);
  for (const Row& row : rows) estimator.AddRow(row);
  return estimator.Estimate();
}

std::vector<Row> RowsOf(const std::string& scenario, int seed,
                        const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {"duration_s=25", fmt::format("seed={}", seed)};
  overrides.insert(overrides.end(), more.begin(), more.end());
  std::vector<Row> rows;
  (void)test::Walk(test::LoadScenario(scenario, overrides),
                   [&](const Row& row) { rows.push_back(row); });
  return rows;
}

struct Injection {
  std::string scenario;
  int seed;
  double delay_s;
  Vec3 p_BM;
};

class InjectedAlignment : public testing::TestWithParam<Injection> {};

TEST_P(InjectedAlignment, IsFoundWithin5msAnd1cm) {
  const Injection& c = GetParam();
  std::vector<Row> rows = RowsOf(c.scenario, c.seed);
  Inject(rows, c.delay_s, c.p_BM);
  const TruthAlignmentResult found = AlignInjected(rows, test::Go2());
  ASSERT_TRUE(found.alignment) << found.refusal;
  EXPECT_NEAR(found.alignment->offset.delay_s, c.delay_s, 0.005) << DescribeAlignment(found);
  ASSERT_TRUE(found.alignment->lever_arm) << DescribeAlignment(found);
  EXPECT_LT((found.alignment->lever_arm->p_BM - c.p_BM).norm(), 0.01) << DescribeAlignment(found);
}

INSTANTIATE_TEST_SUITE_P(Of, InjectedAlignment,
                         testing::Values(Injection{"rough", 1, 0.33, {0.10, 0.05, 0.12}},
                                         Injection{"rough", 31, -0.8, {-0.15, 0.0, 0.2}},
                                         Injection{"vulcano", 32, 0.021, {0.0, -0.1, 0.05}},
                                         Injection{"vulcano", 33, 1.1, {0.3, 0.0, 0.1}}),
                         [](const auto& test_info) {
                           return fmt::format("{}{}", test_info.param.scenario,
                                              test_info.param.seed);
                         });

/// A trot straight on over level ground sways by 0.04 rad/s: what errors repeat with its strides
/// tell from a lever arm is little.
TEST(SmoothWalk, TellsTheDelayBetterThanTheLeverArm) {
  std::vector<Row> rows = RowsOf("flat", 3);
  const Vec3 p_BM(0.10, 0.05, 0.12);
  Inject(rows, 0.33, p_BM);
  const TruthAlignmentResult found = AlignInjected(rows, test::Go2());
  ASSERT_TRUE(found.alignment && found.alignment->lever_arm) << DescribeAlignment(found);
  EXPECT_NEAR(found.alignment->offset.delay_s, 0.33, 0.005);
  EXPECT_LT((found.alignment->lever_arm->p_BM - p_BM).norm(), 0.03) << DescribeAlignment(found);
}

/// The first or the second half of a log.
std::vector<Row> Half(const std::vector<Row>& rows, bool second) {
  const double middle_s = 0.5 * (rows.front().time_s + rows.back().time_s);
  std::vector<Row> half;
  for (const Row& row : rows) {
    if ((row.time_s > middle_s) == second) half.push_back(row);
  }
  return half;
}

TEST(RecordedTruth, HalvesOfTest4AgreeOnDelayAndLeverArm) {
  if (!test::RecordedLog("")) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const std::vector<Row> rows = test::ReadRecordedLog({"go2_vicon_orl/test_4"});
  const TruthAlignmentResult first = AlignInjected(Half(rows, false), test::Go2()),
                             second = AlignInjected(Half(rows, true), test::Go2()),
                             whole = AlignInjected(rows, test::Go2());
  ASSERT_TRUE(first.alignment) << first.refusal;
  ASSERT_TRUE(second.alignment) << second.refusal;
  EXPECT_NEAR(first.alignment->offset.delay_s, second.alignment->offset.delay_s, 0.010);
  ASSERT_TRUE(first.alignment->lever_arm && second.alignment->lever_arm &&
              whole.alignment->lever_arm);
  const LeverArm &a = *first.alignment->lever_arm, &b = *second.alignment->lever_arm;
  EXPECT_LT((a.p_BM - b.p_BM).norm(), 0.02) << DescribeAlignment(first) << "\n"
                                            << DescribeAlignment(second);
  // Standing, the markers are 0.43 m above the ground, the trunk of a Go2 about 0.3 m.
  EXPECT_NEAR(whole.alignment->lever_arm->p_BM.z(), 0.12, 0.04);
}

}  // namespace
}  // namespace scoria::analysis
