#pragma once

// Code shared by all pictures of a framebuffer.

#include "cases/case.h"

namespace rastercheck::reports {

/// The image row for a row of pixels. Window y points up in OpenGL and down elsewhere, and row 0 of
/// an image is at the top.
constexpr int row_of(int y, int height, cases::Rules rules) {
  return rules == cases::Rules::opengl ? height - 1 - y : y;
}

}  // namespace rastercheck::reports
