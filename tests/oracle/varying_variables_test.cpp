// The laws of the Varying-variables notes, "interpolation of varying variables": affine functions,
// going sideways through matrices, and the rational linear interpolation of OpenGL.
//
// Object triangle (−1/2,−1,−1), (1,−2,0), (−2,4,2). Model doubles x, view adds 2 to z, projection
// keeps x, y and makes z' = z − 1, w' = z:
//   x' = 2 x_o     y' = y_o     z' = z_o + 1     w' = z_o + 2
//   clip (−1,−1,0,1), (2,−2,1,2), (−4,4,3,4)      NDC (−1,−1,0), (1,−1,1/2), (−1,1,3/4)
// The varying is v = 2 x_o + 2 y_o + 5 z_o + 11 = 3, 9, 25. Window (0,0), (8,0), (0,8):
// x_n = u/4 − 1, y_n = v/4 − 1; pixel (3, 2) is at NDC (−1/8, −3/8).

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/drawn.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::varying_variables_test {
namespace {

Field center(int pixel) { return Field(pixel) + Field(1, 2); }
Field ndc(int pixel) { return center(pixel) / Field(4) - Field(1); }

/// The varyings: v; the clip coordinates x', y', z', w'; the object coordinates.
enum Varying : std::size_t { kV, kClipX, kClipY, kClipZ, kClipW, kObjectX, kObjectY, kObjectZ };

constexpr std::array<cases::ClipVertex, 3> kObject{
    {{-0.5f, -1, -1, 1}, {1, -2, 0, 1}, {-2, 4, 2, 1}}};
constexpr std::array<cases::ClipVertex, 3> kClip{{{-1, -1, 0, 1}, {2, -2, 1, 2}, {-4, 4, 3, 4}}};

/// The case without a camera: clip positions.
cases::Case clip_case() {
  return small_case(cases::Rules::vulkan, 8, 8, kClip,
                    {{{3, -1, -1, 0, 1, -0.5f, -1, -1},
                      {9, 2, -2, 1, 2, 1, -2, 0},
                      {25, -4, 4, 3, 4, -2, 4, 2}}});
}

cases::Case object_case() {
  cases::Case c = clip_case();
  c.positions.assign(kObject.begin(), kObject.end());
  c.camera = cases::Camera{{2, 0, 0, 0,  //
                            0, 1, 0, 0,  //
                            0, 0, 1, 0,  //
                            0, 0, 0, 1},
                           {1, 0, 0, 0,  //
                            0, 1, 0, 0,  //
                            0, 0, 1, 2,  //
                            0, 0, 0, 1},
                           {1, 0, 0, 0,   //
                            0, 1, 0, 0,   //
                            0, 0, 1, -1,  //
                            0, 0, 1, 0}};
  return c;
}

// Varying-variables notes, eq. (1): v = ax + by + c through three values, "some simple matrix
// operations to solve". Window (0,0), (8,2), (2,8), w = 1, v = 1, 7, 4: 8a + 2b = 6, 2a + 8b = 3,
// so a = 42/60 = 7/10, b = 12/60 = 1/5, c = 1. The function can be evaluated by inserting (x, y),
// or incrementally along x or y.
TEST(VaryingVariables, ThreeValuesDetermineAnAffineFunctionOfThePlane) {
  const Drawn drawn(small_case(cases::Rules::vulkan, 8, 8,
                               {{{-1, -1, 0, 1}, {1, -0.5f, 0, 1}, {-0.5f, 1, 0, 1}}},
                               {{{1}, {7}, {4}}}));
  EXPECT_EQ(drawn.text(0, 3, 3), "83/20");  // 49/20 + 7/10 + 1
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(drawn.value(0, x, y), Field(7, 10) * center(x) + center(y) / Field(5) + Field(1));
  }
  EXPECT_EQ(drawn.value(0, 4, 3) - drawn.value(0, 3, 3), Field(7, 10));
  EXPECT_EQ(drawn.value(0, 3, 4) - drawn.value(0, 3, 3), Field(1, 5));
}

// Varying-variables notes, eq. (2): many functions affine in (x, y, z) agree at three points, and
// then on the whole plane of the triangle, 4 x_o + 3 y_o − 3 z_o + 2 = 0 (at the vertices −2 − 3 +
// 3 + 2, 4 − 6 + 2, −8 + 12 − 6 + 2). Adding its left side to v gives 6 x_o + 5 y_o + 2 z_o + 13,
// which differs from v elsewhere.
TEST(VaryingVariables, AffineFunctionsThatAgreeAtTheVerticesAgreeOnTheTriangle) {
  const Drawn drawn(object_case());
  const auto pixels = drawn.pixels();
  EXPECT_EQ(pixels.size(), 28u);  // x + y <= 6
  for (const auto& [px, py] : pixels) {
    const Field x = drawn.value(kObjectX, px, py);
    const Field y = drawn.value(kObjectY, px, py);
    const Field z = drawn.value(kObjectZ, px, py);
    const Field v = drawn.value(kV, px, py);
    EXPECT_EQ(v, Field(2) * x + Field(2) * y + Field(5) * z + Field(11));
    EXPECT_EQ(v, Field(6) * x + Field(5) * y + Field(2) * z + Field(13));
  }
}

// Varying-variables notes, projecting down: with z_o = (4 x_o + 3 y_o + 2)/3 on the triangle, v is
// affine in two variables: (26 x_o + 21 y_o + 43)/3, which is at the vertices (−13 − 21 + 43)/3,
// (26 − 42 + 43)/3, (−52 + 84 + 43)/3.
TEST(VaryingVariables, AffineFunctionOnATriangleIsAffineInTwoCoordinates) {
  const Drawn drawn(object_case());
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(Field(3) * drawn.value(kV, x, y), Field(26) * drawn.value(kObjectX, x, y) +
                                                    Field(21) * drawn.value(kObjectY, x, y) +
                                                    Field(43));
  }
}

// Varying-variables notes, eq. (3): x', y', z', w' are affine in (x_o, y_o, z_o), being rows of M
// times (x_o, y_o, z_o, 1), although the last row of M is not (0, 0, 0, 1).
TEST(VaryingVariables, ClipCoordinatesAreAffineInObjectCoordinates) {
  const Drawn drawn(object_case());
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(drawn.value(kClipX, x, y), Field(2) * drawn.value(kObjectX, x, y));
    EXPECT_EQ(drawn.value(kClipY, x, y), drawn.value(kObjectY, x, y));
    EXPECT_EQ(drawn.value(kClipZ, x, y), drawn.value(kObjectZ, x, y) + Field(1));
    EXPECT_EQ(drawn.value(kClipW, x, y), drawn.value(kObjectZ, x, y) + Field(2));
  }
}

// Varying-variables notes, eqs. (4)–(6): v = [2 2 5 11] M^-1 (x', y', z', w'). M^-1: x_o = x'/2,
// y_o = y', 1 = w' − z', z_o = z' − 1 = 2z' − w'. So v = x' + 2y' + 5(2z' − w') + 11(w' − z') = x'
// + 2y' − z' + 6w'.
TEST(VaryingVariables, FunctionAffineInObjectSpaceIsAffineInClipSpace) {
  const Drawn drawn(object_case());
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(drawn.value(kV, x, y),
              drawn.value(kClipX, x, y) + Field(2) * drawn.value(kClipY, x, y) -
                  drawn.value(kClipZ, x, y) + Field(6) * drawn.value(kClipW, x, y));
  }
}

// Varying-variables notes, eq. (6), "in agreement between object or eye or clip coordinates": the
// interpolant depends only on the vertex values, whichever of these spaces the positions are given
// in.
TEST(VaryingVariables, ObjectSpaceAndClipSpaceInterpolantsAreTheSame) {
  const Drawn object(object_case());
  const Drawn clip(clip_case());
  ASSERT_EQ(object.pixels(), clip.pixels());
  for (const auto& [x, y] : object.pixels()) {
    EXPECT_EQ(object.value(kV, x, y), clip.value(kV, x, y));
    EXPECT_EQ(object.depth(x, y), clip.depth(x, y));
  }
}

// Varying-variables notes, affine functions: "z_n is an affine function of x_n, y_n", 5/8 + x_n/4 +
// 3y_n/8 through 0, 1/2, 3/4. Pixel (3, 2): 5/8 − 1/32 − 9/64.
TEST(VaryingVariables, NormalizedDepthIsAffineInNormalizedXAndY) {
  const Drawn drawn(object_case());
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(drawn.depth(x, y), Field(5, 8) + ndc(x) / Field(4) + Field(3, 8) * ndc(y));
  }
  EXPECT_EQ(drawn.depth(3, 2), Field(29, 64));
}

// Varying-variables notes, not sideways: after the division v is not affine. Along a row x_n, y_n
// and z_n change in even steps, but v at pixels 1, 2, 3 of row 2 is 275/43, 287/39, 299/35: with
// x_n = −5/8, −3/8, −1/8, y_n = −3/8 it is (3/4 x_n + 13/8 y_n + 43/8) / (3/8 − x_n/4 − 3/8 y_n).
TEST(VaryingVariables, FunctionAffineInObjectSpaceIsNotAffineAfterTheDivision) {
  const Drawn drawn(object_case());
  EXPECT_EQ(drawn.text(kV, 1, 2), "275/43");
  EXPECT_EQ(drawn.text(kV, 2, 2), "287/39");
  EXPECT_EQ(drawn.text(kV, 3, 2), "299/35");
  EXPECT_NE(drawn.value(kV, 2, 2) - drawn.value(kV, 1, 2),
            drawn.value(kV, 3, 2) - drawn.value(kV, 2, 2));
  EXPECT_EQ(drawn.depth(2, 2) - drawn.depth(1, 2), drawn.depth(3, 2) - drawn.depth(2, 2));
}

// Varying-variables notes, how to evaluate: v = x' + 2y' − z' + 6w' and 1 = w' − z', divided by
// w_n, give [v/w_n, 1/w_n] = [e f g h; i j k l] (x_n, y_n, z_n, 1) with 1, 2, −1, 6 and 0, 0, −1,
// 1.
TEST(VaryingVariables, QuotientsByWAreAffineInNormalizedDeviceCoordinates) {
  const Drawn drawn(object_case());
  for (const auto& [x, y] : drawn.pixels()) {
    const Field w = drawn.value(kClipW, x, y);
    const Field z_n = drawn.depth(x, y);
    EXPECT_EQ(drawn.value(kV, x, y) / w, ndc(x) + Field(2) * ndc(y) - z_n + Field(6));
    EXPECT_EQ(Field(1) / w, Field(1) - z_n);
  }
}

// Varying-variables notes, sideways and down again: affine in the window's (x_w, y_w). Corner
// values 3, 9/2, 25/4 and 1, 1/2, 1/4: v/w_n = 3 + 3 x_w/16 + 13 y_w/32, 1/w_n = 1 − x_w/16 − 3
// y_w/32.
TEST(VaryingVariables, QuotientsByWAreAffineInWindowCoordinates) {
  const Drawn drawn(object_case());
  for (const auto& [x, y] : drawn.pixels()) {
    const Field w = drawn.value(kClipW, x, y);
    EXPECT_EQ(drawn.value(kV, x, y) / w,
              Field(3) + Field(3, 16) * center(x) + Field(13, 32) * center(y));
    EXPECT_EQ(Field(1) / w, Field(1) - center(x) / Field(16) - Field(3, 32) * center(y));
  }
}

/// An OpenGL case whose viewport is smaller than the framebuffer. v = 3, 9, 25, first smooth; then
/// the internal variables v/w_n and 1/w_n, linear in the window.
cases::Case opengl_case() {
  cases::Case c =
      small_case(cases::Rules::opengl, 8, 8, {{{-1, -1, -1, 1}, {2, -2, 0, 2}, {-4, 4, 2, 4}}},
                 {{{3, 3, 1}, {9, 4.5f, 0.5f}, {25, 6.25f, 0.25f}}});
  c.viewport = {2, 0, 4, 8, 0.25f, 0.75f};
  c.attributes[1].interpolation = cases::Interpolation::noperspective;
  c.attributes[2].interpolation = cases::Interpolation::noperspective;
  return c;
}

// Varying-variables notes, in OpenGL: NDC (−1,−1), (1,−1), (−1,1) become x_w = 2 + 2(x_n + 1), y_w
// = 4(y_n + 1), upwards: (2,0), (6,0), (2,8). Row y holds the centres with (u − 2)/4 + v/8 < 1: v =
// 1/2 … 15/2, u < 23/4, 21/4, 19/4, 17/4, 15/4, 13/4, 11/4, 9/4, so the rows hold 4, 3, 3, 2, 2, 1,
// 1, 0 centres.
TEST(VaryingVariables, WindowPositionsComeFromNormalizedDeviceCoordinates) {
  const Drawn drawn(opengl_case());
  const std::array<RingVector3, 3> window{RingVector3(2, 0, 1), RingVector3(12, 0, 2),
                                          RingVector3(8, 32, 4)};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(drawn.scene.scene().window_column(i) == window[i]) << i;
  }
  std::array<int, 8> row{};
  for (const auto& [x, y] : drawn.pixels()) ++row[static_cast<std::size_t>(y)];
  EXPECT_EQ(row, (std::array<int, 8>{4, 3, 3, 2, 2, 1, 1, 0}));
}

// Varying-variables notes, in OpenGL: z_w is interpolated linearly. z_n = −1, 0, 1/2 is z_w = 1/4 +
// (z_n + 1)/4 = 1/4, 1/2, 5/8: z_w = 1/4 + (x_w − 2)/16 + 3 y_w/64. Pixel (3, 2): 1/4 + 3/32 +
// 15/128.
TEST(VaryingVariables, WindowDepthIsLinearlyInterpolated) {
  const Drawn drawn(opengl_case());
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(drawn.depth(x, y),
              Field(1, 4) + (center(x) - Field(2)) / Field(16) + Field(3, 64) * center(y));
  }
  EXPECT_EQ(drawn.depth(3, 2), Field(59, 128));
}

// Varying-variables notes, in OpenGL: v = (v/w_n)/(1/w_n) of the linearly interpolated internal
// variables. Pixel (3, 2): 3 + 9/16 + 65/64 = 293/64 and 1 − 3/16 − 15/64 = 37/64.
TEST(VaryingVariables, VaryingIsTheQuotientOfLinearlyInterpolatedInternalVariables) {
  const Drawn drawn(opengl_case());
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(drawn.value(0, x, y), drawn.value(1, x, y) / drawn.value(2, x, y));
  }
  EXPECT_EQ(drawn.text(1, 3, 2), "293/64");
  EXPECT_EQ(drawn.text(2, 3, 2), "37/64");
  EXPECT_EQ(drawn.text(0, 3, 2), "293/37");
}

}  // namespace
}  // namespace rastercheck::oracle::varying_variables_test
