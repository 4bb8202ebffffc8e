// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <limits>
#include <string>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "controller/estimation/rest_attitude.h"
#include "controller/estimation/sample_guard.h"
#include "controller/estimation/state_estimator.h"
#include "core/math/so3.h"
#include "core/rng.h"
#include "tests/support/robots.h"

namespace scoria::controller {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

SensorFrame FrameAt(double time_s) {
  SensorFrame z;
  z.imu_time_s = time_s;
  z.a_WS_S = Vec3(0.0, 0.0, 9.81);
  return z;
}

TEST(SampleGuard, GivesTheTimeBetweenSamples) {
  Counters counters;
  SampleGuard guard({});
  EXPECT_EQ(guard.Check(FrameAt(1.0), counters).imu_dt_s, 0.0) << "the first has no past";
  EXPECT_NEAR(guard.Check(FrameAt(1.001), counters).imu_dt_s, 0.001, 1e-12);
  EXPECT_EQ(counters, Counters());
}

TEST(SampleGuard, CountsRepeatsGapsAndClocksThatGoBack) {
  Counters counters;
  SampleGuard guard({});
  for (const double t : {1.0, 1.001, 1.002}) (void)guard.Check(FrameAt(t), counters);
  EXPECT_EQ(guard.Check(FrameAt(1.002), counters).imu_dt_s, 0.0);
  EXPECT_EQ(counters[Count::kImuRepeated], 1u);
  EXPECT_NEAR(guard.Check(FrameAt(1.006), counters).imu_dt_s, 0.004, 1e-12) << "covers the gap";
  EXPECT_EQ(counters[Count::kImuGap], 1u);
  EXPECT_EQ(guard.Check(FrameAt(9.0), counters).imu_dt_s, SampleGuardParams{}.max_gap_s);
  EXPECT_EQ(guard.Check(FrameAt(0.5), counters).imu_dt_s, 0.0);
  EXPECT_EQ(counters[Count::kImuBackwards], 1u);
  EXPECT_NEAR(guard.Check(FrameAt(0.501), counters).imu_dt_s, 0.001, 1e-12) << "goes on from there";
}

TEST(SampleGuard, HoldsWhatIsNotFinite) {
  Counters counters;
  SampleGuard guard({});
  SensorFrame good = FrameAt(0.0);
  good.q[Leg::kHR] = Vec3(0.1, 0.2, 0.3);
  (void)guard.Check(good, counters);
  SensorFrame bad = FrameAt(0.001);
  bad.a_WS_S.y() = kNaN;
  bad.q[Leg::kHR].x() = kNaN;
  const CheckedFrame& checked = guard.Check(bad, counters);
  EXPECT_EQ(checked.z.a_WS_S, good.a_WS_S);
  EXPECT_EQ(checked.z.q[Leg::kHR], good.q[Leg::kHR]);
  EXPECT_EQ(counters[Count::kImuInvalid], 1u);
  EXPECT_EQ(counters[Count::kJointInvalid], 1u);
  bad = FrameAt(kNaN);
  EXPECT_EQ(guard.Check(bad, counters).imu_dt_s, 0.0);
  EXPECT_EQ(counters[Count::kImuInvalid], 2u);
}

TEST(SampleGuard, TellsSaturation) {
  Counters counters;
  SampleGuard guard({});
  SensorFrame z = FrameAt(0.0);
  EXPECT_FALSE(guard.Check(z, counters).imu_saturated);
  z.a_WS_S.x() = -157.0;
  EXPECT_TRUE(guard.Check(z, counters).imu_saturated);
  EXPECT_EQ(counters[Count::kImuSaturated], 1u);
}

TEST(RestAttitude, FindsGravityAndBiasOnlyAtRest) {
  RestAttitude rest({});
  const Mat3 R_WB = core::RotationFromRpy({0.1, -0.2, 0.7});
  const Vec3 a_S = R_WB.transpose() * Vec3(0.0, 0.0, 9.81), bias_S(0.002, -0.001, 0.003);
  for (int i = 0; i < 300; ++i) {  // sways: not at rest
    rest.Add(a_S, bias_S + Vec3(0.0, 0.3 * std::sin(0.02 * i), 0.0), 0.001);
  }
  EXPECT_FALSE(rest.IsReady());
  EXPECT_EQ(rest.GyroBias_S(), Vec3::Zero().eval());
  for (int i = 0; i < 400; ++i) rest.Add(a_S, bias_S, 0.001);
  EXPECT_TRUE(rest.IsReady());
  EXPECT_LT((rest.GyroBias_S() - bias_S).norm(), 1e-3);
  EXPECT_LT(core::LogSo3(rest.R_WB(Mat3::Identity(), 0.7) * R_WB.transpose()).norm(), 1e-6);
}

TEST(RestAttitude, HasPatience) {
  RestAttitude rest({});
  for (int i = 0; i < 3100; ++i)
    rest.Add(Vec3(0.0, 0.0, 9.81), Vec3(std::sin(0.05 * i), 0.0, 0.0), 0.001);
  EXPECT_TRUE(rest.IsReady());
  EXPECT_EQ(rest.GyroBias_S(), Vec3::Zero().eval());
}

// A Go2 that stands still, its sensors ideal: every estimator knows where it is, and stays there.
class Estimator : public ::testing::TestWithParam<EstimatorParams> {
 protected:
  Estimator() : model_(test::Go2(), 9.81) {
    state_ = test::StandingState();
    model_.Calc(state_, wb_);
    contact_.contact = LegArray<bool>(true);
    z_ = FrameAt(0.0);
    z_.q = state_.q;
    estimator_ = MakeStateEstimator(GetParam(), test::Go2(), 9.81, Placement{});
  }
  StateEstimate Step(bool at_rest) {
    return estimator_->Update({z_, 0.001, false, contact_, wb_, Vec3::UnitZ(), at_rest}, counters_);
  }

  core::WholeBodyModel model_;
  core::WholeBody wb_;
  RobotState state_;
  ContactEstimate contact_;
  SensorFrame z_;
  Counters counters_;
  std::unique_ptr<StateEstimator> estimator_;
};

TEST_P(Estimator, StandsStill) {
  EXPECT_FALSE(Step(true).ready);
  StateEstimate estimate;
  for (int i = 0; i < 300; ++i) estimate = Step(true);
  EXPECT_TRUE(estimate.ready);
  for (int i = 0; i < 5000; ++i) estimate = Step(false);
  EXPECT_LT((estimate.state.p_WB - state_.p_WB).norm(), 1e-3);
  EXPECT_LT(estimate.state.v_WB.norm(), 1e-3);
  EXPECT_LT(core::LogSo3(estimate.state.R_WB).norm(), 1e-4);
  EXPECT_EQ(counters_, Counters());
}

TEST_P(Estimator, WithoutNewSamplesOrFeetItStaysFinite) {
  for (int i = 0; i < 300; ++i) (void)Step(true);
  contact_.contact = LegArray<bool>(false);
  StateEstimate estimate;
  for (int i = 0; i < 500; ++i) estimate = Step(false);
  EXPECT_TRUE(estimate.state.p_WB.allFinite());
  EXPECT_LT((estimate.state.p_WB - state_.p_WB).norm(), 0.05) << "half a second by the IMU alone";
}

// An estimator that follows another one knows the gyro's bias that was learned, and is no surer of
// tilt and velocity than that one was.
TEST_P(Estimator, HandsItsGyroBiasAndCovarianceToTheNext) {
  const Vec3 bias_S(0.02, -0.01, 0.015);
  z_.w_WS_S = bias_S;
  for (int i = 0; i < 600; ++i) (void)Step(true);
  StateEstimate last;
  for (int i = 0; i < 2000; ++i) last = Step(false);
  for (const EstimatorParams& next_params :
       {EstimatorParams(InekfEstimatorParams{}), EstimatorParams(LinearKfParams{}),
        EstimatorParams(LegOdometryParams{})}) {
    const auto next = MakeStateEstimator(next_params, test::Go2(), 9.81, {});
    next->Continue(last, 1.0);
    const StateEstimate first =
        next->Update({z_, 0.001, false, contact_, wb_, Vec3::UnitZ(), false}, counters_);
    EXPECT_LT(first.state.w_WB.norm(), 1e-3);
    if (first.P_tilt_v.isZero()) continue;
    const StateEstimate::Mat5 surplus = first.P_tilt_v - 0.99 * last.P_tilt_v;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<StateEstimate::Mat5>(surplus).eigenvalues().minCoeff(),
              0.0);
    constexpr double kTiltOfABaseline_rad = 0.02;  // of an estimator that states no covariance
    if (last.P_tilt_v.isZero()) {
      EXPECT_GT(std::sqrt(first.P_tilt_v(0, 0)), kTiltOfABaseline_rad);
    }
  }
}

std::string EstimatorName(const ::testing::TestParamInfo<EstimatorParams>& info) {
  constexpr std::array kNames = {"inekf", "linear_kf", "leg_odometry"};
  return kNames[info.index];
}

INSTANTIATE_TEST_SUITE_P(Of, Estimator,
                         ::testing::Values(EstimatorParams(InekfEstimatorParams{}),
                                           EstimatorParams(LinearKfParams{}),
                                           EstimatorParams(LegOdometryParams{})),
                         EstimatorName);

}  // namespace
}  // namespace scoria::controller
