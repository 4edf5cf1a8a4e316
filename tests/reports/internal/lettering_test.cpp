#include "reports/internal/lettering.h"

#include <gtest/gtest.h>

#include <string>

namespace rastercheck::reports::lettering_test {
namespace {

constexpr Color kPaper{255, 255, 255};
constexpr Color kInk{0, 0, 0};

/// A text drawn in a small image, as rows of "#" and ".".
std::string drawing_of(std::string_view text, int width, int height) {
  Image image = Image::filled(width, height, kPaper);
  write_text(image, 1, 1, text, kInk);
  std::string drawing;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      drawing += image.at(column, row) == kInk ? '#' : '.';
    }
    drawing += '\n';
  }
  return drawing;
}

// Kills: letters that are mirrored, upside down, or without space between them.
TEST(WriteText, DrawsLettersSideBySide) {
  EXPECT_EQ(drawing_of("P4", 13, 9),
            ".............\n"
            ".####.....#..\n"
            ".#...#...##..\n"
            ".#...#..#.#..\n"
            ".####..#..#..\n"
            ".#.....#####.\n"
            ".#........#..\n"
            ".#........#..\n"
            ".............\n");
}

TEST(WriteText, LeavesThePlaceOfOthersEmptyAndStaysWithin) {
  EXPECT_EQ(drawing_of("?1", 11, 2), "...........\n.........#.\n");
}

TEST(WidthOf, HasNoSpaceAfterTheLast) {
  EXPECT_EQ(width_of(""), 0);
  EXPECT_EQ(width_of("1"), 5);
  EXPECT_EQ(width_of("1/64"), 23);
}

}  // namespace
}  // namespace rastercheck::reports::lettering_test
