#pragma once

// The framebuffer that a draw must leave: each sample holds what its fragments leave there in
// order.

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// The framebuffer after a draw, computed from its fragments one by one.
Picture kept(const State& state, const Mesh& mesh, Picture framebuffer);

/// Expects the same bits, including signs of zeros and NaNs.
void expect_equal(const Picture& a, const Picture& b);

/// Draws on one to three threads, and once with a shader that outputs the attributes. Expects each
/// draw to leave what the fragments leave.
void expect_kept(const State& state, const Mesh& mesh, const TargetSize& size,
                 ColorFormat format = ColorFormat::float32);

}  // namespace rastercheck::rasterizer
