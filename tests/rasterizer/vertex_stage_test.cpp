// The vertex stage, compared with GMP's rationals within the bounds that its header derives.

#include "rasterizer/vertex_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "tests/rasterizer/exact.h"
#include "tests/rasterizer/failing_allocator.h"

namespace rastercheck::rasterizer::vertex_stage_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Exact4 = std::array<Rational, 4>;

/// matrix · column or, if `of_sizes`, the magnitudes of the matrix's numbers · column.
Exact4 product(const glm::mat4& matrix, const Exact4& column, bool of_sizes) {
  Exact4 result;
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      const Rational factor(
          double{matrix[static_cast<glm::length_t>(c)][static_cast<glm::length_t>(r)]});
      result[r] += (of_sizes ? Rational(abs(factor)) : factor) * column[c];
    }
  }
  return result;
}

Exact4 exact_clip(const Camera& camera, const glm::vec4& p, bool of_sizes) {
  Exact4 column;
  for (std::size_t i = 0; i < 4; ++i) {
    column[i] = Rational(double{p[static_cast<glm::length_t>(i)]});
    if (of_sizes) column[i] = abs(column[i]);
  }
  for (const glm::mat4* matrix : {&camera.model, &camera.view, &camera.projection}) {
    column = product(*matrix, column, of_sizes);
  }
  return column;
}

void expect_within_bound(const Camera& camera, const glm::vec4& p, const glm::vec4& clip) {
  const Exact4 exact = exact_clip(camera, p, false);
  const Exact4 sizes = exact_clip(camera, p, true);
  for (std::size_t k = 0; k < 4; ++k) {
    const float f = clip[static_cast<glm::length_t>(k)];
    const Rational beyond = Rational(double{kTransformBound}) * power_of_two(-53) * sizes[k];
    if (std::isinf(f)) {
      const Rational outwards = f < 0 ? Rational(-exact[k]) : exact[k];
      EXPECT_GE(outwards + beyond, power_of_two(128) - power_of_two(103));
      continue;
    }
    ASSERT_TRUE(std::isfinite(f));
    const Rational computed(double{f});
    EXPECT_LE(Rational(abs(computed - exact[k])), beyond + float_ulp(computed) / 2);
  }
}

glm::mat4 random_matrix(Random& random, int low, int high) {
  glm::mat4 matrix;
  for (glm::length_t c = 0; c < 4; ++c) {
    for (glm::length_t r = 0; r < 4; ++r) matrix[c][r] = random.real(low, high);
  }
  return matrix;
}

glm::vec4 random_position(Random& random, int low, int high) {
  glm::vec4 p;
  for (glm::length_t i = 0; i < 4; ++i) p[i] = random.real(low, high);
  return p;
}

TEST(VertexStage, StaysWithinItsBound) {
  Random random(1);
  for (int i = 0; i < 4000; ++i) {
    const int low = random.pick({-149, -40, -4, 0});
    const int high = random.pick({0, 4, 40, 126});
    const Camera camera{random_matrix(random, low, high), random_matrix(random, low, high),
                        random_matrix(random, low, high)};
    std::vector<glm::vec4> positions;
    for (int k = 0; k < 3; ++k) positions.push_back(random_position(random, low, high));
    std::vector<glm::vec4> clip;
    ASSERT_EQ(transform(camera, positions, clip), std::nullopt);
    ASSERT_EQ(clip.size(), positions.size());
    for (std::size_t k = 0; k < 3; ++k) expect_within_bound(camera, positions[k], clip[k]);
  }
}

// If the model moves far away and the view moves back, only the difference is left.
TEST(VertexStage, StaysWithinItsBoundWhereMatricesCancel) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    Camera camera;
    camera.model = random_matrix(random, -1, 1);
    for (glm::length_t r = 0; r < 3; ++r) {
      const float far = random.real(10, 60);
      camera.model[3][r] = far;
      camera.view[3][r] = std::nextafter(-far, random.one_in(2) ? 0.0F : -kInfinity);
    }
    camera.model[0][3] = camera.model[1][3] = camera.model[2][3] = 0;
    camera.model[3][3] = 1;
    camera.projection = random_matrix(random, -2, 2);
    const std::vector<glm::vec3> positions{glm::vec3(random_position(random, -3, 0))};
    std::vector<glm::vec4> clip;
    ASSERT_EQ(transform(camera, positions, clip), std::nullopt);
    expect_within_bound(camera, glm::vec4(positions[0], 1), clip[0]);
  }
}

TEST(VertexStage, MultipliesModelThenViewThenProjection) {
  Camera camera;
  camera.model[0][0] = 3;       // 3 x
  camera.view[3][0] = 10;       // x + 10
  camera.projection[0][0] = 2;  // 2 x
  camera.projection[2][3] = -1;
  camera.projection[3][3] = 0;
  std::vector<glm::vec4> clip;
  EXPECT_EQ(transform(camera, std::vector<glm::vec4>{{1, 2, 5, 1}}, clip), std::nullopt);
  EXPECT_EQ(transform(camera, std::vector<glm::vec3>{{1, 2, 5}}, clip), std::nullopt);
  EXPECT_THAT(clip, testing::ElementsAre(glm::vec4(26, 2, 5, -5), glm::vec4(26, 2, 5, -5)));
}

TEST(VertexStage, RoundsOnce) {
  Camera camera;
  camera.projection[1][0] = 0x1p-24F;  // 1 + 2^-24 is a tie; float32 would lose a further 2^-48
  camera.projection[2][0] = 0x1p-48F;
  std::vector<glm::vec4> clip;
  ASSERT_EQ(transform(camera, std::vector<glm::vec4>{{1, 1, 0, 1}, {1, 1, 1, 1}}, clip),
            std::nullopt);
  EXPECT_EQ(clip[0].x, 1);
  EXPECT_EQ(clip[1].x, 0x1.000002p0F);
}

TEST(VertexStage, MakesWhatIsBeyondFloat32InfiniteAndADrawDiscardsIt) {
  Camera camera;
  camera.projection[0][0] = 2;
  const float most = std::numeric_limits<float>::max();
  const std::vector<glm::vec4> positions{
      {most, 0, 0, 1}, {0, 1, 0, 1}, {1, 0, 0, 1}, {kInfinity, 0, 0, 1}};
  std::vector<glm::vec4> clip;
  ASSERT_EQ(transform(camera, positions, clip), std::nullopt);
  EXPECT_EQ(clip[0].x, kInfinity);
  EXPECT_FALSE(std::isfinite(clip[3].x));
  State state;
  state.viewport.size = {4, 4};
  const std::vector<glm::uvec3> triangles{{0, 1, 2}, {3, 1, 2}};
  Fragments fragments;
  const DrawResult drawn = draw_fragments(state, {clip, {}, {}, triangles}, {4, 4, 1}, fragments);
  EXPECT_EQ(drawn.error, std::nullopt);
  EXPECT_EQ(drawn.counts.discarded_not_finite, 2U);
  EXPECT_EQ(fragments.size(), 0U);
}

// A camera that is not finite gives no finite position.
TEST(VertexStage, MakesNoNumbersOfWhatIsNone) {
  Random random(3);
  for (int i = 0; i < 48; ++i) {
    Camera camera{random_matrix(random, -4, 4), random_matrix(random, -4, 4),
                  random_matrix(random, -4, 4)};
    glm::mat4& matrix = i % 3 == 0 ? camera.model : i % 3 == 1 ? camera.view : camera.projection;
    matrix[i / 12][i / 3 % 4] = random.pick({kInfinity, -kInfinity, std::nanf("")});
    std::vector<glm::vec4> clip;
    ASSERT_EQ(transform(camera, std::vector<glm::vec3>{{0, 0, 0}}, clip), std::nullopt);
    const glm::vec4 p = clip[0];
    EXPECT_FALSE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) &&
                 std::isfinite(p.w));
  }
}

using Exact3 = std::array<Rational, 3>;

Rational at(const glm::mat4& m, std::size_t row, std::size_t column) {
  return Rational(
      double{m[static_cast<glm::length_t>(column % 3)][static_cast<glm::length_t>(row % 3)]});
}

Rational cofactor(const glm::mat4& m, std::size_t r, std::size_t c) {
  return at(m, r + 1, c + 1) * at(m, r + 2, c + 2) - at(m, r + 1, c + 2) * at(m, r + 2, c + 1);
}

/// A lower bound of `value`'s square root, with a relative error below 2^-200.
Rational root(const Rational& value) {
  if (value == 0) return 0;
  const int shift = 500 - floor_log2(value) / 2;
  const Rational scaled = value * power_of_two(2 * shift);
  const mpz_class whole = scaled.get_num() / scaled.get_den();
  return Rational(sqrt(whole)) * power_of_two(-shift);
}

Rational length(const Exact3& v) { return root(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// Expects that the unit normal has the direction of (Aᵀ)⁻¹ n, within the header's bound.
void expect_normal(const glm::mat4& model, const glm::vec3& n, const glm::vec3& computed) {
  Rational determinant;
  for (std::size_t c = 0; c < 3; ++c) determinant += at(model, 0, c) * cofactor(model, 0, c);
  Exact3 image;
  Exact3 sizes;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Rational term =
          cofactor(model, r, c) * Rational(double{n[static_cast<glm::length_t>(c)]});
      image[r] += determinant < 0 ? Rational(-term) : term;
      sizes[r] += abs(term);
    }
  }
  const Rational norm = length(image);
  if (norm == 0) {
    EXPECT_EQ(computed, glm::vec3(0));
    return;
  }
  const Rational cancelled = length(sizes) / norm;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational f(double{computed[static_cast<glm::length_t>(i)]});
    const Rational bound =
        (Rational(double{kNormalBound}) * cancelled + 4) * power_of_two(-53) + float_ulp(f) / 2;
    EXPECT_LE(Rational(abs(f - image[i] / norm)), bound);
  }
}

glm::vec3 normal_of(const glm::mat4& model, const glm::vec3& n) {
  std::vector<glm::vec3> world;
  EXPECT_EQ(transform_normals(model, std::vector<glm::vec3>{n}, world), std::nullopt);
  return world.at(0);
}

TEST(Normals, StayWithinTheirBound) {
  Random random(4);
  for (int i = 0; i < 3000; ++i) {
    const int low = random.pick({-149, -20, -2});
    const int high = random.pick({0, 20, 126});
    glm::mat4 model = random_matrix(random, low, high);
    // Some models are singular, and some nearly singular.
    if (random.one_in(3)) model[2] = model[0];
    if (random.one_in(2)) model[2][1] = std::nextafter(model[2][1], 0.0F);
    const glm::vec3 n(random_position(random, low, high));
    expect_normal(model, n, normal_of(model, n));
  }
}

TEST(Normals, StayPerpendicularUnderScaleMirrorAndShear) {
  // Scaled by 2, 1, 4, the plane x + y + z = 0 becomes x / 2 + y + z / 4 = 0.
  glm::mat4 scale(1);
  scale[0][0] = 2;
  scale[2][2] = 4;
  const glm::vec3 scaled = normal_of(scale, {1, 1, 1});
  EXPECT_FLOAT_EQ(scaled.x * 2, scaled.y);
  EXPECT_FLOAT_EQ(scaled.z * 4, scaled.y);
  EXPECT_GT(scaled.y, 0);
  // If a face is mirrored at x = 0, its outward normal stays outward.
  glm::mat4 mirror(1);
  mirror[0][0] = -1;
  EXPECT_EQ(normal_of(mirror, {3, 0, 0}), glm::vec3(-1, 0, 0));
  EXPECT_EQ(normal_of(mirror, {0, 0, 0.25F}), glm::vec3(0, 0, 1));
  // If x becomes x + y, the plane x = 0 becomes x − y = 0, and y = 0 stays.
  glm::mat4 shear(1);
  shear[1][0] = 1;
  const glm::vec3 sheared = normal_of(shear, {1, 0, 0});
  EXPECT_EQ(sheared.x, -sheared.y);
  EXPECT_GT(sheared.x, 0);
  EXPECT_EQ(normal_of(shear, {0, 1, 0}), glm::vec3(0, 1, 0));
}

/// A matrix of integers of up to 24 bits with determinant 1 or −1.
glm::mat4 unimodular(Random& random) {
  std::array<std::array<int, 3>, 3> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int step = 0; step < 200; ++step) {
    const auto to = static_cast<std::size_t>(random.between(0, 2));
    const auto from = (to + static_cast<std::size_t>(random.between(1, 2))) % 3;
    const int factor = random.pick({-7, -3, -1, 1, 2, 5});
    std::array<int, 3> sum = columns[to];
    bool is_short = true;
    for (std::size_t r = 0; r < 3; ++r) {
      sum[r] += factor * columns[from][r];
      is_short = is_short && std::abs(sum[r]) < 1 << 24;
    }
    if (is_short) columns[to] = sum;
  }
  const int sign = random.one_in(2) ? -1 : 1;
  glm::mat4 model(1);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t r = 0; r < 3; ++r) {
      model[static_cast<glm::length_t>(c)][static_cast<glm::length_t>(r)] =
          static_cast<float>(c == 0 ? sign * columns[c][r] : columns[c][r]);
    }
  }
  return model;
}

double determinant_in_double(const glm::mat4& m) {
  double sum = 0;
  for (glm::length_t c = 0; c < 3; ++c) {
    const glm::vec4& a = m[(c + 1) % 3];
    const glm::vec4& b = m[(c + 2) % 3];
    sum += double{m[c].x} * (double{a.y} * double{b.z} - double{b.y} * double{a.z});
  }
  return sum;
}

// Determinants of ±1 that are sums of terms beyond 2^60, so that double may give them any sign.
TEST(Normals, MirrorByTheExactSign) {
  Random random(5);
  int wrong_in_double = 0;
  for (int i = 0; i < 500; ++i) {
    const glm::mat4 model = unimodular(random);
    Rational determinant;
    for (std::size_t c = 0; c < 3; ++c) determinant += at(model, 0, c) * cofactor(model, 0, c);
    ASSERT_EQ(abs(determinant), 1);
    if (determinant_in_double(model) * sgn(determinant) <= 0) ++wrong_in_double;
    const glm::vec3 n(random_position(random, -2, 0));
    expect_normal(model, n, normal_of(model, n));
  }
  EXPECT_GT(wrong_in_double, 50);
}

TEST(Normals, AreZeroWhereThereIsNoDirection) {
  const float nan = std::nanf("");
  EXPECT_EQ(normal_of(glm::mat4(1), {0, -0.0F, 0}), glm::vec3(0));
  EXPECT_EQ(normal_of(glm::mat4(0), {1, 2, 3}), glm::vec3(0));
  EXPECT_EQ(normal_of(glm::mat4(1), {1, nan, 0}), glm::vec3(0));
  EXPECT_EQ(normal_of(glm::mat4(1), {kInfinity, 0, 0}), glm::vec3(0));
  for (glm::length_t c = 0; c < 3; ++c) {
    for (glm::length_t r = 0; r < 3; ++r) {
      for (const float bad : {nan, kInfinity, -kInfinity}) {
        glm::mat4 model(1);
        model[c][r] = bad;
        EXPECT_EQ(normal_of(model, {1, 2, 3}), glm::vec3(0));
        EXPECT_EQ(normal_of(model, {0, 0, 1}), glm::vec3(0));
      }
    }
  }
  // The translation does not matter.
  glm::mat4 moved(1);
  moved[3][0] = kInfinity;
  EXPECT_EQ(normal_of(moved, {0, 2, 0}), glm::vec3(0, 1, 0));
  // If a model is flattened onto z = 0, its normals point along z.
  glm::mat4 flat(1);
  flat[2][2] = 0;
  EXPECT_EQ(normal_of(flat, {1, 1, 5}), glm::vec3(0, 0, 1));
}

// Kills: the rounding error of a sum that is exactly zero, used as a direction. The model presses
// everything into one plane. A normal along one of its two nonzero rows has no image.
TEST(Normals, OfASingularModelAreZeroOrExact) {
  const glm::mat4 flat(glm::vec4(0.1F, 0.7F, 0, 0), glm::vec4(0.2F, 0.5F, 0, 0),
                       glm::vec4(0.3F, 0.9F, 0, 0), glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(normal_of(flat, {0.1F, 0.2F, 0.3F}), glm::vec3(0));
  EXPECT_EQ(normal_of(flat, {0.7F, 0.5F, 0.9F}), glm::vec3(0));
  // The last row of the cofactors C is (0.03, 0.12, −0.09). Its terms cancel for (0.1, 0.2, 0.3),
  // so the term of the changed number decides the sign.
  EXPECT_EQ(normal_of(flat, {0.1F, 0.2F, 0.30000004F}), glm::vec3(0, 0, -1));
  EXPECT_EQ(normal_of(flat, {0.1F, 0.20000002F, 0.3F}), glm::vec3(0, 0, 1));
}

TEST(Normals, OfTheLeastAndTheLargestAreUnit) {
  for (const float size : {0x1p-149F, std::numeric_limits<float>::max()}) {
    glm::mat4 model(0);
    for (glm::length_t i = 0; i < 3; ++i) model[i][i] = size;
    EXPECT_EQ(normal_of(model, {0, size, 0}), glm::vec3(0, 1, 0));
    EXPECT_EQ(normal_of(model, {0, -size, 0}), glm::vec3(0, -1, 0));
  }
}

TEST(VertexStage, AppendsAndLosesNothingWhereMemoryRunsOut) {
  const std::vector<glm::vec3> positions(100, glm::vec3(1, 2, 3));
  std::vector<glm::vec4> clip{{9, 9, 9, 9}};
  std::vector<glm::vec3> world{{9, 9, 9}};
  const auto move = [&] { return transform({}, positions, clip); };
  const auto turn = [&] { return transform_normals(glm::mat4(1), positions, world); };
  if (kCanRunOutOfMemory) {
    EXPECT_EQ(with_allocations(0, move), Error::out_of_memory);
    EXPECT_EQ(with_allocations(0, turn), Error::out_of_memory);
    EXPECT_THAT(clip, testing::ElementsAre(glm::vec4(9)));
    EXPECT_THAT(world, testing::ElementsAre(glm::vec3(9)));
  }
  EXPECT_EQ(move(), std::nullopt);
  EXPECT_EQ(turn(), std::nullopt);
  ASSERT_EQ(clip.size(), 101U);
  ASSERT_EQ(world.size(), 101U);
  EXPECT_EQ(clip[0], glm::vec4(9));
  EXPECT_EQ(clip[100], glm::vec4(1, 2, 3, 1));
  EXPECT_EQ(world[0], glm::vec3(9));
}

}  // namespace
}  // namespace rastercheck::rasterizer::vertex_stage_test
