// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/riccati_ipm.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/cholesky.h"

namespace scoria::controller {
namespace {

/// Calls `function.operator()<n>()` for the run-time number of stance feet, so that every product
/// below has fixed size.
template <class Function>
auto WithFeet(int feet, Function&& function) {
  switch (feet) {
    case 0:
      return function.template operator()<0>();
    case 1:
      return function.template operator()<1>();
    case 2:
      return function.template operator()<2>();
    case 3:
      return function.template operator()<3>();
    default:
      return function.template operator()<4>();
  }
}

}  // namespace

double CalcObjective(const OcpQp& qp, const std::array<Vec12, kMaxHorizon>& u) noexcept {
  double objective = 0.0;
  Vec12 x = qp.x0;
  for (int k = 0; k <= qp.horizon; ++k) {
    const OcpStage& stage = qp.stages[static_cast<std::size_t>(k)];
    objective += 0.5 * x.dot(stage.Q.cwiseProduct(x)) + stage.q.dot(x);
    if (k == qp.horizon) break;
    const Vec12& uk = u[static_cast<std::size_t>(k)];
    objective += 0.5 * uk.dot(stage.R.cwiseProduct(uk)) + stage.r.dot(uk);
    x.head<6>() += stage.F * x.tail<6>();
    x += stage.B * uk + stage.b;
  }
  return objective;
}

Eigen::Matrix<double, RiccatiIpm::kRows, 1> RiccatiIpm::Slacks(const Vec3& f) const noexcept {
  Eigen::Matrix<double, kRows, 1> s;
  const double reach = friction_ * f.z();
  s << reach - f.x(), reach + f.x(), reach - f.y(), reach + f.y(), f.z() - f_min_, f_max_ - f.z();
  return s;
}

void RiccatiIpm::Load(const OcpQp& qp) noexcept {
  horizon_ = qp.horizon;
  friction_ = qp.friction;
  f_min_ = qp.f_min_N;
  f_max_ = qp.f_max_N;
  num_inequalities_ = 0;
  for (int k = 0; k < horizon_; ++k) {
    const OcpStage& data = qp.stages[static_cast<std::size_t>(k)];
    Stage& stage = stages_[static_cast<std::size_t>(k)];
    stage.feet = 0;
    for (const Leg leg : kLegs) {
      if (!data.stance[leg]) continue;
      const int from = 3 * static_cast<int>(leg), to = 3 * stage.feet;
      stage.B.middleCols<3>(to) = data.B.middleCols<3>(from);
      stage.R.segment<3>(to) = data.R.segment<3>(from);
      stage.r.segment<3>(to) = data.r.segment<3>(from);
      stage.leg[static_cast<std::size_t>(stage.feet++)] = static_cast<int>(leg);
    }
    num_inequalities_ += kRows * stage.feet;
  }
}

void RiccatiIpm::Start(const OcpQp& qp) noexcept {
  constexpr double kInset = 0.02;  // of the force range, to start strictly inside
  const double inset = kInset * (f_max_ - f_min_);
  for (int k = 0; k < horizon_; ++k) {
    Stage& stage = stages_[static_cast<std::size_t>(k)];
    for (int f = 0; f < stage.feet; ++f) {
      const double share = qp.start_force_N / stage.feet;
      const Vec3 force(0.0, 0.0, std::clamp(share, f_min_ + inset, f_max_ - inset));
      stage.u.segment<3>(3 * f) = force;
      stage.slack.col(f) = Slacks(force);
      stage.lambda.col(f) = params_.start_complementarity * stage.slack.col(f).cwiseInverse();
    }
  }
}

double RiccatiIpm::MeanComplementarity() const noexcept {
  double sum = 0.0;
  for (int k = 0; k < horizon_; ++k) {
    const Stage& stage = stages_[static_cast<std::size_t>(k)];
    for (int f = 0; f < stage.feet; ++f) sum += stage.lambda.col(f).dot(stage.slack.col(f));
  }
  return num_inequalities_ > 0 ? sum / num_inequalities_ : 0.0;
}

/// Linear term of the inputs with the multipliers eliminated: r + Dᵀ(e − W d), where D u ≤ d are
/// the inequalities, W = λ/s, and e = λ for the predictor or λ + (target − Δs Δλ)/s for the
/// corrector.
void RiccatiIpm::SetGradients(double target, bool corrector) noexcept {
  for (int k = 0; k < horizon_; ++k) {
    Stage& stage = stages_[static_cast<std::size_t>(k)];
    for (int f = 0; f < stage.feet; ++f) {
      const auto s = stage.slack.col(f).array();
      Eigen::Array<double, kRows, 1> e = stage.lambda.col(f).array();
      if (corrector) {
        e += (target - stage.d_slack.col(f).array() * stage.d_lambda.col(f).array()) / s;
      } else {
        stage.weight.col(f) = stage.lambda.col(f).array() / s;
      }
      e[4] += stage.weight(4, f) * f_min_;
      e[5] -= stage.weight(5, f) * f_max_;
      stage.r_tilde.segment<3>(3 * f) =
          stage.r.segment<3>(3 * f) +
          Vec3(e[0] - e[1], e[2] - e[3], -friction_ * (e[0] + e[1] + e[2] + e[3]) - e[4] + e[5]);
    }
  }
}

template <int kFeet>
bool RiccatiIpm::FactorizeStage(const OcpStage& data, bool euler, Stage& stage) noexcept {
  constexpr int n = 3 * kFeet;
  const Mat6 P11 = P_.topLeftCorner<6, 6>(), P12 = P_.topRightCorner<6, 6>(),
             P22 = P_.bottomRightCorner<6, 6>();
  const Mat6 E = P11 * data.F + P12;              // upper right of PA
  const Mat6 G = P12.transpose() * data.F + P22;  // lower right of PA
  stage.Pb = P_ * data.b;
  if constexpr (kFeet > 0) {
    using Inputs = Eigen::Matrix<double, 6, n>;
    const Inputs Bl = stage.B.template block<6, n>(6, 0);
    Eigen::Matrix<double, n, 12> BPA;
    Eigen::Matrix<double, n, n> BPB;
    BPA.template leftCols<6>().noalias() = Bl.transpose() * P12.transpose();
    BPA.template rightCols<6>().noalias() = Bl.transpose() * G;
    const Inputs P22Bl = P22 * Bl;
    BPB.noalias() = Bl.transpose() * P22Bl;
    if (!euler) {
      const Inputs Bu = stage.B.template block<6, n>(0, 0);
      BPA.template leftCols<6>() += Bu.transpose() * P11;
      BPA.template rightCols<6>() += Bu.transpose() * E;
      const Eigen::Matrix<double, n, n> cross = Bu.transpose() * P12 * Bl;
      BPB += Bu.transpose() * P11 * Bu + cross + cross.transpose();
    }
    stage.L.template topLeftCorner<n, n>() = BPB;
    stage.L.template topLeftCorner<n, n>().diagonal() += stage.R.template head<n>();
    for (int f = 0; f < kFeet; ++f) {  // DᵀWD of the pyramid, in closed form
      const auto w = stage.weight.col(f);
      auto H = stage.L.template block<3, 3>(3 * f, 3 * f);
      H(0, 0) += w[0] + w[1];
      H(1, 1) += w[2] + w[3];
      H(2, 2) += friction_ * friction_ * (w[0] + w[1] + w[2] + w[3]) + w[4] + w[5];
      H(2, 0) += friction_ * (w[1] - w[0]);
      H(2, 1) += friction_ * (w[3] - w[2]);
    }
    if (!core::FactorCholesky<n>(stage.L)) return false;
    stage.Y.template topRows<n>() = BPA;
    core::SolveLower<n, 12>(stage.L, stage.Y);
  }
  const Mat6 lower_right = data.F.transpose() * E + G;
  P_.topRightCorner<6, 6>() = E;
  P_.bottomLeftCorner<6, 6>() = E.transpose();
  P_.bottomRightCorner<6, 6>() = lower_right;
  if constexpr (kFeet > 0) {
    for (int c = 0; c < n; ++c) {
      for (int i = 0; i < 12; ++i) {
        for (int j = 0; j < 12; ++j) P_(j, i) -= stage.Y(c, i) * stage.Y(c, j);
      }
    }
  }
  P_.diagonal() += data.Q;
  return true;
}

bool RiccatiIpm::Factorize(const OcpQp& qp) noexcept {
  P_ = qp.stages[static_cast<std::size_t>(horizon_)].Q.asDiagonal();
  for (int k = horizon_; k-- > 0;) {
    Stage& stage = stages_[static_cast<std::size_t>(k)];
    const OcpStage& data = qp.stages[static_cast<std::size_t>(k)];
    const bool positive = WithFeet(stage.feet, [&]<int kFeet>() {
      return FactorizeStage<kFeet>(data, qp.forward_euler, stage);
    });
    if (!positive) return false;
  }
  return true;
}

template <int kFeet>
void RiccatiIpm::BackwardStage(const OcpStage& data, Stage& stage, Vec12& p) const noexcept {
  constexpr int n = 3 * kFeet;
  const Vec12 t = p + stage.Pb;
  p = t + data.q;
  p.tail<6>() += data.F.transpose() * t.head<6>();
  if constexpr (kFeet > 0) {
    Eigen::Matrix<double, n, 1> h = stage.r_tilde.template head<n>();
    h.noalias() += stage.B.template leftCols<n>().transpose() * t;
    core::SolveLower<n, 1>(stage.L, h);
    p.noalias() -= stage.Y.template topRows<n>().transpose() * h;
    stage.h.template head<n>() = h;
  }
}

template <int kFeet>
void RiccatiIpm::ForwardStage(const OcpStage& data, Stage& stage, Vec12& x) const noexcept {
  constexpr int n = 3 * kFeet;
  Vec12 next = x + data.b;
  next.head<6>() += data.F * x.tail<6>();
  if constexpr (kFeet > 0) {
    Eigen::Matrix<double, n, 1> u = -stage.h.template head<n>();
    u.noalias() -= stage.Y.template topRows<n>() * x;
    core::SolveLowerTransposed<n>(stage.L, u);
    next.noalias() += stage.B.template leftCols<n>() * u;
    stage.u_new.template head<n>() = u;
  }
  x = next;
}

void RiccatiIpm::SolveForInputs(const OcpQp& qp) noexcept {
  Vec12 p = qp.stages[static_cast<std::size_t>(horizon_)].q;
  for (int k = horizon_; k-- > 0;) {
    Stage& stage = stages_[static_cast<std::size_t>(k)];
    WithFeet(stage.feet, [&]<int kFeet>() {
      BackwardStage<kFeet>(qp.stages[static_cast<std::size_t>(k)], stage, p);
    });
  }
  Vec12 x = qp.x0;
  for (int k = 0; k < horizon_; ++k) {
    Stage& stage = stages_[static_cast<std::size_t>(k)];
    WithFeet(stage.feet, [&]<int kFeet>() {
      ForwardStage<kFeet>(qp.stages[static_cast<std::size_t>(k)], stage, x);
    });
  }
}

/// Steps of slacks and multipliers towards u_new: s Δλ + λ Δs = target − s λ (− Δs Δλ of the
/// predictor).
void RiccatiIpm::CalcDirections(double target, bool corrector) noexcept {
  for (int k = 0; k < horizon_; ++k) {
    Stage& stage = stages_[static_cast<std::size_t>(k)];
    for (int f = 0; f < stage.feet; ++f) {
      const Eigen::Array<double, kRows, 1> s = stage.slack.col(f).array();
      const Eigen::Array<double, kRows, 1> s_new = Slacks(stage.u_new.segment<3>(3 * f)).array();
      Eigen::Array<double, kRows, 1> push = Eigen::Array<double, kRows, 1>::Zero();
      if (corrector) {
        push = (target - stage.d_slack.col(f).array() * stage.d_lambda.col(f).array()) / s;
      }
      stage.d_lambda.col(f) = push - stage.weight.col(f).array() * s_new;
      stage.d_slack.col(f) = s_new - s;
    }
  }
}

RiccatiIpm::StepLengths RiccatiIpm::MaxSteps() const noexcept {
  StepLengths step{std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()};
  for (int k = 0; k < horizon_; ++k) {
    const Stage& stage = stages_[static_cast<std::size_t>(k)];
    for (int f = 0; f < stage.feet; ++f) {
      for (int i = 0; i < kRows; ++i) {
        const double ds = stage.d_slack(i, f), dl = stage.d_lambda(i, f);
        if (ds < 0.0) step.primal = std::min(step.primal, -stage.slack(i, f) / ds);
        if (dl < 0.0) step.dual = std::min(step.dual, -stage.lambda(i, f) / dl);
      }
    }
  }
  return step;
}

double RiccatiIpm::ComplementarityAfter(const StepLengths& step) const noexcept {
  double sum = 0.0;
  for (int k = 0; k < horizon_; ++k) {
    const Stage& stage = stages_[static_cast<std::size_t>(k)];
    for (int f = 0; f < stage.feet; ++f) {
      sum += (stage.slack.col(f) + step.primal * stage.d_slack.col(f))
                 .dot(stage.lambda.col(f) + step.dual * stage.d_lambda.col(f));
    }
  }
  return sum / num_inequalities_;
}

void RiccatiIpm::TakeStep(StepLengths step) noexcept {
  constexpr double kStayInside = 0.995, kMinSlack_N = 1e-13;
  step.primal = step.primal >= 1.0 ? 1.0 : kStayInside * step.primal;
  step.dual = step.dual >= 1.0 ? 1.0 : kStayInside * step.dual;
  for (int k = 0; k < horizon_; ++k) {
    Stage& stage = stages_[static_cast<std::size_t>(k)];
    for (int f = 0; f < stage.feet; ++f) {
      auto u = stage.u.segment<3>(3 * f);
      u += step.primal * (stage.u_new.segment<3>(3 * f) - u);
      stage.slack.col(f) = Slacks(u).cwiseMax(kMinSlack_N);
      stage.lambda.col(f) += step.dual * stage.d_lambda.col(f);
    }
  }
}

void RiccatiIpm::Extract(const OcpQp& qp, OcpSolution& out) const noexcept {
  out.x[0] = qp.x0;
  for (int k = 0; k < horizon_; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const OcpStage& data = qp.stages[i];
    out.u[i].setZero();
    for (int f = 0; f < stages_[i].feet; ++f) {
      out.u[i].segment<3>(3 * stages_[i].leg[static_cast<std::size_t>(f)]) =
          stages_[i].u.segment<3>(3 * f);
    }
    out.x[i + 1] = out.x[i] + data.b;
    out.x[i + 1].head<6>() += data.F * out.x[i].tail<6>();
    out.x[i + 1].noalias() += data.B * out.u[i];
  }
}

void RiccatiIpm::Solve(const OcpQp& qp, OcpSolution& out) noexcept {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (Vec12& u : out.u) u.setConstant(nan);
  out.status = SolveStatus::kIterationLimit;
  Load(qp);
  Start(qp);
  for (out.iterations = 0;; ++out.iterations) {
    out.complementarity = MeanComplementarity();
    if (out.iterations > 0 && out.complementarity < params_.tolerance) {
      out.status = SolveStatus::kOptimal;
      break;
    }
    if (out.iterations >= params_.max_iterations) break;
    SetGradients(0.0, false);
    if (!Factorize(qp)) {
      out.status = SolveStatus::kNumerical;
      return;
    }
    SolveForInputs(qp);
    double target = 0.0;
    if (num_inequalities_ > 0) {
      CalcDirections(0.0, false);
      StepLengths affine = MaxSteps();
      affine = {std::min(1.0, affine.primal), std::min(1.0, affine.dual)};
      const double ratio = ComplementarityAfter(affine) / out.complementarity;
      target = ratio * ratio * ratio * out.complementarity;
      SetGradients(target, true);
      SolveForInputs(qp);
      CalcDirections(target, true);
    }
    TakeStep(MaxSteps());
  }
  Extract(qp, out);
  if (!out.u[0].allFinite()) out.status = SolveStatus::kNumerical;
}

}  // namespace scoria::controller
