// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/inekf.h"

#include <limits>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/math/se3k.h"
#include "core/math/so3.h"
#include "core/rng.h"
#include "tests/support/allocation_guard.h"

namespace scoria::controller {
namespace {

using Index = InekfIndex;

Vec3 Random(core::Rng& rng, double size) {
  return {rng.NextUniform(-size, size), rng.NextUniform(-size, size), rng.NextUniform(-size, size)};
}

InekfNoise SomeNoise() {
  InekfNoise noise;
  noise.gyro = 1e-4 * Mat3::Identity();
  noise.accel = Vec3(1e-2, 2e-2, 3e-2).asDiagonal();
  noise.gyro_bias = 4e-6 * Mat3::Identity();
  noise.accel_bias = 2e-4 * Mat3::Identity();
  noise.contact = Vec3(1e-4, 1e-4, 3e-4).asDiagonal();
  return noise;
}

InekfState SomeState(core::Rng& rng, const LegArray<bool>& in_state) {
  InekfState x;
  x.R_WS = core::ExpSo3(Random(rng, 2.0));
  x.v_WS = Random(rng, 1.0);
  x.p_WS = Random(rng, 3.0);
  x.gyro_bias_S = Random(rng, 0.1);
  x.accel_bias_S = Random(rng, 0.3);
  x.in_state = in_state;
  for (const Leg leg : kLegs) {
    if (in_state[leg]) x.p_WF[leg] = x.p_WS + Random(rng, 0.4);
  }
  return x;
}

/// Positive definite but for the feet that are not in the state.
InekfCovariance SomeCovariance(core::Rng& rng, const LegArray<bool>& in_state) {
  InekfCovariance A;
  for (double& v : A.reshaped()) v = 0.03 * rng.NextNormal();
  for (const Leg leg : kLegs) {
    if (!in_state[leg]) A.middleRows<3>(Index::Foot(leg)).setZero();
  }
  return A * A.transpose();
}

LegArray<FootMeasurement> MeasureFeet(const InekfState& x, const LegArray<bool>& contact) {
  LegArray<FootMeasurement> feet;
  for (const Leg leg : kLegs) {
    const Vec3 nominal_S(IsFront(leg) ? 0.2 : -0.2, IsLeft(leg) ? 0.14 : -0.14, -0.3);
    feet[leg].in_contact = contact[leg];
    feet[leg].p_SF_S =
        x.in_state[leg] ? Vec3(x.R_WS.transpose() * (x.p_WF[leg] - x.p_WS)) : nominal_S;
    feet[leg].cov_SF_S = Vec3(1e-5, 2e-5, 3e-5).asDiagonal();
  }
  return feet;
}

constexpr LegArray<bool> kAll{true};
constexpr LegArray<bool> kNone{false};
constexpr LegArray<bool> kDiagonal{true, false, false, true};
const Vec3 kGravity_W(0.0, 0.0, -9.81);

using LongMat3 = Eigen::Matrix<long double, 3, 3>;

LongMat3 LongSkew(const Vec3& v) { return core::Skew(v).cast<long double>(); }

/// [φ]×ⁿ for n < count.
std::vector<LongMat3> Powers(const Vec3& phi, int count) {
  std::vector<LongMat3> powers = {LongMat3::Identity()};
  while (static_cast<int>(powers.size()) < count) powers.push_back(powers.back() * LongSkew(phi));
  return powers;
}

long double Factorial(int n) { return n < 2 ? 1.0L : n * Factorial(n - 1); }

// Both sides of the change of formula at 1 rad, and down to where θ² underflows.
constexpr double kAngles[] = {0.0,      1e-160, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 0.5,
                              0.999999, 1.0,    1.01, 2.0,  3.0,  3.2,  4.5,  6.0};

TEST(GammaSo3, EqualsItsSeries) {
  core::Rng rng(1, 0, core::Stream::kSensor);
  for (const double angle : kAngles) {
    const Vec3 phi = angle * Random(rng, 1.0).normalized();
    const core::GammaSo3 gamma(phi);
    const std::vector<LongMat3> powers = Powers(phi, 60);
    for (int m = 0; m <= core::GammaSo3::kMaxOrder; ++m) {
      LongMat3 sum = LongMat3::Zero();
      for (int n = 0; n < 60; ++n) sum += powers[static_cast<std::size_t>(n)] / Factorial(n + m);
      EXPECT_LT((gamma(m) - sum.cast<double>()).cwiseAbs().maxCoeff(), 1e-13) << angle << ' ' << m;
    }
    EXPECT_LT((gamma(0) - core::ExpSo3(phi)).cwiseAbs().maxCoeff(), 1e-13) << angle;
  }
}

TEST(InekfTransition, BiasIntegralsEqualTheirSeriesAlsoAtRest) {
  core::Rng rng(2, 0, core::Stream::kSensor);
  for (const double angle : kAngles) {
    const Vec3 phi = angle * Random(rng, 1.0).normalized(), a_S = Random(rng, 10.0);
    const InekfTransition t = CalcExactTransition({}, Vec3::Zero(), a_S, phi, 1.0);
    const std::vector<LongMat3> powers = Powers(phi, 40);
    LongMat3 psi1 = LongMat3::Zero(), psi2 = LongMat3::Zero();
    for (int i = 0; i < 40; ++i) {
      for (int j = 0; j < 40; ++j) {
        const LongMat3 term = powers[static_cast<std::size_t>(i)] * LongSkew(a_S) *
                              powers[static_cast<std::size_t>(j)];
        psi1 += term / Factorial(i + j + 2);
        psi2 += (j + 2) * term / Factorial(i + j + 3);
      }
    }
    const double tolerance = 1e-13 * (1.0 + angle) * 10.0;
    EXPECT_LT((t.velocity_gyro_bias + psi1.cast<double>()).norm(), tolerance) << angle;
    EXPECT_LT((t.position_gyro_bias + psi2.cast<double>()).norm(), tolerance) << angle;
  }
}

InekfCovariance Dense(const InekfTransition& t) {
  InekfCovariance phi = InekfCovariance::Identity();
  constexpr int r = Index::kRotation, v = Index::kVelocity, p = Index::kPosition;
  constexpr int bg = Index::kGyroBias, ba = Index::kAccelBias;
  phi.block<3, 3>(r, bg) = t.rotation_gyro_bias;
  phi.block<3, 3>(v, r) = t.velocity_rotation;
  phi.block<3, 3>(v, bg) = t.velocity_gyro_bias;
  phi.block<3, 3>(v, ba) = t.velocity_accel_bias;
  phi.block<3, 3>(p, r) = t.position_rotation;
  phi.block<3, 3>(p, v) = t.position_velocity * Mat3::Identity();
  phi.block<3, 3>(p, bg) = t.position_gyro_bias;
  phi.block<3, 3>(p, ba) = t.position_accel_bias;
  for (const Leg leg : kLegs) phi.block<3, 3>(Index::Foot(leg), bg) = t.foot_gyro_bias[leg];
  return phi;
}

/// ξ̇ = A ξ, [Hartley2020], with biases.
InekfCovariance ErrorDynamics(const InekfState& x) {
  InekfTransition t;
  t.rotation_gyro_bias = t.velocity_accel_bias = -x.R_WS;
  t.velocity_rotation = core::Skew(kGravity_W);
  t.velocity_gyro_bias = -core::Skew(x.v_WS) * x.R_WS;
  t.position_rotation = t.position_accel_bias = Mat3::Zero();
  t.position_velocity = 1.0;
  t.position_gyro_bias = -core::Skew(x.p_WS) * x.R_WS;
  for (const Leg leg : kLegs) t.foot_gyro_bias[leg] = -core::Skew(x.p_WF[leg]) * x.R_WS;
  return Dense(t) - InekfCovariance::Identity();
}

InekfState Moved(const InekfState& x, const InekfState& rate, double h) {
  InekfState y = x;
  y.R_WS += h * rate.R_WS;
  y.v_WS += h * rate.v_WS;
  y.p_WS += h * rate.p_WS;
  return y;
}

InekfState Rate(const InekfState& x, const Vec3& a_S, const Vec3& w_S) {
  InekfState rate;
  rate.R_WS = x.R_WS * core::Skew(w_S);
  rate.v_WS = x.R_WS * a_S + kGravity_W;
  rate.p_WS = x.v_WS;
  return rate;
}

/// Classical Runge-Kutta for mean and Φ together.
void Integrate(InekfState& x, InekfCovariance& phi, const Vec3& a_S, const Vec3& w_S, double dt) {
  constexpr int kSteps = 400;
  const double h = dt / kSteps;
  for (int k = 0; k < kSteps; ++k) {
    const InekfState k1 = Rate(x, a_S, w_S), x2 = Moved(x, k1, 0.5 * h);
    const InekfState k2 = Rate(x2, a_S, w_S), x3 = Moved(x, k2, 0.5 * h);
    const InekfState k3 = Rate(x3, a_S, w_S), x4 = Moved(x, k3, h);
    const InekfState k4 = Rate(x4, a_S, w_S);
    const InekfCovariance f1 = ErrorDynamics(x) * phi;
    const InekfCovariance f2 = ErrorDynamics(x2) * (phi + 0.5 * h * f1);
    const InekfCovariance f3 = ErrorDynamics(x3) * (phi + 0.5 * h * f2);
    const InekfCovariance f4 = ErrorDynamics(x4) * (phi + h * f3);
    phi += h / 6.0 * (f1 + 2.0 * f2 + 2.0 * f3 + f4);
    x = Moved(Moved(Moved(Moved(x, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
  }
}

TEST(Inekf, MeanAndTransitionEqualNumericalIntegration) {
  core::Rng rng(3, 0, core::Stream::kSensor);
  for (const double rate : {0.0, 1e-6, 1e-3, 0.1, 1.0, 10.0, 40.0}) {
    const InekfState x = SomeState(rng, kAll);
    const Vec3 a_S = Random(rng, 15.0), w_S = rate * Random(rng, 1.0).normalized();
    constexpr double kPeriod_s = 0.05;
    constexpr double kTolerance = 1e-10;  // of Runge-Kutta, which turns by 5 mrad a step
    InekfState expected = x;
    InekfCovariance expected_phi = InekfCovariance::Identity();
    Integrate(expected, expected_phi, a_S, w_S, kPeriod_s);
    const InekfTransition t = CalcExactTransition(x, kGravity_W, a_S, w_S, kPeriod_s);
    EXPECT_LT((Dense(t) - expected_phi).cwiseAbs().maxCoeff(), kTolerance) << rate;
    Inekf filter({});
    filter.Set(x, InekfCovariance::Zero());
    ASSERT_EQ(filter.Predict(a_S + x.accel_bias_S, w_S + x.gyro_bias_S, kPeriod_s),
              InekfStatus::kOk);
    EXPECT_LT((filter.state().R_WS - expected.R_WS).norm(), kTolerance) << rate;
    EXPECT_LT((filter.state().v_WS - expected.v_WS).norm(), kTolerance) << rate;
    EXPECT_LT((filter.state().p_WS - expected.p_WS).norm(), kTolerance) << rate;
  }
}

/// Ad_X of the right-invariant error; identity on biases.
InekfCovariance Adjoint(const InekfState& x) {
  InekfCovariance ad = InekfCovariance::Identity();
  const auto set = [&](int row, const Vec3& v) {
    ad.block<3, 3>(row, Index::kRotation) = core::Skew(v) * x.R_WS;
    ad.block<3, 3>(row, row) = x.R_WS;
  };
  set(Index::kRotation, Vec3::Zero());
  ad.block<3, 3>(Index::kRotation, Index::kRotation) = x.R_WS;
  set(Index::kVelocity, x.v_WS);
  set(Index::kPosition, x.p_WS);
  for (const Leg leg : kLegs) set(Index::Foot(leg), x.p_WF[leg]);
  return ad;
}

TEST(Inekf, BlocksOfThePredictionEqualDenseAlgebra) {
  core::Rng rng(4, 0, core::Stream::kSensor);
  for (const LegArray<bool>& in_state : {kAll, kDiagonal, kNone}) {
    const InekfState x = SomeState(rng, in_state);
    const InekfCovariance P = SomeCovariance(rng, in_state);
    const Vec3 a_S = Random(rng, 15.0), w_S = Random(rng, 5.0);
    constexpr double kPeriod_s = 0.01;
    InekfCovariance Q = InekfCovariance::Zero();
    const InekfNoise noise = SomeNoise();
    Q.block<3, 3>(Index::kRotation, Index::kRotation) = noise.gyro;
    Q.block<3, 3>(Index::kVelocity, Index::kVelocity) = noise.accel;
    Q.block<3, 3>(Index::kGyroBias, Index::kGyroBias) = noise.gyro_bias;
    Q.block<3, 3>(Index::kAccelBias, Index::kAccelBias) = noise.accel_bias;
    InekfCovariance active = InekfCovariance::Identity();
    for (const Leg leg : kLegs) {
      Q.block<3, 3>(Index::Foot(leg), Index::Foot(leg)) = noise.contact;
      if (!in_state[leg]) active.middleCols<3>(Index::Foot(leg)).setZero();
    }
    const InekfCovariance phi = Dense(
        CalcExactTransition(x, kGravity_W, a_S - x.accel_bias_S, w_S - x.gyro_bias_S, kPeriod_s));
    const InekfCovariance ad = active * Adjoint(x);
    const InekfCovariance expected =
        active * phi * (P + ad * Q * ad.transpose() * kPeriod_s) * phi.transpose() * active;
    Inekf filter({.noise = noise});
    filter.Set(x, P);
    ASSERT_EQ(filter.Predict(a_S, w_S, kPeriod_s), InekfStatus::kOk);
    EXPECT_LT((filter.covariance() - expected).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(Inekf, CorrectionEqualsTheJosephForm) {
  core::Rng rng(5, 0, core::Stream::kSensor);
  const InekfState x = SomeState(rng, kAll);
  const InekfCovariance P = SomeCovariance(rng, kAll);
  LegArray<FootMeasurement> feet = MeasureFeet(x, kAll);
  Eigen::Matrix<double, 12, Index::kDim> H = Eigen::Matrix<double, 12, Index::kDim>::Zero();
  Mat12 N = Mat12::Zero();
  Vec12 y;
  for (const Leg leg : kLegs) {
    const int i = 3 * static_cast<int>(leg);
    const Vec3 error_S = Random(rng, 0.01);
    feet[leg].p_SF_S += error_S;
    y.segment<3>(i) = x.R_WS * error_S;
    H.block<3, 3>(i, Index::kPosition) = -Mat3::Identity();
    H.block<3, 3>(i, Index::Foot(leg)) = Mat3::Identity();
    N.block<3, 3>(i, i) = x.R_WS * feet[leg].cov_SF_S * x.R_WS.transpose();
  }
  const Mat12 S = H * P * H.transpose() + N;
  const Eigen::Matrix<double, Index::kDim, 12> K = P * H.transpose() * S.inverse();
  const InekfCovariance rest = InekfCovariance::Identity() - K * H;
  Inekf filter({});
  filter.Set(x, P);
  const InekfCorrection result = filter.Correct(feet);
  EXPECT_EQ(result.status, InekfStatus::kOk);
  EXPECT_EQ(result.dof, 12);
  EXPECT_NEAR(result.nis, y.dot(S.inverse() * y), 1e-9 * result.nis);
  for (const Leg leg : kLegs) {
    const int i = 3 * static_cast<int>(leg);
    EXPECT_TRUE(result.feet[leg].used);
    EXPECT_LT((result.feet[leg].y_W - y.segment<3>(i)).norm(), 1e-14);
    EXPECT_LT((result.feet[leg].cov_W - S.block<3, 3>(i, i)).norm(), 1e-14);
  }
  EXPECT_LT((filter.covariance() - (rest * P * rest.transpose() + K * N * K.transpose())).norm(),
            1e-12);
  const Eigen::Matrix<double, Index::kDim, 1> xi = K * y;
  EXPECT_LT((filter.state().R_WS - core::ExpSo3(xi.head<3>()) * x.R_WS).norm(), 1e-12);
  EXPECT_LT((filter.state().gyro_bias_S - x.gyro_bias_S - xi.segment<3>(9)).norm(), 1e-12);
}

TEST(Inekf, CovarianceStaysSymmetricAndSemidefinite) {
  core::Rng rng(6, 0, core::Stream::kSensor);
  Inekf filter({.noise = SomeNoise()});
  filter.Set({}, 1e-2 * InekfCovariance::Identity());
  const LegArray<FootMeasurement> nominal = MeasureFeet({}, kAll);
  for (int k = 0; k < 100'000; ++k) {
    const Vec3 a_S = Vec3(0.0, 0.0, 9.81) + Random(rng, 0.3);
    ASSERT_EQ(filter.Predict(a_S, Random(rng, 0.1), 0.002), InekfStatus::kOk);
    const int phase = k / 150 % 3;  // stand, one diagonal, the other
    LegArray<FootMeasurement> feet = nominal;
    for (const Leg leg : kLegs) {
      feet[leg].in_contact = phase == 0 || kDiagonal[leg] == (phase == 1);
      feet[leg].p_SF_S += Random(rng, 0.003);
    }
    ASSERT_EQ(filter.Correct(feet).status, InekfStatus::kOk);
  }
  const InekfCovariance& P = filter.covariance();
  EXPECT_EQ(P, P.transpose());
  const Eigen::SelfAdjointEigenSolver<InekfCovariance> eigen(P);
  EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-14 * eigen.eigenvalues().maxCoeff());
  const Mat3& R = filter.state().R_WS;
  EXPECT_LT((R * R.transpose() - Mat3::Identity()).norm(), 1e-14);
  EXPECT_LT(filter.state().v_WS.norm(), 0.1);
}

TEST(Inekf, NoTimeChangesNothing) {
  core::Rng rng(7, 0, core::Stream::kSensor);
  const InekfState x = SomeState(rng, kDiagonal);
  const InekfCovariance P = SomeCovariance(rng, kDiagonal);
  for (const Vec3& w_S : {Vec3(Vec3::Zero()), Vec3(1.0, 2.0, 3.0)}) {
    Inekf filter({.noise = SomeNoise()});
    filter.Set(x, P);
    ASSERT_EQ(filter.Predict(Vec3(1.0, 2.0, 9.0), w_S, 0.0), InekfStatus::kOk);
    EXPECT_LT((filter.state().R_WS - x.R_WS).norm(), 1e-15);
    EXPECT_EQ(filter.state().v_WS, x.v_WS);
    EXPECT_EQ(filter.state().p_WS, x.p_WS);
    EXPECT_LT((filter.covariance() - P).norm(), 1e-16);
  }
}

TEST(Inekf, FeetEnterLeaveAndMove) {
  core::Rng rng(8, 0, core::Stream::kSensor);
  Inekf filter({.noise = SomeNoise()});
  filter.Set(SomeState(rng, kNone), SomeCovariance(rng, kNone));
  const InekfCorrection first = filter.Correct(MeasureFeet(filter.state(), kDiagonal));
  EXPECT_EQ(first.dof, 0);
  EXPECT_EQ(filter.state().in_state, kDiagonal);
  EXPECT_EQ(filter.Correct(MeasureFeet(filter.state(), kAll)).dof, 6);
  EXPECT_EQ(filter.state().in_state, kAll);
  const InekfCovariance P = filter.covariance();
  const Vec3 p_WF = filter.state().p_WF[Leg::kHL], delta_W(0.01, 0.0, 0.002);
  filter.MoveFoot(Leg::kHL, delta_W, 1e-6 * Mat3::Identity());
  EXPECT_EQ(filter.state().p_WF[Leg::kHL], p_WF + delta_W);
  EXPECT_NEAR((filter.covariance() - P).trace(), 3e-6, 1e-12);
  filter.Drop(Leg::kHL);
  EXPECT_FALSE(filter.state().in_state[Leg::kHL]);
  EXPECT_EQ(filter.covariance().middleCols<3>(Index::Foot(Leg::kHL)).norm(), 0.0);
  filter.MoveFoot(Leg::kHL, delta_W);
  EXPECT_EQ(filter.state().p_WF[Leg::kHL], Vec3::Zero());
  EXPECT_EQ(filter.Correct(MeasureFeet(filter.state(), kNone)).dof, 0);
  EXPECT_EQ(filter.state().in_state, kNone);
}

TEST(Inekf, RefusesWhatIsNotFiniteOrIndefinite) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  core::Rng rng(9, 0, core::Stream::kSensor);
  Inekf filter({.noise = SomeNoise()});
  filter.Set(SomeState(rng, kDiagonal), SomeCovariance(rng, kDiagonal));
  const InekfState x = filter.state();
  const InekfCovariance P = filter.covariance();
  EXPECT_EQ(filter.Predict(Vec3(kNan, 0.0, 0.0), Vec3::Zero(), 0.01), InekfStatus::kNotFinite);
  EXPECT_EQ(filter.Predict(Vec3::Zero(), Vec3::Zero(), -0.01), InekfStatus::kNotFinite);
  EXPECT_EQ(filter.Predict(Vec3::Constant(1e300), Vec3::Ones(), 1e20), InekfStatus::kNotFinite);
  LegArray<FootMeasurement> feet = MeasureFeet(x, kDiagonal);
  feet[Leg::kFL].p_SF_S.x() = kNan;
  EXPECT_EQ(filter.Correct(feet).status, InekfStatus::kNotFinite);
  feet = MeasureFeet(x, kDiagonal);
  feet[Leg::kHR].cov_SF_S = -Mat3::Identity();
  EXPECT_EQ(filter.Correct(feet).status, InekfStatus::kIndefinite);
  EXPECT_EQ(filter.state(), x);
  EXPECT_EQ(filter.covariance(), P);
  feet = MeasureFeet(x, kDiagonal);
  feet[Leg::kFR].p_SF_S.x() = kNan;  // in the air: not looked at
  EXPECT_EQ(filter.Correct(feet).status, InekfStatus::kOk);
  feet[Leg::kFL].p_SF_S.x() = kNan;
  feet[Leg::kHR].in_contact = false;
  EXPECT_EQ(filter.Correct(feet).status, InekfStatus::kNotFinite);
  EXPECT_FALSE(filter.state().in_state[Leg::kHR]) << "leaves also when the correction is refused";
}

TEST(Inekf, NeverAllocates) {
  if (!test::AllocationGuard::IsArmed()) GTEST_SKIP() << "the sanitizer owns the allocator";
  Inekf filter({.noise = SomeNoise()});
  filter.Set({}, 0.01 * InekfCovariance::Identity());
  const LegArray<FootMeasurement> all = MeasureFeet({}, kAll), two = MeasureFeet({}, kDiagonal);
  const test::AllocationGuard guard;
  for (int k = 0; k < 20; ++k) {
    EXPECT_EQ(filter.Predict(Vec3(0.0, 0.0, 9.81), Vec3(0.0, 0.1, 0.0), 0.002), InekfStatus::kOk);
    EXPECT_EQ(filter.Correct(k % 8 < 4 ? all : two).status, InekfStatus::kOk);
  }
  EXPECT_EQ(guard.count(), 0);
}

}  // namespace
}  // namespace scoria::controller
