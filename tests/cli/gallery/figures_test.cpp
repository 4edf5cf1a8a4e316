// Numbers that confirm what the figures are meant to show.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/gallery/internal/drawn.h"
#include "cli/gallery/internal/panel.h"
#include "cli/gallery/internal/scenes.h"
#include "tests/cli/gallery/small_gallery.h"

namespace rastercheck::gallery::figures_test {
namespace {

using reports::GalleryPicture;

/// Attribute 0 at each pixel of a drawing with one sample per pixel.
std::map<std::pair<int, int>, double> values_of(const DrawnScene& drawn) {
  std::map<std::pair<int, int>, double> values;
  for (std::size_t i = 0; i < drawn.fragments.size(); ++i) {
    values[{drawn.fragments.x[i], drawn.fragments.y[i]}] = drawn.fragments.attributes_of(i)[0];
  }
  return values;
}

/// The largest second differences of u along a column: next to the rows of the corners, and
/// elsewhere.
struct Bends {
  double at_corners = 0;
  double elsewhere = 0;
};

Bends bends_in_the_middle(std::string_view method) {
  const Canvas canvas{320, 1};
  const DrawnScene drawn = draw_by(method, leaning_rectangle(canvas)).value();
  const auto values = values_of(drawn);
  const std::vector<double> corners = corner_rows(drawn.scene);
  Bends bends;
  const int column = canvas.size / 2;
  for (int row = 1; row + 1 < canvas.size; ++row) {
    const auto before = values.find({column, row - 1});
    const auto here = values.find({column, row});
    const auto after = values.find({column, row + 1});
    if (before == values.end() || here == values.end() || after == values.end()) continue;
    const double bend = std::abs(before->second - 2 * here->second + after->second);
    const bool is_at_corner = std::any_of(corners.begin(), corners.end(), [row](double corner) {
      return std::abs(corner - (row + 0.5)) < 1;
    });
    double& largest = is_at_corner ? bends.at_corners : bends.elsewhere;
    largest = std::max(largest, bend);
  }
  return bends;
}

// Heckbert & Moreton 1991, figure 2: "discontinuity along horizontal lines passing through the
// vertices": in the row of a corner, the end of the row moves on to another edge, and the slope of
// u jumps. Kills: a quad that is drawn as two triangles.
TEST(CheckerboardInPerspective, KinksInTheRowsOfItsCorners) {
  const Bends linear = bends_in_the_middle(kLinearPolygon);
  EXPECT_GT(linear.at_corners, 5 * linear.elsewhere);
  const Bends rational = bends_in_the_middle("method:rational-linear");
  EXPECT_GT(rational.elsewhere, 0);
  EXPECT_LT(rational.at_corners, 2 * rational.elsewhere);
}

// Kills: a facing square whose vertices differ in w, or whose size has to be rounded.
TEST(AffineAndCorrect, HasNoErrorWhereItFaces) {
  const GalleryPicture facing = picture_of("000-6-1-facing");
  EXPECT_EQ(facing.worst, 0);
  EXPECT_EQ(facing.samples, 128U * 128 * 4);
  EXPECT_GT(picture_of("000-6-1-affine").worst, 8);
}

// Pictures drawn with perspective correction have rounding errors only. Kills: scenes judged
// against another method; an error map that leaves out pixels.
TEST(Gallery, IsWithinOneUlpWherePerspectiveIsMeant) {
  int maps = 0;
  for (const reports::GalleryFigure& figure : small_gallery()) {
    for (const GalleryPicture& picture : figure.pictures) {
      EXPECT_EQ(picture.violations, 0U) << picture.name;
      if (picture.scale != &reports::ulp_scale()) continue;
      EXPECT_LT(picture.worst, 1) << picture.name;
      const bool has_large_pixels = picture.name.starts_with("005-lines");
      EXPECT_GT(picture.samples, has_large_pixels ? 100U : 10000U) << picture.name;
      ++maps;
    }
  }
  EXPECT_GE(maps, 8);
}

/// u at the middle of the rectangle: four pixels of the picture meet there, and u is their mean.
double u_in_the_middle(std::string_view method, double roll) {
  const Canvas canvas{160, 1};
  const DrawnScene drawn =
      draw_by(method, leaning_rectangle(canvas, kWiderFieldOfView, roll)).value();
  const auto values = values_of(drawn);
  const int middle = canvas.size / 2;
  double sum = 0;
  for (const int y : {middle - 1, middle}) {
    for (const int x : {middle - 1, middle}) sum += values.at({x, y});
  }
  return sum / 4;
}

// Kills: a strip whose frames are one picture, turned; a linear quad drawn as two triangles, whose
// picture a roll merely turns.
TEST(CameraRoll, ChangesTheLinearQuadAndNoOther) {
  double least = 1;
  double most = 0;
  for (const double roll : {0.0, 45.0, 90.0, 135.0}) {
    EXPECT_NEAR(u_in_the_middle("method:rational-linear", roll), 0.5, 0.001) << roll;
    const double linear = u_in_the_middle(kLinearPolygon, roll);
    least = std::min(least, linear);
    most = std::max(most, linear);
  }
  EXPECT_GT(most - least, 0.05);
}

/// The worst errors of figure 4's curves, in texels; 0 for a curve without points.
std::vector<double> worst_of_curves() {
  std::vector<double> worst;
  for (const reports::GalleryFigure& figure : small_gallery()) {
    for (const reports::GalleryPlot& plot : figure.plots) {
      if (!plot.plot.y.is_logarithmic) continue;
      for (const reports::Curve& curve : plot.plot.curves) {
        worst.push_back(0);
        for (const reports::PlotPoint& p : curve.points) worst.back() = std::max(worst.back(), p.y);
      }
    }
  }
  return worst;
}

/// The greatest error of a linearly interpolated edge, in texels, if u has a range of 1 (derived in
/// rasterizer/methods/screen_linear.cpp).
double linear_error(double ratio) { return 256 * (std::sqrt(ratio) - 1) / (std::sqrt(ratio) + 1); }

// Heckbert & Moreton 1991, figure 4, with w from 1 to 8. Two polygons meet at u = 1/2 and w = 4
// 1/2. The nearer one has the larger error: that of the ratio 4 1/2, halved, because it spans half
// of u's range. Kills: a piece of another size; a curve that is not drawn.
TEST(UOfX, MissesByWhatTheRatioOfDistancesSays) {
  const std::vector<double> worst = worst_of_curves();
  ASSERT_EQ(worst.size(), 4U);
  EXPECT_NEAR(worst[0], linear_error(8), 0.1);
  EXPECT_NEAR(worst[1], linear_error(4.5) / 2, 0.1);
  for (const std::size_t polynomial : {2U, 3U}) {
    EXPECT_GT(worst[polynomial], 16);
    EXPECT_LT(worst[polynomial], worst[0]);
  }
}

TEST(Cube, IsLessThanAThirdAsWrongInEightTrianglesAFace) {
  EXPECT_LT(picture_of("004-cube-subdivided").worst, picture_of("004-cube-linear").worst / 3);
}

/// How much the colours differ at the joint, in levels: the greatest difference between pixels on
/// the two sides of the picture's middle column.
int gap_at_joint(const GalleryPicture& picture) {
  int gap = 0;
  const int middle = picture.picture.width / 2;
  for (int row = 0; row < picture.picture.height; ++row) {
    const reports::Color left = picture.picture.at(middle - 2, row);
    const reports::Color right = picture.picture.at(middle + 1, row);
    for (std::size_t i = 0; i < 3; ++i) gap = std::max(gap, std::abs(left[i] - right[i]));
  }
  return gap;
}

// MIT 6.837 2000, lecture 18, slide 17. Kills: a T-joint with a vertex on both of its sides.
TEST(Gouraud, PartsAtTheJointUnlessInPerspective) {
  EXPECT_GT(gap_at_joint(picture_of("004-gouraud-linear")), 30);
  EXPECT_LE(gap_at_joint(picture_of("004-gouraud-correct")), 1);
}

}  // namespace
}  // namespace rastercheck::gallery::figures_test
