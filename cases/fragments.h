#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cases/sample_place.h"

namespace rastercheck::cases {

/// A backend's raw drawing: its fragments as a structure of arrays, ordered by triangle, y, x,
/// sample. Each triangle is drawn as if alone; with the case's depth test `less`, only the nearest
/// fragment of each sample is kept.
struct Fragments {
  std::size_t attribute_count = 0;
  std::vector<std::uint32_t> triangle;  ///< index into the case's triangles
  std::vector<std::uint16_t> x;         ///< pixels
  std::vector<std::uint16_t> y;         ///< pixels
  std::vector<std::uint8_t> sample;     ///< index into the sample pattern
  std::vector<float> depth;
  std::vector<float> attributes;  ///< [fragment][attribute]
  /// [fragment][attribute][2]: ∂r/∂u and ∂r/∂v at the attribute's location, per pixel of window x
  /// and y (RULES §4); empty if the backend does not give derivatives.
  std::vector<float> derivatives;

  std::size_t size() const { return triangle.size(); }
  SamplePlace place_of(std::size_t fragment) const {
    return {triangle[fragment], y[fragment], x[fragment], sample[fragment]};
  }
  std::span<const float> attributes_of(std::size_t fragment) const {
    return std::span(attributes).subspan(fragment * attribute_count, attribute_count);
  }
  /// [attribute][2]; call only if `derivatives` is not empty.
  std::span<const float> derivatives_of(std::size_t fragment) const {
    return std::span(derivatives).subspan(fragment * attribute_count * 2, attribute_count * 2);
  }
};

}  // namespace rastercheck::cases
