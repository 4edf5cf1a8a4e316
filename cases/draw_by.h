#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace rastercheck::cases {

/// How a driver's fragments are drawn and read back.
enum class DrawBy : std::uint8_t {
  append,  ///< the fragment shader appends all triangles' fragments to a buffer
  layers,  ///< each triangle is drawn into its own layer, with colours and depth
  frame,   ///< all triangles are drawn into one target, with a depth test, as users draw
};

constexpr auto names_of(DrawBy /*type*/) {
  return std::to_array<std::string_view>({"append", "layers", "frame"});
}

}  // namespace rastercheck::cases
