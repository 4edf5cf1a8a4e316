#pragma once

// Vertices whose coordinates add up exactly, so that the last bit of a float, or a far smaller
// number, decides the coverage. If three clip positions sum to the homogeneous position of a
// sample, the sample's weights in their triangle are exactly 1 : 1 : 1; if two clip positions do,
// the sample lies on the edge between them. All arithmetic is +, −, ×, / of doubles that hold the
// results exactly.

#include <array>
#include <optional>
#include <span>

#include "cases/case.h"
#include "properties/window_position.h"

namespace rastercheck::properties {

/// x, y and w of a clip position, w > 0, as doubles.
struct Ray {
  double x = 0;
  double y = 0;
  double w = 0;
};

/// The ray of `p`, a multiple of 1/16 pixel, in the case's viewport, with w in [1, 2). Exact if the
/// viewport's numbers are multiples of 2^-12 and below 2^14.
Ray ray_through(const cases::Case& c, const WindowPoint& p);

/// Returns two floats whose exact sum is `total`. They are of similar size, or one is tiny, or they
/// have opposite signs and are much larger than `total`. Returns nothing if the random choices give
/// no exact sum.
std::optional<std::array<float, 2>> split_in_two(Draw& draw, double total);

/// Like split_in_two(), but returns three floats.
std::optional<std::array<float, 3>> split_in_three(Draw& draw, double total);
/// Returns `total` and two opposite numbers of about 2^-56 to 2^-24 times its size. No double holds
/// the sum of such a number and one as large as `total`. Returns nothing if `total` is not a float.
std::optional<std::array<float, 3>> split_off_opposites(Draw& draw, double total);

/// Moves the nonzero number with the smallest magnitude by one float, up or down with equal chance.
/// Its float spacing is the smallest of all `numbers`.
void nudge_smallest(Draw& draw, std::span<float* const> numbers);

}  // namespace rastercheck::properties
