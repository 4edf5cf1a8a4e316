#pragma once

// A DrawState in GL's words.

#include "backends/gl/internal/objects.h"
#include "tests/bench/gl/draw.h"

namespace rastercheck::backends::gl::bench {

/// For the context that is current.
void set_depth_state(const DrawState& state);
void set_blend_state(cases::Blend blend);

/// A sampler object that reads a texture that way.
Object make_sampler(const Texturing& texturing);

}  // namespace rastercheck::backends::gl::bench
