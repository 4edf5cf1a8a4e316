#pragma once

#include <epoxy/gl.h>

#include "tests/bench/gl/target.h"

namespace rastercheck::backends::gl::bench {

/// The content of a multisampled target's textures, every sample by itself: GL's own copies average
/// the samples of a pixel.
Result<Picture> read_samples(const TargetShape& shape, GLuint color, GLuint depth);

}  // namespace rastercheck::backends::gl::bench
