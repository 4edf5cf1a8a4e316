#pragma once

// Matrices of random cameras, row-major. Uses plain arithmetic only, so results are the same
// everywhere.

#include <cstddef>

#include "cases/case.h"
#include "properties/draw.h"

namespace rastercheck::properties {

cases::Matrix4 translation(float x, float y, float z);

/// A rotation about `axis` (0: x) by the angle 2 atan(t), whose cosine is (1 − t²) / (1 + t²) and
/// whose sine is 2 t / (1 + t²).
cases::Matrix4 rotation(std::size_t axis, float t);

/// A random matrix with elements about 2^exponent, exponent <= 127.
cases::Matrix4 any_matrix(Draw& draw, int exponent);

}  // namespace rastercheck::properties
