// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

namespace scoria::analysis {

/// An OpenGL 3.3 core context without a screen, drawing into memory. One per thread. The only place
/// that knows how such a context is made (OSMesa today).
class GlContext {
 public:
  /// Errors: std::runtime_error if the machine offers no such context.
  GlContext(int width_px, int height_px);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Finished pixels, rows top to bottom, four bytes blue green red alpha each.
  [[nodiscard]] const std::uint8_t* Pixels() const;
  /// Address of an OpenGL function.
  [[nodiscard]] static void* Function(const char* name);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scoria::analysis
