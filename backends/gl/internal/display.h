#pragma once

#include <epoxy/egl.h>

#include <string>
#include <vector>

#include "backends/gl/context.h"
#include "cases/error.h"

namespace rastercheck::backends::gl {

/// Where EGL makes contexts without a window.
struct Display {
  EGLDisplay name = EGL_NO_DISPLAY;
  std::string place;  ///< for messages: "the surfaceless platform", "device 0"
};

/// All that there are, the one to be tried first first. Fails where there is no EGL, or neither a
/// surfaceless platform nor devices.
Result<std::vector<Display>> find_displays(Prefer prefer);

/// EGL's error code, as its specification lists them.
tl::unexpected<Error> egl_failure(const std::string& what);

}  // namespace rastercheck::backends::gl
