#pragma once

// The promises that drivers of OpenGL and Vulkan are judged by; the user chooses one
// (docs/judge-a-driver.md, What a driver is held to).

#include <array>
#include <string_view>

#include "cases/names.h"

namespace rastercheck::cases {

enum class DriverPromise {
  /// The text of both APIs: single operations accurate to one part in 10^5. Assumes that values are
  /// evaluated relative to a point of the triangle's bounding box.
  spec,
  /// The tolerance of Khronos' conformance tests, which compare colours of 8 bits. Every conformant
  /// driver passed them.
  conformance,
  /// A hypothesis rather than a promise: single operations rounded as IEEE 754 float32.
  ieee,
};

constexpr auto names_of(DriverPromise /*type*/) {
  return std::to_array<std::string_view>({"spec", "conformance", "ieee"});
}
constexpr std::string_view to_string(DriverPromise promise) { return name_of(promise); }

}  // namespace rastercheck::cases
