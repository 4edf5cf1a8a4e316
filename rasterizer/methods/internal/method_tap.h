#pragma once

// Records how a textbook method draws one sample: the stages that all methods of a kind share
// (point_drawing.h, polygon_drawing.h).

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rasterizer/trace.h"

namespace rastercheck::rasterizer {

class MethodTap {
 public:
  explicit MethodTap(const SamplePlace& address) : address_(address) {}

  const SamplePlace& address() const { return address_; }

  bool is_at(std::uint32_t triangle, int x, int y, std::size_t sample) const {
    return triangle == address_.triangle && x == address_.x && y == address_.y &&
           sample == static_cast<std::size_t>(address_.sample);
  }

  /// Empty until the triangle is set up.
  std::optional<Trace> trace;
  /// Values of the current pixel, kept until it is known which of its samples are drawn.
  std::vector<TracedValue> attributes;

 private:
  SamplePlace address_;
};

}  // namespace rastercheck::rasterizer
