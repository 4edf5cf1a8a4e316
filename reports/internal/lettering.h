#pragma once

#include <string_view>

#include "reports/image.h"

namespace rastercheck::reports {

/// The size of a character, and its width with the space after it, in pixels.
inline constexpr int kLetterWidth = 5;
inline constexpr int kLetterHeight = 7;
inline constexpr int kLetterAdvance = 6;

/// The width of a text, in pixels.
int width_of(std::string_view text);

/// Writes a text with its upper left corner at (column, row). Known characters are digits, "/",
/// space, and the capitals that the legend of an error map needs. Any other character leaves a gap.
void write_text(Image& image, int column, int row, std::string_view text, Color color);

}  // namespace rastercheck::reports
