#include "cases/internal/camera_frame.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace rastercheck::cases::camera_frame_test {
namespace {

using Vector4 = std::array<double, 4>;

constexpr std::array kAllRules{Rules::opengl, Rules::vulkan, Rules::d3d};
constexpr std::array kAspectRatios{0.25, 0.5, 1.0, 4.0 / 3, 2.0, 4.0};

Vector4 times(const Matrix4& m, const Vector4& v) {
  Vector4 product{};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      product[row] += double{m[4 * row + column]} * v[column];
    }
  }
  return product;
}

/// The clip position of an object position, computed in double.
Vector4 clip_position(const Camera& camera, const std::array<double, 3>& p) {
  return times(camera.projection, times(camera.view, times(camera.model, {p[0], p[1], p[2], 1})));
}

/// How far a position is inside the clip volume (RULES §4), relative to w; negative if outside.
double inset(const Vector4& clip, Rules rules) {
  const double w = clip[3];
  if (!(w > 0)) return -std::numeric_limits<double>::infinity();
  const double nearest = rules == Rules::opengl ? -w : 0;
  return std::min({w - std::abs(clip[0]), w - std::abs(clip[1]), clip[2] - nearest, w - clip[2]}) /
         w;
}

std::array<double, 3> corner(const Bounds& bounds, std::size_t which) {
  std::array<double, 3> p{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    p[axis] = (which >> axis & 1U) != 0 ? bounds.hi[axis] : bounds.lo[axis];
  }
  return p;
}

/// The smallest inset of the corners of a box.
double inset_of(const Bounds& bounds, Rules rules, double aspect_ratio) {
  const Camera camera = frame(bounds, rules, aspect_ratio);
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 8; ++i) {
    smallest = std::min(smallest, inset(clip_position(camera, corner(bounds, i)), rules));
  }
  return smallest;
}

/// Window y of a clip position, in [0, 1] and pointing up as displayed (RULES §4).
double height_as_displayed(const Vector4& clip, Rules rules) {
  const double ndc = clip[1] / clip[3];
  // OpenGL: NDC and window y both point up. Vulkan: both point down. D3D: NDC y points up and
  // window y down, so the displayed y is up again.
  return rules == Rules::vulkan ? (1 - ndc) / 2 : (1 + ndc) / 2;
}

void expect_framed(const Bounds& bounds) {
  for (const Rules rules : kAllRules) {
    for (const double aspect_ratio : kAspectRatios) {
      EXPECT_GT(inset_of(bounds, rules, aspect_ratio), 0)
          << "rules " << static_cast<int>(rules) << ", aspect ratio " << aspect_ratio;
    }
  }
}

TEST(CameraFrame, TheCornersOfABoxLieInsideTheClipVolume) {
  expect_framed({{-1, -1, -1}, {1, 1, 1}});
  expect_framed({{0, 0, 0}, {3, 2, 1}});
  expect_framed({{-10, 5, 100}, {-9, 50, 101}});
}

TEST(CameraFrame, FlatAndLongBoxesToo) {
  expect_framed({{0, 0, 0}, {1, 1, 0}});
  expect_framed({{0, 0, 0}, {0, 1, 1}});
  expect_framed({{0, 0, 0}, {100, 0, 0}});
  expect_framed({{0, -1000, 0}, {0.001, 1000, 0.001}});
}

TEST(CameraFrame, HoweverLargeOrSmall) {
  expect_framed({{-1e18, -1e18, -1e18}, {1e18, 1e18, 1e18}});
  expect_framed({{-1e-15, -1e-15, -1e-15}, {1e-15, 1e-15, 1e-15}});
}

// These are the directions in which the sphere around a box touches the four sides of the view
// cone. Only the margin that the camera adds separates a box with a corner there from the sides.
// Kills: no margin for rounding.
TEST(CameraFrame, ABoxWithACornerWhereTheSphereTouchesASideLiesInsideToo) {
  const Camera camera = frame({{-1, -1, -1}, {1, 1, 1}}, Rules::opengl, 1);
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    for (const double side : {-2.0, 2.0}) {
      for (const double away : {0.0, 1.0, 10.0, 77.0}) {
        Bounds bounds;
        for (std::size_t i = 0; i < 3; ++i) {
          // The rows of the view matrix are the view axes, and the sides have the slope 1/2.
          const double direction =
              side * double{camera.view[4 * axis + i]} + double{camera.view[8 + i]};
          bounds.lo[i] = away - std::abs(direction);
          bounds.hi[i] = away + std::abs(direction);
        }
        SCOPED_TRACE(away);
        expect_framed(bounds);
      }
    }
  }
}

// A float32 mesh may lie a hundred thousand times its size from the origin and still have a shape.
// Kills: a translation rounded to float32 after the rotation, which is off by more than the margin.
TEST(CameraFrame, ABoxFarFromTheOriginLiesInsideToo) {
  for (const double far : {1e3, 1e5, 3e5, 1e6}) {
    SCOPED_TRACE(far);
    expect_framed({{far, 2 * far, -far}, {far + 1, 2 * far + 1, -far + 1}});
    expect_framed({{-3 * far, far, far}, {-3 * far + 1, far, far + 2}});
    expect_framed({{far, -far, 3 * far}, {far, -far + 1, 3 * far + 1}});
  }
}

// Kills: a camera so far away that nothing is visible.
TEST(CameraFrame, TheBoxFillsAGoodPartOfTheShorterSide) {
  const Bounds bounds{{-1, -1, -1}, {1, 1, 1}};
  for (const Rules rules : kAllRules) {
    for (const double aspect_ratio : kAspectRatios) {
      const Camera camera = frame(bounds, rules, aspect_ratio);
      const std::size_t shorter = aspect_ratio >= 1 ? 1 : 0;
      double extent = 0;
      for (std::size_t i = 0; i < 8; ++i) {
        const Vector4 clip = clip_position(camera, corner(bounds, i));
        extent = std::max(extent, std::abs(clip[shorter]) / clip[3]);
      }
      EXPECT_GT(extent, 0.5);
    }
  }
}

TEST(CameraFrame, PixelsAreSquare) {
  for (const double aspect_ratio : kAspectRatios) {
    const Camera camera = frame({{-1, -1, -1}, {1, 1, 1}}, Rules::d3d, aspect_ratio);
    EXPECT_NEAR(double{camera.projection[5]} / double{camera.projection[0]}, aspect_ratio, 1e-6);
  }
}

TEST(CameraFrame, ObjectUpAppearsUpAsDisplayedAndRightAppearsRight) {
  const Bounds bounds{{-1, -1, -1}, {1, 1, 1}};
  for (const Rules rules : kAllRules) {
    SCOPED_TRACE(static_cast<int>(rules));
    const Camera camera = frame(bounds, rules, 1);
    const Vector4 center = clip_position(camera, {0, 0, 0});
    const Vector4 up = clip_position(camera, {0, 1, 0});
    const Vector4 right = clip_position(camera, {1, 0, 0});
    EXPECT_NEAR(height_as_displayed(center, rules), 0.5, 1e-6);
    EXPECT_GT(height_as_displayed(up, rules), 0.6);
    EXPECT_NEAR(up[0] / up[3], 0, 1e-6);  // and straight up
    EXPECT_GT(right[0] / right[3], 0.2);
  }
}

TEST(CameraFrame, ItLooksFromFrontRightAndAbove) {
  const Camera camera = frame({{-1, -1, -1}, {1, 1, 1}}, Rules::vulkan, 1);
  const double center = clip_position(camera, {0, 0, 0})[3];
  // w is the distance along the line of sight.
  EXPECT_LT(clip_position(camera, {0, 0, 1})[3], center);
  EXPECT_LT(clip_position(camera, {1, 0, 0})[3], center);
  EXPECT_LT(clip_position(camera, {0, 1, 0})[3], center);
}

TEST(CameraFrame, WhatIsNearerHasTheSmallerDepth) {
  for (const Rules rules : kAllRules) {
    const Camera camera = frame({{-1, -1, -1}, {1, 1, 1}}, rules, 1);
    const Vector4 front = clip_position(camera, {0, 0, 1});
    const Vector4 behind = clip_position(camera, {0, 0, -1});
    EXPECT_LT(front[2] / front[3], behind[2] / behind[3]);
  }
}

TEST(CameraFrame, ASinglePointGivesFiniteMatrices) {
  for (const double at : {0.0, 1.0, -1e6, 1e30, 1e-40}) {
    for (const Rules rules : kAllRules) {
      const Camera camera = frame({{at, at, at}, {at, at, at}}, rules, 1);
      for (const Matrix4* matrix : {&camera.model, &camera.view, &camera.projection}) {
        EXPECT_TRUE(std::all_of(matrix->begin(), matrix->end(), [](float element) {
          return std::isfinite(element);
        })) << at;
      }
    }
  }
}

// Kills: a margin that suffices only for cubes.
RC_GTEST_PROP(CameraFrame, RandomBoxesLieInsideTheClipVolume, ()) {
  Bounds bounds;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int center = *rc::gen::inRange(-1000, 1000);
    const int half = *rc::gen::inRange(1, 1000);
    bounds.lo[axis] = center - half;
    bounds.hi[axis] = center + half;
  }
  const Rules rules = *rc::gen::element(Rules::opengl, Rules::vulkan, Rules::d3d);
  const int quarters = *rc::gen::inRange(1, 17);
  RC_ASSERT(inset_of(bounds, rules, quarters / 4.0) > 0);
}

}  // namespace
}  // namespace rastercheck::cases::camera_frame_test
