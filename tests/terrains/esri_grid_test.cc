// SPDX-License-Identifier: BSD-3-Clause
// ESRI ASCII grids as others write them, and what becomes of their cells.
#include <algorithm>

#include <gtest/gtest.h>

#include "core/config/archive.h"
#include "core/files.h"
#include "terrains/heightmap.h"
#include "terrains/resample.h"
#include "tests/support/robots.h"

namespace scoria::terrains {
namespace {

constexpr int kCells = 16;

double HeightAt(int column, int row) { return 0.25 * column - 0.125 * row; }

/// 16 x 16 heights, each followed by a blank, every `per_line` by a line end.
std::string Body(int per_line = kCells, const std::string& line_end = "\n") {
  std::string text;
  int written = 0;
  for (int r = 0; r < kCells; ++r) {
    for (int c = 0; c < kCells; ++c) {
      text += fmt::format("{} ", HeightAt(c, r));
      if (++written % per_line == 0) text += line_end;
    }
  }
  return text;
}

class EsriGrid : public ::testing::Test {
 protected:
  HeightmapParams Write(const std::string& text) {
    HeightmapParams params;
    params.file = folder.path() / "g.asc";
    core::WriteText(params.file, text);
    return params;
  }
  std::string ErrorOf(const HeightmapParams& params, double resolution_m = 0.25) {
    try {
      (void)ReadHeightmap(params, resolution_m);
    } catch (const core::ConfigError& e) {
      const std::string text = e.what(), prefix = folder.path().string() + "/";
      return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
    }
    return "no error";
  }
  test::TemporaryFolder folder;
};

const std::string kHead = "ncols 16\nnrows 16\nxllcorner 496510.25\nyllcorner 4250133.75\n";

TEST_F(EsriGrid, IsReadHoweverItIsWritten) {
  const std::string header = kHead + "cellsize 0.5\n";
  std::string all_in_one = header + Body();
  std::replace(all_in_one.begin(), all_in_one.end(), '\n', ' ');
  std::string commas = header + Body();
  std::replace(commas.begin() + static_cast<std::ptrdiff_t>(header.size()), commas.end(), '.', ',');
  const std::vector<std::pair<const char*, std::string>> forms = {
      {"plain", header + Body()},
      {"wrapped", header + Body(7)},
      {"one value per line", header + Body(1)},
      {"all values in one line", header + Body(100000)},
      {"header and values in one line", all_in_one},
      {"byte order mark", "\xef\xbb\xbf" + header + Body()},
      {"blank lines", "\n\n" + kHead + "\n\ncellsize 0.5\n\n" + Body(16, "\n\n") + "\n\n"},
      {"CRLF", "ncols 16\r\nnrows 16\r\ncellsize 0.5\r\n" + Body(16, "\r\n")},
      {"CR", "ncols 16\rnrows 16\rcellsize 0.5\r" + Body(16, "\r")},
      {"tabs", "ncols\t16\nnrows\t16\ncellsize\t0.5\n" + Body()},
      {"key case", "NCOLS 16\nNRows 16\nCELLSIZE 0.5\nNODATA_VALUE -9999\n" + Body()},
      {"key order", "cellsize 0.5\nnodata_value -9999\nnrows 16\nncols 16\n" + Body()},
      {"comments", "# a survey\nncols 16 ; columns\nnrows 16\n// metres\ncellsize 0.5\n" + Body()},
      {"centre", "ncols 16\nnrows 16\nxllcenter 7\nyllcenter 9\ncellsize 0.5\n" + Body()},
      {"dx and dy", kHead + "dx 0.5\ndy 0.5\n" + Body()},
      {"exponents", kHead + "cellsize 5.0E-01\nNODATA_value -3.4e+38\n" + Body()},
      {"Fortran's exponents", kHead + "cellsize 5.0D-01\n" + Body()},
      {"decimal commas", commas},
      {"signs", kHead + "cellsize +0.5\n" + Body()},
      {"colons", "ncols: 16\nnrows: 16\ncellsize: 0.5\n" + Body()},
      {"no last line end", header + Body(17)},
  };
  for (const auto& [name, text] : forms) {
    SCOPED_TRACE(name);
    ASSERT_EQ(ErrorOf(Write(text)), "no error");
    const Heightmap map = ReadHeightmap(Write(text), 0.25);
    ASSERT_EQ(map.heights.nodes, kCells);
    EXPECT_EQ(map.heights.spacing_m, 0.5);
    EXPECT_FALSE(map.remark.has_value());
    for (int r = 0; r < kCells; ++r) {
      for (int c = 0; c < kCells; ++c) EXPECT_EQ(map.heights.at(c, kCells - 1 - r), HeightAt(c, r));
    }
  }
}

TEST_F(EsriGrid, NameDoesNotMatter) {
  HeightmapParams params = Write(kHead + "cellsize 0.5\n" + Body());
  std::filesystem::rename(params.file, folder.path() / "survey.txt");
  params.file = folder.path() / "survey.txt";
  EXPECT_EQ(ReadHeightmap(params, 0.25).heights.nodes, kCells);
}

// A plane stays a plane away from the border, whatever the cells.
TEST_F(EsriGrid, AnyCellIsResampledToTheResolution) {
  struct Case {
    const char* cells;
    double dx_m, dy_m, resolution_m;
  };
  for (const Case& c : {Case{"cellsize 1", 1.0, 1.0, 0.25}, Case{"cellsize 30", 30.0, 30.0, 0.5},
                        Case{"dx 0.5\ndy 1", 0.5, 1.0, 0.25}, Case{"dx 0.4\ndy 0.5", 0.4, 0.5, 0.1},
                        Case{"cellsize 0.6", 0.6, 0.6, 0.5}}) {
    SCOPED_TRACE(c.cells);
    const HeightmapParams params = Write(kHead + c.cells + "\n" + Body());
    ASSERT_EQ(ErrorOf(params, c.resolution_m), "no error");
    const Heightmap map = ReadHeightmap(params, c.resolution_m);
    EXPECT_EQ(map.heights.spacing_m, c.resolution_m);
    const double edge_m = kCells * std::min(c.dx_m, c.dy_m);
    EXPECT_NEAR(map.heights.edge_m(), edge_m, c.resolution_m);
    ASSERT_TRUE(map.remark.has_value());
    const int n = map.heights.nodes, margin = static_cast<int>(2.0 * c.dy_m / c.resolution_m) + 1;
    const double east = 0.25 * c.resolution_m / c.dx_m, north = 0.125 * c.resolution_m / c.dy_m;
    for (int i = margin; i < n - margin - 1; i += 3) {
      EXPECT_NEAR(map.heights.at(i + 1, n / 2) - map.heights.at(i, n / 2), east, 1e-9);
      EXPECT_NEAR(map.heights.at(n / 2, i + 1) - map.heights.at(n / 2, i), north, 1e-9);
    }
  }
}

TEST_F(EsriGrid, RemarkSaysHowTheTileWasMade) {
  EXPECT_EQ(ReadHeightmap(Write(kHead + "cellsize 1\n" + Body()), 0.25).remark,
            "the tile is resampled to 0.25 m from 16 x 16 cells of 1 x 1 m");
}

TEST(Resample, PassesThroughTheOldCellsAndTheirMean) {
  HeightTable table;
  table.columns = table.rows = 8;
  table.dx_m = table.dy_m = 1.0;
  for (int i = 0; i < 64; ++i) table.heights_m.push_back((i * 37) % 11);
  const TileWindow all{0, 0, 8, 8};
  const Grid same = Resample(table, all, 8, 1.0);
  for (int r = 0; r < 8; ++r) {
    for (int c = 0; c < 8; ++c) EXPECT_NEAR(same.at(c, r), table.at(c, 7 - r), 1e-12);
  }
  // Nodes at the old centres and between: every second one is an old height.
  const Grid finer = Resample(table, all, 15, 0.5);
  EXPECT_NEAR(finer.at(6, 8), table.at(3, 3), 1e-12);
  // Coarser ones take the level of what they cover.
  for (double& z : table.heights_m) z = 5.0;
  const Grid coarser = Resample(table, all, 3, 2.5);
  for (const double z : coarser.values) EXPECT_NEAR(z, 5.0, 1e-12);
}

/// A wide map, 40 x 16 cells of 0.5 m, whose heights are the column in decimetres.
std::string WideMap() {
  std::string text =
      "ncols 40\nnrows 16\nxllcorner 1000\nyllcorner 2000\ncellsize 0.5\n"
      "NODATA_value -9999\n";
  for (int r = 0; r < 16; ++r) {
    for (int c = 0; c < 40; ++c) text += c < 4 ? "-9999 " : fmt::format("{} ", 0.1 * c);
    text += "\n";
  }
  return text;
}

TEST_F(EsriGrid, TileOfAWideMapIsItsMiddleUnlessChosen) {
  HeightmapParams params = Write(WideMap());
  const Heightmap middle = ReadHeightmap(params, 0.25);
  EXPECT_EQ(middle.heights.nodes, 16);
  EXPECT_NEAR(middle.heights.at(0, 0), 1.2, 1e-12);
  EXPECT_EQ(middle.remark,
            "the tile is 16 x 16 cells of 40 x 16, from column 13, row 1 in the north");
  params.centre_m = {1016.0, 2004.0};  // 20 m wide: from 1012 to 1020 m east
  EXPECT_NEAR(ReadHeightmap(params, 0.25).heights.at(0, 0), 2.4, 1e-12);
}

TEST_F(EsriGrid, TileMustLieInsideTheMapAndHoldNoGap) {
  HeightmapParams params = Write(WideMap());
  params.centre_m = {1004.0, 2004.0};
  EXPECT_EQ(ErrorOf(params),
            "g.asc:7:1: heightmap: row 1, value 1 is NODATA; fill the gaps first, or choose a tile "
            "without");
  params.centre_m = {1018.0, 2004.0};
  EXPECT_EQ(ErrorOf(params),
            "g.asc: heightmap: spans 1000 to 1020 east, 2000 to 2008 north; a tile of 8 m about "
            "(1018, 2004) reaches beyond");
  params.centre_m.reset();
  params.tile_m = 9.0;
  EXPECT_EQ(ErrorOf(params), "g.asc: heightmap: is 20 x 8 m; a tile_m of 9 does not fit");
  params.tile_m = 5.0;
  EXPECT_EQ(ErrorOf(params), "g.asc: heightmap: is 5 m wide; a robot needs at least 6 m");
  const HeightmapParams coarse = Write(kHead + "cellsize 1000\n" + Body());
  EXPECT_EQ(ErrorOf(coarse),
            "g.asc: heightmap: has 64000 nodes along an edge; at most 16384: choose a smaller "
            "heightmap.tile_m or a coarser resolution_m");
}

}  // namespace
}  // namespace scoria::terrains
