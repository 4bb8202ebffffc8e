// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "controller/qp/sets/qp_file.h"

namespace scoria::controller {

/// Appends the fields of a record, matrices row by row.
class QpFieldWriter {
 public:
  template <class Matrix>
  void Field(const Matrix& m) {
    Field(m, m.rows(), 0.0);
  }
  /// The first of `rows` rows; those that are missing hold `filler`.
  template <class Matrix>
  void Field(const Matrix& m, Eigen::Index rows, double filler) {
    for (Eigen::Index i = 0; i < rows; ++i) {
      for (Eigen::Index j = 0; j < m.cols(); ++j)
        numbers_.push_back(i < m.rows() ? m(i, j) : filler);
    }
  }
  void Numbers(std::span<const double> values) {
    numbers_.insert(numbers_.end(), values.begin(), values.end());
  }
  void Flags(const LegArray<bool>& flags) {
    for (const Leg leg : kLegs) numbers_.push_back(flags[leg] ? 1.0 : 0.0);
  }
  void Drift(const OcpStage& stage) { Field(stage.DriftMatrix()); }

  [[nodiscard]] const std::vector<double>& numbers() const noexcept { return numbers_; }

 private:
  std::vector<double> numbers_;
};

/// Takes the fields of a record in their order; matrices have their sizes before.
class QpFieldReader {
 public:
  explicit QpFieldReader(std::span<const double> numbers) noexcept : numbers_(numbers) {}

  template <class Matrix>
  void Field(Matrix& m) {
    Field(m, m.rows(), 0.0);
  }
  template <class Matrix>
  void Field(Matrix& m, Eigen::Index rows, double /*filler*/) {
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
      for (Eigen::Index j = 0; j < m.cols(); ++j)
        m(i, j) = numbers_[static_cast<std::size_t>(i * m.cols() + j)];
    }
    numbers_ = numbers_.subspan(static_cast<std::size_t>(rows * m.cols()));
  }
  void Numbers(std::span<double> values) {
    for (double& value : values) value = Take();
  }
  void Flags(LegArray<bool>& flags) {
    for (const Leg leg : kLegs) flags[leg] = Take() != 0.0;
  }
  void Drift(OcpStage& stage) {
    Mat12 A;
    Field(A);
    stage.E = A.block<3, 3>(0, 6);
    stage.dt_s = A(3, 9);
    drifts_ = drifts_ && stage.DriftMatrix() == A;
  }
  /// Whether every A had the form that an OcpStage can hold.
  [[nodiscard]] bool drifts() const noexcept { return drifts_; }

 private:
  double Take() noexcept {
    const double value = numbers_.front();
    numbers_ = numbers_.subspan(1);
    return value;
  }
  std::span<const double> numbers_;
  bool drifts_ = true;
};

/// The order of the fields, for writing and for reading. @pre the horizon is known.
template <class Fields, class Record>
void VisitOcp(Fields& fields, Record& r) {
  auto& stages = r.qp.stages;
  const auto each = [](int count, auto&& visit) {
    for (int k = 0; k < count; ++k) visit(static_cast<std::size_t>(k));
  };
  const int N = r.qp.horizon;
  fields.Numbers(r.meta);
  fields.Field(r.qp.x0);
  each(N, [&](std::size_t k) { fields.Flags(stages[k].stance); });
  each(N, [&](std::size_t k) { fields.Drift(stages[k]); });
  each(N, [&](std::size_t k) { fields.Field(stages[k].B); });
  each(N, [&](std::size_t k) { fields.Field(stages[k].b); });
  each(N + 1, [&](std::size_t k) { fields.Field(stages[k].Q); });
  each(N + 1, [&](std::size_t k) { fields.Field(stages[k].q); });
  each(N, [&](std::size_t k) { fields.Field(stages[k].R); });
  each(N, [&](std::size_t k) { fields.Field(stages[k].r); });
  each(N, [&](std::size_t k) { fields.Field(r.point.u[k]); });
  each(N + 1, [&](std::size_t k) { fields.Field(r.point.x[k]); });
  each(N + 1, [&](std::size_t k) { fields.Field(r.point.pi[k]); });
  each(N, [&](std::size_t k) {
    for (const Leg leg : kLegs) fields.Field(r.point.lambda[k][leg]);
  });
}

/// @pre all sizes are known.
template <class Fields, class Record>
void VisitDense(Fields& fields, Record& r, const QpFileShape& shape) {
  constexpr double kNone = DenseQp::kUnbounded;
  fields.Numbers(r.meta);
  fields.Field(r.qp.H);
  fields.Field(r.qp.g);
  fields.Field(r.qp.A, shape.d1, 0.0);
  fields.Field(r.qp.b, shape.d1, 0.0);
  fields.Field(r.qp.C, shape.d2, 0.0);
  fields.Field(r.qp.l, shape.d2, -kNone);
  fields.Field(r.qp.u, shape.d2, kNone);
  fields.Field(r.qp.lb);
  fields.Field(r.qp.ub);
  fields.Field(r.point.z);
  fields.Field(r.point.y, shape.d1, 0.0);
  fields.Field(r.point.of_rows, shape.d2, 0.0);
  fields.Field(r.point.of_bounds);
}

}  // namespace scoria::controller
