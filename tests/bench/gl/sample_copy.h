#pragma once

#include <epoxy/gl.h>

#include "tests/bench/gl/target.h"

namespace rastercheck::backends::gl::bench {

/// Reads every sample of a multisampled target's textures. GL's own copies would average the
/// samples of a pixel.
Result<Picture> read_samples(const TargetShape& shape, GLuint color, GLuint depth);

}  // namespace rastercheck::backends::gl::bench
