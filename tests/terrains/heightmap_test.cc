// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/heightmap.h"

#include <cstring>
#include <map>

#include <gtest/gtest.h>
#include <png.h>

#include "core/config/archive.h"
#include "core/files.h"
#include "terrains/generator.h"
#include "tests/support/robots.h"

namespace scoria::terrains {
namespace {

class HeightmapFile : public ::testing::Test {
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

TEST_F(HeightmapFile, PngKeepsItsSixteenBitsAndItsNorth) {
  HeightmapParams params;
  params.file = WritePng("ramp.png", 32, 32, true);
  params.black_m = -1.0;
  params.white_m = 1.0;
  const Grid heights = ReadHeightmap(params, 0.25).heights;
  EXPECT_EQ(heights.nodes, 32);
  EXPECT_EQ(heights.spacing_m, 0.25);
  EXPECT_NEAR(heights.at(3, 31), -1.0 + 2.0 * 3000 / 65535, 1e-12);  // first line: north
  EXPECT_NEAR(heights.at(3, 0), -1.0 + 2.0 * 3031 / 65535, 1e-12);
}

TEST_F(HeightmapFile, AsciiGridCarriesItsOwnSpacing) {
  HeightmapParams params;
  params.file = Write("ok.asc", Ascii(20, 20, "2.25"));
  const Grid heights = ReadHeightmap(params, 0.25).heights;
  EXPECT_EQ(heights.spacing_m, 0.5);
  EXPECT_EQ(heights.at(3, 17), 2.25);  // third row from the north
  EXPECT_EQ(heights.at(0, 0), 1.5);
}

TEST_F(HeightmapFile, BecomesTheGroundUnderSlopeAndScale) {
  TerrainParams params;
  params.heightmap.file = Write("ok.asc", Ascii(20, 20, "1.5"));
  params.roughness_scale = 2.0;
  const Heightfield ground = GenerateTerrain(params, 1, 0);
  EXPECT_EQ(ground.nodes(), 20);
  EXPECT_NEAR(ground.HeightAt(0.0, 0.0), 3.0, 1e-12);
}

TEST_F(HeightmapFile, EveryErrorNamesFileAndRule) {
  EXPECT_EQ(ErrorOf(folder.path() / "gone.png"), "gone.png: heightmap: cannot read the file");
  EXPECT_EQ(ErrorOf(WritePng("small.png", 10, 20, true)),
            "small.png: heightmap: is 2.5 m wide; a robot needs at least 6 m");
  EXPECT_EQ(ErrorOf(WritePng("colour.png", 32, 32, false)),
            "colour.png: heightmap: has 8 bits and colours; a heightmap needs 16-bit grey");
  EXPECT_EQ(ErrorOf(Write("broken.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16))),
            "broken.png: heightmap: cannot be decoded: Read Error");
  EXPECT_EQ(ErrorOf(Write("small.asc", Ascii(8, 8, "1", "cellsize 0.5\n"))),
            "small.asc: heightmap: is 4 m wide; a robot needs at least 6 m");
  EXPECT_EQ(ErrorOf(Write("few.asc", Ascii(14, 14, "1"))),
            "few.asc: heightmap: has 14 cells along an edge; at least 16");
  EXPECT_EQ(ErrorOf(Write("head.asc", Ascii(20, 20, "1", ""))),
            "head.asc:5:1: heightmap: the header lacks cellsize");
  EXPECT_EQ(ErrorOf(Write("deg.asc", Ascii(20, 20, "1", "cellsize 0.000277\n"))),
            "deg.asc: heightmap: is 0.00554 m wide; a robot needs at least 6 m (is the grid in "
            "degrees? Project it to metres)");
  EXPECT_EQ(ErrorOf(Write("word.asc", "ncols many\n")),
            "word.asc:1:1: heightmap: ncols needs a number");
  EXPECT_EQ(
      ErrorOf(Write("huge.asc", "ncols 1e9\nnrows 16384\ncellsize 0.1\n1\n")),
      "huge.asc: heightmap: has 1e+09 x 16384 cells; at most 2.68435e+08 in all: cut it first");
  EXPECT_EQ(
      ErrorOf(Write("half.asc", "ncols 16.5\nnrows 16\ncellsize 0.5\n1\n")),
      "half.asc:4:1: heightmap: ncols and nrows must be whole numbers from 1 on, one is 16.5");
  EXPECT_EQ(ErrorOf(Write("zero.asc", "ncols 16\nnrows 16\ncellsize 0\n1\n")),
            "zero.asc:4:1: heightmap: a cell of 0 m; it must be positive");
  EXPECT_EQ(ErrorOf(Write("twice.asc", "ncols 16\nncols 16\n")),
            "twice.asc:2:1: heightmap: ncols is given twice");
  EXPECT_EQ(ErrorOf(Write("key.asc", "ncols 16\nnrows 16\ncelsize 0.5\n")),
            "key.asc:3:1: heightmap: \"celsize\" is neither a height nor a key of an ESRI ASCII "
            "grid (did you mean \"cellsize\"?)");
}

TEST_F(HeightmapFile, EveryCountErrorSaysWhatIsThere) {
  const std::string whole = Ascii(20, 20, "1");
  EXPECT_EQ(ErrorOf(Write("more.asc", whole + "1 2 3\n")),
            "more.asc:27:1: heightmap: has more than 20 x 20 heights");
  EXPECT_EQ(ErrorOf(Write("cut.asc", whole.substr(0, whole.size() - 81))),
            "cut.asc:26:1: heightmap: ends after 380 of 400 heights");
  // A value is missing in the third row, whose line is the eighth.
  std::string gap = whole;
  gap.replace(gap.find("1 1.5"), 2, "");
  EXPECT_EQ(ErrorOf(Write("gap.asc", gap)),
            "gap.asc:27:1: heightmap: ends after 399 of 400 heights; line 9 has 19 of 20");
  EXPECT_EQ(ErrorOf(Write("word.asc", Ascii(20, 20, "high"))),
            "word.asc:9:1: heightmap: row 3, value 4 is \"high\"; every height must be a number, "
            "with blanks between");
  EXPECT_EQ(
      ErrorOf(Write("commas.asc", Ascii(20, 20, "1,2,3"))),
      "commas.asc:9:1: heightmap: row 3, value 4 is \"1,2,3\"; every height must be a number, "
      "with blanks between");
}

TEST_F(HeightmapFile, AFileOfAnotherKindIsNamed) {
  EXPECT_EQ(ErrorOf(Write("map.tif", std::string("II*\0\x08\0\0\0", 8))),
            "map.tif: heightmap: is a TIFF image, not a 16-bit PNG or an ESRI ASCII grid (convert: "
            "gdal_translate -of AAIGrid IN OUT.asc)");
  EXPECT_EQ(ErrorOf(Write("photo.png", "\xff\xd8\xff\xe0")),
            "photo.png: heightmap: is a JPEG image, not a 16-bit PNG or an ESRI ASCII grid");
  EXPECT_EQ(ErrorOf(Write("text.png", "not a picture")),
            "text.png:1:1: heightmap: \"not\" is neither a height nor a key of an ESRI ASCII grid");
  EXPECT_EQ(ErrorOf(folder.path()), folder.path().string() + ": heightmap: is a folder");
}

TEST_F(HeightmapFile, GapsAreFoundWhateverMarksThem) {
  const std::string no_data = "cellsize 0.5\nNODATA_value -3.40282346638529e+38\n";
  for (const char* value : {"-3.4028234663852886e+38", "-3.402823e+38", "-3.40282346638529e+38"}) {
    EXPECT_EQ(ErrorOf(Write("gap.asc", Ascii(20, 20, value, no_data))),
              "gap.asc:9:1: heightmap: row 3, value 4 is NODATA; fill the gaps first, or choose a "
              "tile without");
  }
  EXPECT_EQ(ErrorOf(Write("gap.asc", Ascii(20, 20, "-9999.0"))),
            "gap.asc:9:1: heightmap: row 3, value 4 is NODATA; fill the gaps first, or choose a "
            "tile without");
  EXPECT_EQ(ErrorOf(Write("nan.asc", Ascii(20, 20, "nan"))),
            "nan.asc:9:1: heightmap: row 3, value 4 is nan; every height must be a number");
  EXPECT_EQ(ErrorOf(Write("inf.asc", Ascii(20, 20, "-1e999"))),
            "inf.asc:9:1: heightmap: row 3, value 4 is inf; every height must be a number");
  for (const char* value : {"-9999", "-32768", "32767"}) {  // undeclared
    EXPECT_EQ(ErrorOf(Write("mark.asc", Ascii(20, 20, value, "cellsize 0.5\n"))),
              fmt::format("mark.asc:8:1: heightmap: row 3, value 4 is {}, as gaps are marked; fill "
                          "the gaps first, or choose a tile without",
                          value));
  }
  EXPECT_EQ(ErrorOf(Write("far.asc", Ascii(20, 20, "-3.4e38", "cellsize 0.5\n"))),
            "far.asc:8:1: heightmap: row 3, value 4 is -3.4e+38 m; heights of Earth, Moon and Mars "
            "lie in [-11000, 22000] m");
}

/// A level grid of 20 x 20 cells of 0.5 m but for some cells.
std::string LevelBut(const std::map<std::pair<int, int>, double>& others) {
  std::string text = "ncols 20\nnrows 20\ncellsize 0.5\n";
  for (int r = 0; r < 20; ++r) {
    for (int c = 0; c < 20; ++c)
      text += fmt::format("{} ", others.contains({c, r}) ? others.at({c, r}) : 300.0);
    text += "\n";
  }
  return text;
}

TEST_F(HeightmapFile, SpikesPitsAndUndeclaredVoidsAreRefused) {
  EXPECT_EQ(ErrorOf(Write("spike.asc", LevelBut({{{5, 6}, 315.0}}))),
            "spike.asc:10:1: heightmap: row 7, value 6 is 315 m, over 5 m from all but 0 of "
            "its neighbours: a spike or a pit; remove it first");
  EXPECT_EQ(ErrorOf(Write("pit.asc", LevelBut({{{0, 0}, 280.0}}))),
            "pit.asc:4:1: heightmap: row 1, value 1 is 280 m, over 5 m from all but 0 of its "
            "neighbours: a spike or a pit; remove it first");
  EXPECT_EQ(ErrorOf(Write("pair.asc", LevelBut({{{5, 6}, 315.0}, {{5, 7}, 315.0}}))),
            "pair.asc:10:1: heightmap: row 7, value 6 is 315 m, over 5 m from all but 1 of "
            "its neighbours: a spike or a pit; remove it first");
  EXPECT_EQ(ErrorOf(Write("low.asc", LevelBut({{{5, 6}, 304.0}}))),
            "no error");  // a low one is a rock
  std::map<std::pair<int, int>, double> corner;
  for (int r = 0; r < 5; ++r) {
    for (int c = 0; c < 5; ++c) corner[{c, r}] = 0.0;
  }
  EXPECT_EQ(ErrorOf(Write("void.asc", LevelBut(corner))),
            "void.asc:4:1: heightmap: row 1, value 5 is 0 m, its neighbour 300: 300 m in one cell; "
            "fill gaps first");
}

TEST_F(HeightmapFile, CliffsAndBlocksAreGround) {
  std::map<std::pair<int, int>, double> cliff;
  for (int r = 0; r < 20; ++r) {
    for (int c = 0; c < 10; ++c) cliff[{c, r}] = 340.0;
  }
  EXPECT_EQ(ErrorOf(Write("cliff.asc", LevelBut(cliff))), "no error");
  std::map<std::pair<int, int>, double> block;
  for (int r = 5; r < 7; ++r) {
    for (int c = 5; c < 7; ++c) block[{c, r}] = 315.0;
  }
  EXPECT_EQ(ErrorOf(Write("block.asc", LevelBut(block))), "no error");
}

TEST_F(HeightmapFile, SpikesOfCoarseCellsAreHigher) {
  const auto error = [&](double cell_m, double height_m) {
    std::string text = LevelBut({{{5, 6}, 300.0 + height_m}});
    text.replace(text.find("0.5"), 3, fmt::format("{}", cell_m));
    return ErrorOf(Write("spike.asc", text));
  };
  for (const auto& [cell_m, limit_m] :
       {std::pair{0.4, 4.0}, {1.0, 10.0}, {2.0, 10.0}, {30.0, 150.0}}) {
    EXPECT_EQ(error(cell_m, limit_m - 1.0), "no error") << cell_m;
    EXPECT_NE(error(cell_m, limit_m + 1.0).find("a spike or a pit"), std::string::npos) << cell_m;
    EXPECT_NE(error(cell_m, -limit_m - 1.0).find("a spike or a pit"), std::string::npos) << cell_m;
  }
}

TEST_F(HeightmapFile, HeightsInOtherUnitsThanCellsAreRefused) {
  const auto slope = [&](double step) {
    std::string text = "ncols 20\nnrows 20\ncellsize 0.5\n";
    for (int i = 0; i < 400; ++i) text += fmt::format("{} ", step * (i % 20));
    return ErrorOf(Write("mm.asc", text));
  };
  EXPECT_EQ(slope(2.4), "no error");
  EXPECT_EQ(slope(2.6),
            "mm.asc: heightmap: most neighbours differ by more than 5 times their distance; are "
            "cells and heights both in metres?");
}

TEST_F(HeightmapFile, SlopesThatAreCutAreCounted) {
  TerrainParams params;
  params.name = "quarry";
  params.heightmap.file = Write("block.asc", LevelBut({{{5, 5}, 301.0}}));
  params.max_slope_rad = 0.785398163397;  // 45 degrees: the cell may stand 0.5 m high
  const Terrain cut = MakeTerrain(params, 1, 0);
  EXPECT_EQ(cut.cut_nodes, 1u);
  ASSERT_EQ(HeightmapRemarks(cut, params).size(), 1u);
  EXPECT_EQ(HeightmapRemarks(cut, params).front(),
            "1 of 400 nodes of the heightmap, steeper than max_slope_rad 0.785398163397, are "
            "lowered to it");
  params.max_slope_rad = 1.5;
  const Terrain whole = MakeTerrain(params, 1, 0);
  EXPECT_EQ(whole.cut_nodes, 0u);
  EXPECT_TRUE(HeightmapRemarks(whole, params).empty());
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
