// The laws of MIT 6.837 2000, lecture 18: one edge of a triangle and its projection.
//
// The edge runs from V1 at depth z1 = 1 to V2 at depth z2, on a viewport one unit from the centre
// of projection (slide 8): clip w is z. On the screen it is the top edge from window (0, 1/2) to
// (4, 1/2), whose samples a top-left rule owns; V3 = (2, 4) lies below at depth 2. So the fragments
// of row 0 lie exactly on the edge, at t = 1/8, 3/8, 5/8, 7/8 of its projection. An attribute that
// is 0 at V1 and 1 at V2 is s, the position along the edge in space.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "oracle/internal/rational_number.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::mit_6837_lecture_18_test {
namespace {

/// The triangle of the edge, with attribute values at V1 and V2 (the values at V3 do not matter on
/// the edge and are 0).
cases::Case edge_case(float z2, const std::vector<float>& v1, const std::vector<float>& v2) {
  return small_case(cases::Rules::vulkan, 4, 4,
                    {{{-1, -0.75f, 0, 1}, {z2, -0.75f * z2, 0, z2}, {0, 2, 0, 2}}},
                    {{v1, v2, std::vector<float>(v1.size())}});
}

cases::Case screen_linear(cases::Case c) {
  for (cases::Attribute& a : c.attributes) a.interpolation = cases::Interpolation::noperspective;
  return c;
}

/// An attribute of the four fragments of row 0, whichever triangle draws them.
std::array<Field, 4> along_edge(const cases::Case& c, std::size_t attribute = 0) {
  const SceneTruth scene(c, cases::contract_of(c));
  std::array<Field, 4> values;
  for (std::size_t i = 0; i < 4; ++i) {
    const int x = static_cast<int>(i);
    int drawn = 0;
    for (std::size_t t = 0; t < c.triangles.size(); ++t) {
      const TriangleTruth triangle(scene, t);
      if (triangle.judge(x, 0, 0).verdict != records::Verdict::required) continue;
      ++drawn;
      values[i] = to_field(triangle.attribute(attribute, x, 0, 0).value().lo);
    }
    EXPECT_EQ(drawn, 1) << x;
  }
  return values;
}

using Four = std::array<Field, 4>;

const Four kT{Field(1, 8), Field(3, 8), Field(5, 8), Field(7, 8)};

// MIT 6.837 2000, lecture 18, slide 11: s = t z1/(z2 + t (z1 − z2)), with z1 = 1, z2 = 3: t/(3 −
// 2t) = 1/22, 3/18, 5/14, 7/10.
TEST(Mit6837Lecture18, PositionAlongTheEdgeFromPositionOnTheScreen) {
  const Four s = along_edge(edge_case(3, {0}, {1}));
  EXPECT_EQ(s, (Four{Field(1, 22), Field(1, 6), Field(5, 14), Field(7, 10)}));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(s[i], kT[i] * Field(1) / (Field(3) + kT[i] * Field(1 - 3)));
  }
}

// MIT 6.837 2000, lecture 18, slide 11, the equation behind it: x1/z1 + t (x2/z2 − x1/z1) is the
// projection of the point at s, (x1 + s (x2 − x1))/(z1 + s (z2 − z1)). Here x1/z1 = −1, x2/z2 = 1.
TEST(Mit6837Lecture18, PointAlongTheEdgeProjectsToItsPositionOnTheScreen) {
  const cases::Case c = edge_case(3, {-1, 1, 0}, {3, 3, 1});  // x, z, s
  const Four x = along_edge(c, 0);
  const Four z = along_edge(c, 1);
  const Four s = along_edge(c, 2);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(x[i] / z[i], Field(-1) + Field(2) * kT[i]);
    EXPECT_EQ(x[i], Field(-1) + Field(4) * s[i]);
    EXPECT_EQ(z[i], Field(1) + Field(2) * s[i]);
  }
}

// MIT 6.837 2000, lecture 18, slide 8: "uniform steps on the image plane do not correspond to
// uniform steps along the edge". Steps of 1/4 in t are 4/33, 4/21, 12/35 in s: they grow away from
// the eye. If both ends are equally far away, the steps do correspond.
TEST(Mit6837Lecture18, UniformStepsOnTheScreenAreNotUniformAlongTheEdge) {
  const Four s = along_edge(edge_case(3, {0}, {1}));
  EXPECT_EQ(s[1] - s[0], Field(4, 33));
  EXPECT_EQ(s[2] - s[1], Field(4, 21));
  EXPECT_EQ(s[3] - s[2], Field(12, 35));
  EXPECT_EQ(along_edge(edge_case(1, {0}, {1})), kT);
}

// MIT 6.837 2000, lecture 18, slide 11, in terms of w1 = 1/z1 = 1, w2 = 1/z2 = 1/3:
//   s = t (1/w1)/(1/w2 + t (1/w1 − 1/w2)) = t w2/(w1 + t (w2 − w1))
// The slide's w is 1/z, the reciprocal of a clip position's w. If w is read as the clip w, 1 and 3,
// the formula gives 3t/(1 + 2t), 3/10 at t = 1/8: the value of an edge with the two depths
// exchanged.
TEST(Mit6837Lecture18, PositionAlongTheEdgeFromReciprocalDepths) {
  const Four s = along_edge(edge_case(3, {0}, {1}));
  const auto slide = [](const Field& t, const Field& w1, const Field& w2) {
    return Field(t * w2 / (w1 + t * (w2 - w1)));
  };
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(s[i], slide(kT[i], Field(1), Field(1, 3)));
    EXPECT_NE(s[i], slide(kT[i], Field(1), Field(3)));
  }
  EXPECT_EQ(slide(kT[0], Field(1), Field(3)), Field(3, 10));
}

// MIT 6.837 2000, lecture 18, slide 12: u = u1 + s (u2 − u1) = (u1 w1 + t (u2 w2 − u1 w1))/(w1 + t
// (w2 − w1)). With u = 2 … 10, w = 1 … 1/4: s = t/(4 − 3t) = 1/29, 3/23, 5/17, 7/11 and u = 2 + 8s.
TEST(Mit6837Lecture18, ParameterAlongTheEdge) {
  const Four u = along_edge(edge_case(4, {2}, {10}));
  EXPECT_EQ(u, (Four{Field(66, 29), Field(70, 23), Field(74, 17), Field(78, 11)}));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(u[i], (Field(2) + kT[i] * (Field(10, 4) - Field(2))) /
                        (Field(1) + kT[i] * (Field(1, 4) - Field(1))));
  }
}

// MIT 6.837 2000, lecture 18, slides 12 and 13: numerators premultiplied by w = 1/z, and the
// denominator w, are interpolated in screen space, each by its own plane equation, and divided at
// each pixel. u w = 2 … 5/2, v w = 8 … 1 (v = 8 … 4), w = 1 … 1/4; at t = 1/8: (33/16)/(29/32) =
// 66/29 and (57/8)/(29/32) = 228/29. The scan of slide 13's code uses the name "wPlane" both for
// the plane of v w and for that of w; three different names are meant.
TEST(Mit6837Lecture18, PremultipliedParametersAreInterpolatedInScreenSpaceAndDivided) {
  const cases::Case planes = screen_linear(edge_case(4, {2, 8, 1}, {2.5f, 1, 0.25f}));
  const Four uw = along_edge(planes, 0);
  const Four vw = along_edge(planes, 1);
  const Four w = along_edge(planes, 2);
  const cases::Case correct = edge_case(4, {2, 8}, {10, 4});
  const Four u = along_edge(correct, 0);
  const Four v = along_edge(correct, 1);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(uw[i] / w[i], u[i]);
    EXPECT_EQ(vw[i] / w[i], v[i]);
  }
  EXPECT_EQ(u[0], Field(66, 29));
  EXPECT_EQ(v[0], Field(228, 29));
}

// MIT 6.837 2000, lecture 18, slide 12, the counter-check: if u is premultiplied by the clip w, 2 ·
// 1 … 10 · 4 over 1 … 4, the same recipe gives (2 + 38/8)/(1 + 3/8) = 54/11 at t = 1/8 instead of
// 66/29.
TEST(Mit6837Lecture18, PremultiplyingWithDepthItselfIsWrong) {
  const cases::Case planes = screen_linear(edge_case(4, {2, 1}, {40, 4}));
  EXPECT_EQ(along_edge(planes, 0)[0] / along_edge(planes, 1)[0], Field(54, 11));
  EXPECT_EQ(along_edge(edge_case(4, {2}, {10}))[0], Field(66, 29));
}

// MIT 6.837 2000, lecture 18, slides 16 and 17: Gouraud shading interpolates a colour in screen
// space and is wrong. A colour from 0 to 1 is t on the screen and s in space; the difference is
// 7/88, 5/24, 15/56, 7/40.
TEST(Mit6837Lecture18, ColourInScreenSpaceIsNotTheColourInPerspective) {
  const cases::Case colour = edge_case(3, {0}, {1});
  const Four gouraud = along_edge(screen_linear(colour));
  const Four exact = along_edge(colour);
  EXPECT_EQ(gouraud, kT);
  Four difference;
  for (std::size_t i = 0; i < 4; ++i) difference[i] = gouraud[i] - exact[i];
  EXPECT_EQ(difference, (Four{Field(7, 88), Field(5, 24), Field(15, 56), Field(7, 40)}));
}

/// The same triangle, cut at the middle of the edge in space: z = 2, colour 1/2, seen at t = 3/4.
cases::Case subdivided_case() {
  cases::Case c = edge_case(3, {0}, {1});
  c.positions.push_back({1, -1.5f, 0, 2});  // (V1 + V2)/2
  c.attribute_values.push_back(0.5f);
  c.triangles = {{0, 3, 2}, {3, 1, 2}};
  return c;
}

// MIT 6.837 2000, lecture 18, slide 15: subdividing reduces the artifacts of screen-space
// interpolation, but does not remove them. The colour is linear from 0 to 1/2 over t = 0 … 3/4, and
// then to 1: 1/12, 1/4, 5/12, 3/4. The errors are 5/132, 1/12, 5/84, 1/20, each less than above.
TEST(Mit6837Lecture18, SubdivisionReducesTheErrorOfScreenSpaceInterpolationWithoutRemovingIt) {
  const Four gouraud = along_edge(screen_linear(subdivided_case()));
  EXPECT_EQ(gouraud, (Four{Field(1, 12), Field(1, 4), Field(5, 12), Field(3, 4)}));
  const Four exact = along_edge(edge_case(3, {0}, {1}));
  const Four error{Field(5, 132), Field(1, 12), Field(5, 84), Field(1, 20)};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(gouraud[i] - exact[i], error[i]);
    EXPECT_LT(error[i], kT[i] - exact[i]);
  }
}

// MIT 6.837 2000, lecture 18, slide 17: the errors become obvious at T joints and between levels of
// detail, where one side of an edge is cut and the other is not: the two sides differ with
// screen-space interpolation, and agree with perspective correction.
TEST(Mit6837Lecture18, CutAndUncutSidesOfAnEdgeAgreeOnlyInPerspective) {
  const cases::Case uncut = edge_case(3, {0}, {1});
  const cases::Case cut = subdivided_case();
  EXPECT_EQ(along_edge(cut), along_edge(uncut));
  const Four left = along_edge(screen_linear(cut));
  const Four right = along_edge(screen_linear(uncut));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NE(left[i], right[i]);
}

}  // namespace
}  // namespace rastercheck::oracle::mit_6837_lecture_18_test
