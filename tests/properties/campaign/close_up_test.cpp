#include "properties/campaign/close_up.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::close_up_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

records::Violation at(std::uint32_t triangle, std::uint32_t x, std::uint32_t y) {
  records::Violation violation;
  violation.place.triangle = triangle;
  violation.place.x = x;
  violation.place.y = y;
  violation.fragment_class = records::FragmentClass::missing;
  return violation;
}

// Triangle A covers the pixels with x + y < 7; those with x + y = 7 lie on an edge that the method
// may give to either triangle.
TEST(CloseUp, ShowsWhatIsWrongAroundThePixel) {
  DamagedBackend backend(
      [](const cases::Case&, cases::Fragments& d) {
        drop(d, 0, 2, 1);
        add(d, 0, 5, 5);
        value(d, 0, 1, 1, 1) = 3;
      },
      "cpu");
  const std::vector<std::string> lines = close_up(square(), backend, at(0, 2, 1));
  EXPECT_THAT(lines, ElementsAre("y     0    #   #   #   #   #   #   #   . ",  //
                                 "y     1    #   !  [-]  #   #   #   .   . ",  //
                                 "y     2    #   #   #   #   #   .   .   . ",
                                 "y     3    #   #   #   #   .   .   .   . ",
                                 "y     4    #   #   #   .   .   .   .   . ",
                                 "y     5    #   #   .   .   .   +   .   . ",
                                 "y     6    #   .   .   .   .   .   .   . ",
                                 "   x       0   1   2   3   4   5   6   7 ",
                                 "# drawn correctly   . correctly not drawn   - missing   + drawn "
                                 "but must not be   ! drawn with a wrong value"));
}

TEST(CloseUp, ShowsOneTriangleAlone) {
  DamagedBackend backend({}, "cpu");
  const std::vector<std::string> lines = close_up(square(), backend, at(1, 7, 7));
  EXPECT_THAT(lines.front(), HasSubstr("y     2    .   .   .   .   .   #   #   # "));
  EXPECT_THAT(lines.back(), HasSubstr("The picture shows the original drawing"));
}

// Kills: a picture of one drawing, shown without a note although the violation is in the other
// drawing.
TEST(CloseUp, SaysWhereTheViolationIsNotInThePicture) {
  DamagedBackend backend([](const cases::Case&, cases::Fragments& d) { drop(d, 0, 2, 1); }, "cpu");
  const auto last_line = [&backend](records::FragmentClass fragment_class) {
    records::Violation violation = at(0, 2, 1);
    violation.fragment_class = fragment_class;
    return close_up(square(), backend, violation).back();
  };
  using records::FragmentClass;
  EXPECT_THAT(last_line(FragmentClass::missing), testing::StartsWith("# drawn"));
  for (const FragmentClass other : {FragmentClass::extra, FragmentClass::beyond_bound}) {
    EXPECT_THAT(last_line(other), HasSubstr("changed copy")) << to_string(other);
  }
}

// Kills: a case judged by another rounding than it asks for, without a note.
TEST(CloseUp, SaysWhereTheContractIsNotWhatTheCaseAsksFor) {
  cases::Case c = square();
  c.coverage = cases::Snapping{7, cases::Rounding::unspecified, 0};
  DamagedBackend backend([](const cases::Case&, cases::Fragments& d) { drop(d, 0, 2, 1); }, "cpu");
  EXPECT_EQ(close_up(c, backend, at(0, 2, 1)).back(),
            "Judged by the backend's own precision: 7 subpixel bits, rounding nearest_even, values "
            "of the "
            "ideal triangle.");
}

// Kills: a window that begins outside the framebuffer or ends beyond it.
TEST(CloseUp, StaysInTheFramebuffer) {
  cases::Case c = square();
  c.framebuffer = {300, 300, 1};
  c.viewport.width = 300;
  c.viewport.height = 300;
  DamagedBackend backend({}, "cpu");
  const std::vector<std::string> inside = close_up(c, backend, at(0, 120, 130));
  EXPECT_EQ(inside.size(), 11U + 3U);
  EXPECT_THAT(inside[0], testing::StartsWith("y   125   "));
  EXPECT_THAT(inside[5], HasSubstr("[#]"));
  EXPECT_THAT(inside[11], AllOf(HasSubstr(" 113 "), HasSubstr(" 127 ")));
  const std::vector<std::string> corner = close_up(c, backend, at(1, 299, 299));
  EXPECT_EQ(corner.size(), 6U + 3U);
  EXPECT_THAT(corner[6], Not(HasSubstr("300")));
}

TEST(CloseUp, IsNothingWhereNothingIsDrawn) {
  const auto refuses = [] {
    cases::Case c = square();
    c.camera.emplace();
    c.camera->model[0] = 0x1p127F;
    c.camera->view[0] = 4;
    return c;
  }();
  DamagedBackend backend({}, "cpu");
  EXPECT_THAT(close_up(refuses, backend, at(0, 0, 0)), IsEmpty());
  EXPECT_THAT(close_up(square(), backend, at(9, 0, 0)), IsEmpty());
}

}  // namespace
}  // namespace rastercheck::properties::close_up_test
