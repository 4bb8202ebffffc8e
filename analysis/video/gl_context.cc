// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/video/gl_context.h"

#include <cstdlib>
#include <stdexcept>
#include <vector>

#include <GL/osmesa.h>

namespace scoria::analysis {

struct GlContext::Impl {
  OSMesaContext context = nullptr;
  std::vector<std::uint8_t> pixels;
};

GlContext::GlContext(int width_px, int height_px) : impl_(std::make_unique<Impl>()) {
  // One software rasteriser thread: several renderers run side by side better than one with many.
  setenv("LP_NUM_THREADS", "0", 0);
  setenv("GALLIUM_DRIVER", "llvmpipe", 0);
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_BGRA,
                            OSMESA_DEPTH_BITS,
                            24,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  impl_->context = OSMesaCreateContextAttribs(attributes, nullptr);
  impl_->pixels.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) *
                       4);
  if (impl_->context == nullptr ||
      OSMesaMakeCurrent(impl_->context, impl_->pixels.data(), GL_UNSIGNED_BYTE, width_px,
                        height_px) == GL_FALSE) {
    throw std::runtime_error("video: cannot create an OpenGL 3.3 context with OSMesa");
  }
  OSMesaPixelStore(OSMESA_Y_UP, 0);
}

GlContext::~GlContext() { OSMesaDestroyContext(impl_->context); }

const std::uint8_t* GlContext::Pixels() const { return impl_->pixels.data(); }

void* GlContext::Function(const char* name) {
  return reinterpret_cast<void*>(OSMesaGetProcAddress(name));
}

}  // namespace scoria::analysis
