// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/heightmap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include <png.h>

namespace scoria::terrains {
namespace {

constexpr int kFewestNodes = 16, kMostNodes = 16384;
constexpr double kFinest_m = 0.005, kCoarsest_m = 0.5, kSmallestEdge_m = 6.0;

[[noreturn]] void Fail(const HeightmapParams& params, int line, const std::string& rule) {
  throw core::ConfigError({params.file.string(), line, line > 0 ? 1 : 0}, "heightmap", rule);
}

void CheckSquare(const HeightmapParams& params, long columns, long rows, double spacing_m) {
  if (columns != rows) {
    Fail(params, 0, fmt::format("is {} x {} cells; a heightmap must be square", columns, rows));
  }
  if (columns < kFewestNodes) {
    Fail(params, 0, fmt::format("has {} cells along an edge; at least {}", columns, kFewestNodes));
  }
  if (columns > kMostNodes) {
    Fail(params, 0, fmt::format("has {} cells along an edge; at most {}", columns, kMostNodes));
  }
  if (static_cast<double>(columns) * spacing_m < kSmallestEdge_m) {
    Fail(params, 0,
         fmt::format("is {} m wide; a robot needs at least {} m",
                     static_cast<double>(columns) * spacing_m, kSmallestEdge_m));
  }
}

/// libpng reports errors by a callback that must not return.
[[noreturn]] void OnPngError(png_structp png, png_const_charp message) {
  Fail(*static_cast<const HeightmapParams*>(png_get_error_ptr(png)), 0,
       fmt::format("cannot be decoded: {}", message));
}

/// A PNG being read, freed whatever happens.
class PngReader {
 public:
  explicit PngReader(const HeightmapParams& params)
      : params_(params), file_(std::fopen(params.file.c_str(), "rb"), &std::fclose) {
    if (!file_) Fail(params, 0, "cannot read the file");
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, const_cast<HeightmapParams*>(&params_),
                                  OnPngError, [](png_structp, png_const_charp) {});
    info_ = png_create_info_struct(png_);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  Grid Read(double spacing_m) {
    png_init_io(png_, file_.get());
    png_read_info(png_, info_);
    const long columns = png_get_image_width(png_, info_), rows = png_get_image_height(png_, info_);
    const int depth = png_get_bit_depth(png_, info_), colour = png_get_color_type(png_, info_);
    if (depth != 16 || colour != PNG_COLOR_TYPE_GRAY) {
      Fail(params_, 0,
           fmt::format("has {} bits{}; a heightmap needs 16-bit grey", depth,
                       colour == PNG_COLOR_TYPE_GRAY ? "" : " and colours"));
    }
    CheckSquare(params_, columns, rows, spacing_m);
    const auto n = static_cast<std::size_t>(columns);
    std::vector<png_byte> bytes(n * n * 2);
    std::vector<png_bytep> lines(n);
    for (std::size_t row = 0; row < n; ++row) lines[row] = bytes.data() + 2 * n * row;
    png_read_image(png_, lines.data());
    Grid heights(static_cast<int>(n), spacing_m);
    for (std::size_t row = 0; row < n; ++row) {
      for (std::size_t column = 0; column < n; ++column) {
        const png_byte* value = lines[n - 1 - row] + 2 * column;  // the first line is the north
        const double share = (value[0] * 256 + value[1]) / 65535.0;
        heights.values[row * n + column] =
            params_.black_m + share * (params_.white_m - params_.black_m);
      }
    }
    return heights;
  }

 private:
  const HeightmapParams& params_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

std::string Lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// An ESRI ASCII grid, line by line. Source: ESRI ASCII raster format; the header's keys in any
/// case and order, rows from the north.
class AsciiReader {
 public:
  explicit AsciiReader(const HeightmapParams& params) : params_(params), in_(params.file) {
    if (!in_) Fail(params, 0, "cannot read the file");
  }

  Grid Read() {
    ReadHeader();
    const double spacing_m = Header("cellsize");
    if (!(spacing_m >= kFinest_m && spacing_m <= kCoarsest_m)) {
      Fail(params_, line_,
           fmt::format("cellsize {} is outside [{}, {}] m (is the grid in degrees?)", spacing_m,
                       kFinest_m, kCoarsest_m));
    }
    CheckSquare(params_, std::lround(Header("ncols")), std::lround(Header("nrows")), spacing_m);
    const int n = static_cast<int>(std::lround(Header("ncols")));
    Grid heights(n, spacing_m);
    for (int row = n - 1; row >= 0; --row) {
      if (!more_) Fail(params_, line_, fmt::format("ends after {} of {} rows", n - 1 - row, n));
      ReadRow(heights, row);
      Next();
    }
    for (; more_; Next()) {
      if (text_.find_first_not_of(" \t\r") != std::string::npos)
        Fail(params_, line_, fmt::format("has more than {} rows", n));
    }
    return heights;
  }

 private:
  void Next() {
    more_ = static_cast<bool>(std::getline(in_, text_));
    ++line_;
  }

  void ReadHeader() {
    static constexpr std::array<std::string_view, 8> kKeys = {
        "ncols",     "nrows",     "xllcorner", "yllcorner",
        "xllcenter", "yllcenter", "cellsize",  "nodata_value"};
    for (Next(); more_; Next()) {
      std::istringstream words(text_);
      std::string key, value;
      words >> key >> value;
      key = Lower(key);
      if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) return;
      char* end = nullptr;
      header_[key] = std::strtod(value.c_str(), &end);
      if (value.empty() || *end != '\0')
        Fail(params_, line_, fmt::format("{} needs a number", key));
    }
  }

  double Header(const char* key) const {
    if (!header_.contains(key)) Fail(params_, line_, fmt::format("the header lacks {}", key));
    return header_.at(key);
  }

  void ReadRow(Grid& heights, int row) {
    std::istringstream words(text_);
    std::string word;
    for (int column = 0; column < heights.nodes; ++column) {
      if (!(words >> word))
        Fail(params_, line_, fmt::format("has {} of {} values", column, heights.nodes));
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (header_.contains("nodata_value") && value == header_["nodata_value"])
        Fail(params_, line_, fmt::format("value {} is NODATA; fill the gaps first", column + 1));
      if (*end != '\0' || !std::isfinite(value)) {
        Fail(params_, line_,
             fmt::format("value {} is {}; every height must be a number", column + 1, word));
      }
      heights.at(column, row) = value;
    }
    if (words >> word) Fail(params_, line_, fmt::format("has more than {} values", heights.nodes));
  }

  const HeightmapParams& params_;
  std::ifstream in_;
  std::map<std::string, double> header_;
  std::string text_;
  int line_ = 0;
  bool more_ = true;
};

}  // namespace

Grid ReadHeightmap(const HeightmapParams& params, double png_spacing_m) {
  const std::string extension = Lower(params.file.extension().string());
  if (extension == ".png") return PngReader(params).Read(png_spacing_m);
  if (extension == ".asc") return AsciiReader(params).Read();
  Fail(params, 0, fmt::format("ends in \"{}\"; choices: .asc, .png", extension));
}

}  // namespace scoria::terrains
