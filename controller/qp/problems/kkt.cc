// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/problems/kkt.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

namespace scoria::controller {
namespace {

/// std::max that lets a NaN through.
void Raise(double& worst, double value) noexcept {
  worst = value > worst || std::isnan(value) ? value : worst;
}

/// Largest magnitude; NaN where there is one.
template <class Derived>
double Largest(const Eigen::MatrixBase<Derived>& v) noexcept {
  return v.size() > 0 ? v.cwiseAbs().template maxCoeff<Eigen::PropagateNaN>() : 0.0;
}

/// Gradient of λᵀ limits with respect to the force.
Vec3 LimitSlope(const OcpQp& qp, const Vec6& lambda) noexcept {
  return {lambda[0] - lambda[1], lambda[2] - lambda[3],
          -qp.friction * lambda.head<4>().sum() - lambda[4] + lambda[5]};
}

/// Sums over the feet of all stages.
struct FootSums {
  double gap = 0.0;
  double slope = 0.0, terms = 1.0;  // of the gradient, per N
};

void CheckFeet(const OcpQp& qp, const OcpPoint& p, std::size_t k, KktResidual& r, FootSums& sums) {
  const OcpStage& stage = qp.stages[k];
  const Vec12 motion = stage.B.transpose() * p.pi[k + 1];
  const Vec12 smooth = stage.R.cwiseProduct(p.u[k]) + stage.r + motion;
  for (const Leg leg : kLegs) {
    const int l = 3 * static_cast<int>(leg);
    const Vec3 f = p.u[k].segment<3>(l);
    if (!stage.stance[leg]) {
      Raise(r.primal, Largest(f));
      continue;
    }
    const Vec6 limits = CalcForceLimits(qp, f);
    const Vec6& lambda = p.lambda[k][leg];
    Raise(r.primal, limits.maxCoeff<Eigen::PropagateNaN>());
    Raise(r.dual, -lambda.minCoeff<Eigen::PropagateNaN>());
    sums.gap -= limits.dot(lambda);
    const Vec3 limit_slope = LimitSlope(qp, lambda);
    Raise(sums.slope, Largest(smooth.segment<3>(l) + limit_slope));
    Raise(sums.terms, Largest(motion));
    Raise(sums.terms, Largest(limit_slope));
  }
}

}  // namespace

void KktResidual::Worsen(const KktResidual& other) noexcept {
  Raise(primal, other.primal);
  Raise(dual, other.dual);
  Raise(stationarity, other.stationarity);
  Raise(complementarity, other.complementarity);
}

OcpPoint CompletePoint(const OcpQp& qp, const OcpSolution& solution) {
  OcpPoint p{solution.u, solution.x, {}, solution.lambda};
  for (int i = qp.horizon; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    p.pi[k] = qp.stages[k].Q.cwiseProduct(p.x[k]) + qp.stages[k].q;
    if (i < qp.horizon) p.pi[k] += qp.stages[k].DriftTransposed(p.pi[k + 1]);
  }
  return p;
}

DensePoint CompletePoint(const DenseQpView& qp, const DenseSolutionView& s) {
  DensePoint p{s.z, {}, s.of_rows, s.of_bounds};
  const Eigen::VectorXd slope = qp.H * p.z + qp.g + qp.C.transpose() * p.of_rows + p.of_bounds;
  if (qp.A.rows() > 0) p.y = -qp.A.transpose().colPivHouseholderQr().solve(slope);
  return p;
}

KktResidual CalcKkt(const OcpQp& qp, const OcpPoint& p) {
  KktResidual r;
  FootSums sums;
  for (int i = 0; i < qp.horizon; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const OcpStage& stage = qp.stages[k];
    const Vec12 next = stage.Drift(p.x[k]) + stage.B * p.u[k] + stage.b;
    Raise(r.primal, Largest(next - p.x[k + 1]));
    const Vec12 pi = stage.Q.cwiseProduct(p.x[k]) + stage.q + stage.DriftTransposed(p.pi[k + 1]);
    const double scale = std::max(1.0, Largest(p.pi[k]));
    Raise(r.stationarity, Largest(pi - p.pi[k]) / scale);
    CheckFeet(qp, p, k, r, sums);
  }
  Raise(r.stationarity, sums.slope / sums.terms);
  const double cost = CalcObjective(qp, p.u) + CalcTrackingOffset(qp);
  Raise(r.complementarity, sums.gap / std::max(kLeastTrackingCost, cost));
  return r;
}

KktResidual CalcKkt(const DenseQpView& qp, const DensePoint& p) {
  KktResidual r;
  Raise(r.primal, Largest(qp.A * p.z - qp.b));
  const Eigen::VectorXd gradient = qp.H * p.z + qp.g;
  const Eigen::VectorXd slope =
      gradient + qp.A.transpose() * p.y + qp.C.transpose() * p.of_rows + p.of_bounds;
  const double scale = std::max(1.0, Largest(gradient));
  Raise(r.stationarity, Largest(slope) / scale);
  const auto side = [&](double value, double low, double high, double multiplier) {
    Raise(r.primal, std::max(low - value, value - high));
    const double bound = multiplier > 0.0 ? high : low;
    if (multiplier == 0.0) return;
    if (std::abs(bound) >= DenseQp::kNone) {
      Raise(r.dual, std::abs(multiplier));
    } else {
      Raise(r.complementarity,
            std::abs(multiplier * (value - bound)) / std::max(1.0, Largest(p.z)));
    }
  };
  const Eigen::VectorXd rows = qp.C * p.z;
  for (Eigen::Index i = 0; i < rows.size(); ++i) side(rows[i], qp.l[i], qp.u[i], p.of_rows[i]);
  for (Eigen::Index i = 0; i < p.z.size(); ++i) side(p.z[i], qp.lb[i], qp.ub[i], p.of_bounds[i]);
  return r;
}

}  // namespace scoria::controller
