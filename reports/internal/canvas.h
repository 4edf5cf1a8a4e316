#pragma once

// What the pictures of a framebuffer have in common.

#include "cases/case.h"

namespace rastercheck::reports {

/// The row that shows a row of pixels: window y points up in OpenGL, down elsewhere; row 0 of an
/// image is on top.
constexpr int row_of(int y, int height, cases::Rules rules) {
  return rules == cases::Rules::opengl ? height - 1 - y : y;
}

}  // namespace rastercheck::reports
