// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/config/archive.h"

namespace scoria::terrains {

/// Self-affine roughness: the RMS height difference at lag L is nu(L) = nu(1 m) (L / 1 m)^H.
/// Source: [Shepard2001]; two slopes as in reference data on lava, break at break_wavelength_m.
struct RoughnessParams {
  double nu_1m_m = 0.0;
  double hurst = 0.6;
  double fine_hurst = 0.6;
  double break_wavelength_m = 0.5;
  double min_wavelength_m = 0.06;
  double max_wavelength_m = 12.8;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("nu_1m_m", nu_1m_m, {.min = 0.0, .max = 2.0, .doc = "RMS height difference at 1 m"});
    a.Field("hurst", hurst, {.min = 0.05, .max = 0.98, .doc = "exponent above the break"});
    a.Field("fine_hurst", fine_hurst,
            {.min = 0.05, .max = 0.98, .doc = "exponent below the break"});
    a.Field("break_wavelength_m", break_wavelength_m, {.min = 0.05, .max = 50.0});
    a.Field("min_wavelength_m", min_wavelength_m, {.min = 0.05, .max = 50.0});
    a.Field("max_wavelength_m", max_wavelength_m, {.min = 0.1, .max = 51.2});
  }
  [[nodiscard]] std::string Problem() const {
    return min_wavelength_m < max_wavelength_m ? ""
                                               : "min_wavelength_m must be below max_wavelength_m";
  }
};

/// Rocks by size: the area fraction covered by rocks larger than D is k exp(-q D), q = 1.79 + 0.152
/// / k. Source: [Golombek1997].
struct RockParams {
  double area_fraction = 0.0;
  double min_diameter_m = 0.05;
  double max_diameter_m = 0.8;
  double height_ratio = 0.5;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("area_fraction", area_fraction, {.min = 0.0, .max = 0.4, .doc = "k; 0 for none"});
    a.Field("min_diameter_m", min_diameter_m, {.min = 0.02, .max = 5.0});
    a.Field("max_diameter_m", max_diameter_m, {.min = 0.02, .max = 5.0});
    a.Field("height_ratio", height_ratio, {.min = 0.05, .max = 2.0, .doc = "height over diameter"});
  }
};

/// One kind of ground.
struct TerrainParams {
  std::string name = "flat";
  double size_m = 51.2;
  double resolution_m = 0.025;
  double friction = 0.8;
  double slope_rad = 0.0;
  double slope_azimuth_rad = 0.0;
  double roughness_scale = 1.0;
  RoughnessParams roughness;
  RockParams rocks;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("name", name);
    a.Field("size_m", size_m, {.min = 1.0, .max = 204.8, .doc = "edge of the square tile"});
    a.Field("resolution_m", resolution_m, {.min = 0.005, .max = 0.5});
    a.Field("friction", friction, {.min = 0.0, .max = 2.0});
    a.Field("slope_rad", slope_rad, {.min = 0.0, .max = 0.8, .doc = "of the base plane"});
    a.Field("slope_azimuth_rad", slope_azimuth_rad, {.doc = "uphill direction, from +x"});
    a.Field("roughness_scale", roughness_scale,
            {.min = 0.0, .max = 10.0, .doc = "multiplies roughness and rock heights"});
    a.Field("roughness", roughness);
    a.Field("rocks", rocks);
  }
  [[nodiscard]] std::string Problem() const {
    if (size_m < 16.0 * resolution_m) return "size_m must be at least 16 resolution_m";
    if (roughness.nu_1m_m > 0.0 && roughness.max_wavelength_m < 4.0 * resolution_m) {
      return "roughness.max_wavelength_m must be at least 4 resolution_m";
    }
    return "";
  }
};

}  // namespace scoria::terrains
