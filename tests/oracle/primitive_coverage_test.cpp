// Verdicts of lines and points: by hand (RULES §9, §10), and against second implementations on
// random ones. Pictures show window rows from v = 0 on, one character per sample.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "oracle/internal/number.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/drawing.h"

namespace rastercheck::oracle::primitive_coverage_test {
namespace {

using cases::ClipVertex;
using cases::LineMode;
using cases::Primitive;
using cases::Rules;
using records::Reason;
using records::Verdict;

constexpr int kSize = 8;

/// A clip position at window (u, v) of an 8 × 8 viewport whose window y follows NDC y.
ClipVertex at_window(float u, float v, float w = 1, float z = 0) {
  return {(u / 4 - 1) * w, (v / 4 - 1) * w, z, w};
}

cases::Case empty_case(Rules rules) {
  cases::Case c;
  c.rules = rules;
  c.fill_rule = cases::default_fill_rule(rules);
  c.basis = cases::default_basis(rules);
  c.framebuffer = {kSize, kSize, 1};
  c.viewport.width = kSize;
  c.viewport.height = kSize;
  return c;
}

cases::Case line(const ClipVertex& a, const ClipVertex& b, LineMode mode = LineMode::rectangular,
                 float width = 1, Rules rules = Rules::vulkan) {
  cases::Case c = empty_case(rules);
  c.primitive = Primitive::lines;
  c.positions = {a, b};
  c.triangles = {{0, 1, 1}};
  c.line_mode = mode;
  c.line_width = width;
  return c;
}

cases::Case point(const ClipVertex& at, float size, Rules rules = Rules::vulkan) {
  cases::Case c = empty_case(rules);
  c.primitive = Primitive::points;
  c.positions = {at};
  c.triangles = {{0, 0, 0}};
  c.point_size = size;
  return c;
}

records::SampleVerdict verdict(const cases::Case& c, int x, int y) {
  const SceneTruth scene(c, cases::contract_of(c));
  return TriangleTruth(scene, 0).judge(x, y, 0);
}

/// "#" required, "?" permitted, "." forbidden; rows joined by '/', rows without any left out at the
/// end.
std::string picture(const cases::Case& c, const cases::Contract& contract) {
  const SceneTruth scene(c, contract);
  const TriangleTruth truth(scene, 0);
  std::string text;
  for (int y = 0; y < c.framebuffer.height; ++y) {
    if (y > 0) text += '/';
    for (int x = 0; x < c.framebuffer.width; ++x) {
      const Verdict one = truth.judge(x, y, 0).verdict;
      text += one == Verdict::required ? '#' : one == Verdict::permitted ? '?' : '.';
    }
  }
  while (text.ends_with("/........")) text.resize(text.size() - 9);
  return text;
}
std::string picture(const cases::Case& c) { return picture(c, cases::contract_of(c)); }

// --- Points --------------------------------------------------------------------------------------

TEST(PointCoverage, IsASquareAroundTheVertex) {
  EXPECT_EQ(picture(point(at_window(2.5F, 1.5F), 1)), "......../..#.....");
  EXPECT_EQ(picture(point(at_window(2, 1), 2)), ".##...../.##.....");
  EXPECT_EQ(picture(point(at_window(2.5F, 1.5F), 2.5F)), ".###..../.###..../.###....");
  EXPECT_EQ(picture(point(at_window(2, 1), 0.75F)), "........");
}

// Kills: both sides of a square closed, or both open; another rule's sides.
TEST(PointCoverage, OwnsItsBordersByTheFillRule) {
  // Samples at 1.5 and 2.5, 0.5 and 1.5 lie exactly on the four borders.
  EXPECT_EQ(picture(point(at_window(2, 1), 1, Rules::vulkan)), ".#......");
  EXPECT_EQ(picture(point(at_window(2, 1), 1, Rules::opengl)), ".#......");  // y is up there
  EXPECT_EQ(verdict(point(at_window(2, 1), 1), 1, 0).reason, Reason::tie);
  cases::Case lower = point(at_window(2, 1), 1, Rules::vulkan);
  lower.fill_rule = cases::TieRule::bottom_left;
  EXPECT_EQ(picture(lower), "......../.#......");
}

// Kills: a point cut off at the viewport; one whose vertex is outside drawn all the same.
TEST(PointCoverage, ReachesBeyondTheViewportIfItsVertexIsInside) {
  cases::Case c = point(at_window(0, 0), 4);
  c.framebuffer = {6, 6, 1};
  c.viewport.x = c.viewport.y = 2;
  EXPECT_EQ(picture(c), "####../####../####../####../....../......");
  c.positions[0].x = -1 - 0x1p-20F;
  EXPECT_EQ(picture(c), "....../....../....../....../....../......");
  EXPECT_EQ(verdict(c, 1, 1).reason, Reason::clipped);
  c.scissor = {0, 0, 1, 6};
  c.positions[0].x = -1;
  EXPECT_EQ(picture(c), "#...../#...../#...../#...../....../......");
}

// A point of size 4 at w = -1, from a public report: it must not be drawn.
TEST(PointCoverage, IsNothingBehindTheEyeOrBeyondAPlane) {
  EXPECT_EQ(picture(point({0, 0, 0, -1}, 4)), "........");
  EXPECT_EQ(picture(point({0, 0, 0, 0}, 4)), "........");
  cases::Case c = point(at_window(4, 4, 1, 1), 2);
  const std::string drawn = "......../......../......../...##.../...##...";
  EXPECT_EQ(picture(c), drawn);  // on the far plane
  c.positions[0].z = 1 + 0x1p-20F;
  EXPECT_EQ(picture(c), "........");
  c.depth_clamp = true;
  EXPECT_EQ(picture(c), drawn);
  c.depth_clamp = false;
  c.positions[0].z = 0.5F;
  c.clip_distance_count = 1;
  c.clip_distances = {0};
  EXPECT_EQ(picture(c), drawn);
  c.clip_distances = {-0x1p-140F};
  EXPECT_EQ(picture(c), "........");
}

TEST(PointCoverage, FollowsTheSnappedVertex) {
  cases::Case c = point(at_window(2.25F, 1.25F), 1);
  EXPECT_EQ(picture(c), "......../..#.....");
  c.coverage = cases::Snapping{0, cases::Rounding::nearest_even};  // the vertex at (2, 1)
  EXPECT_EQ(picture(c), ".#......");
  c.coverage->rounding = cases::Rounding::unspecified;  // or at (3, 1), (2, 2), (3, 2)
  EXPECT_EQ(picture(c), ".??...../.??.....");
  c.point_size = 3;  // rows 0 and 1 of columns 1 and 2 in all four
  EXPECT_EQ(picture(c), "?##?..../?##?..../????....");
}

// --- Rectangles and parallelograms ---------------------------------------------------------------

TEST(LineCoverage, OfARectangleIsWhatIsNearerThanHalfItsWidth) {
  EXPECT_EQ(picture(line(at_window(1, 2.5F), at_window(5, 2.5F))), "......../......../.####...");
  EXPECT_EQ(picture(line(at_window(1, 2.5F), at_window(5, 2.5F), LineMode::rectangular, 3)),
            "......../.####.../.####.../.####...");
  EXPECT_EQ(picture(line(at_window(0, 0), at_window(4, 4))), "#......./.#....../..#...../...#....");
  // The neighbours of the diagonal are 0.707 pixels away.
  EXPECT_EQ(picture(line(at_window(0, 0), at_window(4, 4), LineMode::rectangular, 1.40625F)),
            "#......./.#....../..#...../...#....");
  EXPECT_EQ(picture(line(at_window(0, 0), at_window(4, 4), LineMode::rectangular, 1.421875F)),
            "##....../###...../.###..../..##....");
}

// Kills: width along the wrong axis; ends at right angles.
TEST(LineCoverage, OfAParallelogramHasEndsAlongTheMinorAxis) {
  const auto wide = [](float u, float v, float width) {
    return picture(line(at_window(0, 0), at_window(u, v), LineMode::parallelogram, width));
  };
  EXPECT_EQ(wide(4, 4, 1.5F), "#......./.#....../..#...../...#....");
  EXPECT_EQ(wide(4, 4, 2.5F), "##....../###...../.###..../..##..../...#....");
  // v = u/2, at u = 0.5, 1.5, …: 0.25, 0.75, 1.25, 1.75.
  EXPECT_EQ(wide(4, 2, 1), "##....../..##....");
  EXPECT_EQ(wide(2, 4, 1), "#......./#......./.#....../.#......");
}

// Kills: long sides that own their samples whichever side they are on.
TEST(LineCoverage, OwnsSamplesOnItsSidesByTheFillRule) {
  // Long sides at v = 1.5 and 2.5, ends at u = 1.5 and 4.5.
  const cases::Case c = line(at_window(1.5F, 2), at_window(4.5F, 2));
  EXPECT_EQ(picture(c), "......../.###....");
  cases::Case turned = c;
  turned.triangles = {{1, 0, 0}};
  EXPECT_EQ(picture(turned), picture(c));
  turned.line_mode = LineMode::parallelogram;
  EXPECT_EQ(picture(turned), picture(c));
  turned.fill_rule = cases::TieRule::bottom_left;
  EXPECT_EQ(picture(turned), "......../......../.###....");
  EXPECT_EQ(verdict(c, 1, 1).reason, Reason::tie);
}

TEST(LineCoverage, IsOfTheVisiblePart) {
  // Beyond the far plane from u = 4 on, halfway in window space as in clip space.
  const cases::Case far = line(at_window(1, 2.5F, 1, 0.5F), at_window(7, 2.5F, 1, 1.5F));
  EXPECT_EQ(picture(far), "......../......../.###....");
  EXPECT_EQ(verdict(far, 4, 2).reason, Reason::clipped);
  // Behind the eye from the middle on: the window line goes from (1, 2.5) to infinity on the right,
  // and the viewport ends it.
  EXPECT_EQ(picture(line(at_window(1, 2.5F, 1, 0.5F), at_window(-5, 2.5F, -1, -0.5F))),
            "......../......../.#######");
  EXPECT_EQ(picture(line(at_window(1, 2.5F, -1), at_window(5, 2.5F, -1))), "........");
}

// Kills: a wide line cut off at the viewport's sides; its middle not clipped there.
TEST(LineCoverage, ReachesBeyondTheViewportBesideItsMiddle) {
  cases::Case c = line({-2, 0.75F, 0, 1}, {0, 0.75F, 0, 1}, LineMode::rectangular, 3);
  c.viewport = {2, 2, 4, 4, 0, 1};  // the middle at v = 5.5, from u = 0; visible from u = 2 on
  EXPECT_EQ(picture(c), "......../......../......../......../..##..../..##..../..##....");
}

/// The verdict under a contract that snaps to a grid of 2^-bits pixels.
records::SampleVerdict snapped_verdict(const cases::Case& c, int bits, cases::Rounding rounding,
                                       int x, int y) {
  cases::Contract contract = cases::contract_of(c);
  contract.coverage = cases::Snapping{bits, rounding};
  const SceneTruth scene(c, contract);
  return TriangleTruth(scene, 0).judge(x, y, 0);
}

// What clipping makes of lines whose vertices are moved is not known.
TEST(LineCoverage, OfALineThatIsSnappedAndCutIsNotPromised) {
  constexpr auto kNearest = cases::Rounding::nearest_even;
  for (const cases::Case& c : {line(at_window(1, 2.5F, 1, 0.5F), at_window(7, 2.5F, 1, 1.5F)),
                               line(at_window(1, 2.5F), at_window(9, 2.5F)),
                               line(at_window(1, 2.5F, 1, 0.5F), at_window(-5, 2.5F, -1, -0.5F))}) {
    EXPECT_EQ(snapped_verdict(c, 8, kNearest, 2, 2).reason, Reason::not_promised);
  }
  cases::Case thin = line(at_window(1, 2.25F), at_window(7, 2.25F), LineMode::bresenham);
  EXPECT_EQ(snapped_verdict(thin, 8, kNearest, 2, 2).verdict, Verdict::required);
  thin.positions[0].x += 0x1p-12F;
  EXPECT_EQ(snapped_verdict(thin, 8, cases::Rounding::unspecified, 2, 2).reason,
            Reason::not_promised);
}

// A vertex on the near plane that snapping moves along the line: nothing is clipped.
TEST(LineCoverage, OfASnappedLineOnAPlaneIsWhole) {
  const cases::Case c =
      line(at_window(1, 2.5F, 1, 0.5F), at_window(4.40625F, 2.5F, 1, 0), LineMode::rectangular);
  EXPECT_EQ(snapped_verdict(c, 0, cases::Rounding::ceil, 4, 2).verdict, Verdict::required);
  EXPECT_EQ(verdict(c, 4, 2).verdict, Verdict::forbidden);
}

// Kills: distances along the minor axis compared with moves in any direction. By hand: moved to
// (17/16, 1) and (101 + 1/16, 91), the line leaves the sample.
TEST(LineCoverage, OfALongParallelogramIsOpenNearItsSides) {
  cases::Case c = empty_case(Rules::vulkan);
  c.primitive = Primitive::lines;
  c.framebuffer = {128, 128, 1};
  c.viewport.width = c.viewport.height = 128;
  c.line_mode = LineMode::parallelogram;
  const auto at = [](float u, float v) { return ClipVertex{u / 64 - 1, v / 64 - 1, 0, 1}; };
  c.positions = {at(1 + 0x1p-8F, 1 + 15 * 0x1p-8F), at(101 + 0x1p-8F, 91 + 15 * 0x1p-8F)};
  c.triangles = {{0, 1, 1}};
  EXPECT_EQ(verdict(c, 5, 5).verdict, Verdict::required);
  EXPECT_EQ(snapped_verdict(c, 4, cases::Rounding::unspecified, 5, 5).verdict, Verdict::permitted);
  c.positions = {at(17 * 0x1p-4F, 1), at(101 + 0x1p-4F, 91)};
  EXPECT_EQ(verdict(c, 5, 5).verdict, Verdict::forbidden);
}

TEST(LineCoverage, IsNothingOfALineWithoutLength) {
  for (const LineMode mode :
       {LineMode::rectangular, LineMode::parallelogram, LineMode::bresenham}) {
    EXPECT_EQ(picture(line(at_window(2.5F, 2.5F), at_window(2.5F, 2.5F, 2), mode, 4)), "........");
  }
}

// --- Bresenham's lines ---------------------------------------------------------------------------

std::string bresenham(float u0, float v0, float u1, float v1, float width = 1,
                      Rules rules = Rules::opengl) {
  return picture(line(at_window(u0, v0), at_window(u1, v1), LineMode::bresenham, width, rules));
}

// From a public report, with nearby numbers that binary fractions have: a start at (0.99, 0.5)
// draws pixel 0, at (0.99, 0.49) it does not; (0.5, 0.2) does, (0.7, 0.2) does not; an end at
// (4.99, 0.5) leaves pixel 4 out, at (4.99, 0.35) it is drawn.
TEST(BresenhamsLine, SelectsTheDiamondsThatItLeaves) {
  EXPECT_EQ(bresenham(0.984375F, 0.5F, 4.5F, 0.5F), "####....");
  EXPECT_EQ(bresenham(0.984375F, 0.46875F, 4.5F, 0.46875F), ".###....");
  EXPECT_EQ(bresenham(0.5F, 0.1875F, 4.5F, 0.1875F), "####....");
  EXPECT_EQ(bresenham(0.703125F, 0.1875F, 4.5F, 0.1875F), ".###....");
  EXPECT_EQ(bresenham(0.5F, 0.5F, 4.984375F, 0.5F), "####....");
  EXPECT_EQ(bresenham(0.5F, 0.5F, 4.984375F, 0.34375F), "#####...");
}

// Kills: the last pixel drawn; a strip's shared ends drawn twice or not at all.
TEST(BresenhamsLine, LeavesItsEndToTheNextOne) {
  EXPECT_EQ(bresenham(0.5F, 0.5F, 3.5F, 0.5F), "###.....");
  EXPECT_EQ(bresenham(3.5F, 0.5F, 6.5F, 0.5F), "...###..");
  EXPECT_EQ(bresenham(3.5F, 0.5F, 0.5F, 0.5F), ".###....");
  EXPECT_EQ(bresenham(0.5F, 0.5F, 3.5F, 3.5F), "#......./.#....../..#.....");
  EXPECT_EQ(bresenham(0.5F, 0.5F, 0.5F, 2.5F), "#......./#.......");
}

// A line through corners that four pixels share touches two diamonds' corners there and no open
// diamond. It is moved by −(ε, ε²): to the left, and by less downwards.
TEST(BresenhamsLine, IsMovedByAnInfinitelySmallStepWhereItTouchesCornersOnly) {
  // Along v = 1: the corners of the diamonds of rows 0 and 1. Moved down (to less v) by ε².
  EXPECT_EQ(bresenham(0, 1, 4, 1), "####....");
  EXPECT_EQ(bresenham(4, 1, 0, 1), "####....");
  // Along u = 1: moved to the left by ε.
  EXPECT_EQ(bresenham(1, 0, 1, 3), "#......./#......./#.......");
  // Under D3D, y is down, and lower edges and the bottom corner belong to a diamond: along v = 1,
  // the bottom corners of row 0.
  EXPECT_EQ(bresenham(0, 1, 4, 1, 1, Rules::d3d),
            "......../......../......../......../......../......../####....");
}

TEST(BresenhamsLine, IsReplicatedAlongTheMinorAxis) {
  EXPECT_EQ(bresenham(0.5F, 2.5F, 3.5F, 2.5F, 3), "......../###...../###...../###.....");
  EXPECT_EQ(bresenham(0.5F, 2.5F, 3.5F, 2.5F, 2.4375F), "......../###...../###.....");
  EXPECT_EQ(bresenham(2.5F, 0.5F, 2.5F, 2.5F, 3), ".###..../.###....");
  EXPECT_EQ(bresenham(0.5F, 2.5F, 3.5F, 2.5F, 0.25F), "......../......../###.....");
}

// Kills: a division by the difference of equal distances from a plane.
TEST(BresenhamsLine, IsNothingBeyondAPlane) {
  EXPECT_EQ(picture(line(at_window(1, 2.5F, 1, 2), at_window(5, 2.5F, 1, 2), LineMode::bresenham)),
            "........");
}

// Whether a pixel beside a new end is selected depends on how clipping is done.
TEST(BresenhamsLine, IsOpenNearWhereItIsCut) {
  const cases::Case far =
      line(at_window(0.5F, 0.5F, 1, 0.5F), at_window(7.5F, 0.5F, 1, 1.375F), LineMode::bresenham);
  EXPECT_EQ(picture(far), "##?????.");  // cut at u = 4.5
  EXPECT_EQ(verdict(far, 4, 0).reason, Reason::clip_edge);
}

TEST(BresenhamsLine, CoversAllSamplesOfAPixel) {
  cases::Case c =
      line(at_window(0.5F, 0.5F), at_window(3.5F, 0.5F), LineMode::bresenham, 1, Rules::opengl);
  c.framebuffer.samples = 4;
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  for (int s = 0; s < 4; ++s) {
    EXPECT_EQ(truth.judge(2, 0, s).verdict, Verdict::required) << s;
    EXPECT_EQ(truth.judge(3, 0, s).verdict, Verdict::forbidden) << s;
  }
}

// --- Second implementations ----------------------------------------------------------------------

/// A position in sixteenths of a pixel.
using Grid = std::array<int, 2>;

ClipVertex at_grid(const Grid& p) {
  return at_window(static_cast<float>(p[0]) / 16, static_cast<float>(p[1]) / 16);
}

/// Random lines, many of them through corners of diamonds, along axes and diagonals.
struct RandomLine {
  Grid a{};
  Grid b{};

  explicit RandomLine(Dice& dice) {
    const int step = dice.pick({1, 4, 8});
    for (Grid* end : {&a, &b}) {
      for (int& coordinate : *end) coordinate = dice.between(0, kSize * 16 / step) * step;
    }
    if (dice.one_in(4)) b[1] = a[1];
    if (dice.one_in(4)) b[0] = a[0];
    if (dice.one_in(4)) b[1] = std::clamp(a[1] + b[0] - a[0], 0, kSize * 16);
  }
};

/// Whether a sample is in the open rectangle, or in the closed one, in integers.
std::optional<bool> is_in_rectangle(const RandomLine& l, int width, int x, int y) {
  const std::int64_t dx = l.b[0] - l.a[0];
  const std::int64_t dy = l.b[1] - l.a[1];
  const std::int64_t u = 16 * x + 8 - l.a[0];
  const std::int64_t v = 16 * y + 8 - l.a[1];
  const std::int64_t square = dx * dx + dy * dy;
  const std::int64_t along = u * dx + v * dy;
  const std::int64_t across = dx * v - dy * u;
  const std::int64_t limit = width * width * square;
  if (along < 0 || along > square || 4 * across * across > limit) return false;
  if (along > 0 && along < square && 4 * across * across < limit) return true;
  return std::nullopt;
}

TEST(LineCoverage, OfRandomRectanglesIsThatOfIntegerArithmetic) {
  Dice dice(1);
  int ties = 0;
  for (int i = 0; i < 300; ++i) {
    const RandomLine l(dice);
    const int width = dice.between(1, 64);
    cases::Case c =
        line(at_grid(l.a), at_grid(l.b), LineMode::rectangular, static_cast<float>(width) / 16);
    const SceneTruth scene(c, cases::contract_of(c));
    const TriangleTruth truth(scene, 0);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const std::optional<bool> expected = l.a == l.b ? false : is_in_rectangle(l, width, x, y);
        const records::SampleVerdict actual = truth.judge(x, y, 0);
        if (!expected) {
          ++ties;
          continue;
        }
        ASSERT_EQ(actual.verdict == Verdict::required, *expected) << cases::Case(c).name << i;
        ASSERT_NE(actual.verdict, Verdict::permitted);
      }
    }
  }
  EXPECT_GT(ties, 100);
}

/// The least |x − x_c| + |y − y_c| along a line moved by (−ε, −ε²): it is convex and changes its
/// slope only where the line is level with the centre.
bool is_met(const std::array<Field, 2>& a, const std::array<Field, 2>& b,
            const std::array<Field, 2>& center) {
  std::vector<Field> times{Field(0), Field(1)};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (a[axis] == b[axis]) continue;
    const Field t = (center[axis] - a[axis]) / (b[axis] - a[axis]);
    if (t > 0 && t < 1) times.push_back(t);
  }
  return std::any_of(times.begin(), times.end(), [&](const Field& t) {
    Field distance(0);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      distance += magnitude(Field(a[axis] + t * (b[axis] - a[axis]) - center[axis]));
    }
    return distance < Field(1, 2);
  });
}

TEST(BresenhamsLine, OfRandomEndsIsThatOfAReallyMovedOne) {
  Dice dice(2);
  // Small enough: numbers of the lines are sixteenths, so that two different ones, and what is made
  // of them here, are farther apart.
  const Field epsilon = power_of_two(-60);
  for (int i = 0; i < 300; ++i) {
    const RandomLine l(dice);
    cases::Case c = line(at_grid(l.a), at_grid(l.b), LineMode::bresenham, 1, Rules::opengl);
    const SceneTruth scene(c, cases::contract_of(c));
    const TriangleTruth truth(scene, 0);
    const auto moved = [&epsilon](const Grid& p) {
      return std::array{Field(Field(p[0], 16) - epsilon),
                        Field(Field(p[1], 16) - epsilon * epsilon)};
    };
    const auto a = moved(l.a);
    const auto b = moved(l.b);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const std::array center{Field(2 * x + 1, 2), Field(2 * y + 1, 2)};
        const bool expected = l.a != l.b && is_met(a, b, center) && !is_met(b, b, center);
        ASSERT_EQ(truth.judge(x, y, 0).verdict == Verdict::required, expected)
            << "(" << l.a[0] << ", " << l.a[1] << ") to (" << l.b[0] << ", " << l.b[1]
            << ") in 1/16, pixel " << x << " " << y;
      }
    }
  }
}

/// D3D's diamond, by its parts: y is down.
bool is_in_d3d_diamond(const Field& dx, const Field& dy, bool is_y_major) {
  const Field half(1, 2);
  const Field distance = magnitude(dx) + magnitude(dy);
  const bool is_on_lower_edge = distance == half && dy > 0;
  const bool is_right_corner = dx == half && dy == 0;
  return distance < half || is_on_lower_edge || (is_y_major && is_right_corner);
}

// Along a line the diamond can begin or end only at the line's ends, where it is level with the
// centre, and where it crosses one of the four edges' lines: the test looks there and between.
TEST(BresenhamsLine, OfRandomEndsUnderD3DIsThatOfDiamondsMadeOfParts) {
  Dice dice(5);
  int on_border = 0;
  for (int i = 0; i < 300; ++i) {
    const RandomLine l(dice);
    cases::Case c = line(at_grid(l.a), at_grid(l.b), LineMode::bresenham, 1, Rules::d3d);
    const SceneTruth scene(c, cases::contract_of(c));
    const TriangleTruth truth(scene, 0);
    const std::array a{Field(l.a[0], 16), Field(kSize * 16 - l.a[1], 16)};
    const std::array b{Field(l.b[0], 16), Field(kSize * 16 - l.b[1], 16)};
    const Field dx = b[0] - a[0];
    const Field dy = b[1] - a[1];
    const bool is_y_major = magnitude(dy) > magnitude(dx);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const Field u = a[0] - Field(2 * x + 1, 2);
        const Field v = a[1] - Field(2 * y + 1, 2);
        std::vector<Field> times{Field(0), Field(1)};
        const auto add_zero_of = [&times](const Field& begin, const Field& change) {
          if (change == 0) return;
          const Field t = -begin / change;
          if (t > 0 && t < 1) times.push_back(t);
        };
        add_zero_of(u, dx);
        add_zero_of(v, dy);
        for (const int sign : {-1, 1}) {
          add_zero_of(u + v + Field(sign, 2), dx + dy);
          add_zero_of(u - v + Field(sign, 2), dx - dy);
        }
        std::sort(times.begin(), times.end());
        bool is_met = false;
        for (std::size_t k = 0; k < times.size(); ++k) {
          const Field between = k == 0 ? times[0] : Field((times[k - 1] + times[k]) / Field(2));
          for (const Field& t : {times[k], between}) {
            is_met = is_met || is_in_d3d_diamond(u + t * dx, v + t * dy, is_y_major);
          }
          on_border += magnitude(Field(u + times[k] * dx)) + magnitude(Field(v + times[k] * dy)) ==
                       Field(1, 2);
        }
        const bool expected =
            l.a != l.b && is_met && !is_in_d3d_diamond(u + dx, v + dy, is_y_major);
        ASSERT_EQ(truth.judge(x, y, 0).verdict == Verdict::required, expected)
            << "(" << l.a[0] << ", " << l.a[1] << ") to (" << l.b[0] << ", " << l.b[1]
            << ") in 1/16, pixel " << x << " " << y;
      }
    }
  }
  EXPECT_GT(on_border, 1000);
}

// Kills: a bound of the moves that is too small, of either kind; one placement forgotten.
TEST(LineCoverage, OfOpenPlacementsHoldsThatOfEachPlacement) {
  Dice dice(3);
  int open = 0;
  int certain = 0;
  for (int i = 0; i < 120; ++i) {
    const RandomLine l(dice);
    const LineMode mode = dice.one_in(2) ? LineMode::rectangular : LineMode::parallelogram;
    cases::Case c = line(at_grid(l.a), at_grid(l.b), mode, dice.pick({0.5F, 1.0F, 2.5F, 5.0F}));
    cases::Contract contract = cases::contract_of(c);
    contract.coverage = cases::Snapping{2, cases::Rounding::unspecified};
    const SceneTruth scene(c, contract);
    const TriangleTruth truth(scene, 0);
    for (int k = 0; k < 16; ++k) {
      cases::Case placed = c;
      for (std::size_t end = 0; end < 2; ++end) {
        Grid there = end == 0 ? l.a : l.b;
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const int down = there[axis] / 4 * 4;
          const bool is_up = ((k >> (2 * end + axis)) & 1) != 0 && down != there[axis];
          there[axis] = is_up ? down + 4 : down;
        }
        placed.positions[end] = at_grid(there);
      }
      const SceneTruth placed_scene(placed, cases::contract_of(placed));
      const TriangleTruth placed_truth(placed_scene, 0);
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
          const Verdict one = truth.judge(x, y, 0).verdict;
          ++(one == Verdict::permitted ? open : certain);
          if (one == Verdict::permitted) continue;
          ASSERT_EQ(one, placed_truth.judge(x, y, 0).verdict) << i << " " << k;
        }
      }
    }
  }
  EXPECT_GT(open, 1000);
  EXPECT_GT(certain, open);
}

}  // namespace
}  // namespace rastercheck::oracle::primitive_coverage_test
