#pragma once

// Draws pictures with the rasterizer's framebuffers and shaders.

#include "cases/case.h"
#include "cases/error.h"
#include "cases/picture.h"

namespace rastercheck::backends {

Result<cases::Picture> draw_picture(const cases::Case& c, const cases::Pipeline& pipeline,
                                    unsigned threads);

/// Draws into an existing picture of the case's size, with the pipeline's channels and format.
Result<void> draw_over(const cases::Case& c, const cases::Pipeline& pipeline, unsigned threads,
                       cases::Picture& picture);

}  // namespace rastercheck::backends
