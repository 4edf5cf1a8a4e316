#pragma once

// Draws pictures with the rasterizer's framebuffers and shaders.

#include "cases/case.h"
#include "cases/error.h"
#include "cases/picture.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::backends {

/// How a picture is drawn; it is the same for any number of threads.
struct PictureOptions {
  rasterizer::Conservative conservative = rasterizer::Conservative::off;
  unsigned threads = 1;
};

Result<cases::Picture> draw_picture(const cases::Case& c, const cases::Pipeline& pipeline,
                                    const PictureOptions& options);

/// Draws into an existing picture of the case's size, with the pipeline's channels and format.
Result<void> draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                       const PictureOptions& options, cases::Picture& picture);

}  // namespace rastercheck::backends
