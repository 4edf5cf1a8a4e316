#include "rasterizer/methods/internal/projective_inference.h"

#include <gtest/gtest.h>

#include "rasterizer/methods/internal/counted.h"
#include "tests/rasterizer/methods/method_draw.h"

namespace rastercheck::rasterizer::projective_inference_test {
namespace {

constexpr TargetSize kEight{8, 8, 1};
constexpr std::string_view kMethod = "projective-inference";

using Vector = Triple<double>;

// Corners (0, 0), (8, 0), (0, 8) of the window, w = 1, 2, 4.
constexpr std::array<Vector, 3> kPositions{Vector{0, 0, 1}, {16, 0, 2}, {0, 32, 4}};
// The texture coordinates (1, 1), (3, 1), (1, 5), with det = 2 · 4.
constexpr TextureTriangle<double> kTexture{{1, 3, 1}, {1, 1, 5}};

// ∂P/∂s = (P_1 − P_0)/2, ∂P/∂t = (P_2 − P_0)/4, origin = P_0 less both.
TEST(ProjectiveInference, InfersTheParameterization) {
  const TextureToObject<double> map = infer_parameterization(kTexture, kPositions);
  EXPECT_EQ(map[0], (std::array<double, 4>{8, 0, 0.5, 0}));
  EXPECT_EQ(map[1], (std::array<double, 4>{0, 8, 0.75, 0}));
  EXPECT_EQ(map[2], (std::array<double, 4>{-8, -8, -0.25, 1}));
}

// Kills: the last row, or the last column, left out.
TEST(ProjectiveInference, ConcatenatesWithTheWholeMatrix) {
  const ObjectToScreen<double> screen{Vector{2, 0, 0}, {0, 3, 0}, {1, 0, 1}, {0, 0, 5}};
  const std::array<Vector, 3> product =
      concatenate(infer_parameterization(kTexture, kPositions), screen);
  EXPECT_EQ(product[0], (Vector{16.5, 0, 0.5}));
  EXPECT_EQ(product[1], (Vector{0.75, 24, 0.75}));
  EXPECT_EQ(product[2], (Vector{-16.25, -24, 4.75}));
}

// Kills: the adjugate's transpose.
TEST(ProjectiveInference, TakesTheWindowBackToTheTexture) {
  const std::array<Vector, 3> planes =
      screen_to_texture(std::array<Vector, 3>{Vector{8, 0, 0.5}, {0, 8, 0.75}, {-8, -8, -0.25}});
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector& p = kPositions[i];
    const Vector texture = transform(planes, p[0] / p[2], p[1] / p[2]);
    EXPECT_EQ(texture[0] / texture[2], kTexture.s[i]);
    EXPECT_EQ(texture[1] / texture[2], kTexture.t[i]);
  }
}

// Heckbert & Moreton 1991, §3.1: "133 arithmetic operations (multiplies and adds) per polygon, plus
// 12 arithmetic operations per vertex". Besides, the method moves the texture's origin, and moves
// it back at each place.
TEST(ProjectiveInference, TakesTheOperationsOfThePaper) {
  const auto number = [](double value) { return Counted(value); };
  TextureTriangle<Counted> texture;
  std::array<Triple<Counted>, 3> positions;
  ObjectToScreen<Counted> screen;
  for (std::size_t i = 0; i < 3; ++i) {
    texture.s[i] = number(kTexture.s[i]);
    texture.t[i] = number(kTexture.t[i]);
    for (std::size_t j = 0; j < 3; ++j) positions[i][j] = number(kPositions[i][j]);
  }
  TextureToObject<Counted> inferred;
  const Operations inference =
      count_operations([&] { inferred = infer_parameterization(texture, positions); });
  std::array<Triple<Counted>, 3> matrix;
  const Operations concatenation =
      count_operations([&] { matrix = concatenate(inferred, screen); });
  std::array<Triple<Counted>, 3> planes;
  const Operations inversion = count_operations([&] { planes = screen_to_texture(matrix); });
  const Operations vertex = count_operations([&] { transform(planes, Counted(1), Counted(2)); });
  const auto multiplies_and_adds = [](const Operations& operations) {
    return operations.additions + operations.multiplications;
  };
  EXPECT_EQ(multiplies_and_adds(inference), 43U);
  EXPECT_EQ(inference.divisions, 6U);
  EXPECT_EQ(multiplies_and_adds(concatenation), 63U);
  EXPECT_EQ(multiplies_and_adds(inversion), 27U);
  EXPECT_EQ(multiplies_and_adds(vertex), 12U);
  const OperationCounts counts = operations_of(kMethod);
  EXPECT_EQ(counts.per_vertex, Operations{});
  EXPECT_EQ(multiplies_and_adds(counts.per_polygon), 133U + 4);
  EXPECT_EQ(counts.per_polygon.divisions, 6U);
  EXPECT_EQ(counts.per_pixel, (Operations{6 + 2, 6, 2}));
}

/// A mesh of kPositions with these attribute values, [vertex][attribute].
SmallMesh with_values(State& state, std::size_t count, std::vector<float> values) {
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0, 1), at(state, 8, 0, 2), at(state, 0, 8, 4)};
  mesh.triangles = {{0, 1, 2}};
  return with_attributes(state, mesh, count, std::move(values));
}

/// r at (u, v) for these values at the three vertices, whose weights are 1 − (u + v)/8, u/16 and
/// v/32.
double r_by_hand(double r0, double r1, double r2, double u, double v) {
  const double e0 = 1 - (u + v) / 8;
  return (r0 * e0 + r1 * u / 16 + r2 * v / 32) / (e0 + u / 16 + v / 32);
}

void expect_attribute(const Fragments& fragments, std::size_t count, std::size_t attribute,
                      const Vector& r) {
  ASSERT_EQ(fragments.size(), 28U);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const double exact = r_by_hand(r[0], r[1], r[2], fragments.x[i] + 0.5, fragments.y[i] + 0.5);
    EXPECT_NEAR(fragments.attributes[i * count + attribute], exact,
                0x1.001p-24 * std::abs(exact) + 0x1p-40)
        << attribute;
  }
}

TEST(ProjectiveInference, DrawsAPairAndWhatIsLeft) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    State state = small_state(8, 8, convention);
    const SmallMesh mesh = with_values(state, 3, {2, 4, -1, 8, 2, 3, 24, 0, 5});
    const Fragments fragments = drawn_by(kMethod, state, mesh, kEight);
    expect_attribute(fragments, 3, 0, {2, 8, 24});
    expect_attribute(fragments, 3, 1, {4, 2, 0});
    expect_attribute(fragments, 3, 2, {-1, 3, 5});
  }
}

// The second attribute is 2 r + 1 if r is the first. The third is constant, and pairs with neither
// neighbour. The fourth and fifth, taken as points, lie on a line except for 2^-20. Kills: a
// division by det = 0; a constant that changes.
TEST(ProjectiveInference, TakesAloneWhatIsNoTexture) {
  State state = small_state(8, 8);
  const float nearly = 1 + 0x1p-20F;
  const SmallMesh mesh =
      with_values(state, 5, {2, 5, 0.1F, 0, 0, 8, 17, 0.1F, 1, 1, 24, 49, 0.1F, 1, nearly});
  const Fragments fragments = drawn_by(kMethod, state, mesh, kEight);
  expect_attribute(fragments, 5, 0, {2, 8, 24});
  expect_attribute(fragments, 5, 1, {5, 17, 49});
  expect_attribute(fragments, 5, 3, {0, 1, 1});
  expect_attribute(fragments, 5, 4, {0, 1, nearly});
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    EXPECT_EQ(fragments.attributes[5 * i + 2], 0.1F);
  }
}

double promised(State& state, const std::vector<float>& values) {
  SmallMesh mesh = with_values(state, values.size() / 3, values);
  for (std::size_t i = 0; i < 3; ++i) mesh.positions[i] /= mesh.positions[i].w;
  return find_method(kMethod)->promise(state, mesh.mesh(), kEight).smooth.per_condition * 0x1p28;
}

// w = 1: |X| = |Y| = 8 and |w| = 1 at all vertices, R = 2/6. The promise is 2^-28 · 400 κ² R.
//   (0, 0), (1, 0), (0, 1)  κ = 1, also far from the origin
//   (0, 0), (1, 1), (0, 1)  κ = 1 · 2/1
//   r = 3, 7, 3             not paired: κ = 4²/4²
//   det = 2^-20             neither paired, the first with κ = 2²/2
//   all equal               only roundings to float32
TEST(ProjectiveInference, PromiseDependsOnTheTexture) {
  State state = small_state(8, 8);
  EXPECT_DOUBLE_EQ(promised(state, {0, 0, 1, 0, 0, 1}), 400.0 / 3);
  EXPECT_DOUBLE_EQ(promised(state, {4096, 0, 4097, 0, 4096, 1}), 400.0 / 3);
  EXPECT_DOUBLE_EQ(promised(state, {0, 0, 1, 1, 0, 1}), 1600.0 / 3);
  EXPECT_DOUBLE_EQ(promised(state, {3, 7, 3}), 400.0 / 3);
  EXPECT_DOUBLE_EQ(promised(state, {0, 0, 1, 1, 1, 1 + 0x1p-20F}), 1600.0 / 3);
  EXPECT_EQ(promised(state, {3, 3, 3}), 0);
}

// The second attribute's values are far from 0. The first attribute's values are the same as in a
// picture where the second's are near 0. Kills: an origin of the texture that costs both attributes
// digits.
TEST(ProjectiveInference, WhereTheTextureIsCostsNothing) {
  State state = small_state(8, 8);
  const Fragments near =
      drawn_by(kMethod, state, with_values(state, 2, {2, 0, 8, 1, 24, 0}), kEight);
  const Fragments far = drawn_by(
      kMethod, state, with_values(state, 2, {2, 0x1p23F, 8, 0x1p23F + 1, 24, 0x1p23F}), kEight);
  ASSERT_EQ(near.size(), 28U);
  for (std::size_t i = 0; i < near.size(); ++i) {
    EXPECT_EQ(near.attributes[2 * i], far.attributes[2 * i]);
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::projective_inference_test
