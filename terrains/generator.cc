// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/generator.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <unsupported/Eigen/FFT>

#include "core/rng.h"

namespace scoria::terrains {
namespace {

using core::Rng;
using core::Stream;
using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;

/// Unnormalised power of one 2-D mode with wavenumber k: k^-(2H+2), continuous at the break, zero
/// outside the band.
double ModePower(double k, const RoughnessParams& p) {
  const double k_low = 2.0 * kPi / p.max_wavelength_m, k_high = 2.0 * kPi / p.min_wavelength_m;
  if (k < k_low || k > k_high) return 0.0;
  const double ratio = k * p.break_wavelength_m / (2.0 * kPi);
  return std::pow(ratio, -2.0 * ((ratio < 1.0 ? p.hurst : p.fine_hurst) + 1.0));
}

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

/// Adds an isotropic Gaussian field whose expected RMS difference at 1 m is params.nu_1m_m: random
/// phases under the spectrum, normalised by the structure function of the very modes that the grid
/// holds.
void AddRoughness(std::vector<double>& heights, int n, double spacing_m, const RoughnessParams& p,
                  double scale, Rng rng) {
  if (p.nu_1m_m * scale == 0.0) return;
  const auto size = static_cast<std::size_t>(n);
  const double dk = 2.0 * kPi / (n * spacing_m);
  std::vector<Complex> modes(size * size);
  double structure_1m = 0.0;  // E (z(x + 1 m) - z(x))^2, averaged over the two axes
  for (int row = 0; row < n; ++row) {
    const double ky = dk * (row <= n / 2 ? row : row - n);
    for (int column = 0; column < n; ++column) {
      const double kx = dk * (column <= n / 2 ? column : column - n);
      const double power = ModePower(std::hypot(kx, ky), p);
      if (power == 0.0) continue;
      structure_1m += power * (2.0 - std::cos(kx) - std::cos(ky));
      const double amplitude = std::sqrt(power);
      const double re = rng.NextNormal(), im = rng.NextNormal();
      modes[static_cast<std::size_t>(row) * size + static_cast<std::size_t>(column)] =
          amplitude * Complex(re, im);
    }
  }
  InverseFft2(modes, n);
  const double gain = scale * p.nu_1m_m / std::sqrt(structure_1m);
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] += gain * modes[i].real();
}

/// Diameter of a random rock: the inverse of RockDensity by bisection.
double DrawDiameter(const RockParams& rocks, Rng& rng) {
  const double target = rng.NextUniform() * RockDensity(rocks, rocks.min_diameter_m);
  double low = rocks.min_diameter_m, high = rocks.max_diameter_m;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (RockDensity(rocks, middle) > target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Adds half-buried ellipsoids, Poisson in area.
void AddRocks(std::vector<double>& heights, int n, double spacing_m, const RockParams& rocks,
              double scale, Rng rng) {
  if (rocks.area_fraction <= 0.0) return;
  constexpr double kMinBurial = 0.2, kMaxBurial = 0.5;  // of the height
  constexpr double kMinAspect = 0.6;                    // plan, short over long axis
  const double edge_m = n * spacing_m;
  const int count = rng.NextPoisson(RockDensity(rocks, rocks.min_diameter_m) * edge_m * edge_m);
  for (int rock = 0; rock < count; ++rock) {
    const double column = rng.NextUniform(0.0, n), row = rng.NextUniform(0.0, n);
    const double diameter_m = DrawDiameter(rocks, rng);
    const double aspect = rng.NextUniform(kMinAspect, 1.0), yaw = rng.NextUniform(0.0, kPi);
    const double burial = rng.NextUniform(kMinBurial, kMaxBurial);
    const double height_m = scale * rocks.height_ratio * diameter_m;
    // Semi-axes with the area of a circle of that diameter.
    const double a = 0.5 * diameter_m / std::sqrt(aspect), b = 0.5 * diameter_m * std::sqrt(aspect);
    const int reach = static_cast<int>(std::ceil(a / spacing_m));
    const int c0 = static_cast<int>(column), r0 = static_cast<int>(row);
    const auto at = [&](int c, int r) -> double& {
      return heights[static_cast<std::size_t>(r) * static_cast<std::size_t>(n) +
                     static_cast<std::size_t>(c)];
    };
    const double foot_m = at(c0, r0) - burial * height_m;
    for (int r = std::max(0, r0 - reach); r <= std::min(n - 1, r0 + reach); ++r) {
      for (int c = std::max(0, c0 - reach); c <= std::min(n - 1, c0 + reach); ++c) {
        const double dx = (c - column) * spacing_m, dy = (r - row) * spacing_m;
        const double u = (std::cos(yaw) * dx + std::sin(yaw) * dy) / a;
        const double v = (-std::sin(yaw) * dx + std::cos(yaw) * dy) / b;
        const double inside = 1.0 - u * u - v * v;
        if (inside > 0.0) at(c, r) = std::max(at(c, r), foot_m + height_m * std::sqrt(inside));
      }
    }
  }
}

}  // namespace

double RockDensity(const RockParams& rocks, double above_diameter_m) {
  const double k = rocks.area_fraction, q = 1.79 + 0.152 / k;
  constexpr int kPanels = 64;  // Simpson, in log D: the integrand is smooth there
  const double low = std::log(above_diameter_m), high = std::log(rocks.max_diameter_m);
  if (high <= low) return 0.0;
  const auto density = [&](double log_d) {
    const double d = std::exp(log_d);
    return 4.0 * k * q * std::exp(-q * d) / (kPi * d);  // n(D) dD = n(D) D dlogD
  };
  const double h = (high - low) / kPanels;
  double sum = density(low) + density(high);
  for (int i = 1; i < kPanels; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * density(low + i * h);
  return sum * h / 3.0;
}

Heightfield GenerateTerrain(const TerrainParams& params, std::uint64_t seed,
                            std::uint32_t episode) {
  const int n = static_cast<int>(std::lround(params.size_m / params.resolution_m));
  const auto size = static_cast<std::size_t>(n);
  std::vector<double> heights(size * size, 0.0);
  AddRoughness(heights, n, params.resolution_m, params.roughness, params.roughness_scale,
               Rng(seed, episode, Stream::kTerrain));
  AddRocks(heights, n, params.resolution_m, params.rocks, params.roughness_scale,
           Rng(seed, episode, Stream::kRocks));
  const double half_m = 0.5 * (n - 1) * params.resolution_m;
  const Vec2 uphill = std::tan(params.slope_rad) *
                      Vec2(std::cos(params.slope_azimuth_rad), std::sin(params.slope_azimuth_rad));
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      const Vec2 p(column * params.resolution_m - half_m, row * params.resolution_m - half_m);
      heights[static_cast<std::size_t>(row) * size + static_cast<std::size_t>(column)] +=
          uphill.dot(p);
    }
  }
  return Heightfield(n, params.resolution_m, std::move(heights), params.friction);
}

TerrainStatistics MeasureTerrain(const Heightfield& ground, const TerrainParams& params) {
  const int n = ground.nodes();
  const double dx = ground.resolution_m();
  constexpr int kStride = 3;  // every third node: the estimate is converged, the time is a ninth
  const Vec2 plane = std::tan(params.slope_rad) *
                     Vec2(std::cos(params.slope_azimuth_rad), std::sin(params.slope_azimuth_rad));
  const auto nu = [&](double lag_m) {
    const int lag = std::max(1, static_cast<int>(std::lround(lag_m / dx)));
    double sum = 0.0;
    std::int64_t count = 0;
    for (int r = 0; r + lag < n; r += kStride) {
      for (int c = 0; c + lag < n; c += kStride) {
        const double z = ground.NodeHeight(c, r);
        const double across = ground.NodeHeight(c + lag, r) - z - plane.x() * lag * dx;
        const double along = ground.NodeHeight(c, r + lag) - z - plane.y() * lag * dx;
        sum += across * across + along * along;
        count += 2;
      }
    }
    return std::sqrt(sum / static_cast<double>(count));
  };
  TerrainStatistics stats{nu(0.1), nu(0.25), nu(1.0), 0.0, 0.0, 0.0};

  const double first_m = 5.0 * dx, last_m = params.roughness.max_wavelength_m / 10.0;
  constexpr int kLags = 8;
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (int i = 0; i < kLags; ++i) {
    const double lag_m = first_m * std::pow(last_m / first_m, i / (kLags - 1.0));
    const double x = std::log(lag_m), y = std::log(std::max(nu(lag_m), 1e-12));
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  stats.hurst = (kLags * sxy - sx * sy) / (kLags * sxx - sx * sx);

  std::vector<double> slopes;
  for (int r = 1; r + 1 < n; r += 7) {
    for (int c = 1; c + 1 < n; c += 7) {
      const double gx = (ground.NodeHeight(c + 1, r) - ground.NodeHeight(c - 1, r)) / (2.0 * dx);
      const double gy = (ground.NodeHeight(c, r + 1) - ground.NodeHeight(c, r - 1)) / (2.0 * dx);
      slopes.push_back(std::atan(std::hypot(gx, gy)));
    }
  }
  for (const double slope : slopes)
    stats.slope_mean_rad += slope / static_cast<double>(slopes.size());
  const auto rank =
      slopes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(slopes.size()));
  std::nth_element(slopes.begin(), rank, slopes.end());
  stats.slope_95_rad = *rank;
  return stats;
}

}  // namespace scoria::terrains
