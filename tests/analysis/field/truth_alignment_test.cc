// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/truth_alignment.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/math/so3.h"
#include "tests/analysis/field/moving_body.h"

namespace scoria::analysis {
namespace {

TruthAlignmentResult Align(const std::vector<logs::Row>& rows) {
  TruthAlignmentEstimator estimator(nullptr);
  for (const logs::Row& row : rows) estimator.AddRow(row);
  return estimator.Estimate();
}

struct Case {
  const char* name;
  double delay_s;
  Vec3 p_BM;
  Vec3 rpy_BM_rad;
  std::uint64_t seed;
};

class KnownAlignment : public testing::TestWithParam<Case> {};

TEST_P(KnownAlignment, IsFoundWithinItsStandardErrors) {
  const Case& c = GetParam();
  test::MovingBody body;
  body.delay_s = c.delay_s;
  body.p_BM = c.p_BM;
  body.R_BM = core::RotationFromRpy(c.rpy_BM_rad);
  body.seed = c.seed;
  const TruthAlignmentResult found = Align(body.Rows());
  ASSERT_TRUE(found.alignment) << found.refusal;
  const TimeOffset& offset = found.alignment->offset;
  constexpr double kSigmas = 4.0;
  EXPECT_NEAR(offset.delay_s, c.delay_s, 1e-3);
  EXPECT_NEAR(offset.delay_s, c.delay_s, kSigmas * offset.sigma_s + 1e-4);
  EXPECT_GT(offset.sigma_s, 1e-6);
  const Vec3 turned = core::LogSo3(offset.R_BM * body.R_BM.transpose());
  EXPECT_LT(turned.norm(), 0.01);
  ASSERT_TRUE(found.alignment->lever_arm) << found.alignment->why_no_lever_arm;
  const LeverArm& arm = *found.alignment->lever_arm;
  EXPECT_LT((arm.p_BM - c.p_BM).norm(), 0.005) << arm.p_BM.transpose();
  // Axes that are turned by their own error turn the lever arm along.
  const double allowed = kSigmas * arm.sigma_m.norm() + turned.norm() * c.p_BM.norm() + 1e-3;
  EXPECT_LT((arm.p_BM - c.p_BM).norm(), allowed);
  EXPECT_LT(arm.sigma_m.maxCoeff(), 0.005);
}

INSTANTIATE_TEST_SUITE_P(
    Of, KnownAlignment,
    testing::Values(Case{"None", 0.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 1},
                    Case{"Late", 0.33, {0.10, 0.05, 0.12}, {0.0, 0.0, 0.0}, 2},
                    Case{"Early", -1.1, {-0.2, 0.0, 0.3}, {0.0, 0.0, 0.0}, 3},
                    Case{"PartOfASample", 0.0037, {0.0, 0.0, -0.1}, {0.0, 0.0, 0.0}, 4},
                    Case{"Turned", -0.0225, {0.25, -0.02, 0.1}, {0.05, -0.12, 0.4}, 5},
                    Case{"UpsideDown", 2.5, {0.05, 0.2, 0.05}, {3.1, 0.0, -1.5}, 6}),
    [](const auto& test_info) { return test_info.param.name; });

TEST(TruthAlignment, EstimateTellsTheLeverArmWithoutAccelerometer) {
  test::MovingBody body;
  body.delay_s = 0.2;
  body.p_BM = {0.1, 0.05, 0.12};
  std::vector<logs::Row> rows = body.Rows();
  for (logs::Row& row : rows) row.measured->a_WS_S_mps2.reset();
  const TruthAlignmentResult found = Align(rows);
  ASSERT_TRUE(found.alignment && found.alignment->lever_arm);
  EXPECT_EQ(found.alignment->lever_arm->source, LeverArmSource::kEstimate);
  EXPECT_LT((found.alignment->lever_arm->p_BM - body.p_BM).norm(), 0.005);
}

TEST(TruthAlignment, LeverArmsThatDifferByMoreThanTheirErrorsAreLessSure) {
  LeverArm a, b;
  a.p_BM = {0.1, 0.1, 0.1};
  a.sigma_m = {0.003, 0.003, 0.003};
  b.p_BM = {0.1, 0.105, 0.15};
  b.sigma_m = {0.003, 0.004, 0.004};
  const LeverArm both = Combine(a, b);
  EXPECT_EQ(both.source, LeverArmSource::kBoth);
  EXPECT_NEAR(both.p_BM.x(), 0.1, 1e-12);
  EXPECT_NEAR(both.sigma_m.x(), 0.003 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(both.p_BM.y(), 0.1018, 1e-12);  // one standard error apart: weights 16 to 9
  EXPECT_NEAR(both.sigma_m.y(), 0.0024, 1e-12);
  EXPECT_NEAR(both.p_BM.z(), 0.118, 1e-12);  // ten apart
  EXPECT_NEAR(both.sigma_m.z(), 0.024, 1e-12);
}

TEST(TruthAlignment, MarkersThatAreMixedUpForAMomentChangeLittle) {
  test::MovingBody body;
  body.delay_s = 0.33;
  body.p_BM = {0.1, 0.05, 0.12};
  std::vector<logs::Row> rows = body.Rows();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (k % 500 >= 8) continue;
    rows[k].truth->p_WB_m[0] += 0.3;
    rows[k].truth->rpy_rad[2] += 1.0;
  }
  const TruthAlignmentResult found = Align(rows);
  ASSERT_TRUE(found.alignment && found.alignment->lever_arm);
  EXPECT_NEAR(found.alignment->offset.delay_s, body.delay_s, 2e-3);
  EXPECT_LT((found.alignment->lever_arm->p_BM - body.p_BM).norm(), 0.01);
}

TEST(TruthAlignment, GapsOfTheLogAreNoMotion) {
  test::MovingBody body;
  body.delay_s = 0.33;
  body.p_BM = {0.1, 0.05, 0.12};
  std::vector<logs::Row> rows = body.Rows();
  std::erase_if(rows, [](const logs::Row& row) { return std::fmod(row.time_s, 3.0) < 0.4; });
  const TruthAlignmentResult found = Align(rows);
  ASSERT_TRUE(found.alignment && found.alignment->lever_arm);
  EXPECT_NEAR(found.alignment->offset.delay_s, body.delay_s, 2e-3);
  EXPECT_LT((found.alignment->lever_arm->p_BM - body.p_BM).norm(), 0.01);
}

TEST(TruthAlignment, StandingRobotIsRefused) {
  test::MovingBody body;
  body.speed_mps = body.turning_radps = body.sway_rad = 0.0;
  EXPECT_EQ(Align(body.Rows()).refusal, "the trunk hardly turns: 0.005 rad/s rms");
}

TEST(TruthAlignment, GaitThatOnlyRepeatsItselfIsRefused) {
  test::MovingBody body;
  body.turning_radps = 0.0;
  const std::string refusal = Align(body.Rows()).refusal;
  EXPECT_NE(refusal.find("the gait repeats itself"), std::string::npos) << refusal;
}

TEST(TruthAlignment, TruthOfAnotherWalkIsRefused) {
  test::MovingBody body, other;
  other.turning_radps = -0.7;
  other.delay_s = 8.0;
  std::vector<logs::Row> rows = body.Rows();
  const std::vector<logs::Row> others = other.Rows();
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].truth = others[k].truth;
  EXPECT_FALSE(Align(rows).alignment);
}

TEST(TruthAlignment, LogWithoutGyroscopeOrTruthIsRefusedInWords) {
  std::vector<logs::Row> rows = test::MovingBody().Rows();
  for (logs::Row& row : rows) row.measured.reset();
  EXPECT_EQ(Align(rows).refusal, "the log has no gyroscope to find the time of the truth by");
  for (logs::Row& row : rows) row.truth.reset();
  EXPECT_EQ(Align(rows).refusal, "the log has no truth");
  EXPECT_EQ(Align({}).refusal, "the log has no truth");
  EXPECT_EQ(nlohmann::json(Align(rows)).dump(), R"({"refusal":"the log has no truth"})");
}

TEST(TruthAlignment, SaysInWordsAndJsonWhatItFound) {
  TruthAlignment alignment;
  alignment.offset = {.delay_s = -0.0225, .sigma_s = 0.0004, .left = 0.04};
  alignment.lever_arm =
      LeverArm{LeverArmSource::kAccelerometer, {0.25, -0.02, 0.1}, {0.004, 0.005, 0.006}};
  EXPECT_EQ(DescribeAlignment({alignment, {}}),
            "truth is 22.5 ms early (standard error 0.4 ms), its axes turned by roll 0.00, pitch "
            "0.00, yaw 0.00 deg (0.00) on the trunk, lever arm 0.250, -0.020, 0.100 m (0.004, "
            "0.005, 0.006) by the accelerometer");
  const nlohmann::json j = TruthAlignmentResult{alignment, {}};
  EXPECT_EQ(j.at("delay_s"), -0.0225);
  EXPECT_EQ(j.at("lever_arm").at("p_BM_m"), nlohmann::json({0.25, -0.02, 0.1}));
  EXPECT_EQ(j.at("lever_arm").at("source"), "accelerometer");
}

}  // namespace
}  // namespace scoria::analysis
