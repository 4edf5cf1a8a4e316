#pragma once

// How much there is to a case: what shrinking (properties/campaign/shrink.h) makes less of.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cases/case.h"
#include "properties/window_position.h"

namespace rastercheck::properties {

/// Compared member by member, the first that differs decides: what a reader has to hold in mind
/// first comes first. A case without any of it has 0 in all but triangles, vertices and pixels.
struct CaseSize {
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  std::uint64_t state = 0;      ///< whatever is not as a case file has it by default
  std::uint64_t camera = 0;     ///< 1, and its matrices' numbers that are not the identity's
  std::uint64_t other_w = 0;    ///< vertices with w != 1
  std::uint64_t pixels = 0;     ///< of the framebuffer
  std::uint64_t viewport = 0;   ///< |width| + |height| + |x| + |y|, rounded up
  std::uint64_t off_grid = 0;   ///< bits behind the point of window positions (window_bits)
  std::uint64_t bits = 0;       ///< of significands, and minus signs
  std::uint64_t exponents = 0;  ///< sum of |exponent|
  auto operator<=>(const CaseSize&) const = default;
};

CaseSize size_of(const cases::Case& c);

/// The bits of a number's significand, from the first to the last that is set: 0 of 0, 1 of a power
/// of two, at most 24.
int significant_bits(float value);

/// Where a vertex with w > 0 appears, y as the viewport's formula has it for Vulkan; in double, as
/// a measure of simplicity and no more.
WindowPoint window_point(const cases::Viewport& viewport, const cases::ClipVertex& vertex);

/// The least k <= kMostWindowBits for which a coordinate is a multiple of 2^-k pixels, else one
/// more.
inline constexpr int kMostWindowBits = 8;
int window_bits(double coordinate);

/// All numbers of a case that are neither sizes nor its viewport's: positions, attributes, clip
/// distances, the camera's.
std::vector<float*> numbers_of(cases::Case& c);

}  // namespace rastercheck::properties
