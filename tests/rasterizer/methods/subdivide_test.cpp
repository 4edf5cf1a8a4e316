#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/rasterizer/methods/method_draw.h"

namespace rastercheck::rasterizer::subdivide_test {
namespace {

constexpr TargetSize kFour{4, 4, 1};

double share_promised(const std::string& method, const SmallMesh& mesh) {
  return find_method(method)->promise(small_state(4, 4), mesh.mesh(), kFour).smooth.range_share;
}

State one_attribute(int size) {
  State state = small_state(size, size);
  state.attributes = {{}};
  return state;
}

/// A right triangle with legs of `size` pixels. The end of the leg along u has the given w and the
/// attribute `value`; the other two vertices have w = 1 and the attribute 0. So r depends on u
/// alone.
SmallMesh leaning(const State& state, float size, float w, float value = 1) {
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0), at(state, size, 0, w), at(state, 0, size)};
  mesh.attributes = {0, value, 0};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

// With w = 3 at u = 4, the middle of an edge to that vertex has w = 2 and lies at u = (0 · 1 + 4 ·
// 3)/2/2 = 3, where the attribute is 1/2. So the attribute is u/6 up to u = 3, and 1/2 + (u − 3)/2
// beyond. (In exact perspective it is u/(12 − 2u).) Kills: new vertices halfway in the window, at u
// = 2; the lower piece's function in both pieces.
TEST(Subdivide, InTwoBendsAtTheMiddlesOfTheEdges) {
  const State state = one_attribute(4);
  expect_values(drawn_by("subdivide-2", state, leaning(state, 4, 3), kFour),
                [](double u, double) { return u <= 3 ? u / 6 : 0.5 + (u - 3) / 2; });
}

// r = b_1 + b_2 is 0, 1, 1 at the vertices. At the middles of the edges it is 1/2 at (3, 0) and (0,
// 2), and 1 at (3, 1). In the piece between these three, r = u/3 + v/2 − 1/2; in the piece at (0,
// 0) it is u/6 + v/4.
TEST(Subdivide, GivesTheMiddlePieceItsOwnFunction) {
  const State state = one_attribute(4);
  SmallMesh mesh = leaning(state, 4, 3);
  mesh.attributes = {0, 1, 1};
  const Fragments fragments = drawn_by("subdivide-2", state, mesh, kFour);
  // (5/2, 1/2) is beyond the line from (3, 0) to (0, 2), but (1/2, 1/2) is not.
  EXPECT_NEAR(value_at(fragments, 2, 0), 7.0 / 12, 0x1p-25);
  EXPECT_NEAR(value_at(fragments, 0, 0), 5.0 / 24, 0x1p-26);
}

// --- How far it is off ---------------------------------------------------------------------------

/// (√ρ − 1)/(√ρ + 1)/n with ρ = 1 + (ratio − 1)/n.
double share_of(double ratio, int n) {
  const double root = std::sqrt(1 + (ratio - 1) / n);
  return (root - 1) / (root + 1) / n;
}

/// The worst error on the triangle `leaning` with this w at its end, as a share of the range.
double worst_error(const std::string& method, float w) {
  constexpr int kSize = 128;
  const State state = one_attribute(kSize);
  const Fragments fragments = drawn_by(method, state, leaning(state, kSize, w), {kSize, kSize, 1});
  double worst = 0;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const double e = (fragments.x[i] + 0.5) / kSize / w;
    const double exact = e / (1 - e * w + e);
    worst = std::max(worst, std::abs(fragments.attributes[i] - exact));
  }
  return worst;
}

// Kills: errors beyond the bound; a bound that is far too large; pieces that are not used.
TEST(Subdivide, IsOffByTheBoundThatItPromises) {
  for (const float w : {1.0F, 1.5F, 4.0F, 9.0F, 100.0F}) {
    const SmallMesh mesh = leaning(one_attribute(4), 4, w);
    for (const int n : {1, 2, 4, 8, 16}) {
      const std::string method = n == 1 ? "screen-linear" : "subdivide-" + std::to_string(n);
      const double bound = share_of(w, n);
      if (n > 1) {
        EXPECT_NEAR(share_promised(method, mesh), bound, 0x1p-19 * bound);
      }
      const double worst = worst_error(method, w);
      EXPECT_LE(worst, bound + 0x1p-24) << method << ", w = " << w;
      EXPECT_GE(worst, 0.96 * bound) << method << ", w = " << w;
    }
  }
}

// Near n = 8, a triangle with w from 1 to 3/2 has an error of nearly (1/2)/(4 n²) of the range.
TEST(Subdivide, TwiceAsManyPiecesAreOffByAFourth) {
  double before = worst_error("subdivide-4", 1.5F);
  for (const char* method : {"subdivide-8", "subdivide-16"}) {
    const double now = worst_error(method, 1.5F);
    EXPECT_NEAR(before / now, 4, 0.2) << method;
    before = now;
  }
}

TEST(Subdivide, PromisesOfMeshesTheMostOfTheirTriangles) {
  const State state = one_attribute(4);
  SmallMesh mesh = leaning(state, 4, 3);
  const SmallMesh other = leaning(state, 4, 9);
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.triangles.push_back({3, 4, 5});
  EXPECT_NEAR(share_promised("subdivide-2", mesh), share_of(9, 2), 0x1p-19);
  mesh.positions[4].w = 0;
  EXPECT_NEAR(share_promised("subdivide-2", mesh), 0.5, 0x1p-19);
  EXPECT_NEAR(share_promised("subdivide-16", mesh), 1.0 / 16, 0x1p-19);
  // A triangle wholly behind the eye, or with a NaN, is not drawn.
  for (std::size_t i = 3; i < 6; ++i) mesh.positions[i].w = -1;
  EXPECT_NEAR(share_promised("subdivide-2", mesh), share_of(3, 2), 0x1p-19);
  mesh.positions[4].w = NAN;
  EXPECT_NEAR(share_promised("subdivide-2", mesh), share_of(3, 2), 0x1p-19);
}

// The vertices are (0, 0) and (0, 4) with w = 1 and the attribute 0, and (−4, 0) with w = −1 and
// the attribute 1, so that r = u/(4 + 2u). The middles of the edges to the last vertex have w = 0
// and r = 1/2, so that all four pieces are cut. The two pieces at the corners in front have the
// mean of 0, 1/2, 0, and the piece in the middle has the mean of 1/2, 0, 1/2.
TEST(Subdivide, PiecesThatTheEyesPlaneCutsHaveOneValue) {
  const State state = one_attribute(4);
  SmallMesh mesh = leaning(state, -4, -1);
  mesh.positions[2] = at(state, 0, 4);
  const Fragments fragments = drawn_by("subdivide-2", state, mesh, kFour);
  EXPECT_EQ(fragments.size(), 16U);
  // b_1 < 1/2 everywhere; b_2 = (v/4)/(1 + u/2), and the middle piece has b_1 + b_2 > 1/2 and b_2 <
  // 1/2.
  EXPECT_EQ(value_at(fragments, 0, 0), 1.0F / 6);
  EXPECT_EQ(value_at(fragments, 3, 3), 1.0F / 3);
  EXPECT_EQ(value_at(fragments, 0, 3), 1.0F / 6);
  for (const int n : {2, 4, 8, 16}) {
    const Fragments finer = drawn_by("subdivide-" + std::to_string(n), state, mesh, kFour);
    for (std::size_t i = 0; i < finer.size(); ++i) {
      const double u = finer.x[i] + 0.5;
      EXPECT_NEAR(finer.attributes[i], u / (4 + 2 * u), 1.0 / n);
    }
  }
}

// Kills: pieces extended beyond the triangle. Its hypotenuse u + v = 17/4 has samples on the inner
// side in pixels whose centres lie beyond it.
TEST(Subdivide, ExtrapolatesByTheRationalFormula) {
  State state = one_attribute(4);
  state.attributes[0].location = Location::center;
  const Fragments fragments = drawn_by("subdivide-2", state, leaning(state, 4.25F, 2), {4, 4, 16});
  int outside = 0;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const double u = fragments.x[i] + 0.5;
    if (u + fragments.y[i] + 0.5 < 4.25) continue;
    ++outside;
    EXPECT_NEAR(fragments.attributes[i], u / (8.5 - u), 0x1p-24);
  }
  EXPECT_GT(outside, 0);
}

// --- The adaptive method -------------------------------------------------------------------------

// Kills: splitting that stops too early; splitting that is not needed.
TEST(SubdivideAdaptive, IsOffByItsToleranceUnlessTheBudgetEnds) {
  constexpr double kTolerance = 1.0 / 256;
  // For n = 1 and ρ = (515/513)², (√ρ − 1)/(√ρ + 1) = 1/514, so that nothing is split.
  const auto gentle = static_cast<float>(515.0 * 515 / (513.0 * 513));
  EXPECT_EQ(worst_error("subdivide-adaptive", gentle), worst_error("screen-linear", gentle));
  for (const float w : {1.5F, 4.0F, 9.0F}) {
    EXPECT_LE(worst_error("subdivide-adaptive", w), kTolerance + 0x1p-24);
    const SmallMesh mesh = leaning(one_attribute(4), 4, w);
    EXPECT_NEAR(share_promised("subdivide-adaptive", mesh), kTolerance, 0x1p-19 * kTolerance);
    // A piece is split if its error is above the tolerance, and the split divides the error by
    // about 4.
    EXPECT_GT(worst_error("subdivide-adaptive", w), kTolerance / 4);
  }
  // An edge has at most 32 pieces.
  for (const float w : {100.0F, 4096.0F}) {
    const double bound = share_of(w, 32);
    EXPECT_GT(bound, kTolerance);
    const SmallMesh mesh = leaning(one_attribute(4), 4, w);
    EXPECT_NEAR(share_promised("subdivide-adaptive", mesh), bound, 0x1p-19 * bound);
    EXPECT_LE(worst_error("subdivide-adaptive", w), bound + 0x1p-24);
    EXPECT_GT(worst_error("subdivide-adaptive", w), kTolerance);
  }
}

// --- Operations ----------------------------------------------------------------------------------

// Four pieces per edge have 5 · 6/2 − 3 = 12 new vertices. Each has x, y, w and two attributes,
// computed as five means of three products, two sums and a division.
TEST(Subdivide, CountsOperationsOfAllPieces) {
  const OperationCounts one = find_method("screen-linear")->operations();
  const OperationCounts four = find_method("subdivide-4")->operations();
  EXPECT_EQ(four.per_polygon.additions, 16 * one.per_polygon.additions + 120);
  EXPECT_EQ(four.per_polygon.multiplications,
            16 * one.per_polygon.multiplications + 12 * (15 + one.per_vertex.multiplications));
  EXPECT_EQ(four.per_polygon.divisions,
            16 * one.per_polygon.divisions + 12 * (5 + one.per_vertex.divisions));
  EXPECT_EQ(four.per_vertex, one.per_vertex);
  EXPECT_EQ(four.per_pixel, one.per_pixel);
  EXPECT_EQ(four.per_pixel.divisions, 0U);
  // For w = 1, 2, 4, pieces of 16 per edge remain where w is about 1, since (4/1 − 1)/(4 · 8²) >
  // 2^-8.
  const auto polygon = [](const char* name) {
    return find_method(name)->operations().per_polygon.total();
  };
  EXPECT_GT(polygon("subdivide-adaptive"), polygon("subdivide-8"));
}

}  // namespace
}  // namespace rastercheck::rasterizer::subdivide_test
