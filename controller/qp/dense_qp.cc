// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/dense_qp.h"

#include <Eigen/QR>

#include "controller/qp/dual_active_set.h"
#include "core/demand.h"

namespace scoria::controller {
namespace {

constexpr int kMaxVars = 42, kMaxRows = 256;
constexpr double kNone = 1e19;
using Solver = DualActiveSet<kMaxVars, kMaxRows>;

/// Collects a z >= b from two-sided rows, leaving out infinite sides.
class RowCollector {
 public:
  explicit RowCollector(Eigen::Index variables) : A_(0, variables), b_(0) {}
  void Add(const Eigen::RowVectorXd& a, double low, double high) {
    if (low > -kNone) Append(a, low);
    if (high < kNone) Append(-a, -high);
  }
  Eigen::MatrixXd A_;
  Eigen::VectorXd b_;

 private:
  void Append(const Eigen::RowVectorXd& a, double b) {
    A_.conservativeResize(A_.rows() + 1, Eigen::NoChange);
    b_.conservativeResize(A_.rows());
    A_.bottomRows(1) = a;
    b_[b_.size() - 1] = b;
  }
};

}  // namespace

struct DenseQpSolver::Impl {
  Solver solver;
  Solver::Result result;
};

DenseQpSolver::DenseQpSolver() : impl_(std::make_unique<Impl>()) {}
DenseQpSolver::~DenseQpSolver() = default;

DenseSolution DenseQpSolver::Solve(const DenseQp& qp) {
  const Eigen::Index n = qp.H.rows(), equalities = qp.A.rows();
  // Jacobi scaling z = D s: blocks of very different weight then meet in the null space on equal
  // terms.
  const Eigen::VectorXd D = qp.H.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd A = qp.A * D.asDiagonal();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A.transpose());
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd N = Q.rightCols(n - equalities);
  const Eigen::MatrixXd R = qr.matrixQR().topRows(equalities).triangularView<Eigen::Upper>();
  const Eigen::VectorXd s_0 =
      Q.leftCols(equalities) * R.transpose().triangularView<Eigen::Lower>().solve(qp.b);
  const Eigen::MatrixXd basis = D.asDiagonal() * N;  // z = z_0 + basis y
  const Eigen::VectorXd z_0 = D.asDiagonal() * s_0;

  RowCollector rows(n);
  for (Eigen::Index i = 0; i < qp.C.rows(); ++i) rows.Add(qp.C.row(i), qp.l[i], qp.u[i]);
  for (Eigen::Index i = 0; i < n; ++i) rows.Add(Eigen::RowVectorXd::Unit(n, i), qp.lb[i], qp.ub[i]);
  SCORIA_DEMAND(n <= kMaxVars && rows.A_.rows() <= kMaxRows, "variables {}, rows {}", n,
                rows.A_.rows());

  const Eigen::MatrixXd G = basis.transpose() * qp.H * basis;
  impl_->solver.Solve(G, basis.transpose() * (qp.g + qp.H * z_0), rows.A_ * basis,
                      rows.b_ - rows.A_ * z_0, impl_->result);
  DenseSolution out;
  out.status = impl_->result.status;
  out.iterations = impl_->result.iterations;
  out.z = z_0 + basis * impl_->result.x;
  return out;
}

}  // namespace scoria::controller
