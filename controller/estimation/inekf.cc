// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/inekf.h"

#include <cmath>

#include "core/math/cholesky.h"
#include "core/math/se3k.h"
#include "core/math/so3.h"

namespace scoria::controller {
namespace {

using Index = InekfIndex;

// Columns are padded to whole SIMD registers; the row that this adds is zero.
constexpr int kPadded = (Index::kDim + 3) / 4 * 4;
using Columns = Eigen::Matrix<double, kPadded, Index::kDim>;
using ThreeColumns = Eigen::Matrix<double, kPadded, 3>;

/// M_to ← M_to + M_from blockᵀ for three columns each: a block of M Φᵀ.
template <int to, int from>
void AddBlock(const Mat3& block, Columns& M) noexcept {
  for (int j = 0; j < 3; ++j)
    M.col(to + j) +=
        block(j, 0) * M.col(from) + block(j, 1) * M.col(from + 1) + block(j, 2) * M.col(from + 2);
}

/// M ← M Φᵀ. Columns that others need are changed last.
void TimesTransposed(const InekfTransition& phi, const LegArray<bool>& in_state,
                     Columns& M) noexcept {
  M.middleCols<3>(Index::kPosition) += phi.position_velocity * M.middleCols<3>(Index::kVelocity);
  AddBlock<Index::kPosition, Index::kRotation>(phi.position_rotation, M);
  AddBlock<Index::kPosition, Index::kGyroBias>(phi.position_gyro_bias, M);
  AddBlock<Index::kPosition, Index::kAccelBias>(phi.position_accel_bias, M);
  AddBlock<Index::kVelocity, Index::kRotation>(phi.velocity_rotation, M);
  AddBlock<Index::kVelocity, Index::kGyroBias>(phi.velocity_gyro_bias, M);
  AddBlock<Index::kVelocity, Index::kAccelBias>(phi.velocity_accel_bias, M);
  AddBlock<Index::kRotation, Index::kGyroBias>(phi.rotation_gyro_bias, M);
  const auto add_foot = [&]<Leg leg>() {
    if (in_state[leg]) AddBlock<Index::Foot(leg), Index::kGyroBias>(phi.foot_gyro_bias[leg], M);
  };
  add_foot.operator()<Leg::kFL>();
  add_foot.operator()<Leg::kFR>();
  add_foot.operator()<Leg::kHL>();
  add_foot.operator()<Leg::kHR>();
}

/// M ← M + Ad Q Adᵀ dt, with Ad of the state X.
void AddNoise(const InekfState& x, const InekfNoise& noise, double dt_s, Columns& M) noexcept {
  ThreeColumns gyro = ThreeColumns::Zero();  // the columns of Ad that the gyro's noise enters by
  gyro.middleRows<3>(Index::kRotation) = x.R_WS;
  gyro.middleRows<3>(Index::kVelocity) = core::Skew(x.v_WS) * x.R_WS;
  gyro.middleRows<3>(Index::kPosition) = core::Skew(x.p_WS) * x.R_WS;
  const Mat3 contact = x.R_WS * (noise.contact * dt_s) * x.R_WS.transpose();
  for (const Leg leg : kLegs) {
    if (!x.in_state[leg]) continue;
    gyro.middleRows<3>(Index::Foot(leg)) = core::Skew(x.p_WF[leg]) * x.R_WS;
    M.block<3, 3>(Index::Foot(leg), Index::Foot(leg)) += contact;
  }
  M.block<3, 3>(Index::kVelocity, Index::kVelocity) +=
      x.R_WS * (noise.accel * dt_s) * x.R_WS.transpose();
  M.block<3, 3>(Index::kGyroBias, Index::kGyroBias) += noise.gyro_bias * dt_s;
  M.block<3, 3>(Index::kAccelBias, Index::kAccelBias) += noise.accel_bias * dt_s;
  const ThreeColumns weighted = gyro * (noise.gyro * dt_s);
  for (int j = 0; j < Index::kDim; ++j)
    M.col(j) +=
        gyro(j, 0) * weighted.col(0) + gyro(j, 1) * weighted.col(1) + gyro(j, 2) * weighted.col(2);
}

/// The lower triangle counts.
void Symmetrise(InekfCovariance& P) noexcept {
  for (int j = 0; j < Index::kDim; ++j) {
    for (int i = j + 1; i < Index::kDim; ++i) P(j, i) = P(i, j);
  }
}

/// Φ = I + A dt with A at the start of the step.
InekfTransition CalcHeldTransition(const InekfState& x, const Vec3& gravity_W,
                                   double dt_s) noexcept {
  const Mat3 R_dt = x.R_WS * dt_s;
  InekfTransition phi;
  phi.rotation_gyro_bias = -R_dt;
  phi.velocity_rotation = core::Skew(gravity_W * dt_s);
  phi.velocity_gyro_bias = -core::Skew(x.v_WS) * R_dt;
  phi.velocity_accel_bias = -R_dt;
  phi.position_velocity = dt_s;
  phi.position_gyro_bias = -core::Skew(x.p_WS) * R_dt;
  for (const Leg leg : kLegs) phi.foot_gyro_bias[leg] = -core::Skew(x.p_WF[leg]) * R_dt;
  return phi;
}

/// One Newton step towards SO(3): rounding must not add up over millions of steps.
Mat3 Orthonormalised(const Mat3& R) noexcept { return 1.5 * R - 0.5 * R * (R.transpose() * R); }

/// Mean after dt; a_S and w_S free of bias.
InekfState Propagate(const InekfState& x, const InekfParams& params, const Vec3& a_S,
                     const Vec3& w_S, double dt_s) noexcept {
  const core::GammaSo3 gamma(w_S * dt_s);
  const bool exact = params.model == InekfModel::kExact;
  const Vec3 mean_a_W = x.R_WS * (exact ? Vec3(gamma(1) * a_S) : a_S) + params.gravity_W;
  const Vec3 half_a_W =
      x.R_WS * (exact ? Vec3(gamma(2) * a_S) : Vec3(0.5 * a_S)) + 0.5 * params.gravity_W;
  InekfState next = x;
  next.R_WS = Orthonormalised(x.R_WS * gamma(0));
  next.v_WS += mean_a_W * dt_s;
  next.p_WS += x.v_WS * dt_s + half_a_W * (dt_s * dt_s);
  return next;
}

bool IsFinite(const InekfState& x) noexcept {
  return x.R_WS.allFinite() && x.v_WS.allFinite() && x.p_WS.allFinite();
}

}  // namespace

InekfTransition CalcExactTransition(const InekfState& x, const Vec3& gravity_W, const Vec3& a_S,
                                    const Vec3& w_S, double dt_s) noexcept {
  const Vec3 turn_S = w_S * dt_s;
  const core::GammaSo3 gamma(turn_S);
  const Mat3 G2 = gamma(2), G3 = gamma(3), a_x = core::Skew(a_S);
  const double along = turn_S.dot(a_S), dt2 = dt_s * dt_s;
  const Mat3 psi1 = a_x * G2 + G2 * a_x - 0.5 * a_x - along * (G2 - 3.0 * G3);
  const Mat3 psi2 = a_x * (G2 - G3) + 2.0 * G3 * a_x - 1.0 / 3.0 * a_x -
                    0.5 * along * (G2 - 2.0 * G3 - 4.0 * gamma(4));
  const Mat3 R_G1_dt = x.R_WS * gamma(1) * dt_s;
  const Vec3 v_free_W = x.v_WS + gravity_W * dt_s;  // in free fall
  const Vec3 p_free_W = x.p_WS + x.v_WS * dt_s + gravity_W * (0.5 * dt2);
  InekfTransition phi;
  phi.rotation_gyro_bias = -R_G1_dt;
  phi.velocity_rotation = core::Skew(gravity_W * dt_s);
  phi.velocity_gyro_bias = -core::Skew(v_free_W) * R_G1_dt - x.R_WS * psi1 * dt2;
  phi.velocity_accel_bias = -R_G1_dt;
  phi.position_rotation = core::Skew(gravity_W * (0.5 * dt2));
  phi.position_velocity = dt_s;
  phi.position_gyro_bias = -core::Skew(p_free_W) * R_G1_dt - x.R_WS * psi2 * (dt2 * dt_s);
  phi.position_accel_bias = -x.R_WS * G2 * dt2;
  for (const Leg leg : kLegs) phi.foot_gyro_bias[leg] = -core::Skew(x.p_WF[leg]) * R_G1_dt;
  return phi;
}

void Inekf::Set(const InekfState& state, const InekfCovariance& P) noexcept {
  x_ = state;
  P_ = P;
  Symmetrise(P_);
  for (const Leg leg : kLegs) {
    if (!x_.in_state[leg]) Drop(leg);
  }
}

InekfStatus Inekf::Predict(const Vec3& a_S, const Vec3& w_S, double dt_s) noexcept {
  if (!(a_S.allFinite() && w_S.allFinite() && std::isfinite(dt_s) && dt_s >= 0.0))
    return InekfStatus::kNotFinite;
  const Vec3 true_a_S = a_S - x_.accel_bias_S, true_w_S = w_S - x_.gyro_bias_S;
  const InekfState next = Propagate(x_, params_, true_a_S, true_w_S, dt_s);
  const InekfTransition phi =
      params_.model == InekfModel::kExact
          ? CalcExactTransition(x_, params_.gravity_W, true_a_S, true_w_S, dt_s)
          : CalcHeldTransition(x_, params_.gravity_W, dt_s);
  Columns M;
  M.topRows<Index::kDim>() = P_;
  M.bottomRows<kPadded - Index::kDim>().setZero();
  AddNoise(x_, params_.noise, dt_s, M);
  TimesTransposed(phi, x_.in_state, M);
  Columns Mt;  // Φ M Φᵀ = ((M Φᵀ)ᵀ Φᵀ)ᵀ
  Mt.topRows<Index::kDim>() = M.topRows<Index::kDim>().transpose();
  Mt.bottomRows<kPadded - Index::kDim>().setZero();
  TimesTransposed(phi, x_.in_state, Mt);
  if (!IsFinite(next) || !Mt.topRows<Index::kDim>().diagonal().allFinite())
    return InekfStatus::kNotFinite;
  x_ = next;
  P_ = Mt.topRows<Index::kDim>();
  Symmetrise(P_);
  return InekfStatus::kOk;
}

FootInnovation Inekf::CalcInnovation(Leg leg, const FootMeasurement& foot) const noexcept {
  FootInnovation innovation;
  innovation.used = foot.in_contact && x_.in_state[leg];
  if (!innovation.used) return innovation;
  constexpr int p = Index::kPosition;
  const int d = Index::Foot(leg);
  innovation.y_W = x_.R_WS * foot.p_SF_S - (x_.p_WF[leg] - x_.p_WS);
  innovation.cov_W = P_.block<3, 3>(d, d) - P_.block<3, 3>(d, p) - P_.block<3, 3>(p, d) +
                     P_.block<3, 3>(p, p) + x_.R_WS * foot.cov_SF_S * x_.R_WS.transpose();
  return innovation;
}

InekfCorrection Inekf::Correct(const LegArray<FootMeasurement>& feet) noexcept {
  InekfCorrection result;
  Stack stack;
  for (const Leg leg : kLegs) {
    const FootMeasurement& foot = feet[leg];
    if (!foot.in_contact) continue;
    if (!foot.p_SF_S.allFinite() || !foot.cov_SF_S.allFinite())
      result.status = InekfStatus::kNotFinite;
    result.feet[leg] = CalcInnovation(leg, foot);
    if (result.feet[leg].used) stack.legs[static_cast<std::size_t>(stack.size++)] = leg;
  }
  const Mat3 R_before_WS = x_.R_WS;
  if (result.status == InekfStatus::kOk) result.status = CorrectStack(stack, result);
  for (const Leg leg : kLegs) {
    if (!feet[leg].in_contact && x_.in_state[leg]) Drop(leg);
  }
  if (result.status != InekfStatus::kOk) return result;
  for (const Leg leg : kLegs) {
    if (feet[leg].in_contact && !x_.in_state[leg])
      Append(leg, feet[leg], params_.model == InekfModel::kExact ? x_.R_WS : R_before_WS);
  }
  return result;
}

InekfStatus Inekf::CorrectStack(const Stack& stack, InekfCorrection& result) noexcept {
  switch (stack.size) {
    case 1:
      return CorrectWith<1>(stack, result);
    case 2:
      return CorrectWith<2>(stack, result);
    case 3:
      return CorrectWith<3>(stack, result);
    case 4:
      return CorrectWith<4>(stack, result);
    default:
      return InekfStatus::kOk;
  }
}

/// H is −I at the position and +I at the foot, so P Hᵀ is a difference of columns of P. With
/// S = L Lᵀ and B = L⁻¹ H P: K y = Bᵀ (L⁻¹ y), P⁺ = P − Bᵀ B.
template <int n>
InekfStatus Inekf::CorrectWith(const Stack& stack, InekfCorrection& result) noexcept {
  constexpr int kRows = 3 * n;
  Eigen::Matrix<double, kRows, kPadded, Eigen::RowMajor> B;
  Eigen::Matrix<double, kRows, kRows> S;
  Eigen::Matrix<double, kRows, 1> y;
  B.template rightCols<kPadded - Index::kDim>().setZero();
  for (int i = 0; i < n; ++i) {
    const Leg leg = stack.legs[static_cast<std::size_t>(i)];
    B.template block<3, Index::kDim>(3 * i, 0) =
        (P_.middleCols<3>(Index::Foot(leg)) - P_.middleCols<3>(Index::kPosition)).transpose();
    y.template segment<3>(3 * i) = result.feet[leg].y_W;
    for (int j = 0; j < i; ++j)
      S.template block<3, 3>(3 * i, 3 * j) =
          B.template block<3, 3>(3 * i, Index::Foot(stack.legs[static_cast<std::size_t>(j)])) -
          B.template block<3, 3>(3 * i, Index::kPosition);
    S.template block<3, 3>(3 * i, 3 * i) = result.feet[leg].cov_W;
  }
  if (!core::FactorCholesky<kRows>(S)) return InekfStatus::kIndefinite;
  core::SolveLower<kRows, kPadded>(S, B);
  core::SolveLower<kRows, 1>(S, y);
  const Eigen::Matrix<double, kPadded, 1> xi = B.transpose() * y;
  const double nis = y.squaredNorm();
  if (!xi.allFinite() || !std::isfinite(nis) || !B.allFinite()) return InekfStatus::kNotFinite;
  for (int j = 0; j < Index::kDim; ++j) {
    Eigen::Matrix<double, kPadded, 1> reduction = B(0, j) * B.row(0).transpose();
    for (int k = 1; k < kRows; ++k) reduction += B(k, j) * B.row(k).transpose();
    P_.col(j) -= reduction.template head<Index::kDim>();
  }
  Symmetrise(P_);
  Retract(xi.template head<Index::kDim>());
  result.nis = nis;
  result.dof = kRows;
  return InekfStatus::kOk;
}

/// X ← Exp(ξ) X, b ← b + ξ_b.
void Inekf::Retract(const Eigen::Matrix<double, Index::kDim, 1>& xi) noexcept {
  Eigen::Matrix<double, 3, 2 + kNumLegs> columns;
  columns << xi.segment<3>(Index::kVelocity), xi.segment<3>(Index::kPosition),
      xi.tail<3 * kNumLegs>().reshaped<Eigen::AutoOrder>(Eigen::fix<3>, Eigen::fix<kNumLegs>);
  const core::Sek3<2 + kNumLegs> step =
      core::ExpSek3<2 + kNumLegs>(xi.segment<3>(Index::kRotation), columns);
  x_.R_WS = step.R * x_.R_WS;
  x_.v_WS = step.R * x_.v_WS + step.x.col(0);
  x_.p_WS = step.R * x_.p_WS + step.x.col(1);
  for (const Leg leg : kLegs) {
    if (x_.in_state[leg])
      x_.p_WF[leg] = step.R * x_.p_WF[leg] + step.x.col(2 + static_cast<int>(leg));
  }
  x_.gyro_bias_S += xi.segment<3>(Index::kGyroBias);
  x_.accel_bias_S += xi.segment<3>(Index::kAccelBias);
}

/// The foot's place is p + R p_SF_S: its error is that of p and the measurement's.
void Inekf::Append(Leg leg, const FootMeasurement& foot, const Mat3& R_WS) noexcept {
  const int d = Index::Foot(leg);
  x_.p_WF[leg] = x_.p_WS + R_WS * foot.p_SF_S;
  x_.in_state[leg] = true;
  P_.middleCols<3>(d) = P_.middleCols<3>(Index::kPosition);
  P_.middleRows<3>(d) = P_.middleRows<3>(Index::kPosition);
  const Mat3 noise_W = R_WS * foot.cov_SF_S * R_WS.transpose();
  P_.block<3, 3>(d, d) += 0.5 * (noise_W + noise_W.transpose());
}

void Inekf::Drop(Leg leg) noexcept {
  x_.in_state[leg] = false;
  x_.p_WF[leg].setZero();
  P_.middleCols<3>(Index::Foot(leg)).setZero();
  P_.middleRows<3>(Index::Foot(leg)).setZero();
}

void Inekf::MoveFoot(Leg leg, const Vec3& delta_W, const Mat3& cov_W) noexcept {
  if (!x_.in_state[leg] || !delta_W.allFinite() || !cov_W.allFinite()) return;
  x_.p_WF[leg] += delta_W;
  P_.block<3, 3>(Index::Foot(leg), Index::Foot(leg)) += 0.5 * (cov_W + cov_W.transpose());
}

}  // namespace scoria::controller
