// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include <unsupported/Eigen/FFT>

namespace scoria::terrains {
namespace {

using core::Rng;
using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;

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
  const double dk = 2.0 * kPi / (n * spacing_m);
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
          std::polar(2.0 * std::sqrt(p), rng.NextUniform(0.0, 2.0 * kPi));
    }
  }
  InverseFft2(out.modes, n);
  return out;
}

/// Power of one isotropic mode with wavenumber k: k^-(2H+2), continuous at the break.
double SelfAffinePower(double k, const RoughnessParams& p) {
  const double ratio = k * p.break_wavelength_m / (2.0 * kPi);
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
        k_low_(2.0 * kPi / params.max_wavelength_m),
        k_high_(2.0 * kPi / params.min_wavelength_m) {
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
    const double dk = 2.0 * kPi / grid.edge_m();
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

/// Draws diameters by the inverse of RockDensity, from a table.
class DiameterLaw {
 public:
  explicit DiameterLaw(const RockParams& rocks) {
    const double ratio = rocks.max_diameter_m / rocks.min_diameter_m;
    for (int i = 0; i <= kPoints; ++i) {
      diameters_m_.push_back(rocks.min_diameter_m * std::pow(ratio, i / double{kPoints}));
      densities_.push_back(RockDensity(rocks, diameters_m_.back()));
    }
  }
  [[nodiscard]] double Draw(Rng& rng) const {
    const double target = rng.NextUniform() * densities_.front();
    const auto above = std::lower_bound(densities_.begin(), densities_.end(), target,
                                        [](double density, double t) { return density > t; });
    const auto i = std::max<std::ptrdiff_t>(1, above - densities_.begin());
    const auto at = static_cast<std::size_t>(i);
    const double share = (densities_[at - 1] - target) / (densities_[at - 1] - densities_[at]);
    return diameters_m_[at - 1] + share * (diameters_m_[at] - diameters_m_[at - 1]);
  }

 private:
  static constexpr int kPoints = 400;
  std::vector<double> diameters_m_, densities_;
};

/// Rocks by the metre in which they lie, to find neighbours.
class RockIndex {
 public:
  RockIndex(double edge_m, double cell_m)
      : edge_m_(edge_m),
        cell_m_(cell_m),
        cells_(static_cast<int>(std::ceil(edge_m / cell_m))),
        lists_(static_cast<std::size_t>(cells_ * cells_)) {}
  void Add(const Rock& rock) {
    lists_[Index(Cell(rock.p_W.x()), Cell(rock.p_W.y()))].push_back(rock);
  }
  /// A rock whose centre lies within the larger of the two covers about half of the smaller.
  [[nodiscard]] bool Overlaps(const Rock& rock) const {
    for (int r = -1; r <= 1; ++r) {
      for (int c = -1; c <= 1; ++c) {
        const int column = Cell(rock.p_W.x()) + c, row = Cell(rock.p_W.y()) + r;
        if (column < 0 || row < 0 || column >= cells_ || row >= cells_) continue;
        for (const Rock& other : lists_[Index(column, row)]) {
          const double reach_m = 0.5 * std::max(rock.diameter_m, other.diameter_m);
          if ((rock.p_W - other.p_W).norm() < reach_m) return true;
        }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] int Cell(double coordinate_m) const {
    return std::clamp(static_cast<int>((coordinate_m + 0.5 * edge_m_) / cell_m_), 0, cells_ - 1);
  }
  [[nodiscard]] std::size_t Index(int column, int row) const {
    return static_cast<std::size_t>(row * cells_ + column);
  }
  double edge_m_, cell_m_;
  int cells_;
  std::vector<std::vector<Rock>> lists_;
};

/// Calls visit(column, row, p_W) for every node within reach_m of a place.
template <class Visit>
void ForNodesNear(const Grid& grid, const Vec2& p_W, double reach_m, Visit visit) {
  const Vec2 corner = grid.Position(0, 0);
  const auto first = [&](double coordinate, double origin) {
    return std::max(0,
                    static_cast<int>(std::ceil((coordinate - reach_m - origin) / grid.spacing_m)));
  };
  const auto last = [&](double coordinate, double origin) {
    return std::min(grid.nodes - 1,
                    static_cast<int>(std::floor((coordinate + reach_m - origin) / grid.spacing_m)));
  };
  for (int row = first(p_W.y(), corner.y()); row <= last(p_W.y(), corner.y()); ++row) {
    for (int column = first(p_W.x(), corner.x()); column <= last(p_W.x(), corner.x()); ++column) {
      visit(column, row, grid.Position(column, row));
    }
  }
}

/// Height at a place, of the nearest node.
double NearestHeight(const Grid& grid, const Vec2& p_W) {
  const Vec2 from_corner = (p_W - grid.Position(0, 0)) / grid.spacing_m;
  return grid.at(std::clamp(static_cast<int>(std::lround(from_corner.x())), 0, grid.nodes - 1),
                 std::clamp(static_cast<int>(std::lround(from_corner.y())), 0, grid.nodes - 1));
}

/// Running mean over 2 radius + 1 nodes along rows, then columns; borders continue.
Grid BoxBlur(const Grid& in, int radius) {
  Grid once(in.nodes, in.spacing_m), out(in.nodes, in.spacing_m);
  const auto run = [&](auto get, auto set) {
    double sum = 0.0;
    const auto value = [&](int i) { return get(std::clamp(i, 0, in.nodes - 1)); };
    for (int i = -radius; i <= radius; ++i) sum += value(i);
    for (int i = 0; i < in.nodes; ++i) {
      set(i, sum / (2 * radius + 1));
      sum += value(i + radius + 1) - value(i - radius);
    }
  };
  for (int r = 0; r < in.nodes; ++r) {
    run([&](int i) { return in.at(i, r); }, [&](int i, double v) { once.at(i, r) = v; });
  }
  for (int c = 0; c < in.nodes; ++c) {
    run([&](int i) { return once.at(c, i); }, [&](int i, double v) { out.at(c, i) = v; });
  }
  return out;
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

std::vector<Rock> DrawRocks(const RockParams& params, double edge_m, Rng rng) {
  std::vector<Rock> rocks;
  if (params.area_fraction <= 0.0) return rocks;
  constexpr double kMinBurial = 0.2, kMaxBurial = 0.5;  // of the height
  constexpr double kMinAspect = 0.6;
  constexpr int kTries = 30;  // to find a free place; a crowded ground keeps the last one
  const DiameterLaw law(params);
  RockIndex placed(edge_m, std::max(0.5, params.max_diameter_m));
  const int count = rng.NextPoisson(RockDensity(params, params.min_diameter_m) * edge_m * edge_m);
  for (int i = 0; i < count; ++i) {
    Rock rock;
    rock.diameter_m = law.Draw(rng);
    rock.height_m = params.height_ratio * rock.diameter_m;
    rock.aspect = rng.NextUniform(kMinAspect, 1.0);
    rock.yaw_rad = rng.NextUniform(0.0, kPi);
    rock.burial = rng.NextUniform(kMinBurial, kMaxBurial);
    for (int attempt = 0; attempt < kTries; ++attempt) {
      rock.p_W = {rng.NextUniform(-0.5, 0.5) * edge_m, rng.NextUniform(-0.5, 0.5) * edge_m};
      if (!placed.Overlaps(rock)) break;
    }
    placed.Add(rock);
    rocks.push_back(rock);
  }
  return rocks;
}

Grid AddRocks(Grid& heights, const std::vector<Rock>& rocks) {
  Grid presence(heights.nodes, heights.spacing_m);
  const Grid bare = heights;
  for (const Rock& rock : rocks) {
    // Half an ellipsoid, so wide that the part above the ground has the rock's diameter.
    const double widening = 1.0 / std::sqrt(1.0 - rock.burial * rock.burial);
    const double a = 0.5 * widening * rock.diameter_m / std::sqrt(rock.aspect);
    const double b = 0.5 * widening * rock.diameter_m * std::sqrt(rock.aspect);
    const double foot_m = NearestHeight(bare, rock.p_W) - rock.burial * rock.height_m;
    const double c = std::cos(rock.yaw_rad), s = std::sin(rock.yaw_rad);
    ForNodesNear(heights, rock.p_W, a, [&](int column, int row, const Vec2& p_W) {
      const Vec2 d = p_W - rock.p_W;
      const double u = (c * d.x() + s * d.y()) / a, v = (-s * d.x() + c * d.y()) / b;
      const double inside = 1.0 - u * u - v * v;
      if (inside <= 0.0) return;
      const double top_m = foot_m + rock.height_m * std::sqrt(inside);
      if (inside >= rock.burial * rock.burial) presence.at(column, row) = 1.0;
      heights.at(column, row) = std::max(heights.at(column, row), top_m);
    });
  }
  return presence;
}

double TargetDeviation(const RoughnessParams& params, double lag_m) {
  // ∫ S(k) 2 (1 − J0(k L)) 2π k dk, in log k, relative to L = 1 m.
  constexpr double kLongest_m = 1000.0;
  const auto structure = [&](double lag) {
    constexpr int kPanels = 2000;
    const double low = std::log(2.0 * kPi / kLongest_m);
    const double high = std::log(2.0 * kPi / params.min_wavelength_m);
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
  const double k_low = 2.0 * kPi / p.max_wavelength_m, k_high = 2.0 * kPi / p.min_wavelength_m;
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

void AddGullies(Grid& heights, const GullyParams& p, double downhill_rad, Rng rng) {
  const Vec2 down(std::cos(downhill_rad), std::sin(downhill_rad)), across(-down.y(), down.x());
  const double span_m = std::numbers::sqrt2 * heights.edge_m();  // whatever the direction
  const int count = static_cast<int>(std::lround(p.per_20m * span_m / 20.0));
  for (int gully = 0; gully < count; ++gully) {
    const double at_m = span_m * ((gully + rng.NextUniform()) / count - 0.5);
    const double depth_m = rng.NextUniform(p.min_depth_m, p.max_depth_m);
    const double half_m = 0.5 * rng.NextUniform(p.min_width_m, p.max_width_m);
    // It winds and fades: waves of some metres, of random phase.
    const double bend_m = rng.NextUniform(0.3, 1.0), wave_m = rng.NextUniform(8.0, 20.0);
    const double bend_phase = rng.NextUniform(0.0, 2.0 * kPi);
    const double fade_m = rng.NextUniform(10.0, 30.0), fade_phase = rng.NextUniform(0.0, 2.0 * kPi);
    for (int row = 0; row < heights.nodes; ++row) {
      for (int column = 0; column < heights.nodes; ++column) {
        const Vec2 p_W = heights.Position(column, row);
        const double along = p_W.dot(down), beside = p_W.dot(across) - at_m;
        if (std::abs(beside) >= half_m + bend_m) continue;
        const double off = beside - bend_m * std::sin(2.0 * kPi * along / wave_m + bend_phase);
        if (std::abs(off) >= half_m) continue;
        const double strength = 0.5 + 0.5 * std::sin(2.0 * kPi * along / fade_m + fade_phase);
        heights.at(column, row) -= strength * depth_m * (1.0 - off * off / (half_m * half_m));
      }
    }
  }
}

void AddCraters(Grid& heights, const CraterParams& p, Rng rng) {
  if (p.per_100m2 == 0.0) return;
  const auto above = [&](double d) { return 0.01 * p.per_100m2 / (d * d); };  // per m^2
  const double most = above(p.min_diameter_m), least = above(p.max_diameter_m);
  const int count = rng.NextPoisson((most - least) * heights.edge_m() * heights.edge_m());
  constexpr double kRim = 0.25, kReach = 2.0;  // rim height over depth; ejecta out to 2 radii
  for (int crater = 0; crater < count; ++crater) {
    const double density = rng.NextUniform(least, most);
    const double diameter_m = std::sqrt(0.01 * p.per_100m2 / density);
    const double radius_m = 0.5 * diameter_m, depth_m = p.depth_ratio * diameter_m;
    const double rim_m = kRim * depth_m;
    const Vec2 centre =
        heights.edge_m() * Vec2(rng.NextUniform(-0.5, 0.5), rng.NextUniform(-0.5, 0.5));
    ForNodesNear(heights, centre, kReach * radius_m, [&](int column, int row, const Vec2& p_W) {
      const double r = (p_W - centre).norm() / radius_m;
      if (r >= kReach) return;
      // A paraboloid from floor to rim; ejecta fall off as r^-3 and end smoothly.
      const double fade = 1.0 - (r - 1.0) / (kReach - 1.0);
      heights.at(column, row) +=
          r < 1.0 ? depth_m * r * r - (depth_m - rim_m) : rim_m * fade / (r * r * r);
    });
  }
}

void AddCells(Grid& heights, const CellParams& p, Rng rng) {
  if (p.amplitude_m == 0.0) return;
  const int cells = static_cast<int>(std::ceil(heights.edge_m() / p.cell_m)) + 1;
  Grid coarse(cells, p.cell_m);
  const int levels = static_cast<int>(std::floor(2.0 * p.amplitude_m / p.step_m + 0.5)) + 1;
  for (double& z : coarse.values) {
    z = -p.amplitude_m +
        p.step_m * std::min(levels - 1, static_cast<int>(rng.NextUniform() * levels));
  }
  for (int row = 0; row < heights.nodes; ++row) {
    for (int column = 0; column < heights.nodes; ++column) {
      const Vec2 at = heights.spacing_m / p.cell_m * Vec2(column, row);
      const int i = static_cast<int>(at.x()), j = static_cast<int>(at.y());
      const double u = at.x() - i, v = at.y() - j;
      heights.at(column, row) += (1 - v) * ((1 - u) * coarse.at(i, j) + u * coarse.at(i + 1, j)) +
                                 v * ((1 - u) * coarse.at(i, j + 1) + u * coarse.at(i + 1, j + 1));
    }
  }
}

void AddRipples(Grid& heights, const RippleParams& p, const Grid& presence) {
  if (p.amplitude_m == 0.0) return;
  const Vec2 wind(std::cos(p.azimuth_rad), std::sin(p.azimuth_rad)), across(-wind.y(), wind.x());
  constexpr double kSkew = 0.5;  // rad: the lee side is steeper
  for (int row = 0; row < heights.nodes; ++row) {
    for (int column = 0; column < heights.nodes; ++column) {
      const double share = presence.at(column, row);
      if (share == 0.0) continue;
      const Vec2 p_W = heights.Position(column, row);
      const double sway = 0.7 * std::sin(2.0 * kPi * p_W.dot(across) / (12.0 * p.wavelength_m));
      const double phase = 2.0 * kPi * p_W.dot(wind) / p.wavelength_m + sway;
      heights.at(column, row) += share * p.amplitude_m * std::sin(phase + kSkew * std::sin(phase));
    }
  }
}

Grid DrawPatchField(int nodes, double spacing_m, Rng rng) {
  constexpr double kMin_m = 1.0, kMax_m = 5.0, kHurst = 0.8;
  // Smooth at a metre, so a coarse grid will do.
  const int coarsening = std::max(1, static_cast<int>(0.2 / spacing_m));
  const int n = (nodes + coarsening - 1) / coarsening + 1;
  RoughnessParams band;
  band.hurst = band.fine_hurst = kHurst;
  const Spectral field = DrawSpectral(n, coarsening * spacing_m, rng, [&](double kx, double ky) {
    const double wave_m = 2.0 * kPi / std::hypot(kx, ky);
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

Grid CalcHollows(const Grid& heights) {
  constexpr double kNear_m = 0.25, kFar_m = 2.0;  // radii of the means that are compared
  const auto radius = [&](double m) {
    return std::clamp(static_cast<int>(m / heights.spacing_m), 1, heights.nodes / 4);
  };
  Grid near = BoxBlur(heights, radius(kNear_m));
  const Grid far = BoxBlur(heights, radius(kFar_m));
  for (std::size_t i = 0; i < near.values.size(); ++i)
    near.values[i] = far.values[i] - near.values[i];
  return near;
}

Grid CoverHighest(const Grid& field, double fraction, double blend_m) {
  Grid cover(field.nodes, field.spacing_m);
  if (fraction <= 0.0) return cover;
  std::vector<double> sorted;
  constexpr std::size_t kEvery = 17;  // a sample is enough for a quantile
  for (std::size_t i = 0; i < field.values.size(); i += kEvery) sorted.push_back(field.values[i]);
  const auto rank =
      std::min(sorted.size() - 1,
               static_cast<std::size_t>((1.0 - fraction) * static_cast<double>(sorted.size())));
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank),
                   sorted.end());
  const double threshold = fraction >= 1.0 ? -1e300 : sorted[rank];
  for (std::size_t i = 0; i < field.values.size(); ++i)
    cover.values[i] = field.values[i] > threshold ? 1.0 : 0.0;
  // Two passes of a mean over half the blend make an edge that rises over all of it.
  const int radius = static_cast<int>(std::lround(0.25 * blend_m / field.spacing_m));
  return radius > 0 ? BoxBlur(BoxBlur(cover, radius), radius) : cover;
}

Grid SoftenEdges(const Grid& presence) { return BoxBlur(presence, 1); }

void LimitSlope(Grid& heights, double max_slope_rad) {
  const double step_m = std::tan(max_slope_rad) * heights.spacing_m;
  const int n = heights.nodes;
  const auto lower = [&](int c, int r, int c2, int r2) {
    if (c2 < 0 || r2 < 0 || c2 >= n || r2 >= n) return;
    heights.at(c, r) = std::min(heights.at(c, r), heights.at(c2, r2) + step_m);
  };
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c < n; ++c) lower(c, r, c - 1, r), lower(c, r, c, r - 1);
  }
  for (int r = n - 1; r >= 0; --r) {
    for (int c = n - 1; c >= 0; --c) lower(c, r, c + 1, r), lower(c, r, c, r + 1);
  }
}

Vec2 FitPlane(const Grid& heights) {
  Vec2 moment = Vec2::Zero(), size = Vec2::Zero();  // nodes are symmetric about the origin
  constexpr int kStride = 4;
  const auto weigh = [&](int column, int row) {
    const Vec2 p = heights.Position(column, row);
    moment += p * heights.at(column, row);
    size += p.cwiseAbs2();
  };
  for (int row = 0; 2 * row < heights.nodes; row += kStride) {
    for (int column = 0; 2 * column < heights.nodes; column += kStride) {
      const int far_row = heights.nodes - 1 - row, far_column = heights.nodes - 1 - column;
      weigh(column, row), weigh(far_column, row), weigh(column, far_row);
      weigh(far_column, far_row);
    }
  }
  return moment.cwiseQuotient(size);
}

double CalcDeviation(const Grid& heights, double lag_m, const Vec2& plane) {
  constexpr int kStride = 3;  // every third node: the estimate is converged, the time is a ninth
  const int lag = std::max(1, static_cast<int>(std::lround(lag_m / heights.spacing_m)));
  const Vec2 drop = plane * (lag * heights.spacing_m);
  double sum = 0.0;
  std::int64_t count = 0;
  for (int r = 0; r + lag < heights.nodes; r += kStride) {
    for (int c = 0; c + lag < heights.nodes; c += kStride) {
      const double z = heights.at(c, r);
      const double east = heights.at(c + lag, r) - z - drop.x();
      const double north = heights.at(c, r + lag) - z - drop.y();
      sum += east * east + north * north;
      count += 2;
    }
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

}  // namespace scoria::terrains
