#pragma once

#include <epoxy/egl.h>

#include <string>
#include <vector>

#include "backends/gl/context.h"
#include "cases/error.h"

namespace rastercheck::backends::gl {

/// An EGL display on which contexts can be made without a window.
struct Display {
  EGLDisplay name = EGL_NO_DISPLAY;
  std::string place;  ///< for messages: "the surfaceless platform", "device 0"
};

/// All displays, in the order to try them. Fails if EGL is missing, or has neither a surfaceless
/// platform nor devices.
Result<std::vector<Display>> find_displays(Prefer prefer);

/// The error for EGL's current error code, which is named as in EGL's specification.
tl::unexpected<Error> egl_failure(const std::string& what);

}  // namespace rastercheck::backends::gl
