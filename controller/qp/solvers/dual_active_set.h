// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "controller/qp/status.h"
#include "core/math/cholesky.h"
#include "core/math/types.h"

namespace scoria::controller {

/// Dual active-set method of Goldfarb and Idnani for strictly convex dense problems
///   min ½ xᵀGx + gᵀx   s.t.  A x ≥ b,
/// with at most kVars variables and kRows rows. Starts at the unconstrained optimum and adds the
/// most violated row until none is left, so an easy problem costs one Cholesky factorisation. Owns
/// its memory: no allocation. With kSize the number of variables is fixed, which is faster.
/// Source: [Goldfarb1983], algorithm 2.
template <int kVars, int kRows, int kSize = Eigen::Dynamic>
class DualActiveSet {
 public:
  using Vector = Eigen::Matrix<double, kSize, 1, 0, kVars, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize, 0, kVars, kVars>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, kSize, Eigen::RowMajor, kRows, kVars>;
  using RowVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kRows, 1>;
  using Active = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kVars, 1>;

  struct Result {
    SolveStatus status = SolveStatus::kNumerical;
    int iterations = 0;
    Vector x;
    RowVector multipliers;  // of all rows, when optimal
  };

  /// @param G (n×n) symmetric positive definite, @param g (n), @param A (m×n), @param b (m).
  /// A row is met when its violation is below `tolerance` relative to the size of its terms.
  void Solve(const Matrix& G, const Vector& g, const Rows& A, const RowVector& b, Result& out,
             double tolerance = 1e-11) noexcept {
    const Eigen::Index n = G.rows(), m = A.rows();
    out.iterations = 0;
    if (!Factorize(G)) {
      out.status = SolveStatus::kNumerical;
      out.x = Vector::Constant(n, std::numeric_limits<double>::quiet_NaN());
      return;
    }
    const Vector y = J_.transpose().lazyProduct(-g);
    out.x = J_.lazyProduct(y);
    num_active_ = 0;
    is_active_.fill(false);
    out.status = SolveStatus::kIterationLimit;
    const int limit = 10 * static_cast<int>(n + m);
    while (out.iterations < limit) {
      const Eigen::Index worst = MostViolated(A, b, out.x, tolerance);
      if (worst < 0) {
        out.status = SolveStatus::kOptimal;
        out.multipliers.setZero(m);
        for (Eigen::Index i = 0; i < num_active_; ++i)
          out.multipliers[active_[static_cast<std::size_t>(i)]] = multipliers_[i];
        return;
      }
      if (!AddRow(A, b, worst, limit, out)) return;
    }
  }

 private:
  /// J = L⁻ᵀ of G = L Lᵀ.
  [[nodiscard]] bool Factorize(const Matrix& G) noexcept {
    const Eigen::Index n = G.rows();
    if constexpr (kSize != Eigen::Dynamic) {
      Matrix L = G;
      Eigen::Matrix<double, kSize, kSize, Eigen::RowMajor> inverse;
      inverse.setIdentity();
      if (!core::FactorCholesky<kSize>(L)) return false;
      core::SolveLower<kSize, kSize>(L, inverse);
      J_ = inverse.transpose();
      return true;
    }
    llt_.compute(G);
    J_ = Matrix::Identity(n, n);
    llt_.matrixU().solveInPlace(J_);
    return llt_.info() == Eigen::Success;
  }

  [[nodiscard]] Eigen::Index MostViolated(const Rows& A, const RowVector& b, const Vector& x,
                                          double tolerance) const noexcept {
    Eigen::Index worst = -1;
    double deepest = 0.0;
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      if (is_active_[static_cast<std::size_t>(i)]) continue;
      const double value = A.row(i).dot(x) - b[i];
      if (value >= deepest) continue;
      const double scale = 1.0 + std::abs(b[i]) + A.row(i).cwiseAbs().dot(x.cwiseAbs());
      const double violation = value + tolerance * scale;
      if (violation < 0.0) {
        deepest = value;
        worst = i;
      }
    }
    return worst;
  }

  /// Moves until row p holds with equality, dropping rows whose multiplier would turn negative on
  /// the way.
  bool AddRow(const Rows& A, const RowVector& b, Eigen::Index p, int limit, Result& out) noexcept {
    const Eigen::Index n = J_.rows();
    const Vector normal = A.row(p).transpose();
    double multiplier = 0.0;
    while (out.iterations++ < limit) {
      Vector d = J_.transpose().lazyProduct(normal);
      const Eigen::Index free = n - num_active_;
      const Vector z = J_.rightCols(free) * d.tail(free);  // primal direction
      Active r = d.head(num_active_);                      // dual direction of the active rows
      R_.topLeftCorner(num_active_, num_active_)
          .template triangularView<Eigen::Upper>()
          .solveInPlace(r);

      Eigen::Index blocking = -1;
      double dual_step = std::numeric_limits<double>::infinity();
      for (Eigen::Index i = 0; i < num_active_; ++i) {
        if (r[i] > 0.0 && multipliers_[i] / r[i] < dual_step) {
          dual_step = multipliers_[i] / r[i];
          blocking = i;
        }
      }
      const double curvature = z.dot(normal);
      const double value = normal.dot(out.x) - b[p];
      const bool independent = d.tail(free).norm() > kDependent * d.norm();
      const double primal_step =
          independent ? -value / curvature : std::numeric_limits<double>::infinity();
      const double step = std::min(dual_step, primal_step);
      if (std::isinf(step)) {
        out.status = SolveStatus::kInfeasible;
        return false;
      }
      if (independent) out.x += step * z;
      multipliers_.head(num_active_) -= step * r;
      multiplier += step;
      if (step == primal_step) {
        Append(p, d, multiplier);
        return true;
      }
      Drop(blocking);
    }
    return false;
  }

  /// Rotates columns `a` and `b` of J and the pair (x, y) so that y becomes 0.
  void Rotate(Eigen::Index a, Eigen::Index b, double& x, double& y, double& c, double& s) noexcept {
    const double h = std::hypot(x, y);
    c = h > 0.0 ? x / h : 1.0;
    s = h > 0.0 ? y / h : 0.0;
    x = h;
    y = 0.0;
    for (Eigen::Index i = 0; i < J_.rows(); ++i) {
      const double u = J_(i, a), v = J_(i, b);
      J_(i, a) = c * u + s * v;
      J_(i, b) = c * v - s * u;
    }
  }

  void Append(Eigen::Index row, Vector& d, double multiplier) noexcept {
    double c, s;
    for (Eigen::Index i = J_.rows() - 1; i > num_active_; --i)
      Rotate(i - 1, i, d[i - 1], d[i], c, s);
    R_.col(num_active_).head(num_active_ + 1) = d.head(num_active_ + 1);
    active_[static_cast<std::size_t>(num_active_)] = row;
    is_active_[static_cast<std::size_t>(row)] = true;
    multipliers_[num_active_] = multiplier;
    ++num_active_;
  }

  void Drop(Eigen::Index position) noexcept {
    is_active_[static_cast<std::size_t>(active_[static_cast<std::size_t>(position)])] = false;
    for (Eigen::Index i = position; i + 1 < num_active_; ++i) {
      active_[static_cast<std::size_t>(i)] = active_[static_cast<std::size_t>(i + 1)];
      multipliers_[i] = multipliers_[i + 1];
      R_.col(i).head(i + 2) = R_.col(i + 1).head(i + 2);
    }
    --num_active_;
    for (Eigen::Index i = position; i < num_active_; ++i) {
      double c, s;
      Rotate(i, i + 1, R_(i, i), R_(i + 1, i), c, s);
      for (Eigen::Index j = i + 1; j < num_active_; ++j) {
        const double u = R_(i, j), v = R_(i + 1, j);
        R_(i, j) = c * u + s * v;
        R_(i + 1, j) = c * v - s * u;
      }
    }
  }

  static constexpr double kDependent =
      1e-13;  // sine of the angle below which a normal lies in the active span

  Eigen::LLT<Matrix> llt_{kVars};
  Matrix J_;
  Eigen::Matrix<double, kVars, kVars> R_ = Eigen::Matrix<double, kVars, kVars>::Zero();
  Eigen::Matrix<double, kVars, 1> multipliers_ = Eigen::Matrix<double, kVars, 1>::Zero();
  std::array<Eigen::Index, kVars> active_{};
  std::array<bool, kRows> is_active_{};
  Eigen::Index num_active_ = 0;
};

}  // namespace scoria::controller
