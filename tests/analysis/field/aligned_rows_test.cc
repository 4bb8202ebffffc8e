// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/aligned_rows.h"

#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "logs/vectors.h"
#include "tests/analysis/field/moving_body.h"

namespace scoria::analysis {
namespace {

test::MovingBody Exact(double delay_s) {
  test::MovingBody body;
  body.delay_s = delay_s;
  body.p_BM = {0.1, 0.05, 0.12};
  body.R_BM = core::RotationFromRpy({0.1, -0.2, 0.3});
  body.place_noise_m = body.attitude_noise_rad = 0.0;
  body.duration_s = 8.0;
  return body;
}

std::vector<logs::Row> Aligned(const std::vector<logs::Row>& rows, const test::MovingBody& body) {
  TruthAlignment alignment;
  alignment.offset.delay_s = body.delay_s;
  alignment.offset.R_BM = body.R_BM;
  alignment.lever_arm = LeverArm{.p_BM = body.p_BM};
  std::vector<logs::Row> out;
  AlignedRows aligned(alignment, [&](const logs::Row& row) { out.push_back(row); });
  for (const logs::Row& row : rows) aligned.Add(row);
  aligned.Finish();
  return out;
}

class AlignedRowsOfDelay : public testing::TestWithParam<double> {};

TEST_P(AlignedRowsOfDelay, HaveTheTruthOfTheTrunkAtTheirTime) {
  const test::MovingBody body = Exact(GetParam());
  const std::vector<logs::Row> rows = body.Rows(), aligned = Aligned(rows, body);
  ASSERT_EQ(aligned.size(), rows.size());
  std::size_t with_truth = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const logs::Row& row = aligned[k];
    EXPECT_EQ(row.time_s, rows[k].time_s);
    EXPECT_EQ(row.measured, rows[k].measured);
    if (!row.truth) continue;
    ++with_truth;
    EXPECT_LT((logs::ToVec3(row.truth->p_WB_m) - body.p_WB(row.time_s)).norm(), 1e-4);
    const Mat3 R_WB = core::RotationFromRpy(logs::ToVec3(row.truth->rpy_rad));
    EXPECT_LT(core::LogSo3(R_WB.transpose() * body.R_WB(row.time_s)).norm(), 1e-3);
  }
  const double beyond_s = std::abs(GetParam());  // of the log's end, or before its start
  EXPECT_NEAR(static_cast<double>(with_truth) / body.rate_Hz, body.duration_s - beyond_s, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Of, AlignedRowsOfDelay, testing::Values(0.0, 0.33, -1.1, 0.0037));

TEST(AlignedRows, HaveNoTruthWhereItPauses) {
  const test::MovingBody body = Exact(0.33);
  std::vector<logs::Row> rows = body.Rows();
  for (logs::Row& row : rows) {
    if (row.time_s > 3.0 && row.time_s < 3.5) row.truth.reset();
  }
  for (const logs::Row& row : Aligned(rows, body)) {
    const double seen_at_s = row.time_s + body.delay_s;
    if (seen_at_s < 2.99) {
      EXPECT_TRUE(row.truth) << row.time_s;
    } else if (seen_at_s > 3.0 + 1e-3 && seen_at_s < 3.5 - 1e-3) {
      EXPECT_FALSE(row.truth) << row.time_s;
    }
  }
}

TEST(AlignedRows, GoOnAfterAClockThatIsSetBack) {
  const test::MovingBody body = Exact(0.33);
  std::vector<logs::Row> rows = body.Rows();
  for (std::size_t k = rows.size() / 2; k < rows.size(); ++k) rows[k].time_s -= 2.0;
  EXPECT_EQ(Aligned(rows, body).size(), rows.size());
}

}  // namespace
}  // namespace scoria::analysis
