#pragma once

// Translates a DrawState into GL state.

#include "backends/gl/internal/objects.h"
#include "tests/bench/gl/draw.h"

namespace rastercheck::backends::gl::bench {

/// Set the state in the current context.
void set_depth_state(const DrawState& state);
void set_blend_state(cases::Blend blend);

/// A sampler object that reads a texture in this way.
Object make_sampler(const Texturing& texturing);

}  // namespace rastercheck::backends::gl::bench
