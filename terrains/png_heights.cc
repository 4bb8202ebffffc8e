// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include <png.h>

#include "terrains/height_table.h"

namespace scoria::terrains {
namespace {

/// libpng reports errors by a callback that must not return.
[[noreturn]] void OnPngError(png_structp png, png_const_charp message) {
  FailHeightmap(*static_cast<const HeightmapParams*>(png_get_error_ptr(png)), 0,
                fmt::format("cannot be decoded: {}", message));
}

/// A PNG being read, freed whatever happens.
class PngReader {
 public:
  explicit PngReader(const HeightmapParams& params)
      : params_(params), file_(std::fopen(params.file.c_str(), "rb"), &std::fclose) {
    if (!file_) FailHeightmap(params, 0, "cannot read the file");
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, const_cast<HeightmapParams*>(&params_),
                                  OnPngError, [](png_structp, png_const_charp) {});
    info_ = png_create_info_struct(png_);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  HeightTable Read(double spacing_m) {
    png_init_io(png_, file_.get());
    png_read_info(png_, info_);
    const long columns = png_get_image_width(png_, info_), rows = png_get_image_height(png_, info_);
    const int depth = png_get_bit_depth(png_, info_), colour = png_get_color_type(png_, info_);
    if (depth != 16 || colour != PNG_COLOR_TYPE_GRAY) {
      FailHeightmap(params_, 0,
                    fmt::format("has {} bits{}; a heightmap needs 16-bit grey", depth,
                                colour == PNG_COLOR_TYPE_GRAY ? "" : " and colours"));
    }
    CheckTableSize(params_, columns, rows);
    HeightTable table;
    table.columns = static_cast<int>(columns);
    table.rows = static_cast<int>(rows);
    table.dx_m = table.dy_m = spacing_m;
    const std::size_t line_bytes = 2 * static_cast<std::size_t>(columns);
    std::vector<png_byte> bytes(line_bytes * static_cast<std::size_t>(rows));
    std::vector<png_bytep> lines(static_cast<std::size_t>(rows));
    for (std::size_t row = 0; row < lines.size(); ++row) lines[row] = &bytes[line_bytes * row];
    png_read_image(png_, lines.data());
    table.heights_m.reserve(bytes.size() / 2);
    for (std::size_t i = 0; i < bytes.size(); i += 2) {
      const double share = (bytes[i] * 256 + bytes[i + 1]) / 65535.0;
      table.heights_m.push_back(params_.black_m + share * (params_.white_m - params_.black_m));
    }
    return table;
  }

 private:
  const HeightmapParams& params_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

HeightTable ReadPng(const HeightmapParams& params, double spacing_m) {
  return PngReader(params).Read(spacing_m);
}

}  // namespace scoria::terrains
