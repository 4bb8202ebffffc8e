// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace scoria::core {

/// Small dense kernels with sizes known at compile time: Eigen's own triangular routines switch to
/// blocked run-time code above a few rows, which costs several times the arithmetic here. `A` and
/// `B` are any types with operator()(i, j).

/// Lower Cholesky factor of the leading n×n block, in place, the strict upper part untouched. The
/// diagonal of the factor is stored inverted, so that solves multiply. @returns false if a pivot is
/// not positive.
template <int n, class Matrix>
[[nodiscard]] inline bool FactorCholesky(Matrix& A) noexcept {
  for (int j = 0; j < n; ++j) {
    double d = A(j, j);
    for (int k = 0; k < j; ++k) d -= A(j, k) * A(j, k);
    if (!(d > 0.0)) return false;
    const double inverse = 1.0 / std::sqrt(d);
    A(j, j) = inverse;
    for (int i = j + 1; i < n; ++i) {
      double v = A(i, j);
      for (int k = 0; k < j; ++k) v -= A(i, k) * A(j, k);
      A(i, j) = v * inverse;
    }
  }
  return true;
}

/// B ← L⁻¹ B for the factor of FactorCholesky and B (n×columns); fastest with B in row-major order.
template <int n, int columns, class Factor, class Matrix>
inline void SolveLower(const Factor& L, Matrix& B) noexcept {
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) {
      for (int j = 0; j < columns; ++j) B(i, j) -= L(i, k) * B(k, j);
    }
    for (int j = 0; j < columns; ++j) B(i, j) *= L(i, i);
  }
}

/// b ← L⁻ᵀ b for one column.
template <int n, class Factor, class Vector>
inline void SolveLowerTransposed(const Factor& L, Vector& b) noexcept {
  for (int i = n - 1; i >= 0; --i) {
    double v = b(i);
    for (int k = i + 1; k < n; ++k) v -= L(k, i) * b(k);
    b(i) = v * L(i, i);
  }
}

}  // namespace scoria::core
