// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/solvers/riccati_ipm.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scoria::controller {

FootIndex FootIndex::Of(const OcpQp& qp) noexcept {
  FootIndex feet;
  for (int k = 0; k < qp.horizon; ++k) {
    const auto at = static_cast<std::size_t>(k);
    feet.first[at] = feet.count;
    for (const Leg leg : kLegs) {
      if (!qp.stages[at].stance[leg]) continue;
      feet.stage[static_cast<std::size_t>(feet.count)] = k;
      feet.leg[static_cast<std::size_t>(feet.count++)] = leg;
    }
  }
  feet.first[static_cast<std::size_t>(qp.horizon)] = feet.count;
  return feet;
}

/// The inequalities of a foot: μ fz − fx, μ fz + fx, μ fz − fy, μ fz + fy, fz − f_min, f_max − fz.
void RiccatiIpm::CalcSlacks(const FootTable<3>& u, RowTable& slack) const noexcept {
  const int n = feet_.count;
  const auto x = u.col(0).head(n), y = u.col(1).head(n), z = u.col(2).head(n);
  slack.col(0).head(n) = friction_ * z - x;
  slack.col(1).head(n) = friction_ * z + x;
  slack.col(2).head(n) = friction_ * z - y;
  slack.col(3).head(n) = friction_ * z + y;
  slack.col(4).head(n) = z - f_min_;
  slack.col(5).head(n) = f_max_ - z;
}

void RiccatiIpm::Load(const OcpQp& qp) noexcept {
  friction_ = qp.friction;
  f_min_ = qp.f_min_N;
  f_max_ = qp.f_max_N;
  cost_offset_ = CalcTrackingOffset(qp);
  feet_ = FootIndex::Of(qp);
  for (int f = 0; f < feet_.count; ++f) {
    const OcpStage& stage =
        qp.stages[static_cast<std::size_t>(feet_.stage[static_cast<std::size_t>(f)])];
    const int c = 3 * static_cast<int>(feet_.leg[static_cast<std::size_t>(f)]);
    R_.row(f) = stage.R.segment<3>(c).transpose().array();
    r_.row(f) = stage.r.segment<3>(c).transpose().array();
  }
  regulator(qp).Load(qp, feet_);
}

/// Strictly feasible: every foot bears its share of the weight, upright; after a solve, the last
/// forces pulled that far towards it that no slack is small, with the last multipliers.
void RiccatiIpm::Start(const OcpQp& qp) noexcept {
  constexpr double kInset = 0.02;     // of the force range, to start strictly inside
  constexpr double kPull = 0.1;       // of a warm start towards the cold one
  constexpr double kWarmShare = 0.1;  // of the cold start's complementarity
  const int n = feet_.count;
  const double inset = kInset * (f_max_ - f_min_);
  const bool warm = params_.warm_start && last_.valid && last_.horizon == qp.horizon;
  for (int f = 0; f < n; ++f) {
    const auto k = static_cast<std::size_t>(feet_.stage[static_cast<std::size_t>(f)]);
    const Leg leg = feet_.leg[static_cast<std::size_t>(f)];
    const double share = qp.start_force_N / (feet_.first[k + 1] - feet_.first[k]);
    now_.u.row(f) << 0.0, 0.0, std::clamp(share, f_min_ + inset, f_max_ - inset);
    if (!warm || !last_.known[k][leg]) continue;
    const int from = kNumLegs * static_cast<int>(k) + static_cast<int>(leg);
    const Eigen::Array<double, 1, 3> u = last_.u.row(from);
    now_.u.row(f) = kPull * now_.u.row(f) + (1.0 - kPull) * u;
  }
  CalcSlacks(now_.u, slack_);
  const double start = (warm ? kWarmShare : 1.0) * params_.start_complementarity;
  lambda_.topRows(n) = start / slack_.topRows(n);
  if (warm) {
    for (int f = 0; f < n; ++f) {
      const auto k = static_cast<std::size_t>(feet_.stage[static_cast<std::size_t>(f)]);
      const Leg leg = feet_.leg[static_cast<std::size_t>(f)];
      if (!last_.known[k][leg]) continue;
      const int from = kNumLegs * static_cast<int>(k) + static_cast<int>(leg);
      lambda_.row(f) = lambda_.row(f).max(last_.lambda.row(from));
    }
  }
  now_.x[0] = qp.x0;
  for (int k = 0; k < qp.horizon; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const OcpStage& stage = qp.stages[at];
    now_.x[at + 1] = stage.Drift(now_.x[at]) + stage.b;
    for (int f = feet_.first[at]; f < feet_.first[at + 1]; ++f) {
      const int c = 3 * static_cast<int>(feet_.leg[static_cast<std::size_t>(f)]);
      now_.x[at + 1].noalias() += stage.B.middleCols<3>(c) * now_.u.row(f).transpose().matrix();
    }
  }
}

/// Tracking cost of the present iterate.
double RiccatiIpm::Cost(const OcpQp& qp) const noexcept {
  const int n = feet_.count;
  const auto u = now_.u.topRows(n);
  double cost = cost_offset_ + ((0.5 * R_.topRows(n) * u + r_.topRows(n)) * u).sum();
  for (int k = 0; k <= qp.horizon; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const OcpStage& stage = qp.stages[at];
    cost += now_.x[at].dot(0.5 * stage.Q.cwiseProduct(now_.x[at]) + stage.q);
  }
  return cost;
}

/// Hessian R + DᵀWD of every foot, W = λ / s, where D u ≤ d are the inequalities.
void RiccatiIpm::CalcWeights() noexcept {
  const int n = feet_.count;
  inverse_slack_.topRows(n) = slack_.topRows(n).inverse();
  weight_.topRows(n) = lambda_.topRows(n) * inverse_slack_.topRows(n);
  const auto w = [&](int row) { return weight_.col(row).head(n); };
  const auto R = [&](int j) { return R_.col(j).head(n); };
  const double mu = friction_, mu2 = friction_ * friction_;
  hessian_.a.head(n) = R(0) + w(0) + w(1);
  hessian_.b.head(n) = R(1) + w(2) + w(3);
  hessian_.c.head(n) = R(2) + mu2 * (w(0) + w(1) + w(2) + w(3)) + w(4) + w(5);
  hessian_.d.head(n) = mu * (w(1) - w(0));
  hessian_.e.head(n) = mu * (w(3) - w(2));
  hessian_.pivot.head(n) = R(2) + w(4) + w(5) +
                           mu2 * ((R(0) * (w(0) + w(1)) + 4.0 * w(0) * w(1)) / hessian_.a.head(n) +
                                  (R(1) * (w(2) + w(3)) + 4.0 * w(2) * w(3)) / hessian_.b.head(n));
}

/// Linear term of the forces with the multipliers eliminated: r + Dᵀ(e − W d), with e = λ for the
/// predictor or λ + (target − Δs Δλ)/s for the corrector.
void RiccatiIpm::CalcGradients(double target, bool corrector) noexcept {
  const int n = feet_.count;
  RowTable e;
  e.topRows(n) = lambda_.topRows(n);
  if (corrector) {
    e.topRows(n) +=
        (target - d_slack_.topRows(n) * d_lambda_.topRows(n)) * inverse_slack_.topRows(n);
  }
  const auto row = [&](int i) { return e.col(i).head(n); };
  gradient_.col(0).head(n) = r_.col(0).head(n) + row(0) - row(1);
  gradient_.col(1).head(n) = r_.col(1).head(n) + row(2) - row(3);
  gradient_.col(2).head(n) = r_.col(2).head(n) - friction_ * (row(0) + row(1) + row(2) + row(3)) -
                             row(4) - weight_.col(4).head(n) * f_min_ + row(5) -
                             weight_.col(5).head(n) * f_max_;
}

/// Steps of slacks and multipliers towards the Newton point: s Δλ + λ Δs = target − s λ (− Δs Δλ of
/// the predictor).
void RiccatiIpm::CalcDirections(double target, bool corrector) noexcept {
  const int n = feet_.count;
  RowTable slack;
  CalcSlacks(newton_.u, slack);
  const auto s = slack.topRows(n);
  if (corrector) {
    d_lambda_.topRows(n) =
        (target - d_slack_.topRows(n) * d_lambda_.topRows(n)) * inverse_slack_.topRows(n) -
        weight_.topRows(n) * s;
  } else {
    d_lambda_.topRows(n) = -weight_.topRows(n) * s;
  }
  d_slack_.topRows(n) = s - slack_.topRows(n);
}

/// How far slacks and multipliers can go before one is zero; infinite if none shrinks.
RiccatiIpm::StepLengths RiccatiIpm::MaxSteps() const noexcept {
  const int n = feet_.count;
  if (n == 0) return {};
  // -Δ/value: the largest of these rates is the inverse of the step.
  const double primal = (-d_slack_.topRows(n) * inverse_slack_.topRows(n)).maxCoeff();
  const double dual = (-d_lambda_.topRows(n) / lambda_.topRows(n)).maxCoeff();
  const auto step = [](double rate) {
    return rate > 0.0 ? 1.0 / rate : std::numeric_limits<double>::infinity();
  };
  return {step(primal), step(dual)};
}

void RiccatiIpm::TakeStep(const OcpQp& qp, StepLengths step) noexcept {
  constexpr double kStayInside = 0.995, kMinSlack_N = 1e-13;
  step.primal = step.primal >= 1.0 ? 1.0 : kStayInside * step.primal;
  step.dual = step.dual >= 1.0 ? 1.0 : kStayInside * step.dual;
  const int n = feet_.count;
  now_.u.topRows(n) += step.primal * (newton_.u.topRows(n) - now_.u.topRows(n));
  for (int k = 1; k <= qp.horizon; ++k) {
    const auto at = static_cast<std::size_t>(k);
    now_.x[at] += step.primal * (newton_.x[at] - now_.x[at]);
  }
  CalcSlacks(now_.u, slack_);
  slack_.topRows(n) = slack_.topRows(n).max(kMinSlack_N);
  lambda_.topRows(n) += step.dual * d_lambda_.topRows(n);
}

void RiccatiIpm::Extract(const OcpQp& qp) noexcept {
  OcpSolution& out = solution_;
  last_.valid = true;
  last_.horizon = qp.horizon;
  for (int k = 0; k < qp.horizon; ++k) {
    const auto at = static_cast<std::size_t>(k);
    out.u[at].setZero();
    out.lambda[at] = LegArray<Vec6>(Vec6::Zero());
    out.x[at] = now_.x[at];
    last_.known[at] = qp.stages[at].stance;
    for (int f = feet_.first[at]; f < feet_.first[at + 1]; ++f) {
      const int leg = static_cast<int>(feet_.leg[static_cast<std::size_t>(f)]);
      out.u[at].segment<3>(3 * leg) = now_.u.row(f).transpose().matrix();
      last_.u.row(kNumLegs * k + leg) = now_.u.row(f);
      last_.lambda.row(kNumLegs * k + leg) = lambda_.row(f);
      out.lambda[at][static_cast<Leg>(leg)] = lambda_.row(f).transpose().matrix();
    }
  }
  out.x[static_cast<std::size_t>(qp.horizon)] = now_.x[static_cast<std::size_t>(qp.horizon)];
}

/// Predictor and corrector from the present iterate; leaves the Newton point and the directions
/// towards it. @returns how far they can be followed.
RiccatiIpm::StepLengths RiccatiIpm::CalcNewtonStep(const OcpQp& qp, double gap) noexcept {
  const int n = feet_.count;
  Regulator& regulator = this->regulator(qp);
  CalcWeights();
  CalcGradients(0.0, false);
  regulator.Factorize(qp, feet_, hessian_);
  regulator.Solve(qp, feet_, gradient_, newton_);
  if (n == 0) return {};
  CalcDirections(0.0, false);
  StepLengths affine = MaxSteps();
  affine = {std::min(1.0, affine.primal), std::min(1.0, affine.dual)};
  const double after = ((slack_.topRows(n) + affine.primal * d_slack_.topRows(n)) *
                        (lambda_.topRows(n) + affine.dual * d_lambda_.topRows(n)))
                           .sum();
  const double ratio = after / gap;
  const double target = ratio * ratio * ratio * gap / (kRows * n);
  CalcGradients(target, true);
  regulator.Solve(qp, feet_, gradient_, newton_);
  CalcDirections(target, true);
  return MaxSteps();
}

/// Stops when the gap is small and the last step was nearly whole and changed little: a small gap
/// alone may belong to multipliers that do not fit yet. Far below the tolerance it stops anyway,
/// before rounding spoils the barrier.
const OcpSolution& RiccatiIpm::Solve(const OcpQp& qp) noexcept {
  constexpr double kWholeStep = 0.97, kLittle = 100.0, kFarBelow = 1e-2;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  OcpSolution& out = solution_;
  for (Vec12& u : out.u) u.setConstant(nan);
  out.status = SolveStatus::kIterationLimit;
  Load(qp);
  Start(qp);
  bool whole = false;
  double last_cost = std::numeric_limits<double>::infinity();
  for (out.iterations = 0;; ++out.iterations) {
    const double gap = (slack_.topRows(feet_.count) * lambda_.topRows(feet_.count)).sum();
    const double cost = std::max(Cost(qp), kLeastTrackingCost);
    out.relative_gap = gap / cost;
    if (!std::isfinite(out.relative_gap)) {
      out.status = SolveStatus::kNumerical;
      last_.valid = false;
      return out;
    }
    const bool settled = whole && std::abs(cost - last_cost) < kLittle * params_.tolerance * cost;
    if (out.relative_gap < (settled ? 1.0 : kFarBelow) * params_.tolerance) {
      out.status = SolveStatus::kOptimal;
      break;
    }
    if (out.iterations >= params_.max_iterations) break;
    const StepLengths step = CalcNewtonStep(qp, gap);
    whole = std::min(step.primal, step.dual) >= kWholeStep;
    last_cost = cost;
    TakeStep(qp, step);
  }
  Extract(qp);
  return out;
}

}  // namespace scoria::controller
