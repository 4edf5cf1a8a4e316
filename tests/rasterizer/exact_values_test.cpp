#include "rasterizer/internal/exact_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/determinant.h"
#include "rasterizer/internal/fragment_drawing.h"
#include "tests/rasterizer/exact_frame.h"

namespace rastercheck::rasterizer::exact_values_test {
namespace {

float rounded(double value) { return static_cast<float>(value); }

/// The bound of an exact path by the derivation: half a unit plus, for the sums and a division, a
/// relative 2^-50, which is far below the 2^-20 units added here.
constexpr double kExactBound = 0.5 + 0x1p-20;

/// A triangle with its values prepared.
struct Prepared {
  FramedDraw draw;
  Weights weights;
  TriangleValues values;

  Prepared(const Prepared&) = delete;  // the weights refer to the draw
  Prepared& operator=(const Prepared&) = delete;
  ~Prepared() = default;
  explicit Prepared(const FramedDraw& framed) : draw(framed) {
    weights.set_ideal(draw.corners, edge_functions(draw.corners, draw.orientation, draw.frame, 1),
                      draw.frame);
    const std::span<const float> all(draw.mesh.attributes);
    const std::size_t count = draw.state.attributes.size();
    const ValueSource source{
        draw.corners,
        {all.subspan(0, count), all.subspan(count, count), all.subspan(2 * count, count)},
        {}};
    set_up_values(draw.state, source, weights, values);
  }

  std::array<Rational, 3> rational_weights(const SampleOffset& at) const {
    return exact_weights(draw.corners, draw.orientation, draw.state, at.x, at.y);
  }
  float attribute(std::size_t vertex, std::size_t index) const {
    return draw.mesh.attributes[vertex * draw.state.attributes.size() + index];
  }
};

struct Expected {
  bool is_defined = true;
  Rational value;
  Rational scale;  ///< errors are measured in its ulp
};

Expected exact_attribute(const Prepared& p, std::size_t index, const std::array<Rational, 3>& e) {
  const bool is_smooth = p.draw.state.attributes[index].interpolation == Interpolation::smooth;
  Expected expected;
  Rational divisor = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational w = p.draw.corners[i].w;
    const Rational r = p.attribute(i, index);
    expected.value += r * e[i] * (is_smooth ? Rational(1) : w);
    divisor += e[i] * (is_smooth ? Rational(1) : w);
    if (expected.scale < abs(r)) expected.scale = abs(r);
  }
  expected.is_defined = divisor > 0;
  if (divisor != 0) expected.value /= divisor;
  if (expected.scale < abs(expected.value)) expected.scale = abs(expected.value);
  return expected;
}

Expected exact_depth(const Prepared& p, const std::array<Rational, 3>& e) {
  const Viewport& viewport = p.draw.state.viewport;
  Rational z = 0;
  Rational divisor = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    z += Rational(p.draw.corners[i].z) * e[i];
    divisor += Rational(p.draw.corners[i].w) * e[i];
  }
  z /= divisor;
  if (p.draw.state.convention == Convention::opengl) z = (z + 1) / 2;
  const Rational near = viewport.min_depth;
  const Rational far = viewport.max_depth;
  Expected expected;
  expected.value = near + (far - near) * z;
  expected.scale = near < far ? far : near;
  const Rational least = near < far ? near : far;
  if (expected.value < least) expected.value = least;
  if (expected.value > expected.scale) expected.value = expected.scale;
  return expected;
}

::testing::AssertionResult is_within(float value, const Expected& expected, double bound) {
  if (std::isinf(value)) {  // right from half a unit beyond the largest float on
    const bool is_beyond = expected.scale >= power_of_two(128) - power_of_two(103);
    if (is_beyond && (value > 0) == (expected.value > 0)) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << value << " for " << expected.value.get_d();
  }
  if (std::isnan(value)) return ::testing::AssertionFailure() << "not a number";
  const Rational error = abs(Rational(value) - expected.value) / float_ulp(expected.scale);
  if (error <= Rational(bound)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << value << " for " << expected.value.get_d() << " is off by " << error.get_d();
}

/// The weights of one sample as the vector kernels compute them.
BlockWeights block_at(const Prepared& p, const SampleOffset& at) {
  EdgeRow row;
  for (std::size_t i = 0; i < 3; ++i) {
    row.a[i] = p.weights.edges[i].a.value;
    row.row[i] = p.weights.edges[i].row(p.draw.frame, at.y);
    row.band[i] = p.weights.edges[i].band;
  }
  row.scale = p.draw.frame.u.scale;
  row.shift = p.draw.frame.u.shift;
  row.offset = at.x - std::floor(at.x);
  BlockWeights weights;
  evaluate_edges(row, static_cast<int>(std::floor(at.x)), 1, weights);
  return weights;
}

PlaneRow row_at(const Prepared& p, const Plane& plane, const SampleOffset& at) {
  return plane_row(plane, p.draw.frame, at.y);
}

bool is_covered(const std::array<Rational, 3>& e) { return e[0] >= 0 && e[1] >= 0 && e[2] >= 0; }

TEST(ExactValues, TheDeterminantIsAlmostExact) {
  Random random(70);
  for (int i = 0; i < 3'000 && !HasFailure(); ++i) {
    const Prepared p(random_framed_draw(random));
    Rational exact = 0;
    const auto e = p.rational_weights({0.5, 0.5});
    for (std::size_t k = 0; k < 3; ++k) exact += Rational(p.draw.corners[k].w) * e[k];
    EXPECT_GT(exact, 0);
    EXPECT_LE(abs(Rational(p.weights.det_t) - exact), exact * power_of_two(-33));
  }
}

// Samples anywhere, also outside and behind the eye. Kills: a sum in double although the weights
// cancel.
TEST(ExactValues, ExactPathsRoundOnce) {
  Random random(71);
  for (int i = 0; i < 2'000 && !HasFailure(); ++i) {
    const Prepared p(random_framed_draw(random));
    const SampleOffset at = random_sample(random, p.draw.bounds, p.draw.samples);
    const auto e = p.rational_weights(at);
    for (std::size_t a = 0; a < p.draw.state.attributes.size(); ++a) {
      if (p.values.attributes[a].kind == ValueLine::Kind::copied) continue;
      const Expected expected = exact_attribute(p, a, e);
      if (!expected.is_defined) continue;
      EXPECT_TRUE(is_within(rounded(exact_value_at(p.values.attributes[a], p.weights, at.x, at.y)),
                            expected, kExactBound));
    }
    const auto depth = static_cast<float>(exact_depth_at(p.values, p.weights, at.x, at.y));
    EXPECT_TRUE(is_within(depth, exact_depth(p, e), kExactBound));
  }
}

// Kills: a certificate that ignores weights of both signs.
TEST(ExactValues, ValuesAnywhereAreWithinTheBound) {
  Random random(72);
  for (int i = 0; i < 3'000 && !HasFailure(); ++i) {
    const Prepared p(random_framed_draw(random));
    const SampleOffset at = random_sample(random, p.draw.bounds, p.draw.samples);
    const auto e = p.rational_weights(at);
    for (std::size_t a = 0; a < p.draw.state.attributes.size(); ++a) {
      if (p.values.attributes[a].kind == ValueLine::Kind::copied) continue;
      const Expected expected = exact_attribute(p, a, e);
      if (!expected.is_defined) continue;
      EXPECT_TRUE(
          is_within(rounded(value_at(p.values.attributes[a], p.values, p.weights, at.x, at.y)),
                    expected, kValueBound));
    }
  }
}

/// The number of values of each kind that a certificate covered.
struct Certified {
  int smooth = 0;
  int affine = 0;
  int depth = 0;
};

void expect_certified(const Prepared& p, const SampleOffset& at, Certified& count) {
  const auto e = p.rational_weights(at);
  BlockWeights weights = block_at(p, at);
  const bool is_smooth_certain =
      (sum_weights(row_at(p, p.values.sum, at), p.values.certificates.least_sum, 1, weights) & 1) !=
      0;
  std::array<float, kBlockSize> out{};
  if (p.values.certificates.depth_is_certain) {  // certain for all samples, also outside
    const DepthLine& depth = p.values.depth;
    evaluate_depth(row_at(p, depth.plane, at), depth.least, depth.greatest, depth.steps, 1, weights,
                   out.data());
    EXPECT_TRUE(is_within(out[0], exact_depth(p, e), kValueBound)) << "depth";
    ++count.depth;
  }
  if (!is_covered(e)) return;
  for (std::size_t a = 0; a < p.draw.state.attributes.size(); ++a) {
    const ValueLine& line = p.values.attributes[a];
    const Expected expected = exact_attribute(p, a, e);
    if (line.kind == ValueLine::Kind::smooth && is_smooth_certain) {
      evaluate_smooth(row_at(p, line.plane, at), 1, weights, out.data());
      EXPECT_TRUE(is_within(out[0], expected, kValueBound)) << "smooth";
      ++count.smooth;
    }
    if (line.kind == ValueLine::Kind::affine && p.values.certificates.affine_is_certain) {
      evaluate_affine(row_at(p, line.plane, at), 1, weights, out.data());
      EXPECT_TRUE(is_within(out[0], expected, kValueBound)) << "noperspective";
      ++count.affine;
    }
  }
}

// If a certificate says that double is enough, it is. Kills: a certificate that forgets w.
TEST(ExactValues, CertificatesHold) {
  Random random(73);
  Certified count;
  for (int i = 0; i < 8'000 && !HasFailure(); ++i) {
    const Prepared p(random_framed_draw(random));
    for (int k = 0; k < 2; ++k) {
      expect_certified(p, random_sample(random, p.draw.bounds, p.draw.samples), count);
    }
  }
  EXPECT_GT(count.smooth, 1'000);
  EXPECT_GT(count.affine, 300);
  EXPECT_GT(count.depth, 1'000);
}

/// A triangle around a centre that is almost a line in float precision: the rounding of its corners
/// decides whether the centre is inside.
FramedDraw sliver_about(Random& random, const SampleOffset& at) {
  FramedDraw framed;
  framed.state = small_state(1'021, 1'021);
  framed.state.attributes = {{Interpolation::smooth, Location::sample},
                             {Interpolation::noperspective, Location::sample}};
  framed.bounds = draw_bounds(framed.state, {1'021, 1'021, 1});
  framed.frame = sample_frame(framed.state, framed.bounds, 1);
  const double direction = random.number(24, -2, 1);
  double along = 0.5;
  for (glm::vec4& p : framed.corners) {
    const double w = random.one_in(2) ? 1 : std::abs(random.number(24, -2, 1));
    const double x = 2 * at.x / 1'021 - 1 + along;
    const double y = 2 * at.y / 1'021 - 1 + along * direction;
    const double z = std::abs(random.number(24, -3, -1));
    p = {static_cast<float>(w * x), static_cast<float>(w * y), static_cast<float>(w * z),
         static_cast<float>(w)};
    along -= std::abs(random.number(24, -2, -1));
  }
  framed.orientation = determinant_sign(framed.corners[0], framed.corners[1], framed.corners[2]);
  for (int i = 0; i < 6; ++i) framed.mesh.attributes.push_back(random.real(-1, 1));
  return framed;
}

// Weights that lose most of their digits. Kills: treating every value as certified; a certificate
// with the constant 2^18 instead of 2^32.
TEST(ExactValues, CertificatesHoldOfSlivers) {
  Random random(74);
  Certified count;
  int doubtful = 0;
  for (int i = 0; i < 12'000 && !HasFailure(); ++i) {
    const SampleOffset at{random.between(0, 1'020) + 0.5, random.between(0, 1'020) + 0.5};
    const FramedDraw framed = sliver_about(random, at);
    if (framed.orientation == 0) continue;
    const Prepared p(framed);
    expect_certified(p, at, count);
    doubtful += p.values.certificates.depth_is_certain ? 0 : 1;
  }
  EXPECT_GT(doubtful, 1'000);
}

/// A triangle around the middle of a viewport of one pixel, so that the weight of each corner is
/// the determinant of the other two. The weights are integers, exact in double, and so is their
/// sum.
FramedDraw about_the_middle(const Corners& corners, Interpolation interpolation, float constant) {
  FramedDraw framed;
  framed.state = small_state(1, 1);
  framed.state.attributes = {{interpolation, Location::sample}};
  framed.mesh.attributes = {constant, constant, constant};
  framed.bounds = draw_bounds(framed.state, {1, 1, 1});
  framed.frame = sample_frame(framed.state, framed.bounds, 1);
  framed.corners = corners;
  framed.orientation = determinant_sign(corners[0], corners[1], corners[2]);
  return framed;
}

// A sample outside, with weights of 2^46 whose sum is 1: the rounding errors of the products are as
// large as the value, although the weights themselves are exact. Kills: a certificate that looks at
// the bands only.
TEST(ExactValues, WeightsThatCancelAreSummedExactly) {
  constexpr float kN = 0x1p23F + 1;
  constexpr float kK = 0x1p22F + 3;
  const Prepared p(about_the_middle({glm::vec4{0, kN, 0, 3}, {1, kN, 0, 4}, {kK, kN + 1, 0, 5}},
                                    Interpolation::smooth, 0.1F));
  const auto e = p.rational_weights({0.5, 0.5});
  ASSERT_EQ(e[0] + e[1] + e[2], 1);
  ASSERT_EQ(p.values.certificates.band_sum, 0);
  EXPECT_EQ(rounded(value_at(p.values.attributes[0], p.values, p.weights, 0.5, 0.5)), 0.1F);
}

// A sample inside, with w of both signs: the sum of the weights is large, but weighted by w it is
// 1. Kills: the certificate for values linear in the window without its condition w > 0.
TEST(ExactValues, SharesThatCancelAreSummedExactly) {
  const Prepared p(about_the_middle(
      {glm::vec4{-1016313, -796241, 0, -423006}, {592999, 0, 0, 59869}, {0, 538095, 0, 216524}},
      Interpolation::noperspective, 0.1F));
  const auto e = p.rational_weights({0.5, 0.5});
  ASSERT_TRUE(is_covered(e));
  ASSERT_EQ(p.weights.det_t, 1);
  ASSERT_EQ(p.values.certificates.band_sum, 0);
  EXPECT_FALSE(p.values.certificates.affine_is_certain);
  EXPECT_EQ(rounded(value_at(p.values.attributes[0], p.values, p.weights, 0.5, 0.5)), 0.1F);
}

// An attribute that is the same at all vertices has this value whatever the weights. Kills: using
// the first quotient, which in double is slightly below an integer, as the result.
TEST(ExactValues, FloorsOfConstantsAreTheirs) {
  Random random(75);
  int wraps = 0;
  for (int i = 0; i < 6'000 && !HasFailure(); ++i) {
    FramedDraw framed = random_framed_draw(random);
    const int shift = random.between(0, 20);
    const auto constant = static_cast<float>(std::ldexp(random.between(-4096, 4096), shift));
    std::fill(framed.mesh.attributes.begin(), framed.mesh.attributes.end(), constant);
    const Prepared p(framed);
    const SampleOffset at = random_sample(random, p.draw.bounds, p.draw.samples);
    for (std::size_t a = 0; a < p.draw.state.attributes.size(); ++a) {
      const ValueLine& line = p.values.attributes[a];
      if (line.kind == ValueLine::Kind::copied ||
          !exact_attribute(p, a, p.rational_weights(at)).is_defined)
        continue;
      const double scale = random.between(1, 64);
      const double texels = scale * double{constant};  // below 2^38
      const double infinity = std::numeric_limits<double>::infinity();
      EXPECT_EQ(exact_floor_at(line, p.values, p.weights, at.x, at.y, scale, infinity), texels);
      const double wrapped = exact_floor_at(line, p.values, p.weights, at.x, at.y, scale, scale);
      EXPECT_EQ(std::fmod(wrapped, scale), 0) << wrapped << " of " << scale;
      ++wraps;
    }
  }
  EXPECT_GT(wraps, 3'000);
}

// The three weights are an integer g of 53 bits, a number −1/2 + ε with ε between 2^-55 and 2^-54,
// and almost 0. Their sum lies just above the middle between two doubles. The remainder after the
// first quotient equals this sum, but ExactSum::nearest(), which is not always the nearest double,
// returns different doubles for the two, the greater one for the sum. Kills: taking the floor of
// their quotient, 0, as the last step.
TEST(ExactValues, AFloorAsksWhetherAWholeDenominatorIsLeft) {
  const Corners first{glm::vec4{-0x1.dc4p-108F, -0x1p-61F, 0, 1},
                      {0x1.6e278ep-1F, -0x1.4f0b76p-37F, 0, 1},
                      {0x1p60F, 0x1.e2f03ap52F, 0, 1}};
  const Corners second{glm::vec4{-0x1.a9cp-108F, -0x1p-61F, 0, 1},
                       {0x1.f28556p-1F, -0x1.6a0ab6p-37F, 0, 1},
                       {0x1p60F, 0x1.c4cdcep52F, 0, 1}};
  const auto floor_of = [](const Corners& corners, float constant, double scale) {
    const Prepared p(about_the_middle(corners, Interpolation::noperspective, constant));
    return exact_floor_at(p.values.attributes[0], p.values, p.weights, 0.5, 0.5, scale,
                          std::numeric_limits<double>::infinity());
  };
  EXPECT_EQ(floor_of(first, 12, 9), 108);
  EXPECT_EQ(floor_of(second, 7, 30), 210);
}

/// A triangle of small_state(8, 8) with these w and the same attributes at all vertices.
Prepared plain(const State& state, const std::array<float, 3>& w,
               const std::vector<float>& attributes, const std::array<float, 3>& depth = {}) {
  FramedDraw framed;
  framed.state = state;
  framed.mesh.attributes = attributes;
  framed.bounds = draw_bounds(state, {8, 8, 1});
  framed.frame = sample_frame(state, framed.bounds, 1);
  framed.corners = {at(state, 0.5F, 0.5F, w[0], depth[0]), at(state, 7.5F, 1.5F, w[1], depth[1]),
                    at(state, 2.5F, 7.5F, w[2], depth[2])};
  framed.orientation = determinant_sign(framed.corners[0], framed.corners[1], framed.corners[2]);
  return Prepared(framed);
}

State state_with(Interpolation interpolation) {
  State state = small_state(8, 8);
  state.attributes = {{interpolation, Location::sample}};
  return state;
}

TEST(ExactValues, ConstantsStayWhatTheyAre) {
  for (const auto interpolation : {Interpolation::smooth, Interpolation::noperspective}) {
    for (const float c : {1.0F, 0.1F, -3.3e38F, 0x1.fffffep127F, 0x1p-149F, -0x1.8p-130F}) {
      for (const float w : {1.0F, 0.3F, 1e-20F, 1e20F}) {
        const Prepared p = plain(state_with(interpolation), {1, w, 3}, {c, c, c});
        const SampleOffset middle{3.5, 3.5};
        BlockWeights weights = block_at(p, middle);
        sum_weights(row_at(p, p.values.sum, middle), 0, 1, weights);
        std::array<float, kBlockSize> out{};
        const ValueLine& line = p.values.attributes[0];
        if (interpolation == Interpolation::smooth) {
          evaluate_smooth(row_at(p, line.plane, middle), 1, weights, out.data());
        } else {
          evaluate_affine(row_at(p, line.plane, middle), 1, weights, out.data());
        }
        EXPECT_EQ(out[0], c);
        EXPECT_EQ(rounded(value_at(line, p.values, p.weights, 3.5, 3.5)), c);
        EXPECT_EQ(rounded(exact_value_at(line, p.weights, 3.5, 3.5)), c);
      }
    }
  }
}

// Kills: the form r_0 + (r_1 − r_0) b_1 + …, which loses a small value of one vertex beside a large
// value of another.
TEST(ExactValues, VerticesHaveTheirOwnValues) {
  for (const auto interpolation : {Interpolation::smooth, Interpolation::noperspective}) {
    const std::vector<float> r{0x1.234568p-40F, -1e30F, 0x1.000002p0F};
    const Prepared p = plain(state_with(interpolation), {1, 0.5F, 4}, r);
    const ValueLine& line = p.values.attributes[0];
    const std::array<SampleOffset, 3> vertices{SampleOffset{0.5, 0.5}, {7.5, 1.5}, {2.5, 7.5}};
    for (std::size_t i = 0; i < 3; ++i) {
      const SampleOffset& v = vertices[i];
      EXPECT_EQ(rounded(value_at(line, p.values, p.weights, v.x, v.y)), r[i]);
      EXPECT_EQ(rounded(exact_value_at(line, p.weights, v.x, v.y)), r[i]);
    }
  }
}

TEST(ExactValues, ZerosKeepACommonSign) {
  const State state = state_with(Interpolation::smooth);
  const Prepared negative = plain(state, {1, 2, 3}, {-0.0F, -0.0F, -0.0F});
  ASSERT_EQ(negative.values.attributes[0].kind, ValueLine::Kind::copied);
  EXPECT_TRUE(std::signbit(negative.values.attributes[0].copy));
  EXPECT_EQ(plain(state, {1, 2, 3}, {0, -0.0F, 0}).values.attributes[0].kind,
            ValueLine::Kind::smooth);
}

TEST(ExactValues, FlatIsTheProvokingVertex) {
  State state = state_with(Interpolation::flat);
  EXPECT_EQ(plain(state, {1, 2, 3}, {7, 8, 9}).values.attributes[0].copy, 7);
  state.convention = Convention::d3d;
  EXPECT_EQ(plain(state, {1, 2, 3}, {7, 8, 9}).values.attributes[0].copy, 7);
  state.convention = Convention::opengl;
  EXPECT_EQ(plain(state, {1, 2, 3}, {7, 8, 9}).values.attributes[0].copy, 9);
}

/// The depth in the middle, as the kernels for a block of samples compute it.
float depth_of(const Prepared& p) {
  const SampleOffset middle{3.5, 3.5};
  const DepthLine& depth = p.values.depth;
  std::array<float, kBlockSize> out{};
  evaluate_depth(row_at(p, depth.plane, middle), depth.least, depth.greatest, depth.steps, 1,
                 block_at(p, middle), out.data());
  EXPECT_EQ(out[0], static_cast<float>(exact_depth_at(p.values, p.weights, middle.x, middle.y)));
  return out[0];
}

// Kills: comparing only two of the three vertices, or comparing the quotients in float.
TEST(ExactValues, PlanesOfOneDepthHaveOneDepth) {
  const State state = state_with(Interpolation::smooth);
  const Prepared level = plain(state, {1, 0.5F, 4}, {1, 2, 3}, {0.25F, 0.25F, 0.25F});
  EXPECT_TRUE(level.values.has_constant_depth);
  EXPECT_EQ(depth_of(level), 0.25F);
  constexpr float kNext = 0x1.000002p-2F;
  EXPECT_FALSE(
      plain(state, {1, 0.5F, 4}, {1, 2, 3}, {0.25F, 0.25F, kNext}).values.has_constant_depth);
  EXPECT_FALSE(
      plain(state, {1, 0.5F, 4}, {1, 2, 3}, {kNext, 0.25F, 0.25F}).values.has_constant_depth);
  EXPECT_FALSE(
      plain(state, {1, 0.5F, 4}, {1, 2, 3}, {0.25F, kNext, 0.25F}).values.has_constant_depth);
}

// A vertex with z = w = 0 lies in every plane of one depth; a vertex with only w = 0 lies in none.
TEST(ExactValues, PlanesOfOneDepthMayPassThroughTheEye) {
  FramedDraw framed;
  framed.state = small_state(8, 8);
  framed.bounds = draw_bounds(framed.state, {8, 8, 1});
  framed.frame = sample_frame(framed.state, framed.bounds, 1);
  framed.orientation = 1;
  framed.corners = {glm::vec4{1, 0, 0, 0}, {0, 1, 0.3F, 0.3F}, {0, 0, -2, -2}};
  const Prepared in_plane(framed);
  EXPECT_TRUE(in_plane.values.has_constant_depth);
  EXPECT_EQ(depth_of(in_plane), 1);
  framed.corners[0].z = 1;
  EXPECT_FALSE(Prepared(framed).values.has_constant_depth);
}

// Kills: a constant depth that is not clamped.
TEST(ExactValues, ConstantDepthIsClamped) {
  State state = small_state(8, 8);
  state.depth_clamp = true;
  state.viewport.min_depth = 0.75F;
  state.viewport.max_depth = 0.25F;
  EXPECT_EQ(depth_of(plain(state, {1, 2, 4}, {}, {2, 2, 2})), 0.25F);
  EXPECT_EQ(depth_of(plain(state, {1, 2, 4}, {}, {-2, -2, -2})), 0.75F);
}

}  // namespace
}  // namespace rastercheck::rasterizer::exact_values_test
