#pragma once

// The size of a case, which shrinking (properties/campaign/shrink.h) reduces.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cases/case.h"
#include "properties/window_position.h"

namespace rastercheck::properties {

/// Compared member by member; the first difference decides. Members are ordered by how much they
/// burden a reader. The simplest case has 0 in all but triangles, vertices and pixels.
struct CaseSize {
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  std::uint64_t state = 0;      ///< state that differs from a case file's defaults
  std::uint64_t camera = 0;     ///< 1 + matrix elements that differ from the identity's
  std::uint64_t other_w = 0;    ///< vertices with w != 1
  std::uint64_t pixels = 0;     ///< of the framebuffer
  std::uint64_t viewport = 0;   ///< |width| + |height| + |x| + |y|, rounded up
  std::uint64_t off_grid = 0;   ///< fractional bits of window positions (window_bits)
  std::uint64_t bits = 0;       ///< of significands, and minus signs
  std::uint64_t exponents = 0;  ///< sum of |exponent|
  auto operator<=>(const CaseSize&) const = default;
};

CaseSize size_of(const cases::Case& c);

/// The number of bits in a significand, from the first set bit to the last: 0 for 0, 1 for a power
/// of two, at most 24.
int significant_bits(float value);

/// The window position of a vertex with w > 0, y by Vulkan's viewport formula; in double, only to
/// measure simplicity.
WindowPoint window_point(const cases::Viewport& viewport, const cases::ClipVertex& vertex);

/// Returns the least k <= kMostWindowBits for which a coordinate is a multiple of 2^-k pixels, or
/// kMostWindowBits + 1 if there is none.
inline constexpr int kMostWindowBits = 8;
int window_bits(double coordinate);

/// All numbers of a case except sizes and viewport: positions, attributes, clip distances, camera.
std::vector<float*> numbers_of(cases::Case& c);

}  // namespace rastercheck::properties
