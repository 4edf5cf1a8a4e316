// The laws of Appendix 5, "Perspective Correct Interpolation & Interpolation of Linear Functions in
// Homogeneous Space", on one triangle whose answers are short fractions.
//
// View space V0 = (−1,−1,1), V1 = (2,−2,2), V2 = (−4,4,4); screen (A 6.2) (−1,−1), (1,−1), (−1,1);
// window (0,0), (8,0), (0,8). The linear function is φ = x + 2y + 5z (A 6.4): 2, 8, 24.
//   Screen and window   sx = u/4 − 1, sy = v/4 − 1
//   Plane of the triangle   1 = −x/4 − 3y/8 + 3z/8
//   Pixel (0, 0) lies at s = (−7/8, −7/8), pixel (3, 2) at s = (−1/8, −3/8).

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/drawn.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::appendix_5_test {
namespace {

/// Samples with u + v < 8, which is x + y <= 6 (at x + y = 7 the sample lies on an edge that owns
/// no ties).
constexpr std::size_t kCoveredPixels = 28;

/// The projection matrix of A 6.1.
constexpr cases::Matrix4 kA61{1, 0, 0, 0,  //
                              0, 1, 0, 0,  //
                              0, 0, 1, 0,  //
                              0, 0, 1, 0};

/// Attributes: φ smooth, φ noperspective, and the view coordinates x, y, z.
cases::Case appendix_case() {
  cases::Case c =
      small_case(cases::Rules::vulkan, 8, 8, {{{-1, -1, 1, 1}, {2, -2, 2, 1}, {-4, 4, 4, 1}}},
                 {{{2, 2, -1, -1, 1}, {8, 8, 2, -2, 2}, {24, 24, -4, 4, 4}}});
  c.attributes[1].interpolation = cases::Interpolation::noperspective;
  c.camera = cases::Camera{cases::kIdentity, cases::kIdentity, kA61};
  return c;
}

/// The same screen triangle with clip w as given; φ smooth, φ noperspective.
cases::Case case_of_w(float w0, float w1, float w2) {
  cases::Case c = small_case(cases::Rules::vulkan, 8, 8,
                             {{{-w0, -w0, 0, w0}, {w1, -w1, 0, w1}, {-w2, w2, 0, w2}}},
                             {{{2, 2}, {8, 8}, {24, 24}}});
  c.attributes[1].interpolation = cases::Interpolation::noperspective;
  return c;
}

Field screen_x(int x) { return (Field(x) + Field(1, 2)) / Field(4) - Field(1); }
Field screen_y(int y) { return (Field(y) + Field(1, 2)) / Field(4) - Field(1); }

// Appendix 5, A 6.1: (x, y, z, 1) becomes (x, y, z, z). A 6.2: the screen position is (x/z, y/z).
TEST(Appendix5, ProjectionMovesViewDepthIntoWAndTheDivisionGivesTheScreenPosition) {
  const Drawn drawn(appendix_case());
  const std::array<RingVector4, 3> clip{RingVector4(-1, -1, 1, 1), RingVector4(2, -2, 2, 2),
                                        RingVector4(-4, 4, 4, 4)};
  // Window position times w: u = 4 sx + 4, v = 4 sy + 4 at s = (−1,−1), (1,−1), (−1,1).
  const std::array<RingVector3, 3> window{RingVector3(0, 0, 1), RingVector3(16, 0, 2),
                                          RingVector3(0, 32, 4)};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(drawn.scene.scene().clip_position(i) == clip[i]) << i;
    EXPECT_TRUE(drawn.scene.scene().window_column(i) == window[i]) << i;
  }
  EXPECT_EQ(drawn.pixels().size(), kCoveredPixels);
}

// Appendix 5, A 6.1: its last two rows are equal, so z/w = 1 wherever w ≠ 0. The matrix is
// singular; the appendix's way back from clip to view space works only on a plane that misses the
// eye, through A 6.4, and not by the matrix alone.
TEST(Appendix5, PrintedProjectionKeepsNoDepth) {
  const Drawn drawn(appendix_case());
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(drawn.triangle.depth(x, y, 0).value().lo.to_string(), "1");
  }
}

// Appendix 5, A 6.3: φ = α sx + β sy + γ through 2, 8, 24 at (−1,−1), (1,−1), (−1,1):
//   2α = 6, 2β = 22, γ = 2 + 3 + 11   =>   φ = 3 sx + 11 sy + 16
TEST(Appendix5, InterpolationInScreenSpaceIsAffineInTheScreenPosition) {
  const Drawn drawn(appendix_case());
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(drawn.value(1, x, y), Field(3) * screen_x(x) + Field(11) * screen_y(y) + Field(16));
  }
  EXPECT_EQ(drawn.text(1, 0, 0), "15/4");  // 14 · (−7/8) + 16
  EXPECT_EQ(drawn.text(1, 3, 2), "23/2");  // −3/8 − 33/8 + 16
}

// Appendix 5, after A 6.3: interpolating in screen space gives a different value than interpolating
// along the primitive.
//   Pixel (0, 0): 1/w = 7/32 + 21/64 + 3/8 = 59/64, φ/w = −7/8 − 14/8 + 5 = 19/8, φ = 152/59
//   Pixel (3, 2): 1/w = 1/32 + 9/64 + 3/8 = 35/64, φ/w = −1/8 − 6/8 + 5 = 33/8, φ = 264/35
TEST(Appendix5, InterpolationAlongThePrimitiveDiffersFromScreenSpace) {
  const Drawn drawn(appendix_case());
  EXPECT_EQ(drawn.text(0, 0, 0), "152/59");
  EXPECT_EQ(drawn.text(0, 3, 2), "264/35");
  EXPECT_NE(drawn.value(0, 0, 0), drawn.value(1, 0, 0));
  EXPECT_NE(drawn.value(0, 3, 2), drawn.value(1, 3, 2));
}

// Appendix 5, A 6.4 and A 6.7: φ = a x + b y + c z in view space, and with the same a, b, c
// φ = a x + b y + c w in homogeneous screen space, where (x, y, w) = (sx w, sy w, w).
TEST(Appendix5, SameCoefficientsHoldInViewSpaceAndInHomogeneousScreenSpace) {
  const Drawn drawn(appendix_case());
  for (const auto& [px, py] : drawn.pixels()) {
    const Field phi = drawn.value(0, px, py);
    const Field z = drawn.value(4, px, py);
    EXPECT_EQ(phi, drawn.value(2, px, py) + Field(2) * drawn.value(3, px, py) + Field(5) * z);
    EXPECT_EQ(phi, screen_x(px) * z + Field(2) * screen_y(py) * z + Field(5) * z);
  }
  // Pixel (0, 0): w = 64/59, x = y = −7/8 w.
  EXPECT_EQ(drawn.text(2, 0, 0), "-56/59");
  EXPECT_EQ(drawn.text(3, 0, 0), "-56/59");
  EXPECT_EQ(drawn.text(4, 0, 0), "64/59");
}

// Appendix 5, A 6.5 and A 6.6: the screen position of a fragment is (x/z, y/z) of its view
// position.
TEST(Appendix5, ViewPositionOfAFragmentProjectsBackToItsSample) {
  const Drawn drawn(appendix_case());
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(drawn.value(2, x, y) / drawn.value(4, x, y), screen_x(x));
    EXPECT_EQ(drawn.value(3, x, y) / drawn.value(4, x, y), screen_y(y));
  }
}

// Appendix 5, A 6.8: φ/w = a sx + b sy + c, with the coefficients of A 6.4: sx + 2 sy + 5.
TEST(Appendix5, QuotientOfALinearFunctionAndWIsAffineInTheScreenPosition) {
  const Drawn drawn(appendix_case());
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(drawn.value(0, x, y) / drawn.value(4, x, y),
              screen_x(x) + Field(2) * screen_y(y) + Field(5));
  }
}

// Appendix 5, A 6.9: 1/w is affine in the screen position. The appendix prints the letters of A
// 6.8, but here they are the coefficients of φ = 1, which is −x/4 − 3y/8 + 3z/8 on this plane: V0:
// 1/4 + 3/8 + 3/8, V1: −1/2 + 3/4 + 3/4, V2: 1 − 3/2 + 3/2.
TEST(Appendix5, ReciprocalOfWIsAffineInTheScreenPosition) {
  const Drawn drawn(appendix_case());
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(Field(1) / drawn.value(4, x, y),
              -screen_x(x) / Field(4) - Field(3, 8) * screen_y(y) + Field(3, 8));
  }
}

// Appendix 5, after A 6.9: "the same value of w" at all vertices is the signature of the case where
// perspective correction does not matter; both interpolations give 3 sx + 11 sy + 16.
TEST(Appendix5, EqualWAtAllVerticesMakesSmoothAndNoperspectiveTheSame) {
  for (const float w : {0.5f, 1.0f, 2.0f, 3.0f}) {
    const Drawn drawn(case_of_w(w, w, w));
    const auto pixels = drawn.pixels();
    EXPECT_EQ(pixels.size(), kCoveredPixels);
    for (const auto& [x, y] : pixels) {
      EXPECT_EQ(drawn.value(0, x, y), drawn.value(1, x, y));
      EXPECT_EQ(drawn.value(0, x, y), Field(3) * screen_x(x) + Field(11) * screen_y(y) + Field(16));
    }
  }
}

// Appendix 5, the converse: one vertex with another w is enough to make them differ. Pixel (0, 0)
// has screen weights 14/16, 1/16, 1/16; r = Σ r_i λ_i/w_i / Σ λ_i/w_i.
TEST(Appendix5, OneOtherWMakesSmoothAndNoperspectiveDiffer) {
  const Drawn first(case_of_w(2, 1, 1));  // 7 : 1 : 1, (14 + 8 + 24)/9
  EXPECT_EQ(first.text(0, 0, 0), "46/9");
  EXPECT_EQ(first.text(1, 0, 0), "15/4");
  const Drawn second(case_of_w(1, 2, 1));  // 28 : 1 : 2, (56 + 8 + 48)/31
  EXPECT_EQ(second.text(0, 0, 0), "112/31");
  EXPECT_EQ(second.text(1, 0, 0), "15/4");
  const Drawn third(case_of_w(1, 1, 2));  // 28 : 2 : 1, (56 + 16 + 24)/31
  EXPECT_EQ(third.text(0, 0, 0), "96/31");
  EXPECT_EQ(third.text(1, 0, 0), "15/4");
}

}  // namespace
}  // namespace rastercheck::oracle::appendix_5_test
