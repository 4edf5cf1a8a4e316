#pragma once

#include <string_view>

#include "backends/backend.h"

namespace rastercheck::backends::gl {

/// The driver behind GL_RENDERER and GL_VERSION:
///
///   "llvmpipe (LLVM 15.0.6, 256 bits)", "4.5 (Core Profile) Mesa 22.3.6" → llvmpipe, Mesa 22.3.6
///   "NVIDIA H200/PCIe/SSE2", "4.6.0 NVIDIA 550.54.15"                    → nvidia, NVIDIA
///   550.54.15
///
/// Of Mesa's drivers of AMD's GPUs, which name the GPU, the one that they name in brackets.
Driver driver_of(std::string_view renderer, std::string_view version);

}  // namespace rastercheck::backends::gl
