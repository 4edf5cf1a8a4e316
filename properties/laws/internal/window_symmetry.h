#pragma once

// For laws that turn, mirror or move the window without rounding: checks whether a case's numbers
// and samples allow this, and adjusts cases that do not.

#include <cstdint>
#include <optional>
#include <vector>

#include "cases/case.h"
#include "cases/sample_pattern.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::properties {

/// The viewport's extent along one axis, from `begin` to `end` = `begin + size`, both exact in
/// double, size > 0; and whether the clip coordinate runs in the opposite direction.
struct WindowSide {
  double begin = 0;
  double size = 0;
  double end = 0;
  bool is_turned_round = false;
};

/// Returns nothing if the size is 0 or the end is not a double.
std::optional<WindowSide> side_of(float begin, float size);

/// True if the framebuffer has samples in a column (axis x) or row (axis y) at exactly `at`.
bool is_at_samples(oracle::WindowAxis axis, double at, const cases::FramebufferSize& size);

/// Returns, for each sample of the standard pattern, the sample at the position to which `carry`
/// moves it; nothing if `carry` changes the pattern. Positions are in 1/16 pixel, 0 to 16.
std::optional<std::vector<std::uint8_t>> carried_samples(
    int samples, cases::SamplePosition (*carry)(const cases::SamplePosition&));

/// The sample that is carried to `sample`; `sample` itself if none is.
std::uint8_t carried_back(const std::vector<std::uint8_t>& carried, std::uint8_t sample);

/// Pixels first <= i < last.
struct PixelSpan {
  int first = 0;
  int last = 0;
};

/// The columns, and the rows, of the framebuffer inside the scissor.
PixelSpan scissor_columns(const cases::Case& c);
PixelSpan scissor_rows(const cases::Case& c);
/// The scissor rectangle of two spans; without pixels if either span is empty.
cases::Scissor rectangle(const PixelSpan& columns, const PixelSpan& rows);

/// True if a move by `pixels` does not change how positions midway between two grid points are
/// rounded. Rounding to even requires an even number of grid units for this; it then also gives the
/// same grid point if positions are counted from a border that is `pixels` away. Other roundings
/// require nothing.
bool keeps_even_points(const cases::Snapping& grid, int pixels);

/// True if the grid rounds a position and its mirror image alike, along both axes.
bool is_symmetric(const cases::Snapping& grid);

/// True if whole pixels may be added to positions without changing how the grid rounds them, but
/// for what keeps_even_points() says.
bool is_the_same_everywhere(const cases::Snapping& grid);

/// The contract for a window whose origin is `pixels` away: its guard band is narrower.
cases::Contract with_origin_away(cases::Contract contract, int pixels);

/// Replaces centroid locations by sample locations, since turning the pattern changes which covered
/// sample is the first.
void move_centroids_to_samples(cases::Case& c);

/// Rounds the viewport's corner and size, below 2^12 pixels, to multiples of 2^-10 pixel, so that
/// they stay float32 when moved by a framebuffer's size.
void shorten_viewport(cases::Case& c);

}  // namespace rastercheck::properties
