#pragma once

#include <compare>
#include <cstdint>

namespace rastercheck::cases {

/// One sample of one triangle. Compares in the order in which fragments are listed.
struct SamplePlace {
  std::uint32_t triangle = 0;  ///< index into the case's triangles
  std::uint32_t y = 0;         ///< pixels
  std::uint32_t x = 0;         ///< pixels
  std::uint32_t sample = 0;    ///< index into the sample pattern
  auto operator<=>(const SamplePlace&) const = default;
};

}  // namespace rastercheck::cases
