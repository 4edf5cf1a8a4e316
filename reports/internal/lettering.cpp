#include "reports/internal/lettering.h"

#include <algorithm>
#include <array>

namespace rastercheck::reports {
namespace {

/// One character as seven rows of five pixels.
struct Glyph {
  char character;
  std::array<std::string_view, kLetterHeight> rows;
};

constexpr std::array kGlyphs{
    Glyph{'0', {" ### ", "#   #", "#  ##", "# # #", "##  #", "#   #", " ### "}},
    Glyph{'1', {"  #  ", " ##  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "}},
    Glyph{'2', {" ### ", "#   #", "    #", "  ## ", " #   ", "#    ", "#####"}},
    Glyph{'3', {" ### ", "#   #", "    #", "  ## ", "    #", "#   #", " ### "}},
    Glyph{'4', {"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "}},
    Glyph{'5', {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "}},
    Glyph{'6', {"  ## ", " #   ", "#    ", "#### ", "#   #", "#   #", " ### "}},
    Glyph{'7', {"#####", "    #", "   # ", "   # ", "  #  ", "  #  ", "  #  "}},
    Glyph{'8', {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "}},
    Glyph{'9', {" ### ", "#   #", "#   #", " ####", "    #", "   # ", " ##  "}},
    Glyph{'/', {"    #", "    #", "   # ", "  #  ", " #   ", "#    ", "#    "}},
    Glyph{'A', {" ### ", "#   #", "#   #", "#####", "#   #", "#   #", "#   #"}},
    Glyph{'C', {" ### ", "#   #", "#    ", "#    ", "#    ", "#   #", " ### "}},
    Glyph{'D', {"#### ", "#   #", "#   #", "#   #", "#   #", "#   #", "#### "}},
    Glyph{'E', {"#####", "#    ", "#    ", "#### ", "#    ", "#    ", "#####"}},
    Glyph{'I', {" ### ", "  #  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "}},
    Glyph{'L', {"#    ", "#    ", "#    ", "#    ", "#    ", "#    ", "#####"}},
    Glyph{'N', {"#   #", "##  #", "# # #", "#  ##", "#   #", "#   #", "#   #"}},
    Glyph{'O', {" ### ", "#   #", "#   #", "#   #", "#   #", "#   #", " ### "}},
    Glyph{'P', {"#### ", "#   #", "#   #", "#### ", "#    ", "#    ", "#    "}},
    Glyph{'R', {"#### ", "#   #", "#   #", "#### ", "# #  ", "#  # ", "#   #"}},
    Glyph{'S', {" ####", "#    ", "#    ", " ### ", "    #", "    #", "#### "}},
    Glyph{'T', {"#####", "  #  ", "  #  ", "  #  ", "  #  ", "  #  ", "  #  "}},
    Glyph{'U', {"#   #", "#   #", "#   #", "#   #", "#   #", "#   #", " ### "}},
    Glyph{'V', {"#   #", "#   #", "#   #", "#   #", "#   #", " # # ", "  #  "}},
};

}  // namespace

int width_of(std::string_view text) {
  constexpr int kSpace = kLetterAdvance - kLetterWidth;
  return text.empty() ? 0 : static_cast<int>(text.size()) * kLetterAdvance - kSpace;
}

void write_text(Image& image, int column, int row, std::string_view text, Color color) {
  for (const char character : text) {
    const auto* glyph = std::find_if(kGlyphs.begin(), kGlyphs.end(), [character](const Glyph& g) {
      return g.character == character;
    });
    for (int y = 0; glyph != kGlyphs.end() && y < kLetterHeight; ++y) {
      for (int x = 0; x < kLetterWidth; ++x) {
        if (glyph->rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#') {
          image.set(column + x, row + y, color);
        }
      }
    }
    column += kLetterAdvance;
  }
}

}  // namespace rastercheck::reports
