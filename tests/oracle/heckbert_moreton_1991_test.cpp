// The laws of Heckbert & Moreton 1991, "Interpolation for Polygon Texture Mapping and Shading".
//
// Object space triangle (−1,−1,0), (2,−2,1), (−4,4,3); the camera keeps x and y, z = z_o/4 and
// w = z_o + 1 = 1, 2, 4. Screen corners (0,0), (8,0), (0,8), where screen is the window in pixels:
// x = 4 x_o/w + 4, y = 4 y_o/w + 4. Parameters, all object-affine:
//   r1 = x_o + y_o = −2, 0, 0     r2 = z_o = 0, 1, 3     r3 = 2, 8, 24 = x_o + 2 y_o + 5 z_o + 5
//   k = 0, 1, 0                   l = 0, 0, 1            w
// Values below are mostly at pixel (3, 2): x = 7/2, y = 5/2, where 1/w = 1 − x/16 − 3y/32 = 35/64.

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

#include "oracle/fragments.h"
#include "oracle/internal/projective_map.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/drawn.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::heckbert_moreton_1991_test {
namespace {

Field center(int pixel) { return Field(pixel) + Field(1, 2); }

enum Parameter : std::size_t { kR1, kR2, kR3, kK, kL, kW };

constexpr cases::Matrix4 kPerspective{1, 0, 0,     0,  //
                                      0, 1, 0,     0,  //
                                      0, 0, 0.25f, 0,  //
                                      0, 0, 1,     1};
constexpr cases::Matrix4 kParallel{0.25f, 0,     0,     0,  //
                                   0,     0.25f, 0,     0,  //
                                   0,     0,     0.25f, 0,  //
                                   0,     0,     0,     1};

cases::Case paper_case() {
  cases::Case c =
      small_case(cases::Rules::vulkan, 8, 8, {{{-1, -1, 0, 1}, {2, -2, 1, 1}, {-4, 4, 3, 1}}},
                 {{{-2, 0, 2, 0, 0, 1}, {0, 1, 8, 1, 0, 2}, {0, 3, 24, 0, 1, 4}}});
  c.camera = cases::Camera{cases::kIdentity, cases::kIdentity, kPerspective};
  return c;
}

/// Object positions seen by a camera, with the parameter 2, 8, 24 twice: first smooth, then linear
/// in screen space.
cases::Case two_ways(const cases::Matrix4& projection,
                     const std::array<cases::ClipVertex, 3>& positions) {
  cases::Case c = small_case(cases::Rules::vulkan, 8, 8, positions, {{{2, 2}, {8, 8}, {24, 24}}});
  c.attributes[1].interpolation = cases::Interpolation::noperspective;
  c.camera = cases::Camera{cases::kIdentity, cases::kIdentity, projection};
  return c;
}

void expect_line(const Line& line, int a, int b, int c) {
  EXPECT_EQ(line.a, Ring(a));
  EXPECT_EQ(line.b, Ring(b));
  EXPECT_EQ(line.c, Ring(c));
}

// Heckbert & Moreton 1991, §1.2: x = (a u + b v + c)/(g u + h v + i) and similarly y, in
// homogeneous form (xw, yw, w) = (uq, vq, q) [a d g; b e h; c f i]. For (u, v) = (k, l) the rows
// are the differences of the columns (xw, yw, w) = (0,0,1), (16,0,2), (0,32,4): x = 16k/(k + 3l +
// 1), y = 32l/(k + 3l + 1). Pixel (3, 2): k = 2/5, l = 1/7, 16 · 2/5 · 35/64 = 7/2.
TEST(HeckbertMoreton1991, ParametersMapToTheScreenByAHomogeneousMatrix) {
  const Drawn drawn(paper_case());
  const auto pixels = drawn.pixels();
  EXPECT_EQ(pixels.size(), 28u);  // x + y <= 6
  for (const auto& [x, y] : pixels) {
    const Field k = drawn.value(kK, x, y);
    const Field l = drawn.value(kL, x, y);
    const Field w = k + Field(3) * l + Field(1);
    EXPECT_EQ(Field(16) * k / w, center(x));
    EXPECT_EQ(Field(32) * l / w, center(y));
  }
  EXPECT_EQ(drawn.text(kK, 3, 2), "2/5");
  EXPECT_EQ(drawn.text(kL, 3, 2), "1/7");
}

// Heckbert & Moreton 1991, §1.2: projective mappings are inverted by the inverse or the adjoint
// matrix. Solving X = 16 kq, Y = 32 lq, W = kq + 3 lq + q, multiplied by 512:
//   kq = 32 X     lq = 16 Y     q = 512 W − 32 X − 48 Y
// At (X, Y, W) = (x, y, 1) these are E_1, E_2 and the sum of all E_i.
TEST(HeckbertMoreton1991, TheInverseMappingIsTheAdjointMatrix) {
  const ProjectiveMap map = Drawn(paper_case()).map();
  expect_line(map.edge(1), 32, 0, 0);
  expect_line(map.edge(2), 0, 16, 0);
  expect_line(map.inverse_w(), -32, -48, 512);
  EXPECT_EQ(map.determinant(), Ring(512));
}

// Heckbert & Moreton 1991, §1.2: the mapping is affine iff g = h = 0 and i ≠ 0; here g = w1 − w0, h
// = w2 − w0, i = w0.
TEST(HeckbertMoreton1991, MappingIsAffineExactlyWhereGAndHAreZeroAndIIsNot) {
  const auto drawn = [](float w0, float w1, float w2) {
    return Drawn(small_case(cases::Rules::vulkan, 8, 8,
                            {{{-1, -1, 0, w0}, {1, -1, 0, w1}, {-1, 1, 0, w2}}}));
  };
  EXPECT_TRUE(drawn(2, 2, 2).map().inverse_w().is_constant());
  EXPECT_FALSE(drawn(2, 3, 2).map().inverse_w().is_constant());  // g ≠ 0
  EXPECT_FALSE(drawn(2, 2, 1).map().inverse_w().is_constant());  // h ≠ 0
  EXPECT_EQ(drawn(0, 0, 0).triangle.orientation(), 0);           // i = 0
}

// Heckbert & Moreton 1991, §1.2: projective mappings preserve lines, but not equispaced points.
// Along y = 5/2, (k, l) = (4x, 5)/(49 − 4x): pixels 0, 1, 2 at (2, 5)/47, (6, 5)/43, (10, 5)/39.
TEST(HeckbertMoreton1991, LinesStayLinesAndEquispacedPointsDoNotStayEquispaced) {
  const Drawn drawn(paper_case());
  std::array<Field, 3> k;
  std::array<Field, 3> l;
  for (std::size_t i = 0; i < 3; ++i) {
    k[i] = drawn.value(kK, static_cast<int>(i), 2);
    l[i] = drawn.value(kL, static_cast<int>(i), 2);
  }
  EXPECT_EQ((k[1] - k[0]) * (l[2] - l[0]), (k[2] - k[0]) * (l[1] - l[0]));
  EXPECT_EQ(k[1], Field(6, 43));
  EXPECT_NE(k[1] - k[0], k[2] - k[1]);
}

// Heckbert & Moreton 1991, §2.1: linear interpolation in screen space is wrong for a plane seen in
// perspective. At pixel (3, 2) the screen weights 4/16, 7/16, 5/16 give (8 + 56 + 120)/16 = 23/2,
// but the value on the plane is 264/35.
TEST(HeckbertMoreton1991, ScreenLinearInterpolationIsWrongInPerspective) {
  const Drawn drawn(two_ways(kPerspective, {{{-1, -1, 0, 1}, {2, -2, 1, 1}, {-4, 4, 3, 1}}}));
  EXPECT_EQ(drawn.text(0, 3, 2), "264/35");
  EXPECT_EQ(drawn.text(1, 3, 2), "23/2");
}

// Heckbert & Moreton 1991, §2.1: screen-linear interpolation is right for a plane perpendicular to
// the line of sight (z_o = 1: w = 2), and for a parallel projection of any plane; both have the
// corners (0,0), (8,0), (0,8).
TEST(HeckbertMoreton1991, ScreenLinearInterpolationIsRightForFrontalPlanesAndParallelProjection) {
  const Drawn frontal(two_ways(kPerspective, {{{-2, -2, 1, 1}, {2, -2, 1, 1}, {-2, 2, 1, 1}}}));
  const Drawn parallel(two_ways(kParallel, {{{-4, -4, 0, 1}, {4, -4, 1, 1}, {-4, 4, 3, 1}}}));
  const auto pixels = frontal.pixels();
  EXPECT_EQ(pixels.size(), 28u);
  EXPECT_EQ(parallel.pixels(), pixels);
  for (const auto& [x, y] : pixels) {
    EXPECT_EQ(frontal.value(0, x, y), frontal.value(1, x, y));
    EXPECT_EQ(parallel.value(0, x, y), parallel.value(1, x, y));
  }
  EXPECT_EQ(frontal.text(0, 3, 2), "23/2");
  EXPECT_EQ(parallel.text(0, 3, 2), "23/2");
}

// Heckbert & Moreton 1991, §2.1: over triangles, unlike polygons of more sides, screen-linear
// interpolation is an affine mapping and does not change with a rotation. The rotation takes (x, y)
// to (−y, x) in NDC, and pixel (x, y) to (7 − y, x).
TEST(HeckbertMoreton1991, ScreenLinearInterpolationOfATriangleIsRotationInvariant) {
  const Drawn upright(two_ways(kPerspective, {{{-1, -1, 0, 1}, {2, -2, 1, 1}, {-4, 4, 3, 1}}}));
  const Drawn rotated(two_ways(kPerspective, {{{1, -1, 0, 1}, {2, 2, 1, 1}, {-4, -4, 3, 1}}}));
  for (const auto& [x, y] : upright.pixels()) {
    EXPECT_EQ(rotated.value(1, 7 - y, x), upright.value(1, x, y));
    EXPECT_EQ(rotated.value(0, 7 - y, x), upright.value(0, x, y));
  }
}

// Heckbert & Moreton 1991, figure 4, §3.1: along a scanline u(x) = (ax + b)/(cx + d). Here r3/w =
// x/4 + y/2 + 2. At y = 5/2, (x + 13)/4 over (49 − 4x)/64 is (16x + 208)/(49 − 4x), for x = 1/2 …
// 9/2.
TEST(HeckbertMoreton1991, ParameterIsARationalLinearFunctionAlongAScanline) {
  const Drawn drawn(paper_case());
  EXPECT_EQ(drawn.text(kR3, 0, 2), "216/47");
  EXPECT_EQ(drawn.text(kR3, 1, 2), "232/43");
  EXPECT_EQ(drawn.text(kR3, 2, 2), "248/39");
  EXPECT_EQ(drawn.text(kR3, 3, 2), "264/35");
  EXPECT_EQ(drawn.text(kR3, 4, 2), "280/31");
  // The figure's dashed line, linear over one polygon, lies above the curve.
  const Field chord = (drawn.value(kR3, 0, 2) + drawn.value(kR3, 4, 2)) / Field(2);
  EXPECT_LT(drawn.value(kR3, 2, 2), chord);
}

// Heckbert & Moreton 1991, §3.2, theorem: r_i/w = a_i x + b_i y + c_i, 1/w = Ax + By + C. From the
// corners:
//   r1/w = −2, 0, 0        x/4 + y/4 − 2         r2/w = 0, 1/2, 3/4     x/16 + 3y/32
//   r3/w = 2, 4, 6         x/4 + y/2 + 2         1/w = 1, 1/2, 1/4      1 − x/16 − 3y/32
// and the depth of the plane, z = αx + βy + γ: 0, 1/8, 3/16 give x/64 + 3y/128.
TEST(HeckbertMoreton1991, ParametersOverWAndOneOverWAreScreenAffine) {
  const Drawn drawn(paper_case());
  for (const auto& [px, py] : drawn.pixels()) {
    const Field x = center(px);
    const Field y = center(py);
    const Field w = drawn.value(kW, px, py);
    EXPECT_EQ(Field(1) / w, Field(1) - x / Field(16) - Field(3, 32) * y);
    EXPECT_EQ(drawn.value(kR1, px, py) / w, x / Field(4) + y / Field(4) - Field(2));
    EXPECT_EQ(drawn.value(kR2, px, py) / w, x / Field(16) + Field(3, 32) * y);
    EXPECT_EQ(drawn.value(kR3, px, py) / w, x / Field(4) + y / Field(2) + Field(2));
    EXPECT_EQ(to_field(drawn.triangle.depth(px, py, 0).value().lo),
              x / Field(64) + Field(3, 128) * y);
  }
  EXPECT_EQ(drawn.text(kR1, 3, 2), "-32/35");  // (7/8 + 5/8 − 2) · 64/35
  EXPECT_EQ(drawn.text(kR2, 3, 2), "29/35");   // 64/35 − 1
  EXPECT_EQ(drawn.triangle.depth(3, 2, 0).value().lo.to_string(), "29/256");
}

// Heckbert & Moreton 1991, §3.2, condition 3: the plane is not edge-on to the screen. The plane x_o
// = 0 contains the eye; the smallest step of one vertex away from this plane is enough for the
// theorem to apply.
TEST(HeckbertMoreton1991, EdgeOnPlaneCoversNothing) {
  cases::Case c = paper_case();
  c.positions = {{0, -1, 0, 1}, {0, -2, 1, 1}, {0, 4, 3, 1}};
  const Drawn edge_on(c);
  EXPECT_EQ(edge_on.triangle.orientation(), 0);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(edge_on.triangle.judge(x, y, 0).verdict, records::Verdict::forbidden);
    }
  }
  c.positions[1].x = 0x1p-149f;
  EXPECT_NE(Drawn(c).triangle.orientation(), 0);
}

// Heckbert & Moreton 1991, §3.3: n + 1 quantities, r_1/w … r_n/w and 1/w, each interpolated
// linearly in screen space, give all n parameters by one division each.
TEST(HeckbertMoreton1991, NPlusOneScreenLinearQuantitiesGiveNParameters) {
  const Drawn drawn(paper_case());
  cases::Case c = paper_case();
  // r1/w, r2/w, r3/w, k/w, l/w, 1/w with w = 1, 2, 4.
  c.attribute_values = {-2, 0,     2, 0,    0,     1,     //
                        0,  0.5f,  4, 0.5f, 0,     0.5f,  //
                        0,  0.75f, 6, 0,    0.25f, 0.25f};
  for (cases::Attribute& a : c.attributes) a.interpolation = cases::Interpolation::noperspective;
  const Drawn quantities(c);
  for (const auto& [x, y] : drawn.pixels()) {
    for (const std::size_t r : {kR1, kR2, kR3, kK, kL}) {
      EXPECT_EQ(quantities.value(r, x, y) / quantities.value(kW, x, y), drawn.value(r, x, y));
    }
  }
}

// Heckbert & Moreton 1991, §3.3: identical w at all vertices make the parameters screen-affine:
// 3x/4 + 11y/4 + 2.
TEST(HeckbertMoreton1991, IdenticalWMakesParametersScreenAffine) {
  const Drawn drawn(two_ways(kPerspective, {{{-2, -2, 1, 1}, {2, -2, 1, 1}, {-2, 2, 1, 1}}}));
  for (const auto& [x, y] : drawn.pixels()) {
    EXPECT_EQ(drawn.value(0, x, y), Field(3, 4) * center(x) + Field(11, 4) * center(y) + Field(2));
  }
}

// Heckbert & Moreton 1991, §3.5: clipping against the near plane, with linearly interpolated
// parameters at the new vertices, draws the values of the plane itself. V0 = (0, 5/2, −2, −1) is
// behind the eye, V1, V2 = (∓3/2, −3/2, 2, 3), and z = 0 halfway along both edges: N1, N2 = (∓3/4,
// 1/2, 0, 1). The polygon's window corners are (2,2), (6,2), (7,6), (1,6); its rows 2 … 5 hold 4,
// 4, 6, 6 samples. By hand:
//   1/w = v/6     z = 1 − v/6     r/w = 17/6 − u/3 + v/4, from 8/3, 4/3 on top and 4, 2 below
//   Pixel (3, 4): r = (17/6 − 7/6 + 9/8)/(3/4) = 67/18     Pixel (2, 2): (17 − 5 + 15/4)/(5/2)
TEST(HeckbertMoreton1991, HandClippedPolygonHasTheFragmentsOfTheUnclippedTriangle) {
  const cases::Case whole = small_case(
      cases::Rules::vulkan, 8, 8, {{{0, 2.5f, -2, -1}, {-1.5f, -1.5f, 2, 3}, {1.5f, -1.5f, 2, 3}}},
      {{{0}, {8}, {4}}});
  cases::Case clipped = whole;
  clipped.positions = {
      {-1.5f, -1.5f, 2, 3}, {1.5f, -1.5f, 2, 3}, {0.75f, 0.5f, 0, 1}, {-0.75f, 0.5f, 0, 1}};
  clipped.attribute_values = {8, 4, 2, 4};  // (0 + 4)/2, (0 + 8)/2 at the new vertices
  clipped.triangles = {{0, 1, 2}, {0, 2, 3}};

  using Values = std::pair<std::string, std::string>;
  const auto fragments = [](const cases::Case& c) {
    std::map<std::pair<int, int>, Values> found;
    const SceneTruth scene(c, cases::contract_of(c));
    for_each_fragment(scene, [&](const Fragment& f, const TriangleTruth&) {
      EXPECT_EQ(f.decision.verdict, records::Verdict::required);
      const bool is_new =
          found
              .insert({{f.place.x, f.place.y},
                       {f.attributes[0].value().lo.to_string(), f.depth.value().lo.to_string()}})
              .second;
      EXPECT_TRUE(is_new) << f.place.x << ' ' << f.place.y;
      return true;
    });
    return found;
  };
  const auto of_whole = fragments(whole);
  EXPECT_EQ(of_whole.size(), 20u);
  EXPECT_EQ(of_whole.at({3, 4}), Values("67/18", "1/4"));
  EXPECT_EQ(of_whole.at({2, 2}), Values("63/10", "7/12"));
  EXPECT_EQ(fragments(clipped), of_whole);
}

}  // namespace
}  // namespace rastercheck::oracle::heckbert_moreton_1991_test
