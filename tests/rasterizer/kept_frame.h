#pragma once

// What a draw into a framebuffer is to leave there: of each sample what its fragments, in order,
// leave.

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// What the fragments of a draw leave, one by one.
Picture kept(const State& state, const Mesh& mesh, Picture framebuffer);

/// The same bits, signs of zeros and NaN included.
void expect_equal(const Picture& a, const Picture& b);

/// Draws on one to three threads, as attributes and as what a shader makes of them, the same; all
/// give what the fragments leave.
void expect_kept(const State& state, const Mesh& mesh, const TargetSize& size,
                 ColorFormat format = ColorFormat::float32);

}  // namespace rastercheck::rasterizer
