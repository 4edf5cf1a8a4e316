#pragma once

// What laws have in common that turn, mirror or move the window: whether its numbers go along
// without rounding, and what does not go along.

#include <cstdint>
#include <optional>
#include <vector>

#include "cases/case.h"
#include "cases/sample_pattern.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::properties {

/// A side of the viewport: from `begin` to `begin + size`, both exact in double, size > 0; and
/// whether the clip coordinate runs the other way.
struct WindowSide {
  double begin = 0;
  double size = 0;
  double end = 0;
  bool is_turned_round = false;
};

/// Nothing where the size is 0 or the end no double.
std::optional<WindowSide> side_of(float begin, float size);

/// Whether a column (axis x) or row (axis y) of the framebuffer's samples lies at `at`.
bool is_at_samples(oracle::WindowAxis axis, double at, const cases::FramebufferSize& size);

/// [sample]: the sample of the standard pattern in whose place `carry` puts it; nothing where that
/// makes another pattern. Positions are in 1/16 pixel, 0 to 16.
std::optional<std::vector<std::uint8_t>> carried_samples(
    int samples, cases::SamplePosition (*carry)(const cases::SamplePosition&));

/// The sample that is carried to `sample`; `sample` itself where none is.
std::uint8_t carried_back(const std::vector<std::uint8_t>& carried, std::uint8_t sample);

/// Pixels first <= i < last.
struct PixelSpan {
  int first = 0;
  int last = 0;
};

/// The columns, and the rows, of the framebuffer that the scissor leaves.
PixelSpan scissor_columns(const cases::Case& c);
PixelSpan scissor_rows(const cases::Case& c);
/// Of no pixels where a span has none.
cases::Scissor rectangle(const PixelSpan& columns, const PixelSpan& rows);

/// The middle n + 1/2 between two points of the grid goes to the even one: whether that is the same
/// one after a move by so many pixels, or seen from a border so many pixels away. True of other
/// roundings.
bool keeps_even_points(const cases::Snapping& grid, int pixels);

/// Promises that are made around the window's origin, as they are where this is `pixels` away: the
/// guard band is narrower.
cases::Contract with_origin_away(cases::Contract contract, int pixels);

/// Takes centroids to the samples: the first one that is covered is another where patterns turn.
void move_centroids_to_samples(cases::Case& c);

/// Rounds the viewport's corner and size, of less than 2^12 pixels, to multiples of 2^-10 pixel:
/// moved by a framebuffer's size they stay float32.
void shorten_viewport(cases::Case& c);

}  // namespace rastercheck::properties
