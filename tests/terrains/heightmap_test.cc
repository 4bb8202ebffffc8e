// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/heightmap.h"

#include <cstring>

#include <gtest/gtest.h>
#include <png.h>

#include "core/files.h"
#include "terrains/generator.h"
#include "tests/support/robots.h"

namespace scoria::terrains {
namespace {

class Heightmap : public ::testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const std::string& text) {
    core::WriteText(folder.path() / name, text);
    return folder.path() / name;
  }
  /// A grey or coloured PNG of a ramp from west to east.
  std::filesystem::path WritePng(const std::string& name, int columns, int rows, bool grey16) {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(columns);
    image.height = static_cast<png_uint_32>(rows);
    image.format = grey16 ? PNG_FORMAT_LINEAR_Y : PNG_FORMAT_RGB;
    std::vector<std::uint16_t> pixels(static_cast<std::size_t>(columns * rows) * 2);
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c)
        pixels[static_cast<std::size_t>(r * columns + c)] =
            static_cast<std::uint16_t>(1000 * c + r);
    }
    const std::filesystem::path file = folder.path() / name;
    EXPECT_TRUE(png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, nullptr));
    return file;
  }
  /// The message of the error that reading gives, without the folder.
  std::string ErrorOf(const std::filesystem::path& file) {
    HeightmapParams params;
    params.file = file;
    try {
      (void)ReadHeightmap(params, 0.25);
    } catch (const core::ConfigError& e) {
      const std::string text = e.what(), prefix = folder.path().string() + "/";
      return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
    }
    return "no error";
  }
  static std::string Ascii(int columns, int rows, const std::string& value,
                           const std::string& header = "cellsize 0.5\nNODATA_value -9999\n") {
    std::string text =
        fmt::format("ncols {}\nnrows {}\nxllcorner 0\nyllcorner 0\n{}", columns, rows, header);
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) text += (r == 2 && c == 3 ? value : "1.5") + " ";
      text += "\n";
    }
    return text;
  }

  test::TemporaryFolder folder;
};

TEST_F(Heightmap, PngKeepsItsSixteenBitsAndItsNorth) {
  HeightmapParams params;
  params.file = WritePng("ramp.png", 32, 32, true);
  params.black_m = -1.0;
  params.white_m = 1.0;
  const Grid heights = ReadHeightmap(params, 0.25);
  EXPECT_EQ(heights.nodes, 32);
  EXPECT_EQ(heights.spacing_m, 0.25);
  EXPECT_NEAR(heights.at(3, 31), -1.0 + 2.0 * 3000 / 65535, 1e-12);  // first line: north
  EXPECT_NEAR(heights.at(3, 0), -1.0 + 2.0 * 3031 / 65535, 1e-12);
}

TEST_F(Heightmap, AsciiGridCarriesItsOwnSpacing) {
  HeightmapParams params;
  params.file = Write("ok.asc", Ascii(20, 20, "2.25"));
  const Grid heights = ReadHeightmap(params, 0.25);
  EXPECT_EQ(heights.spacing_m, 0.5);
  EXPECT_EQ(heights.at(3, 17), 2.25);  // third row from the north
  EXPECT_EQ(heights.at(0, 0), 1.5);
}

TEST_F(Heightmap, BecomesTheGroundUnderSlopeAndScale) {
  TerrainParams params;
  params.heightmap.file = Write("ok.asc", Ascii(20, 20, "1.5"));
  params.roughness_scale = 2.0;
  const Heightfield ground = GenerateTerrain(params, 1, 0);
  EXPECT_EQ(ground.nodes(), 20);
  EXPECT_NEAR(ground.HeightAt(0.0, 0.0), 3.0, 1e-12);
}

TEST_F(Heightmap, EveryErrorNamesFileAndRule) {
  EXPECT_EQ(ErrorOf(folder.path() / "gone.png"), "gone.png: heightmap: cannot read the file");
  EXPECT_EQ(ErrorOf(Write("map.tif", "")),
            "map.tif: heightmap: ends in \".tif\"; choices: .asc, .png");
  EXPECT_EQ(ErrorOf(WritePng("wide.png", 40, 20, true)),
            "wide.png: heightmap: is 40 x 20 cells; a heightmap must be square");
  EXPECT_EQ(ErrorOf(WritePng("colour.png", 32, 32, false)),
            "colour.png: heightmap: has 8 bits and colours; a heightmap needs 16-bit grey");
  EXPECT_EQ(ErrorOf(Write("text.png", "not a picture")),
            "text.png: heightmap: cannot be decoded: Not a PNG file");
  EXPECT_EQ(ErrorOf(Write("flat.asc", Ascii(20, 18, "1"))),
            "flat.asc: heightmap: is 20 x 18 cells; a heightmap must be square");
  EXPECT_EQ(ErrorOf(Write("small.asc", Ascii(8, 8, "1"))),
            "small.asc: heightmap: has 8 cells along an edge; at least 16");
  EXPECT_EQ(ErrorOf(Write("nan.asc", Ascii(20, 20, "nan"))),
            "nan.asc:9:1: heightmap: value 4 is nan; every height must be a number");
  EXPECT_EQ(ErrorOf(Write("gap.asc", Ascii(20, 20, "-9999"))),
            "gap.asc:9:1: heightmap: value 4 is NODATA; fill the gaps first");
  EXPECT_EQ(ErrorOf(Write("head.asc", Ascii(20, 20, "1", ""))),
            "head.asc:5:1: heightmap: the header lacks cellsize");
  EXPECT_EQ(ErrorOf(Write("short.asc", "ncols 20\nnrows 20\ncellsize 0.5\n1 2 3\n")),
            "short.asc:4:1: heightmap: has 3 of 20 values");
  EXPECT_EQ(ErrorOf(Write("deg.asc", Ascii(20, 20, "1", "cellsize 0.000277\n"))),
            "deg.asc:6:1: heightmap: cellsize 0.000277 is outside [0.005, 0.5] m (is the grid in "
            "degrees?)");
  EXPECT_EQ(ErrorOf(Write("tiny.asc", Ascii(20, 20, "1", "cellsize 0.1\n"))),
            "tiny.asc: heightmap: is 2 m wide; a robot needs at least 6 m");
  EXPECT_EQ(ErrorOf(Write("word.asc", "ncols many\n")),
            "word.asc:1:1: heightmap: ncols needs a number");
  EXPECT_EQ(ErrorOf(Write("more.asc", Ascii(20, 20, "1") + "1 2 3\n")),
            "more.asc:27:1: heightmap: has more than 20 rows");
  EXPECT_EQ(ErrorOf(Write("wider.asc", "ncols 16\nnrows 16\ncellsize 0.5\n" +
                                           std::string("1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1\n"))),
            "wider.asc:4:1: heightmap: has more than 16 values");
  EXPECT_EQ(ErrorOf(Write("first.asc", "ncols 16\nnrows 16\ncellsize 0.5\nnan 1 1\n")),
            "first.asc:4:1: heightmap: value 1 is nan; every height must be a number");
  const std::string whole = Ascii(20, 20, "1");
  EXPECT_EQ(ErrorOf(Write("cut.asc", whole.substr(0, whole.size() - 81))),
            "cut.asc:26:1: heightmap: ends after 19 of 20 rows");
}

std::string TerrainError(const std::string& yaml) {
  try {
    (void)core::ReadConfig<TerrainParams>(core::ParseConfig(yaml, "my.yaml"));
  } catch (const core::ConfigError& e) {
    return e.what();
  }
  return "no error";
}

TEST(TerrainYaml, WhatCannotBeBuiltIsRefused) {
  const auto has = [](const std::string& yaml, const std::string& text) {
    EXPECT_NE(TerrainError(yaml).find(text), std::string::npos) << TerrainError(yaml);
  };
  has("patches: [{name: sand, fraction: 0.1, where: hollows}]\n"
      "ripples: {amplitude_m: 0.01, material: sand}\n",
      "ripples.material: unknown \"sand\"; the patches that lie anywhere are: none");
  has("patches: [{name: a, fraction: 0.8}, {name: b, fraction: 0.5}]\n",
      "patches: fractions sum to 1.3, more than 1");
  has("resolution_m: 0.5\nropes: {amplitude_m: 0.02}\n",
      "ropes.max_wavelength_m must be at least 2 resolution_m");
  has("size_m: 1\nresolution_m: 0.1\n", "size_m must be at least 16 resolution_m");
  has("gullies: {min_depth_m: 1, max_depth_m: 0.5}\n", "minima must not exceed maxima");
}

TEST(TerrainYaml, UnknownMaterialNamesTheChoices) {
  try {
    (void)core::ReadConfig<TerrainParams>(core::ParseConfig(
        "patches: [{name: lapilli, fraction: 0.4}, {name: crust, fraction: 0.1}]\n"
        "ripples: {amplitude_m: 0.01, material: ash}\n",
        "my.yaml"));
    FAIL();
  } catch (const core::ConfigError& e) {
    EXPECT_NE(
        std::string(e.what()).find(
            "ripples.material: unknown \"ash\"; the patches that lie anywhere are: lapilli, crust"),
        std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace scoria::terrains
