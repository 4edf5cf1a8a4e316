#pragma once

// The vertices that a driver gets of a primitive. A case repeats the last vertex of a line or point
// (cases::Triangle), a driver gets each vertex once.

#include <cstddef>
#include <cstdint>
#include <span>

#include "cases/case.h"

namespace rastercheck::backends {

/// The number of vertices of one primitive.
constexpr std::size_t vertices_per(cases::Primitive primitive) {
  switch (primitive) {
    case cases::Primitive::triangles:
      return 3;
    case cases::Primitive::lines:
      return 2;
    case cases::Primitive::points:
      break;
  }
  return 1;
}

/// The indices of one primitive's vertices, each once.
inline std::span<const std::uint32_t> vertices_of(cases::Primitive primitive,
                                                  const cases::Triangle& indices) {
  return std::span(indices).first(vertices_per(primitive));
}

}  // namespace rastercheck::backends
