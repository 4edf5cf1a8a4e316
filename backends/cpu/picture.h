#pragma once

// Pictures by the rasterizer's framebuffers and shaders.

#include "cases/case.h"
#include "cases/error.h"
#include "cases/picture.h"

namespace rastercheck::backends {

Result<cases::Picture> draw_picture(const cases::Case& c, const cases::Pipeline& pipeline,
                                    unsigned threads);

}  // namespace rastercheck::backends
