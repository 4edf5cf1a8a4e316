#include <gtest/gtest.h>

#include "tests/rasterizer/methods/method_draw.h"

namespace rastercheck::rasterizer::clipless_homogeneous_test {
namespace {

constexpr TargetSize kEight{8, 8, 1};
constexpr std::string_view kMethod = "clipless-homogeneous";

// Appendix 5, A 6.1–A 6.8: view space (−1, −1, 1), (2, −2, 2), (−4, 4, 4) with w = z, at (0, 0),
// (8, 0), (0, 8) in the window, so that 1/w = 1 − u/16 − 3v/32. φ = x + 2y + 3z is 0, 4, 16 at the
// vertices and φ/w = x/w + 2 y/w + 3 = (u/4 − 1) + 2 (v/4 − 1) + 3 = u/4 + v/2. Kills: a value
// taken from the plane of the parameter or of 1 alone, without their quotient.
TEST(CliplessHomogeneous, DrawsWhatIsLinearInViewSpace) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    State state = small_state(8, 8, convention);
    SmallMesh mesh;
    mesh.positions = {at(state, 0, 0, 1), at(state, 8, 0, 2), at(state, 0, 8, 4)};
    mesh.triangles = {{0, 1, 2}};
    mesh = with_attributes(state, mesh, 1, {0, 4, 16});
    const Fragments fragments = drawn_by(kMethod, state, mesh, kEight);
    EXPECT_EQ(fragments.size(), 28U);
    expect_values(fragments,
                  [](double u, double v) { return (u / 4 + v / 2) / (1 - u / 16 - 3 * v / 32); });
  }
}

// The matrix with the columns (0, 0, 1), (16, 0, 0), (0, 32, 4) has an adjugate with the rows (0,
// −64, 512), (32, 0, 0), (0, 16, 0), so that the inside is u >= 0 and 0 <= v <= 8. r = 2, 8, 24
// gives 1024 + 256 u + 256 v over 512 + 32 u − 48 v. Kills: a division by w_i.
TEST(CliplessHomogeneous, TakesAVertexAtInfinity) {
  State state = small_state(8, 8);
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0, 1), {4, 0, 0, 0}, at(state, 0, 8, 4)};
  mesh.triangles = {{0, 1, 2}};
  mesh = with_attributes(state, mesh, 1, {2, 8, 24});
  const Fragments fragments = drawn_by(kMethod, state, mesh, kEight);
  EXPECT_EQ(fragments.size(), 64U);
  expect_values(fragments, [](double u, double v) {
    return (1024 + 256 * u + 256 * v) / (512 + 32 * u - 48 * v);
  });
}

// The first test's triangle moved 8 pixels to the right, with its second vertex behind the eye.
// With u counted from u = 8, e = (1 − u/8 − v/8, −u/16, v/32), all three >= 0 where u <= 0 and 0 <=
// v <= 8 − u. r = 2, 8, 24 gives 2 − u/4 − v/4 − u/2 + 3v/4 over 1 − u/8 − v/8 − u/16 + v/32.
// Kills: |w| used for w.
TEST(CliplessHomogeneous, AVertexBehindTheEyeIsNoDifferent) {
  State state = small_state(8, 8);
  SmallMesh mesh;
  mesh.positions = {at(state, 8, 0, 1), -at(state, 16, 0, 2), at(state, 8, 8, 4)};
  mesh.triangles = {{0, 1, 2}};
  mesh = with_attributes(state, mesh, 1, {2, 8, 24});
  const Fragments fragments = drawn_by(kMethod, state, mesh, kEight);
  EXPECT_EQ(fragments.size(), 64U);
  expect_values(fragments, [](double at_u, double v) {
    const double u = at_u - 8;
    return (2 - 3 * u / 4 + v / 2) / (1 - 3 * u / 16 - 3 * v / 32);
  });
}

// The adjugate takes 9 times two products and a difference. Each coefficient of a plane takes two
// sums, and three products unless the plane is that of 1.
TEST(CliplessHomogeneous, CountsItsOperations) {
  const OperationCounts counts = operations_of(kMethod);
  EXPECT_EQ(counts.per_vertex, Operations{});
  EXPECT_EQ(counts.per_polygon, (Operations{9 + 3 * 6, 18 + 2 * 9, 0}));
  EXPECT_EQ(counts.per_pixel, (Operations{3 * 2, 3 * 2, 2}));
}

}  // namespace
}  // namespace rastercheck::rasterizer::clipless_homogeneous_test
