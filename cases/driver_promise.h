#pragma once

// What drivers of OpenGL and Vulkan are held to, of which the user chooses one (RULES §7).

#include <array>
#include <string_view>

#include "cases/names.h"

namespace rastercheck::cases {

enum class DriverPromise {
  /// The text of both APIs: single operations accurate to one part in 10^5. Assumes
  /// that values are evaluated about a point of the triangle's bounding box.
  spec,
  /// The tolerance of Khronos' conformance tests, which every driver met that passed them: colours
  /// of 8 bits.
  conformance,
  /// No promise but a hypothesis: single operations rounded as IEEE 754 float32 has it.
  ieee,
};

constexpr auto names_of(DriverPromise /*type*/) {
  return std::to_array<std::string_view>({"spec", "conformance", "ieee"});
}
constexpr std::string_view to_string(DriverPromise promise) { return name_of(promise); }

}  // namespace rastercheck::cases
