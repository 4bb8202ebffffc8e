// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "core/math/types.h"

namespace scoria::core {

/// The integrals of the rotation about a constant axis,
///   Γ_m(φ) = Σ_{n≥0} [φ]×ⁿ / (n + m)!,  m = 0 … kMaxOrder:
/// Γ_0 the exponential map of SO(3), Γ_1 its left Jacobian, and t^m Γ_m(ω t) the m-fold integral of
/// Exp(ω τ) over [0, t]. One construction serves all orders. Absolute error of an entry < 1e-13 for
/// every |φ| <= 6 rad, from 0 on.
/// Source: [Hartley2020], there up to Γ_2; differs: the scalar coefficients
///   g_n = Σ_k (−1)^k |φ|^2k / (2k + n)!,  Γ_m = 1/m! + g_{m+1} [φ]× + g_{m+2} [φ]×²
/// come from the recurrence g_n = 1/n! − |φ|² g_{n+2}, run in its stable direction.
class GammaSo3 {
 public:
  static constexpr int kMaxOrder = 4;

  explicit GammaSo3(const Vec3& phi) noexcept;

  /// Γ_m(φ), 0 <= m <= kMaxOrder.
  [[nodiscard]] Mat3 operator()(int m) const noexcept;

  /// Where the coefficients change from their series to sine and cosine.
  static constexpr double kSeriesLimit_rad = 1.0;

 private:
  std::array<double, kMaxOrder + 3> g_;  // g_n
  Mat3 phi_x_, phi_x2_;                  // [φ]×, [φ]×²
};

/// Element of SE_k(3): a rotation and k vectors that it acts on together.
template <int k>
struct Sek3 {
  Mat3 R = Mat3::Identity();
  Eigen::Matrix<double, 3, k> x = Eigen::Matrix<double, 3, k>::Zero();
};

/// Exponential map of SE_k(3): (Γ_0(φ), Γ_1(φ) ξ) with the k columns of ξ.
/// Source: [Hartley2020].
template <int k>
[[nodiscard]] Sek3<k> ExpSek3(const Vec3& phi, const Eigen::Matrix<double, 3, k>& xi) noexcept {
  const GammaSo3 gamma(phi);
  return {gamma(0), gamma(1) * xi};
}

}  // namespace scoria::core
