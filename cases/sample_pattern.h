#pragma once

#include <span>

namespace rastercheck::cases {

/// A sample's position in its pixel, in 1/16 pixel from the pixel's corner of smallest window x and
/// y; 0…15.
struct SamplePosition {
  int x = 0;
  int y = 0;
  bool operator==(const SamplePosition&) const = default;
};

/// The standard pattern of a sample count (RULES §4), in index order; empty unless the count is
/// 1, 2, 4, 8 or 16.
std::span<const SamplePosition> standard_pattern(int samples);

}  // namespace rastercheck::cases
