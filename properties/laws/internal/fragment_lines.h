#pragma once

// Lines of samples of one triangle: what is affine on the screen, or the ratio of what is, shows
// along them.

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

/// A fragment on a line, and how many pixels along it.
struct LinePoint {
  std::size_t fragment = 0;
  int at = 0;
};

/// One of the four, by the case's numbers.
LineDirection some_direction(const cases::Case& c);

/// Takes the fragments of one triangle on one line, of one sample of their pixels, in ascending
/// order of `at`; two or more.
using LineSink = std::function<void(std::span<const LinePoint>)>;

/// Hands over all lines of a direction, of the case's own fragments.
void for_each_line(const cases::Case& c, const cases::Fragments& drawn, LineDirection direction,
                   const LineSink& see);

}  // namespace rastercheck::properties
