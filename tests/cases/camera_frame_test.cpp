#include "cases/internal/camera_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace rastercheck::cases::camera_frame_test {
namespace {

using ::testing::HasSubstr;

using Point = std::array<float, 3>;
using Points = std::vector<Point>;
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
Vector4 clip_position(const Camera& camera, const Point& p) {
  return clip_position(camera, std::array<double, 3>{p[0], p[1], p[2]});
}

/// How far a position is inside the clip volume (RULES §4), relative to w; negative if outside.
double inset(const Vector4& clip, Rules rules) {
  const double w = clip[3];
  if (!(w > 0)) return -std::numeric_limits<double>::infinity();
  const double nearest = rules == Rules::opengl ? -w : 0;
  return std::min({w - std::abs(clip[0]), w - std::abs(clip[1]), clip[2] - nearest, w - clip[2]}) /
         w;
}

Points box(const Point& lo, const Point& hi) {
  Points corners;
  for (unsigned i = 0; i < 8; ++i) {
    Point& p = corners.emplace_back(lo);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if ((i >> axis & 1U) != 0) p[axis] = hi[axis];
    }
  }
  return corners;
}

Points cube() { return box({-1, -1, -1}, {1, 1, 1}); }

Camera framed(const Points& points, Rules rules, double aspect_ratio, const View& view = {}) {
  const Result<Camera> camera = frame(points, view, rules, aspect_ratio);
  EXPECT_TRUE(camera.has_value()) << camera.error().reason;
  return camera.value_or(Camera{});
}

std::string refusal(const Points& points, const View& view) {
  const Result<Camera> camera = frame(points, view, Rules::vulkan, 1);
  return camera ? "framed" : camera.error().reason;
}

/// The smallest inset of the points of a mesh.
double inset_of(const Points& points, Rules rules, double aspect_ratio, const View& view = {}) {
  const Camera camera = framed(points, rules, aspect_ratio, view);
  double smallest = std::numeric_limits<double>::infinity();
  for (const Point& p : points) {
    smallest = std::min(smallest, inset(clip_position(camera, p), rules));
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

void expect_framed(const Points& points) {
  for (const Rules rules : kAllRules) {
    for (const double aspect_ratio : kAspectRatios) {
      EXPECT_GT(inset_of(points, rules, aspect_ratio), 0)
          << "rules " << static_cast<int>(rules) << ", aspect ratio " << aspect_ratio;
    }
  }
}

/// The share of the picture that a polygon fills; negative if it is seen from behind.
double share_of_picture(const Camera& camera, const Points& polygon) {
  double doubled = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector4 a = clip_position(camera, polygon[i]);
    const Vector4 b = clip_position(camera, polygon[(i + 1) % polygon.size()]);
    doubled += (a[0] * b[1] - a[1] * b[0]) / (a[3] * b[3]);
  }
  return doubled / 2 / 4;  // NDC span 2 × 2
}

void expect_clip(const Camera& camera, const std::array<double, 3>& p, const Vector4& expected) {
  const Vector4 clip = clip_position(camera, p);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(clip[i], expected[i], 1e-5) << "component " << i;
}

TEST(CameraFrame, ThePointsLieInsideTheClipVolume) {
  expect_framed(cube());
  expect_framed(box({0, 0, 0}, {3, 2, 1}));
  expect_framed(box({-10, 5, 100}, {-9, 50, 101}));
  expect_framed({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

TEST(CameraFrame, FlatAndLongOnesToo) {
  expect_framed(box({0, 0, 0}, {1, 1, 0}));
  expect_framed(box({0, 0, 0}, {0, 1, 1}));
  expect_framed(box({0, 0, 0}, {100, 0, 0}));
  expect_framed(box({0, -1000, 0}, {0.001F, 1000, 0.001F}));
}

// Kills: an eye that the tightest fit puts on the mesh.
TEST(CameraFrame, ALineAlongTheViewToo) { expect_framed({{0, 0, 0}, {2, 5, 4}}); }

TEST(CameraFrame, HoweverLargeOrSmall) {
  expect_framed(box({-1e18F, -1e18F, -1e18F}, {1e18F, 1e18F, 1e18F}));
  expect_framed(box({-1e-15F, -1e-15F, -1e-15F}, {1e-15F, 1e-15F, 1e-15F}));
}

// A float32 mesh may lie a hundred thousand times its size from the origin and still have a shape.
// Kills: a fit that is rounded to float32 afterwards.
TEST(CameraFrame, FarFromTheOriginToo) {
  for (const float far : {1e3F, 1e5F, 3e5F, 1e6F}) {
    SCOPED_TRACE(far);
    expect_framed(box({far, 2 * far, -far}, {far + 1, 2 * far + 1, -far + 1}));
    expect_framed(box({-3 * far, far, far}, {-3 * far + 1, far, far + 2}));
    expect_framed(box({far, -far, 3 * far}, {far, -far + 1, 3 * far + 1}));
  }
}

// Kills: a sphere or a box around the mesh that is framed in its place.
TEST(CameraFrame, TwoOppositeSidesOfThePictureAreReached) {
  for (const Points& points : {cube(), box({0, 0, 0}, {1, 9, 1}), box({3, 4, 5}, {13, 4, 15}),
                               Points{{0, 0, 0}, {5, 0, 0}, {0, 4, -2}}}) {
    for (const Rules rules : kAllRules) {
      for (const double aspect_ratio : kAspectRatios) {
        const Camera camera = framed(points, rules, aspect_ratio);
        std::array<double, 2> lo{1, 1};
        std::array<double, 2> hi{-1, -1};
        for (const Point& p : points) {
          const Vector4 clip = clip_position(camera, p);
          for (std::size_t axis = 0; axis < 2; ++axis) {
            lo[axis] = std::min(lo[axis], clip[axis] / clip[3]);
            hi[axis] = std::max(hi[axis], clip[axis] / clip[3]);
          }
        }
        // The border is 1/256 of the picture's 2 NDC wide.
        constexpr double kBorder = 1 - 2 * 0x1p-8;
        const std::size_t full = hi[0] - lo[0] > hi[1] - lo[1] ? 0 : 1;
        EXPECT_NEAR(hi[full], kBorder, 1e-5);
        EXPECT_NEAR(lo[full], -kBorder, 1e-5);
      }
    }
  }
}

// Kills: a frontal view, in which a cube looks like a flat square.
TEST(CameraFrame, ThreeFacesOfACubeAreSeen) {
  for (const double aspect_ratio : kAspectRatios) {
    // The share of the picture that its largest square fills.
    const double square = std::min(aspect_ratio, 1 / aspect_ratio);
    const Camera camera = framed(cube(), Rules::opengl, aspect_ratio);
    EXPECT_GT(share_of_picture(camera, {{1, -1, 1}, {1, -1, -1}, {1, 1, -1}, {1, 1, 1}}),
              square / 32);
    EXPECT_GT(share_of_picture(camera, {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}),
              square / 8);
    EXPECT_GT(share_of_picture(camera, {{-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1}}),
              square / 8);
  }
}

TEST(CameraFrame, ALevelSquareFillsFourTenthsOfTheSquarePicture) {
  const Points square{{0, 0, 8}, {8, 0, 8}, {8, 0, 0}, {0, 0, 0}};
  EXPECT_GT(share_of_picture(framed(square, Rules::opengl, 1), square), 0.4);
}

TEST(CameraFrame, PixelsAreSquare) {
  for (const double aspect_ratio : kAspectRatios) {
    const Camera camera = framed(cube(), Rules::d3d, aspect_ratio);
    EXPECT_NEAR(double{camera.projection[5]} / double{camera.projection[0]}, aspect_ratio, 1e-6);
  }
}

// The field of view is 30° along the shorter side: 1 / tan(15°) = 2 + √3.
TEST(CameraFrame, ItsUsualFieldOfViewIsThirtyDegrees) {
  const double focal = 2 + std::numbers::sqrt3;
  EXPECT_NEAR(framed(cube(), Rules::d3d, 2).projection[5], focal, 1e-6);
  EXPECT_NEAR(framed(cube(), Rules::d3d, 0.5).projection[0], focal, 1e-6);
}

TEST(CameraFrame, ObjectUpAppearsUpAsDisplayedAndRightAppearsRight) {
  for (const Rules rules : kAllRules) {
    SCOPED_TRACE(static_cast<int>(rules));
    const Camera camera = framed(cube(), rules, 1);
    const Vector4 below = clip_position(camera, Point{0, -1, 0});
    const Vector4 above = clip_position(camera, Point{0, 1, 0});
    const Vector4 left = clip_position(camera, Point{-1, 0, 0});
    const Vector4 right = clip_position(camera, Point{1, 0, 0});
    EXPECT_GT(height_as_displayed(above, rules), height_as_displayed(below, rules) + 0.2);
    EXPECT_GT(right[0] / right[3], left[0] / left[3] + 0.4);
  }
}

TEST(CameraFrame, ItLooksFromFrontRightAndAbove) {
  const Camera camera = framed(cube(), Rules::vulkan, 1);
  const double center = clip_position(camera, Point{0, 0, 0})[3];
  // w is the distance along the line of sight.
  EXPECT_LT(clip_position(camera, Point{0, 0, 1})[3], center);
  EXPECT_LT(clip_position(camera, Point{1, 0, 0})[3], center);
  EXPECT_LT(clip_position(camera, Point{0, 1, 0})[3], center);
}

// Kills: an eye above the xz plane, whatever is up.
TEST(CameraFrame, WithAnotherUpItLooksFromAboveToo) {
  for (const Point& up : Points{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, {1, 2, 3}}) {
    const View view{{}, {}, std::array<double, 3>{up[0], up[1], up[2]}, {}};
    const Camera camera = framed(cube(), Rules::opengl, 1, view);
    const Vector4 center = clip_position(camera, Point{0, 0, 0});
    const Vector4 above = clip_position(camera, up);
    EXPECT_LT(above[3], center[3]);
    EXPECT_GT(above[1] / above[3], center[1] / center[3]);
    EXPECT_GT(inset_of(cube(), Rules::opengl, 1, view), 0);
  }
}

TEST(CameraFrame, WhatIsNearerHasTheSmallerDepth) {
  for (const Rules rules : kAllRules) {
    const Camera camera = framed(cube(), rules, 1);
    const Vector4 front = clip_position(camera, Point{0, 0, 1});
    const Vector4 behind = clip_position(camera, Point{0, 0, -1});
    EXPECT_LT(front[2] / front[3], behind[2] / behind[3]);
  }
}

TEST(CameraFrame, ASinglePointGivesFiniteMatrices) {
  for (const float at : {0.0F, 1.0F, -1e6F, 1e30F, 1e-40F}) {
    for (const Rules rules : kAllRules) {
      const Camera camera = framed({{at, at, at}}, rules, 1);
      for (const Matrix4* matrix : {&camera.model, &camera.view, &camera.projection}) {
        EXPECT_TRUE(std::all_of(matrix->begin(), matrix->end(), [](float element) {
          return std::isfinite(element);
        })) << at;
      }
    }
  }
}

// Kills: a margin that suffices only for cubes.
RC_GTEST_PROP(CameraFrame, RandomPointsLieInsideTheClipVolume, ()) {
  Points points;
  const int count = *rc::gen::inRange(1, 12);
  for (int i = 0; i < count; ++i) {
    Point& p = points.emplace_back();
    for (float& x : p) x = static_cast<float>(*rc::gen::inRange(-1000, 1000));
  }
  const Rules rules = *rc::gen::element(Rules::opengl, Rules::vulkan, Rules::d3d);
  const int quarters = *rc::gen::inRange(1, 17);
  View view;
  if (*rc::gen::arbitrary<bool>()) view.fov = *rc::gen::inRange(1, 180);
  if (*rc::gen::arbitrary<bool>()) view.target = {1.0 * *rc::gen::inRange(-9, 9), 500.0, -2.5};
  // Points that are close together need not be framed about a target far away.
  const Result<Camera> camera = frame(points, view, rules, quarters / 4.0);
  if (!camera && view.target) return;
  RC_ASSERT(inset_of(points, rules, quarters / 4.0, view) > 0);
}

// --- Views that the user gives -------------------------------------------------------------------

// By hand: from (0, 0, 5), (1, 2, 0) is 1 to the right, 2 up and 5 away. tan(90° / 2) = 1, and the
// picture is twice as wide as high.
TEST(CameraFrame, ItLooksFromAnEyeToATarget) {
  const View view{std::array{0.0, 0.0, 5.0}, std::array{0.0, 0.0, 0.0}, {}, 90.0};
  for (const Rules rules : kAllRules) {
    const Vector4 clip = clip_position(framed(cube(), rules, 2, view), Point{1, 2, 0});
    EXPECT_NEAR(clip[0], 0.5, 1e-6);
    EXPECT_NEAR(clip[1], rules == Rules::vulkan ? -2 : 2, 1e-6);
    EXPECT_NEAR(clip[3], 5, 1e-6);
  }
}

// By hand: the eye is 5 away, back = (0.6, 0, 0.8), right = up × back = (0.8, 0, −0.6). The point
// (1, 0, 0) is 0.8 to the right and 5 − 0.6 away; 1 / tan(60° / 2) = √3.
TEST(CameraFrame, ItLooksFromTheSide) {
  const View view{std::array{3.0, 1.0, 4.0}, std::array{0.0, 1.0, 0.0}, {}, 60.0};
  const Vector4 clip = clip_position(framed(cube(), Rules::opengl, 1, view), Point{1, 1, 0});
  EXPECT_NEAR(clip[0], 0.8 * std::numbers::sqrt3, 1e-6);
  EXPECT_NEAR(clip[1], 0, 1e-6);
  EXPECT_NEAR(clip[3], 4.4, 1e-6);
}

// By hand: from (0, −5, 0) with z up, x is to the right.
TEST(CameraFrame, AnotherDirectionMayBeUp) {
  const View view{std::array{0.0, -5.0, 0.0}, std::array{0.0, 0.0, 0.0}, std::array{0.0, 0.0, 7.0},
                  90.0};
  const Vector4 clip = clip_position(framed(cube(), Rules::opengl, 1, view), Point{1, 0, 2});
  EXPECT_NEAR(clip[0], 1, 1e-6);
  EXPECT_NEAR(clip[1], 2, 1e-6);
  EXPECT_NEAR(clip[3], 5, 1e-6);
}

// By hand: the cube's corners are √3 from its middle, of which the planes keep a sixteenth. From
// (0, 0, 5) the planes are 4 − √3/16 and 6 + √3/16 away.
TEST(CameraFrame, ThePlanesEncloseTheMesh) {
  const View view{std::array{0.0, 0.0, 5.0}, {}, {}, 90.0};
  const double near = 4 - std::numbers::sqrt3 / 16;
  const double far = 6 + std::numbers::sqrt3 / 16;
  for (const Rules rules : kAllRules) {
    const Camera camera = framed(cube(), rules, 1, view);
    const double nearest = rules == Rules::opengl ? -1 : 0;
    expect_clip(camera, {0, 0, 5 - near}, {0, 0, nearest * near, near});
    expect_clip(camera, {0, 0, 5 - far}, {0, 0, far, far});
  }
}

// From inside the mesh, the near plane is 1/4096 of the farthest distance away: 1 + √3/16.
TEST(CameraFrame, AnEyeInsideTheMeshSeesWhatIsAhead) {
  const View view{std::array{0.0, 0.0, 0.0}, std::array{0.0, 0.0, -1.0}, {}, {}};
  const double near = (1 + std::numbers::sqrt3 / 16) / 4096;
  expect_clip(framed(cube(), Rules::d3d, 1, view), {0, 0, -near}, {0, 0, 0, near});
}

TEST(CameraFrame, ATargetIsInTheMiddleOfThePicture) {
  const View view{{}, std::array{1.0, -1.0, 0.5}, {}, {}};
  const Camera camera = framed(cube(), Rules::vulkan, 1, view);
  const Vector4 clip = clip_position(camera, Point{1, -1, 0.5F});
  EXPECT_NEAR(clip[0] / clip[3], 0, 1e-6);
  EXPECT_NEAR(clip[1] / clip[3], 0, 1e-6);
  EXPECT_GT(inset_of(cube(), Rules::vulkan, 1, view), 0);
}

TEST(CameraFrame, AFieldOfViewIsVerticalAndFramesTheMesh) {
  const View view{{}, {}, {}, 90.0};
  for (const double aspect_ratio : kAspectRatios) {
    EXPECT_NEAR(framed(cube(), Rules::d3d, aspect_ratio, view).projection[5], 1, 1e-6);
    EXPECT_GT(inset_of(cube(), Rules::d3d, aspect_ratio, view), 0);
  }
}

TEST(CameraFrame, RefusesViewsThatAreNone) {
  const std::array one{1.0, 2.0, 3.0};
  EXPECT_EQ(refusal(cube(), {one, one, {}, {}}),
            "the eye lies at the target, 1,2,3 (--eye, --target)");
  EXPECT_EQ(refusal(cube(), {std::array{0.0, 9.0, 0.0}, {}, {}, {}}),
            "the view goes along 0,1,0, which is to point up (--up X,Y,Z names another direction)");
  EXPECT_EQ(refusal(cube(), {{}, {}, std::array{0.0, 0.0, 0.0}, {}}),
            "0,0,0 is no direction (--up)");
  EXPECT_EQ(refusal(cube(), {std::array{0.0, 0.0, 5.0}, std::array{0.0, 0.0, 6.0}, {}, {}}),
            "all of it lies behind the eye (--eye, --target)");
  EXPECT_THAT(refusal(cube(), {std::array{0.0, 0.0, 1e9}, {}, {}, {}}),
              HasSubstr("too far away from the eye"));
  EXPECT_THAT(refusal(cube(), {{}, {}, {}, 1e-30}), HasSubstr("too large for a float32 camera"));
  constexpr float kLargest = std::numeric_limits<float>::max();
  EXPECT_THAT(refusal({{-kLargest, 0, 0}, {kLargest, 0, 0}}, {}), HasSubstr("too large"));
}

// --- Cameras of files ----------------------------------------------------------------------------
//
// A camera at (10, 20, 30), turned by 90° about y: its −z is the object's −x, its +x the object's
// −z. From there, (8, 21, 29.5) is 0.5 to the right, 1 up and 2 away. tan(yfov / 2) = 1/2. Expected
// clip positions follow from the matrices of glTF 2.0, section 3.10.3, which are OpenGL's; Vulkan
// and D3D have (z + w) / 2 in place of z, and Vulkan −y.

constexpr std::array kPoint{8.0, 21.0, 29.5};

MeshCamera turned() {
  MeshCamera camera;
  camera.yfov = 2 * std::atan(0.5);
  camera.aspect_ratio = 2;
  camera.znear = 1;
  camera.zfar = 3;
  camera.to_object = {0,  0, 1, 10,  //
                      0,  1, 0, 20,  //
                      -1, 0, 0, 30};
  return camera;
}

MeshCamera orthographic() {
  MeshCamera camera = turned();
  camera.is_orthographic = true;
  camera.xmag = 4;
  camera.ymag = 2;
  return camera;
}

// z = (f + n) / (n − f) · −2 + 2 f n / (n − f) = −2 · −2 − 3 = 1.
TEST(CameraPlace, AFinitePerspectiveCamera) {
  expect_clip(place(turned(), Rules::opengl, 2).value(), kPoint, {0.5, 2, 1, 2});
  expect_clip(place(turned(), Rules::vulkan, 2).value(), kPoint, {0.5, -2, 1.5, 2});
  expect_clip(place(turned(), Rules::d3d, 2).value(), kPoint, {0.5, 2, 1.5, 2});
}

// z = −1 · −2 − 2 n = 0. Kills: assimp's far plane at 100.
TEST(CameraPlace, AnInfinitePerspectiveCamera) {
  MeshCamera camera = turned();
  camera.zfar.reset();
  expect_clip(place(camera, Rules::opengl, 2).value(), kPoint, {0.5, 2, 0, 2});
  expect_clip(place(camera, Rules::vulkan, 2).value(), kPoint, {0.5, -2, 1, 2});
}

// x = 0.5 / 4, y = 1 / 2, z = 2 / (n − f) · −2 + (f + n) / (n − f) = 2 − 2 = 0.
TEST(CameraPlace, AnOrthographicCamera) {
  expect_clip(place(orthographic(), Rules::opengl, 2).value(), kPoint, {0.125, 0.5, 0, 1});
  expect_clip(place(orthographic(), Rules::vulkan, 2).value(), kPoint, {0.125, -0.5, 0.5, 1});
}

// Section 3.10.2 ignores the scaling.
TEST(CameraPlace, TheScaleOfItsNodeDoesNotCount) {
  MeshCamera camera = turned();
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      camera.to_object[4 * row + column] *= static_cast<double>(2 + column);
    }
  }
  expect_clip(place(camera, Rules::opengl, 2).value(), kPoint, {0.5, 2, 1, 2});
}

// By hand: in a square picture the height grows to the width, 2 · 1/2 = 1; in one four times as
// wide as high, the width grows to 4 · 1/2 = 2.
TEST(CameraPlace, AnotherPictureShowsMoreAndStretchesNothing) {
  expect_clip(place(turned(), Rules::opengl, 1).value(), kPoint, {0.5, 1, 1, 2});
  expect_clip(place(turned(), Rules::opengl, 4).value(), kPoint, {0.25, 2, 1, 2});
  expect_clip(place(orthographic(), Rules::opengl, 1).value(), kPoint, {0.125, 0.25, 0, 1});
}

TEST(CameraPlace, WithoutAnAspectRatioItHasThePictures) {
  MeshCamera camera = turned();
  camera.aspect_ratio.reset();
  expect_clip(place(camera, Rules::opengl, 4).value(), kPoint, {0.25, 2, 1, 2});
}

TEST(CameraPlace, RefusesNumbersThatMakeNoSense) {
  const auto reason = [](MeshCamera camera, auto change) {
    change(camera);
    const Result<Camera> placed = place(camera, Rules::vulkan, 1);
    return placed ? "placed" : placed.error().reason;
  };
  EXPECT_EQ(reason(turned(), [](MeshCamera& c) { c.yfov = 4; }),
            "its yfov, 4 radians, is not between 0 and π");
  EXPECT_EQ(reason(turned(), [](MeshCamera& c) { c.yfov = 0; }),
            "its yfov, 0 radians, is not between 0 and π");
  EXPECT_EQ(reason(turned(), [](MeshCamera& c) { c.aspect_ratio = -1; }),
            "its aspectRatio, -1, is not above 0");
  EXPECT_EQ(reason(turned(), [](MeshCamera& c) { c.znear = 0; }), "its znear, 0, is not above 0");
  EXPECT_EQ(reason(turned(), [](MeshCamera& c) { c.zfar = 1; }),
            "its zfar, 1, is not above its znear, 1");
  EXPECT_EQ(reason(turned(), [](MeshCamera& c) { c.to_object = {}; }), "its node has no direction");
  EXPECT_EQ(reason(turned(),
                   [](MeshCamera& c) {
                     c.znear = 1e39;
                     c.zfar = 1e40;
                   }),
            "it is too large for float32");
  EXPECT_EQ(reason(orthographic(), [](MeshCamera& c) { c.xmag = -4; }),
            "its xmag, -4, is not above 0");
  EXPECT_EQ(reason(orthographic(), [](MeshCamera& c) { c.ymag = 0; }),
            "its ymag, 0, is not above 0");
  EXPECT_EQ(reason(orthographic(), [](MeshCamera& c) { c.zfar.reset(); }), "it has no zfar");
}

}  // namespace
}  // namespace rastercheck::cases::camera_frame_test
