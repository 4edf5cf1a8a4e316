// The laws of the Rasterization slides, "Rasterization Parameter Interpolation", on one camera and
// one triangle.
//
//   eye C = (1, 2, 3), a = (1, 0, 0), b = (0, 1, 1), c = (−4, −4, 4): pixel (u, v) looks along
//   c + u a + v b = (u − 4, v − 4, v + 4)
//   corners (u, v; w) = (0, 0; 1), (8, 0; 2), (0, 8; 4), V_i = C + (c + u_i a + v_i b) w_i:
//   V1 = C + (−4,−4,4) = (−3,−2,7)
//   V2 = C + 2(4,−4,4) = (9,−6,11)
//   V3 = C + 4(−4,4,12) = (−15,18,51)
//
// The same camera as a projection. With d = P − C: d = (u−4, v−4, v+4) w, so w = (dz − dy)/8, u w =
// dx + 4w, v w = dy + 4w; clip x = u w/4 − w = dx/4, clip y = v w/4 − w = dy/4. All values below
// are at pixel (3, 2): u = 7/2, v = 5/2.

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "oracle/internal/camera_form.h"
#include "oracle/internal/projective_map.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/drawn.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::rasterization_slides_test {
namespace {

const Field kU(7, 2);
const Field kV(5, 2);

const ImagePlane kImage{.eye = {1, 2, 3}, .a = {1, 0, 0}, .b = {0, 1, 1}, .c = {-4, -4, 4}};
const std::array<FieldVector3, 3> kVertices{FieldVector3(-3, -2, 7), FieldVector3(9, -6, 11),
                                            FieldVector3(-15, 18, 51)};

ImagePlane scaled_image(const Field& lambda) {
  return {kImage.eye, lambda * kImage.a, lambda * kImage.b, lambda * kImage.c};
}

FieldMatrix3 columns(const FieldVector3& a, const FieldVector3& b, const FieldVector3& c) {
  FieldMatrix3 m;
  m.col(0) = a;
  m.col(1) = b;
  m.col(2) = c;
  return m;
}

/// The rows (λ_i of the window) / w_i, where λ = 1 − (u + v)/8, u/8, v/8.
FieldMatrix3 q_by_hand() {
  FieldMatrix3 q;
  q << Field(-1, 8), Field(-1, 8), Field(1),  //
      Field(1, 16), Field(0), Field(0),       //
      Field(0), Field(1, 32), Field(0);
  return q;
}

/// The camera as a case: view moves C to the origin, and the projection is λ times the one above,
/// with z = w/2. Attributes: r = 2, 8, 24; "C", k and l; the position P.
cases::Case camera_case(float lambda) {
  cases::Case c =
      small_case(cases::Rules::vulkan, 8, 8, {{{-3, -2, 7, 1}, {9, -6, 11, 1}, {-15, 18, 51, 1}}},
                 {{{2, 1, 0, 0, -3, -2, 7}, {8, 0, 1, 0, 9, -6, 11}, {24, 0, 0, 1, -15, 18, 51}}});
  c.camera = cases::Camera{cases::kIdentity,
                           {1, 0, 0, -1,  //
                            0, 1, 0, -2,  //
                            0, 0, 1, -3,  //
                            0, 0, 0, 1},
                           {lambda / 4, 0, 0, 0,              //
                            0, lambda / 4, 0, 0,              //
                            0, -lambda / 16, lambda / 16, 0,  //
                            0, -lambda / 8, lambda / 8, 0}};
  return c;
}

// Rasterization slides, p. 4: a u + b v + c = r at (1, 0), (7, 1), (2, 6) with r = 2, 9, 5.
// Differences: 6a + b = 7, a + 6b = 3, so a = 39/35, b = 11/35, c = r_0 − a = 31/35. The values w
// do not matter.
TEST(RasterizationSlides, ScreenSpaceInterpolationSolvesTheThreeByThreeSystem) {
  // w (u/4 − 1, v/4 − 1) for w = 1, 2, 4.
  cases::Case c =
      small_case(cases::Rules::vulkan, 8, 8,
                 {{{-0.75f, -1, 0, 1}, {1.5f, -1.5f, 0, 2}, {-2, 2, 0, 4}}}, {{{2}, {9}, {5}}});
  c.attributes[0].interpolation = cases::Interpolation::noperspective;
  const Drawn drawn(c);
  ASSERT_TRUE(drawn.covers(3, 2));
  EXPECT_EQ(drawn.text(0, 3, 2), "39/7");  // (39 · 7/2 + 11 · 5/2 + 31)/35 = 195/35
  const Derivatives slopes = drawn.triangle.derivatives(0, 3, 2, 0).value();
  EXPECT_EQ(slopes.du.to_string(), "39/35");
  EXPECT_EQ(slopes.dv.to_string(), "11/35");
}

// Rasterization slides, p. 5: of the parameters that the page lists, "1/z is the only parameter
// linear in screen space, for others it is an approximation". Corners (0,0), (8,0), (0,8), z = 1,
// 2, 4; pixel (0, 0) has screen weights 14/16, 1/16, 1/16.
//   1/z in screen space 14/16 + 1/32 + 1/64 = 59/64, so the true z is 64/59
//   z in screen space (14 + 2 + 4)/16 = 5/4
//   1/z in the triangle plane (14/16 + 1/64 + 1/256)/(59/64) = 229/236
TEST(RasterizationSlides, ReciprocalOfDepthIsLinearInScreenSpaceAndDepthIsNot) {
  cases::Case c =
      small_case(cases::Rules::vulkan, 8, 8, {{{-1, -1, 0, 1}, {2, -2, 0, 2}, {-4, 4, 0, 4}}},
                 {{{1, 1, 1, 1}, {0.5f, 2, 2, 0.5f}, {0.25f, 4, 4, 0.25f}}});
  c.attributes[0].interpolation = cases::Interpolation::noperspective;
  c.attributes[1].interpolation = cases::Interpolation::noperspective;
  const Drawn drawn(c);
  EXPECT_EQ(drawn.text(0, 0, 0), "59/64");    // 1/z, screen
  EXPECT_EQ(drawn.text(1, 0, 0), "5/4");      // z, screen
  EXPECT_EQ(drawn.text(2, 0, 0), "64/59");    // z, triangle plane
  EXPECT_EQ(drawn.text(3, 0, 0), "229/236");  // 1/z, triangle plane
}

// Rasterization slides, p. 6: P = V1 + (V2 − V1) k + (V3 − V1) l, and likewise for r. Here k = 2/5,
// l = 1/7:
//   P = (−3,−2,7) + (12,−4,4) 2/5 + (−12,20,44)/7 = (3/35, −26/35, 521/35)
//   r = 2 + 6 · 2/5 + 22/7 = 264/35
TEST(RasterizationSlides, PointsAndParametersAreLinearInThePlaneOfTheTriangle) {
  const Drawn drawn(camera_case(1));
  int covered = 0;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      if (!drawn.covers(x, y)) continue;
      ++covered;
      const Field k = drawn.value(2, x, y);
      const Field l = drawn.value(3, x, y);
      EXPECT_EQ(drawn.value(0, x, y), Field(2) + Field(6) * k + Field(22) * l);
      EXPECT_EQ(drawn.value(4, x, y), Field(-3) + Field(12) * k - Field(12) * l);
      EXPECT_EQ(drawn.value(5, x, y), Field(-2) - Field(4) * k + Field(20) * l);
      EXPECT_EQ(drawn.value(6, x, y), Field(7) + Field(4) * k + Field(44) * l);
    }
  }
  EXPECT_EQ(covered, 28);  // x + y <= 6
  EXPECT_EQ(drawn.text(4, 3, 2), "3/35");
  EXPECT_EQ(drawn.text(5, 3, 2), "-26/35");
  EXPECT_EQ(drawn.text(6, 3, 2), "521/35");
}

// Rasterization slides, p. 7: Q = [V1−C V2−C V3−C]^-1 [a b c]. Proof by multiplying back, column by
// column:
//   −1/8 (−4,−4,4) + 1/16 (8,−8,8) = (1,0,0)      −1/8 (−4,−4,4) + 1/32 (−16,16,48) = (0,1,1)
TEST(RasterizationSlides, QMatrixOfTheCameraForm) {
  const std::optional<FieldMatrix3> q = q_matrix(kVertices, kImage);
  ASSERT_TRUE(q);
  EXPECT_TRUE(*q == q_by_hand()) << *q;
}

// Rasterization slides, p. 7, the lines of w, k, l and C. Column sums of Q: −1/16, −3/32, 1.
//   1/w = 1 − 7/32 − 15/64 = 35/64     k = 7/32 w = 2/5     l = 5/64 w = 1/7     C = 1/4 w = 16/35
TEST(RasterizationSlides, FormulasOfWKLAndC) {
  const FieldMatrix3 q = q_matrix(kVertices, kImage).value();
  const FieldVector3 e = q * FieldVector3(kU, kV, 1);
  const Field w = Field(1) / (e[0] + e[1] + e[2]);
  EXPECT_EQ(w, Field(64, 35));
  EXPECT_EQ(e[1] * w, Field(2, 5));
  EXPECT_EQ(e[2] * w, Field(1, 7));
  EXPECT_EQ(e[0] * w, Field(16, 35));

  const Drawn drawn(camera_case(1));
  ASSERT_TRUE(drawn.covers(3, 2));
  EXPECT_EQ(drawn.text(1, 3, 2), "16/35");
  EXPECT_EQ(drawn.text(2, 3, 2), "2/5");
  EXPECT_EQ(drawn.text(3, 3, 2), "1/7");
}

// Rasterization slides, p. 7, last two lines. First: 2 · 16/35 + 8 · 2/5 + 24/7 = 264/35. Second:
// coefficients −2/8 + 8/16 = 1/4 of u, −2/8 + 24/32 = 1/2 of v, constant 2; (7/8 + 5/4 + 2)/(35/64)
// = 264/35.
TEST(RasterizationSlides, BothFormsOfRAgree) {
  const FieldMatrix3 q = q_matrix(kVertices, kImage).value();
  const Eigen::Matrix<Field, 1, 3> numerator = Eigen::Matrix<Field, 1, 3>(2, 8, 24) * q;
  EXPECT_EQ(numerator[0], Field(1, 4));
  EXPECT_EQ(numerator[1], Field(1, 2));
  EXPECT_EQ(numerator[2], Field(2));
  EXPECT_EQ((numerator[0] * kU + numerator[1] * kV + numerator[2]) * Field(64, 35), Field(264, 35));
  EXPECT_EQ(Field(2) * Field(16, 35) + Field(8) * Field(2, 5) + Field(24) * Field(1, 7),
            Field(264, 35));
  EXPECT_EQ(Drawn(camera_case(1)).text(0, 3, 2), "264/35");
}

// Rasterization slides, p. 7: the second line, P = C + (c + u a + v b) w, holds; the third prints
// (u, v, w) but means (u w, v w, w), and the fourth repeats the mistake.
//   P − C = (−32/35, −96/35, 416/35)
//   u a + v b + w c = (7/2 − 256/35, 5/2 − 256/35, 5/2 + 256/35)
// Nor does the printed line imply the line for w below it: its two sides, solved for 1 − k − l, k
// and l and summed, give 1 = −u/16 − 3v/32 + w, so w = 1 + 7/32 + 15/64 = 93/64, not 64/35.
TEST(RasterizationSlides, ThirdLineLacksWOnUAndV) {
  const Drawn drawn(camera_case(1));
  const FieldVector3 p(drawn.value(4, 3, 2), drawn.value(5, 3, 2), drawn.value(6, 3, 2));
  const FieldVector3 kl(drawn.value(1, 3, 2), drawn.value(2, 3, 2), drawn.value(3, 3, 2));
  const Field w(64, 35);
  const FieldMatrix3 abc = columns(kImage.a, kImage.b, kImage.c);
  const FieldVector3 ray = kImage.c + kU * kImage.a + kV * kImage.b;
  EXPECT_TRUE(p == FieldVector3(kImage.eye + ray * w)) << p;

  const FieldVector3 corrected = abc * FieldVector3(kU * w, kV * w, w);
  EXPECT_TRUE(corrected == FieldVector3(p - kImage.eye)) << corrected;
  const FieldVector3 printed = abc * FieldVector3(kU, kV, w);
  EXPECT_TRUE(printed == FieldVector3(Field(-267, 70), Field(-337, 70), Field(687, 70))) << printed;
  EXPECT_FALSE(printed == FieldVector3(p - kImage.eye));

  const FieldMatrix3 q = q_by_hand();
  EXPECT_TRUE(FieldVector3(q * FieldVector3(kU * w, kV * w, w)) == kl);
  EXPECT_FALSE(FieldVector3(q * FieldVector3(kU, kV, w)) == kl);
  const FieldVector3 sums = q.colwise().sum().transpose();
  EXPECT_EQ((Field(1) - sums[0] * kU - sums[1] * kV) / sums[2], Field(93, 64));
}

// Rasterization slides, p. 7 against RULES §1: if [a b c] inverts the map from V − C to (X, Y, w),
// the clip form has the same Q. M = columns (0,0,1), (16,0,2), (0,32,4), det M = 512.
TEST(RasterizationSlides, ClipFormIsTheCameraForm) {
  const Drawn drawn(camera_case(1));
  const FieldMatrix3 abc = columns(kImage.a, kImage.b, kImage.c);
  std::array<RingVector3, 3> m;
  for (std::size_t i = 0; i < 3; ++i) {
    m[i] = drawn.scene.scene().window_column(i);
    const auto column = FieldVector3(Field(m[i][0]), Field(m[i][1]), Field(m[i][2]));
    EXPECT_TRUE(FieldVector3(abc * column) == FieldVector3(kVertices[i] - kImage.eye)) << i;
  }
  const ProjectiveMap map(m);
  EXPECT_EQ(map.determinant(), Ring(512));
  const FieldMatrix3 q = q_by_hand();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    EXPECT_EQ(quotient(map.edge(i).a, map.determinant()), q(row, 0));
    EXPECT_EQ(quotient(map.edge(i).b, map.determinant()), q(row, 1));
    EXPECT_EQ(quotient(map.edge(i).c, map.determinant()), q(row, 2));
  }
}

// Rasterization slides, p. 7: scaling (a, b, c) scales Q by the same factor and w by its inverse,
// and does not change k, l, C and r. On the clip side, doubling the projection halves the clip
// form's e.
TEST(RasterizationSlides, MultipleOfTheImagePlaneLeavesTheParameters) {
  for (const Field& lambda : {Field(3), Field(2, 7), Field(-1)}) {
    const std::optional<FieldMatrix3> q = q_matrix(kVertices, scaled_image(lambda));
    ASSERT_TRUE(q);
    EXPECT_TRUE(*q == FieldMatrix3(lambda * q_by_hand()));
    const FieldVector3 e = *q * FieldVector3(kU, kV, 1);
    const Field w = Field(1) / (e[0] + e[1] + e[2]);
    EXPECT_EQ(w, Field(64, 35) / lambda);
    EXPECT_EQ(e[1] * w, Field(2, 5));
    EXPECT_EQ(e[2] * w, Field(1, 7));
  }
  const Drawn twice(camera_case(2));
  EXPECT_EQ(twice.scene.scene().window_column(1)[2], Ring(4));  // w of V2 was 2
  ASSERT_TRUE(twice.covers(3, 2));
  EXPECT_EQ(twice.text(0, 3, 2), "264/35");
  EXPECT_EQ(twice.text(2, 3, 2), "2/5");
  EXPECT_EQ(twice.text(3, 3, 2), "1/7");
}

// Rasterization slides, p. 7 with λ < 0: the same lines of sight, but the triangle is behind the
// eye (w < 0).
TEST(RasterizationSlides, NegativeMultipleIsBehindTheEyeAndCoversNothing) {
  const Drawn behind(camera_case(-1));
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(behind.triangle.judge(x, y, 0).verdict, records::Verdict::forbidden);
    }
  }
}

// Rasterization slides, p. 7, RULES §1: facing is sign(det M_cam · det [a b c]), here of 8 · 512
// and 8; swapping two vertices reverses the facing.
TEST(RasterizationSlides, FacingIsTheSignOfTheTwoDeterminants) {
  const FieldMatrix3 m_cam =
      columns(kVertices[0] - kImage.eye, kVertices[1] - kImage.eye, kVertices[2] - kImage.eye);
  EXPECT_EQ(columns(kImage.a, kImage.b, kImage.c).determinant(), Field(8));
  EXPECT_EQ(m_cam.determinant(), Field(4096));
  cases::Case c = camera_case(1);
  EXPECT_EQ(Drawn(c).triangle.orientation(), 1);
  c.triangles = {{0, 2, 1}};
  EXPECT_EQ(Drawn(c).triangle.orientation(), -1);
}

// Rasterization slides, p. 7: the inverse exists unless the plane of the triangle contains the eye.
// V3 is moved to the midpoint of C and the middle of V1 and V2, ((1,2,3) + (3,−4,9))/2 = (2,−1,6).
TEST(RasterizationSlides, PlaneThroughTheEyeHasNoQMatrixAndCoversNothing) {
  std::array<FieldVector3, 3> vertices = kVertices;
  vertices[2] = FieldVector3(2, -1, 6);
  EXPECT_FALSE(q_matrix(vertices, kImage));
  cases::Case c = camera_case(1);
  c.positions[2] = {2, -1, 6, 1};
  const Drawn edge_on(c);
  EXPECT_EQ(edge_on.triangle.orientation(), 0);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(edge_on.triangle.judge(x, y, 0).verdict, records::Verdict::forbidden);
    }
  }
}

}  // namespace
}  // namespace rastercheck::oracle::rasterization_slides_test
