// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/config/archive.h"
#include "terrains/heightfield.h"

namespace scoria::terrains {

template <class Archive>
void SerializeMaterial(Archive& a, Material& m) {
  a.Field("name", m.name);
  a.Field("friction", m.friction, {.min = 0.0, .max = 2.0});
  a.Field("stiffness_N_per_m3", m.stiffness_N_per_m3,
          {.min = 1e4, .max = 1e12, .doc = "k_s: a foot sunk by z presses with k_s A(z) z"});
  a.Field("damping_ratio", m.damping_ratio, {.min = 0.0, .max = 5.0});
}

/// What the ground consists of where no patch lies.
struct Substrate : Material {
  template <class Archive>
  void Serialize(Archive& a) {
    SerializeMaterial(a, *this);
  }
};

/// Self-affine roughness: the RMS height difference at lag L is nu(L) = nu(1 m) (L / 1 m)^H, with
/// another exponent below a break.
/// Source: [Shepard2001], [Campbell1993] for the break.
struct RoughnessParams {
  double nu_1m_m = 0.0;
  double hurst = 0.6;
  double fine_hurst = 0.6;
  double break_wavelength_m = 0.5;
  double min_wavelength_m = 0.06;
  double max_wavelength_m = 12.8;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("nu_1m_m", nu_1m_m,
            {.min = 0.0, .max = 2.0, .doc = "RMS height difference at 1 m, large forms included"});
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
  double friction = 0.7;
  double stiffness_N_per_m3 = 1e9;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("area_fraction", area_fraction, {.min = 0.0, .max = 0.4, .doc = "k; 0 for none"});
    a.Field("min_diameter_m", min_diameter_m, {.min = 0.02, .max = 5.0});
    a.Field("max_diameter_m", max_diameter_m, {.min = 0.02, .max = 5.0});
    a.Field("height_ratio", height_ratio,
            {.min = 0.05, .max = 2.0, .doc = "height over diameter, a fifth to a half is buried"});
    a.Field("friction", friction, {.min = 0.0, .max = 2.0});
    a.Field("stiffness_N_per_m3", stiffness_N_per_m3, {.min = 1e4, .max = 1e12});
  }
  [[nodiscard]] std::string Problem() const {
    return min_diameter_m < max_diameter_m ? "" : "min_diameter_m must be below max_diameter_m";
  }
};

enum class PatchPlace { kAnywhere, kHollows };
constexpr std::array<std::pair<PatchPlace, std::string_view>, 2> EnumNames(PatchPlace) {
  return {{{PatchPlace::kAnywhere, "anywhere"}, {PatchPlace::kHollows, "hollows"}}};
}

/// A material that covers part of the ground, in patches with blended edges.
struct PatchParams : Material {
  double fraction = 0.0;
  PatchPlace where = PatchPlace::kAnywhere;
  template <class Archive>
  void Serialize(Archive& a) {
    SerializeMaterial(a, *this);
    a.Field("depth_m", depth_m, {.min = 0.0, .max = 10.0, .doc = "the substrate lies below"});
    a.Required("fraction", fraction, {.min = 0.0, .max = 1.0, .doc = "of the area"});
    a.Field("where", where);
  }
};

/// Wind ripples: skewed waves, steep in the lee.
struct RippleParams {
  double amplitude_m = 0.0;
  double wavelength_m = 0.2;
  double azimuth_rad = 0.0;
  double fraction = 1.0;
  std::string material;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("amplitude_m", amplitude_m, {.min = 0.0, .max = 1.0, .doc = "half of crest to trough"});
    a.Field("wavelength_m", wavelength_m, {.min = 0.05, .max = 10.0});
    a.Field("azimuth_rad", azimuth_rad, {.doc = "of the wind, from +x"});
    a.Field("fraction", fraction, {.min = 0.0, .max = 1.0, .doc = "of the area"});
    a.Field("material", material,
            {.doc = "patch that they lie on first, spreading from it; empty: anywhere"});
  }
};

/// Channels down the fall line, parabolic across.
struct GullyParams {
  double per_20m = 0.0;
  double min_depth_m = 0.1, max_depth_m = 0.3;
  double min_width_m = 0.4, max_width_m = 1.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("per_20m", per_20m, {.min = 0.0, .max = 20.0, .doc = "channels per 20 m of slope"});
    a.Field("min_depth_m", min_depth_m, {.min = 0.0, .max = 5.0});
    a.Field("max_depth_m", max_depth_m, {.min = 0.0, .max = 5.0});
    a.Field("min_width_m", min_width_m, {.min = 0.1, .max = 20.0});
    a.Field("max_width_m", max_width_m, {.min = 0.1, .max = 20.0});
  }
  [[nodiscard]] std::string Problem() const {
    return min_depth_m <= max_depth_m && min_width_m <= max_width_m
               ? ""
               : "minima must not exceed maxima";
  }
};

/// Bowl craters with raised rims: N(> D) = density D^-2.
struct CraterParams {
  double per_100m2 = 0.0;
  double min_diameter_m = 0.5, max_diameter_m = 5.0;
  double depth_ratio = 0.1;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("per_100m2", per_100m2,
            {.min = 0.0, .max = 100.0, .doc = "number of craters wider than 1 m"});
    a.Field("min_diameter_m", min_diameter_m, {.min = 0.1, .max = 50.0});
    a.Field("max_diameter_m", max_diameter_m, {.min = 0.1, .max = 50.0});
    a.Field("depth_ratio", depth_ratio, {.min = 0.0, .max = 0.5, .doc = "depth over diameter"});
  }
  [[nodiscard]] std::string Problem() const {
    return min_diameter_m < max_diameter_m ? "" : "min_diameter_m must be below max_diameter_m";
  }
};

/// Ropes of pahoehoe: short ridges, all across one direction.
struct RopeParams {
  double amplitude_m = 0.0;
  double min_wavelength_m = 0.1, max_wavelength_m = 0.3;
  double anisotropy = 3.0;
  double azimuth_rad = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("amplitude_m", amplitude_m,
            {.min = 0.0, .max = 1.0, .doc = "of the mean sine; its RMS height is 0.71 of this"});
    a.Field("min_wavelength_m", min_wavelength_m, {.min = 0.05, .max = 10.0});
    a.Field("max_wavelength_m", max_wavelength_m, {.min = 0.05, .max = 10.0});
    a.Field("anisotropy", anisotropy, {.min = 1.0, .max = 20.0, .doc = "length over width"});
    a.Field("azimuth_rad", azimuth_rad, {.doc = "of the flow, from +x"});
  }
  [[nodiscard]] std::string Problem() const {
    return min_wavelength_m < max_wavelength_m ? ""
                                               : "min_wavelength_m must be below max_wavelength_m";
  }
};

/// The ground of reinforcement-learning suites: independent heights on coarse cells, linear
/// between.
struct CellParams {
  double amplitude_m = 0.0;
  double step_m = 0.005;
  double cell_m = 0.2;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("amplitude_m", amplitude_m, {.min = 0.0, .max = 1.0, .doc = "heights in +- this"});
    a.Field("step_m", step_m, {.min = 1e-4, .max = 1.0});
    a.Field("cell_m", cell_m, {.min = 0.05, .max = 10.0});
  }
};

/// A measured ground in place of the generated relief: 16-bit grey PNG or ESRI ASCII grid.
struct HeightmapParams {
  std::filesystem::path file;
  double black_m = 0.0, white_m = 1.0;
  double tile_m = 0.0;
  std::optional<std::array<double, 2>> centre_m;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("file", file,
            {.doc = "PNG, 16-bit grey, north up, with resolution_m of the terrain; or ESRI ASCII "
                    "grid in metres, its cells square and 0.005 to 0.5 m wide, else resampled to "
                    "resolution_m"});
    a.Field("black_m", black_m, {.doc = "height of a PNG's value 0"});
    a.Field("white_m", white_m, {.doc = "height of a PNG's value 65535"});
    a.Field("tile_m", tile_m,
            {.min = 0.0, .max = 1e6, .doc = "edge of the square tile; 0: the largest that fits"});
    a.Field("centre_m", centre_m,
            {.doc = "east, north of the tile's centre as the grid's xllcorner, yllcorner count (a "
                    "PNG: from its south-west corner); none: the middle of the map"});
  }
};

/// One kind of ground.
struct TerrainParams {
  std::string name = "flat";
  double size_m = 51.2;
  double resolution_m = 0.025;
  HeightmapParams heightmap;
  double slope_rad = 0.0;
  double slope_azimuth_rad = 0.0;
  double max_slope_rad = 1.5;
  double roughness_scale = 1.0;
  Substrate substrate;
  std::vector<PatchParams> patches;
  RoughnessParams roughness;
  RockParams rocks;
  RippleParams ripples;
  GullyParams gullies;
  CraterParams craters;
  RopeParams ropes;
  CellParams cells;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("name", name);
    a.Field("size_m", size_m, {.min = 1.0, .max = 204.8, .doc = "edge of the square tile"});
    a.Field("resolution_m", resolution_m, {.min = 0.005, .max = 0.5});
    a.Field("heightmap", heightmap);
    a.Field("slope_rad", slope_rad, {.min = 0.0, .max = 0.8, .doc = "of the base plane"});
    a.Field("slope_azimuth_rad", slope_azimuth_rad, {.doc = "uphill direction, from +x"});
    a.Field("max_slope_rad", max_slope_rad,
            {.min = 0.1, .max = 1.5, .doc = "between neighbouring nodes; steeper relief is cut"});
    a.Field("roughness_scale", roughness_scale,
            {.min = 0.0, .max = 10.0, .doc = "multiplies all relief but the base plane"});
    a.Field("substrate", substrate);
    a.Field("patches", patches);
    a.Field("roughness", roughness);
    a.Field("rocks", rocks);
    a.Field("ripples", ripples);
    a.Field("gullies", gullies);
    a.Field("craters", craters);
    a.Field("ropes", ropes);
    a.Field("cells", cells);
  }
  [[nodiscard]] std::string Problem() const;
};

}  // namespace scoria::terrains
