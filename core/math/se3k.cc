// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/se3k.h"

#include <cassert>
#include <cmath>

#include "core/math/so3.h"

namespace scoria::core {
namespace {

constexpr std::array<double, GammaSo3::kMaxOrder + 3> kInverseFactorial = {
    1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0};

/// g_n by its series, for |φ|² <= 1: the first term left out is below 1/(2 · 8 + n)!, that is 1e-18
/// for n >= 5.
double CoefficientSeries(int n, double phi2) noexcept {
  constexpr int kTerms = 7;
  double sum = 1.0;
  for (int k = kTerms; k > 0; --k) sum = 1.0 - phi2 / ((2 * k + n) * (2 * k + n - 1)) * sum;
  return sum * kInverseFactorial[static_cast<std::size_t>(n)];
}

}  // namespace

GammaSo3::GammaSo3(const Vec3& phi) noexcept : phi_x_(Skew(phi)) {
  const double phi2 = phi.squaredNorm();
  phi_x2_ = phi * phi.transpose();
  phi_x2_.diagonal().array() -= phi2;
  constexpr std::size_t kLast = kMaxOrder + 2;
  // Towards smaller n the recurrence multiplies errors by |φ|², towards larger n it divides by it.
  if (phi2 < kSeriesLimit_rad * kSeriesLimit_rad) {
    g_[kLast] = CoefficientSeries(kLast, phi2);
    g_[kLast - 1] = CoefficientSeries(kLast - 1, phi2);
    for (std::size_t n = kLast - 1; n-- > 0;) g_[n] = kInverseFactorial[n] - phi2 * g_[n + 2];
  } else {
    const double angle = std::sqrt(phi2);
    g_[0] = std::cos(angle);
    g_[1] = std::sin(angle) / angle;
    for (std::size_t n = 0; n + 2 <= kLast; ++n) g_[n + 2] = (kInverseFactorial[n] - g_[n]) / phi2;
  }
}

Mat3 GammaSo3::operator()(int m) const noexcept {
  assert(0 <= m && m <= kMaxOrder);
  const auto i = static_cast<std::size_t>(m);
  Mat3 gamma = g_[i + 1] * phi_x_ + g_[i + 2] * phi_x2_;
  gamma.diagonal().array() += kInverseFactorial[i];
  return gamma;
}

}  // namespace scoria::core
