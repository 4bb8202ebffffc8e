// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <unsupported/Eigen/FFT>

namespace scoria::terrains {
namespace {

using core::Rng;
using Complex = std::complex<double>;
using std::numbers::pi;

/// In-place unscaled inverse transform of an n x n field, rows then columns.
void InverseFft2(std::vector<Complex>& field, int n) {
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::Unscaled);
  const auto size = static_cast<std::size_t>(n);
  std::vector<Complex> line(size), out(size);
  for (std::size_t row = 0; row < size; ++row) {
    std::copy_n(field.begin() + static_cast<std::ptrdiff_t>(row * size), size, line.begin());
    fft.inv(out, line);
    std::copy(out.begin(), out.end(), field.begin() + static_cast<std::ptrdiff_t>(row * size));
  }
  for (std::size_t column = 0; column < size; ++column) {
    for (std::size_t row = 0; row < size; ++row) line[row] = field[row * size + column];
    fft.inv(out, line);
    for (std::size_t row = 0; row < size; ++row) field[row * size + column] = out[row];
  }
}

/// A real field of random phases under a power spectrum, and its variance. Amplitudes are not
/// random, so every seed has the same statistics; by the sum of many waves it is Gaussian.
struct Spectral {
  std::vector<Complex> modes;  // the field is the real part
  double variance = 0.0;
};

/// @param power  of one mode, by its wave vector in rad/m.
template <class Power>
Spectral DrawSpectral(int n, double spacing_m, Rng& rng, Power power) {
  const auto size = static_cast<std::size_t>(n);
  const double dk = 2.0 * pi / (n * spacing_m);
  Spectral out;
  out.modes.resize(size * size);
  for (int row = 0; row < n; ++row) {
    const double ky = dk * (row <= n / 2 ? row : row - n);
    for (int column = 0; column < n; ++column) {
      const double kx = dk * (column <= n / 2 ? column : column - n);
      if (ky < 0.0 || (ky == 0.0 && kx < 0.0)) continue;  // that wave runs the other way
      const double p = power(kx, ky);
      if (p == 0.0) continue;
      out.variance += 2.0 * p;
      out.modes[static_cast<std::size_t>(row) * size + static_cast<std::size_t>(column)] =
          std::polar(2.0 * std::sqrt(p), rng.NextUniform(0.0, 2.0 * pi));
    }
  }
  InverseFft2(out.modes, n);
  return out;
}

/// Power of one isotropic mode with wavenumber k: k^-(2H+2), continuous at the break.
double SelfAffinePower(double k, const RoughnessParams& p) {
  const double ratio = k * p.break_wavelength_m / (2.0 * pi);
  return std::pow(ratio, -2.0 * ((ratio < 1.0 ? p.hurst : p.fine_hurst) + 1.0));
}

/// The self-affine spectrum times one factor per band of wavenumbers, fitted so that its structure
/// function and that of `other` relief sum to the target. Richardson-Lucy iterations: they keep
/// every factor positive and stay near the start where the data do not ask otherwise.
/// Source: [Lucy1974].
class FittedSpectrum {
 public:
  FittedSpectrum(const RoughnessParams& params, const Grid& other)
      : params_(params),
        k_low_(2.0 * pi / params.max_wavelength_m),
        k_high_(2.0 * pi / params.min_wavelength_m) {
    factors_.fill(1.0);
    const std::array<double, kBands> power = BandPower(other);
    Eigen::Matrix<double, kLags, kBands> response;  // of the structure function at a lag to a band
    Eigen::Matrix<double, kLags, 1> wanted, there;
    const double first_m = 2.0 * other.spacing_m,
                 last_m = 0.25 * std::min(params.max_wavelength_m, other.edge_m());
    const Vec2 plane = FitPlane(other);
    for (int l = 0; l < kLags; ++l) {
      const double lag_m = first_m * std::pow(last_m / first_m, l / (kLags - 1.0));
      const double whole_m = std::round(lag_m / other.spacing_m) * other.spacing_m;
      const double target_m = TargetDeviation(params, whole_m);
      const double other_m = CalcDeviation(other, whole_m, plane);
      wanted[l] = 1.0;  // every lag relative to its target, so that all weigh the same
      there[l] = other_m * other_m / (target_m * target_m);
      for (int b = 0; b < kBands; ++b) {
        const double k = k_low_ * std::exp((b + 0.5) * BandWidth());
        response(l, b) = 2.0 * power[static_cast<std::size_t>(b)] *
                         (1.0 - std::cyl_bessel_j(0.0, k * whole_m)) / (target_m * target_m);
      }
    }
    Eigen::Map<Eigen::Matrix<double, kBands, 1>> factor(factors_.data());
    factor *= 1.0 / (response * factor).mean();
    constexpr int kIterations = 300;
    for (int i = 0; i < kIterations; ++i) {
      const Eigen::Matrix<double, kLags, 1> ratio = wanted.cwiseQuotient(response * factor + there);
      // A band without modes, wider than the tile, keeps its factor.
      for (int b = 0; b < kBands; ++b) {
        const double total = response.col(b).sum();
        if (total > 0.0) factor[b] *= response.col(b).dot(ratio) / total;
      }
    }
  }

  [[nodiscard]] double Power(double k) const {
    if (k < k_low_ || k > k_high_) return 0.0;
    const int band =
        std::clamp(static_cast<int>(std::log(k / k_low_) / BandWidth()), 0, kBands - 1);
    return factors_[static_cast<std::size_t>(band)] * SelfAffinePower(k, params_);
  }

 private:
  static constexpr int kBands = 24, kLags = 24;
  [[nodiscard]] double BandWidth() const { return std::log(k_high_ / k_low_) / kBands; }

  /// Sum of the unfitted power of all modes that the grid has in each band.
  [[nodiscard]] std::array<double, kBands> BandPower(const Grid& grid) const {
    std::array<double, kBands> power{};
    const double dk = 2.0 * pi / grid.edge_m();
    for (int row = 0; row < grid.nodes; ++row) {
      const double ky = dk * (row <= grid.nodes / 2 ? row : row - grid.nodes);
      for (int column = 0; column < grid.nodes; ++column) {
        const double kx = dk * (column <= grid.nodes / 2 ? column : column - grid.nodes);
        const double k = std::hypot(kx, ky);
        if (k < k_low_ || k > k_high_) continue;
        const int band =
            std::clamp(static_cast<int>(std::log(k / k_low_) / BandWidth()), 0, kBands - 1);
        power[static_cast<std::size_t>(band)] += SelfAffinePower(k, params_);
      }
    }
    return power;
  }

  const RoughnessParams& params_;
  double k_low_, k_high_;
  std::array<double, kBands> factors_;
};

}  // namespace

double TargetDeviation(const RoughnessParams& params, double lag_m) {
  // ∫ S(k) 2 (1 − J0(k L)) 2π k dk, in log k, relative to L = 1 m.
  constexpr double kLongest_m = 1000.0;
  const auto structure = [&](double lag) {
    constexpr int kPanels = 2000;
    const double low = std::log(2.0 * pi / kLongest_m);
    const double high = std::log(2.0 * pi / params.min_wavelength_m);
    double sum = 0.0;
    for (int i = 0; i < kPanels; ++i) {
      const double k = std::exp(low + (i + 0.5) * (high - low) / kPanels);
      sum += SelfAffinePower(k, params) * k * k * (1.0 - std::cyl_bessel_j(0.0, k * lag));
    }
    return sum;
  };
  return params.nu_1m_m * std::sqrt(structure(lag_m) / structure(1.0));
}

void AddRoughness(Grid& heights, const RoughnessParams& params, const Grid& other, Rng rng) {
  if (params.nu_1m_m == 0.0) return;
  const FittedSpectrum spectrum(params, other);
  const std::vector<Complex> field =
      DrawSpectral(heights.nodes, heights.spacing_m, rng, [&](double kx, double ky) {
        return spectrum.Power(std::hypot(kx, ky));
      }).modes;
  for (std::size_t i = 0; i < heights.values.size(); ++i) heights.values[i] += field[i].real();
}

void AddRopes(Grid& heights, const RopeParams& p, Rng rng) {
  if (p.amplitude_m == 0.0) return;
  const double c = std::cos(p.azimuth_rad), s = std::sin(p.azimuth_rad);
  const double k_low = 2.0 * pi / p.max_wavelength_m, k_high = 2.0 * pi / p.min_wavelength_m;
  const Spectral field =
      DrawSpectral(heights.nodes, heights.spacing_m, rng, [&](double kx, double ky) {
        const double k = std::hypot(c * kx + s * ky, p.anisotropy * (-s * kx + c * ky));
        return k < k_low || k > k_high ? 0.0 : 1.0 / (k * k);
      });
  const double gain =
      p.amplitude_m / std::sqrt(2.0 * field.variance);  // a sine's RMS is a / sqrt 2
  for (std::size_t i = 0; i < heights.values.size(); ++i)
    heights.values[i] += gain * field.modes[i].real();
}

Grid DrawPatchField(int nodes, double spacing_m, Rng rng) {
  constexpr double kMin_m = 1.0, kMax_m = 5.0, kHurst = 0.8;
  // Smooth at a metre, so a coarse grid will do.
  const int coarsening = std::max(1, static_cast<int>(0.2 / spacing_m));
  const int n = (nodes + coarsening - 1) / coarsening + 1;
  RoughnessParams band;
  band.hurst = band.fine_hurst = kHurst;
  const Spectral field = DrawSpectral(n, coarsening * spacing_m, rng, [&](double kx, double ky) {
    const double wave_m = 2.0 * pi / std::hypot(kx, ky);
    return wave_m < kMin_m || wave_m > kMax_m ? 0.0 : SelfAffinePower(std::hypot(kx, ky), band);
  });
  const auto value = [&](int column, int row) {
    return field
        .modes[static_cast<std::size_t>(row) * static_cast<std::size_t>(n) +
               static_cast<std::size_t>(column)]
        .real();
  };
  Grid out(nodes, spacing_m);
  for (int row = 0; row < nodes; ++row) {
    for (int column = 0; column < nodes; ++column) {
      const int i = column / coarsening, j = row / coarsening;
      const double u = static_cast<double>(column % coarsening) / coarsening;
      const double v = static_cast<double>(row % coarsening) / coarsening;
      out.at(column, row) = (1 - v) * ((1 - u) * value(i, j) + u * value(i + 1, j)) +
                            v * ((1 - u) * value(i, j + 1) + u * value(i + 1, j + 1));
    }
  }
  return out;
}

}  // namespace scoria::terrains
