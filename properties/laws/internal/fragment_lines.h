#pragma once

// Lines of samples of one triangle: along them, values must be affine, or ratios of affine
// functions.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "cases/case.h"
#include "cases/fragments.h"

namespace rastercheck::properties {

enum class LineDirection { row, column, falling_diagonal, rising_diagonal };

std::string_view to_string(LineDirection direction);

/// A fragment on a line, and its pixel coordinate along the line.
struct LinePoint {
  std::size_t fragment = 0;
  int at = 0;
};

/// Chooses one of the four directions by the case's pseudorandom number (choices.h).
LineDirection some_direction(const cases::Case& c);

/// Receives the fragments of one triangle on one line, all at the same sample of their pixels, in
/// ascending order of `at`; at least two.
using LineSink = std::function<void(std::span<const LinePoint>)>;

/// Calls `see` with every line of the direction, for fragments of the case's own triangles.
void for_each_line(const cases::Case& c, const cases::Fragments& drawn, LineDirection direction,
                   const LineSink& see);

}  // namespace rastercheck::properties
