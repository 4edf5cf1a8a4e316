#pragma once

// Vertices whose coordinates add up exactly: what is decided by the last bit of a float, or by far
// less. If three clip positions sum to the homogeneous position of a sample, then the sample's
// weights in their triangle are 1 : 1 : 1, without any rounding; if two of them do, it lies on
// their edge. All arithmetic is +, −, ×, / of doubles that hold the results.

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

/// What appears at `p`, a multiple of 1/16 pixel, in the case's viewport: exact where the numbers
/// of that are multiples of 2^-12 and below 2^14. w is in [1, 2).
Ray ray_through(const cases::Case& c, const WindowPoint& p);

/// Two floats whose exact sum is `total`: of the same size, one of them tiny, or both much larger
/// than it and opposite. Nothing where the choices lead to none.
std::optional<std::array<float, 2>> split_in_two(Draw& draw, double total);

/// The same of three floats.
std::optional<std::array<float, 3>> split_in_three(Draw& draw, double total);
/// The total and two numbers that are opposite, 2^-24 to 2^-56 of its size: no double holds the sum
/// of one of these and a number as large as the total. Nothing where the total is no float.
std::optional<std::array<float, 3>> split_off_opposites(Draw& draw, double total);

/// The smallest number that is not 0 moved by one float, as often up as down: of the `numbers` it
/// is the one whose floats are closest.
void nudge_smallest(Draw& draw, std::span<float* const> numbers);

}  // namespace rastercheck::properties
