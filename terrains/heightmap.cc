// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/heightmap.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include <png.h>

namespace scoria::terrains {
namespace {

constexpr int kFewestNodes = 16;

[[noreturn]] void Fail(const HeightmapParams& params, int line, const std::string& rule) {
  throw core::ConfigError({params.file.string(), line, line > 0 ? 1 : 0}, "heightmap", rule);
}

void CheckSquare(const HeightmapParams& params, long columns, long rows) {
  if (columns != rows) {
    Fail(params, 0, fmt::format("is {} x {} cells; a heightmap must be square", columns, rows));
  }
  if (columns < kFewestNodes) {
    Fail(params, 0, fmt::format("has {} cells along an edge; at least {}", columns, kFewestNodes));
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
    CheckSquare(params_, columns, rows);
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

/// Source: ESRI ASCII raster format; the header's keys in any case and order, rows from the north.
Grid ReadAscii(const HeightmapParams& params) {
  std::ifstream in(params.file);
  if (!in) Fail(params, 0, "cannot read the file");
  std::map<std::string, double> header;
  std::string text;
  int line = 0;
  std::streampos data = in.tellg();
  while (std::getline(in, text)) {
    std::istringstream words(text);
    std::string key;
    double value = 0.0;
    words >> key;
    if (key.empty() || !std::isalpha(static_cast<unsigned char>(key[0]))) break;
    ++line;
    if (!(words >> value)) Fail(params, line, fmt::format("{} needs a number", key));
    header[Lower(key)] = value;
    data = in.tellg();
  }
  for (const char* key : {"ncols", "nrows", "cellsize"}) {
    if (!header.contains(key)) Fail(params, line + 1, fmt::format("the header lacks {}", key));
  }
  if (!(header["cellsize"] > 0.0)) Fail(params, line, "cellsize must be positive");
  CheckSquare(params, std::lround(header["ncols"]), std::lround(header["nrows"]));
  const int n = static_cast<int>(std::lround(header["ncols"]));
  in.clear();
  in.seekg(data);
  Grid heights(n, header["cellsize"]);
  for (int row = n - 1; row >= 0; --row) {
    ++line;
    if (!std::getline(in, text))
      Fail(params, line, fmt::format("ends after {} of {} rows", n - 1 - row, n));
    std::istringstream words(text);
    for (int column = 0; column < n; ++column) {
      std::string word;
      if (!(words >> word)) Fail(params, line, fmt::format("has {} of {} values", column, n));
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (*end != '\0' || !std::isfinite(value)) {
        Fail(params, line,
             fmt::format("value {} is {}; every height must be a number", column + 1, word));
      }
      if (header.contains("nodata_value") && value == header["nodata_value"]) {
        Fail(params, line, fmt::format("value {} is NODATA; fill the gaps first", column + 1));
      }
      heights.at(column, row) = value;
    }
  }
  return heights;
}

}  // namespace

Grid ReadHeightmap(const HeightmapParams& params, double png_spacing_m) {
  const std::string extension = Lower(params.file.extension().string());
  if (extension == ".png") return PngReader(params).Read(png_spacing_m);
  if (extension == ".asc") return ReadAscii(params);
  Fail(params, 0, fmt::format("ends in \"{}\"; choices: .asc, .png", extension));
}

}  // namespace scoria::terrains
