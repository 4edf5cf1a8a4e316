#pragma once

// What a textbook method shows of itself while it draws, as far as all methods of a kind have it in
// common (point_drawing.h, polygon_drawing.h): recorded for one sample.

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

  /// Nothing as long as the triangle is not set up.
  std::optional<Trace> trace;
  /// Of the pixel at hand, until it is known which samples of it are drawn.
  std::vector<TracedValue> attributes;

 private:
  SamplePlace address_;
};

}  // namespace rastercheck::rasterizer
