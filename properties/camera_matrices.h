#pragma once

// Matrices of random cameras, row-major, by arithmetic alone: the same everywhere.

#include <cstddef>

#include "cases/case.h"
#include "properties/draw.h"

namespace rastercheck::properties {

cases::Matrix4 translation(float x, float y, float z);

/// A turn about the axis `axis` (0: x) by the angle whose half has tangent t: (1 − t²) / (1 + t²)
/// and 2 t / (1 + t²) in place of cosine and sine.
cases::Matrix4 rotation(std::size_t axis, float t);

/// Any matrix, its numbers about 2^exponent, exponent <= 127.
cases::Matrix4 any_matrix(Draw& draw, int exponent);

}  // namespace rastercheck::properties
