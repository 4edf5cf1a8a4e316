#pragma once

#include <string_view>

#include "backends/backend.h"

namespace rastercheck::backends::gl {

/// Derives the driver from GL_RENDERER and GL_VERSION:
///
///   "llvmpipe (LLVM 15.0.6, 256 bits)", "4.5 (Core Profile) Mesa 22.3.6" → llvmpipe, Mesa 22.3.6
///   "NVIDIA H200/PCIe/SSE2", "4.6.0 NVIDIA 550.54.15"                    → nvidia, 550.54.15
///
/// For Mesa's drivers of AMD GPUs, the renderer string starts with the GPU's name, so the driver's
/// name is taken from the brackets.
Driver driver_of(std::string_view renderer, std::string_view version);

}  // namespace rastercheck::backends::gl
