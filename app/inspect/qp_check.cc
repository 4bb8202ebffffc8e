// SPDX-License-Identifier: BSD-3-Clause
#include "app/inspect/qp_check.h"

#include <algorithm>
#include <cmath>

#include "app/inspect/qp_sets.h"

namespace scoria::app {
namespace {

/// std::max that lets a NaN through.
void Worsen(double& worst, double value) {
  worst = value > worst || std::isnan(value) ? value : worst;
}

/// Values of fx − μ fz, −fx − μ fz, fy − μ fz, −fy − μ fz, f_min − fz, fz − f_max, all ≤ 0.
Vec6 Limits(const controller::OcpQp& qp, const Vec3& f) {
  const double reach = qp.friction * f.z();
  Vec6 limits;
  limits << f.x() - reach, -f.x() - reach, f.y() - reach, -f.y() - reach, qp.f_min_N - f.z(),
      f.z() - qp.f_max_N;
  return limits;
}

/// Gradient of λᵀ limits with respect to the force.
Vec3 LimitSlope(const controller::OcpQp& qp, const Vec6& lambda) {
  return {lambda[0] - lambda[1], lambda[2] - lambda[3],
          -qp.friction * lambda.head<4>().sum() - lambda[4] + lambda[5]};
}

void CheckMpc(const QpSet::Mpc& p, QpCheck& c) {
  const controller::OcpQp& qp = p.qp;
  double gap = 0.0, slope = 0.0, terms = 1.0;  // of the gradient, per N
  for (int i = 0; i < qp.horizon; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const controller::OcpStage& stage = qp.stages[k];
    const Vec12 next = stage.Drift(p.x[k]) + stage.B * p.u[k] + stage.b;
    Worsen(c.primal, (next - p.x[k + 1]).lpNorm<Eigen::Infinity>());
    const Vec12 pi = stage.Q.cwiseProduct(p.x[k]) + stage.q + stage.DriftTransposed(p.pi[k + 1]);
    const double scale = std::max(1.0, p.pi[k].lpNorm<Eigen::Infinity>());
    Worsen(c.stationarity, (pi - p.pi[k]).lpNorm<Eigen::Infinity>() / scale);
    const Vec12 motion = stage.B.transpose() * p.pi[k + 1];
    const Vec12 smooth = stage.R.cwiseProduct(p.u[k]) + stage.r + motion;
    for (const Leg leg : kLegs) {
      const int l = static_cast<int>(leg);
      const Vec3 f = p.u[k].segment<3>(3 * l);
      if (!stage.stance[leg]) {
        Worsen(c.primal, f.lpNorm<Eigen::Infinity>());
        continue;
      }
      const Vec6 limits = Limits(qp, f), lambda = p.lambda[k].segment<6>(6 * l);
      Worsen(c.primal, limits.maxCoeff());
      Worsen(c.dual, -lambda.minCoeff());
      gap -= limits.dot(lambda);
      const Vec3 limit_slope = LimitSlope(qp, lambda);
      Worsen(slope, (smooth.segment<3>(3 * l) + limit_slope).lpNorm<Eigen::Infinity>());
      Worsen(terms, motion.lpNorm<Eigen::Infinity>());
      Worsen(terms, limit_slope.lpNorm<Eigen::Infinity>());
    }
  }
  Worsen(c.stationarity, slope / terms);
  const double cost = CalcObjective(qp, p.u) + CalcTrackingOffset(qp);
  Worsen(c.complementarity, gap / std::max(1e-3, cost));
}

void CheckWbc(const QpSet::Wbc& p, QpCheck& c) {
  const controller::DenseQp& qp = p.qp;
  Worsen(c.primal, (qp.A * p.z - qp.b).lpNorm<Eigen::Infinity>());
  const Eigen::VectorXd gradient = qp.H * p.z + qp.g;
  const Eigen::VectorXd slope =
      gradient + qp.A.transpose() * p.y + qp.C.transpose() * p.of_rows + p.of_bounds;
  const double scale = std::max(1.0, gradient.lpNorm<Eigen::Infinity>());
  Worsen(c.stationarity, slope.lpNorm<Eigen::Infinity>() / scale);
  const auto side = [&](double value, double low, double high, double multiplier) {
    Worsen(c.primal, std::max(low - value, value - high));
    const double bound = multiplier > 0.0 ? high : low;
    if (multiplier == 0.0) return;
    if (std::abs(bound) >= controller::DenseQp::kNone) {
      Worsen(c.dual, std::abs(multiplier));
    } else {
      Worsen(c.complementarity,
             std::abs(multiplier * (value - bound)) / std::max(1.0, p.z.lpNorm<Eigen::Infinity>()));
    }
  };
  const Eigen::VectorXd rows = qp.C * p.z;
  for (Eigen::Index i = 0; i < rows.size(); ++i) side(rows[i], qp.l[i], qp.u[i], p.of_rows[i]);
  for (Eigen::Index i = 0; i < p.z.size(); ++i) side(p.z[i], qp.lb[i], qp.ub[i], p.of_bounds[i]);
}

}  // namespace

std::vector<QpCheck> CheckQpSets(const std::filesystem::path& folder) {
  std::vector<QpCheck> checks;
  for (const std::filesystem::path& file : FindQpSets(folder)) {
    QpSet set(file);
    QpCheck c;
    c.file = file.filename().string();
    c.exact = !set.IsMpc();
    c.records = set.size();
    for (int i = 0; i < set.size(); ++i) {
      if (set.IsMpc()) {
        CheckMpc(set.ReadMpc(i), c);
      } else {
        CheckWbc(set.ReadWbc(i), c);
      }
    }
    checks.push_back(c);
  }
  return checks;
}

}  // namespace scoria::app
