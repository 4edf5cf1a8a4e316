// Compares screen derivatives with rational arithmetic: the weights as functionals of the window,
// by inverting a matrix, and the quotient rule.

#include "rasterizer/internal/derivatives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rasterizer/internal/fragment_drawing.h"
#include "rasterizer/internal/grid_piece.h"
#include "rasterizer/internal/grid_polygon.h"
#include "tests/rasterizer/brute_force.h"
#include "tests/rasterizer/exact_frame.h"

namespace rastercheck::rasterizer::derivatives_test {
namespace {

/// The bound of exact paths by the derivation: half a unit plus 2^-47 of the terms' size (at most
/// 2^-23 units, generously rounded up to 2^-20).
constexpr double kExactBound = 0.5 + 0x1p-20;

using Three = std::array<Rational, 3>;

/// A derivative, and the size of the terms that it is the sum of.
struct Expected {
  Rational slope;
  Rational scale;
};

/// A triangle given by its homogeneous window positions (X, Y, w).
class Truth {
 public:
  Truth(const Three& x, const Three& y, const Three& w) : w_(w) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      e_[i] = {y[j] * w[k] - w[j] * y[k], w[j] * x[k] - x[j] * w[k], x[j] * y[k] - y[j] * x[k]};
    }
    determinant_ = e_[0][0] * x[0] + e_[0][1] * y[0] + e_[0][2] * w[0];
    if (determinant_ == 0) return;
    for (Three& line : e_) {
      for (Rational& coefficient : line) coefficient /= determinant_;
    }
  }

  static Truth of(const State& state, const Corners& corners) {
    const Viewport& viewport = state.viewport;
    const Rational half_width = Rational(viewport.size.x) / 2;
    const Rational half_height = Rational(viewport.size.y) / 2;
    std::array<Three, 3> columns;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec4& p = corners[i];
      const Rational up = state.convention == Convention::d3d ? -p.y : p.y;
      columns[0][i] =
          Rational(p.x) * half_width + Rational(p.w) * (Rational(viewport.origin.x) + half_width);
      columns[1][i] =
          up * half_height + Rational(p.w) * (Rational(viewport.origin.y) + half_height);
      columns[2][i] = p.w;
    }
    return {columns[0], columns[1], columns[2]};
  }

  bool is_degenerate() const { return determinant_ == 0; }
  Rational reciprocal_w(const Rational& u, const Rational& v) const {
    return at(0, u, v) + at(1, u, v) + at(2, u, v);
  }

  /// The derivative along u or v of an attribute with the numerators n_i at the corners (n_i = r_i
  /// if smooth, r_i w_i if noperspective).
  Expected smooth(const Three& r, const Rational& most, std::size_t axis, const Rational& u,
                  const Rational& v) const {
    const Rational d = reciprocal_w(u, v);
    Rational n = 0;
    for (std::size_t i = 0; i < 3; ++i) n += r[i] * at(i, u, v);
    Expected expected;
    for (std::size_t i = 0; i < 3; ++i) {
      expected.slope += e_[i][axis] * (r[i] - n / d) / d;
      expected.scale += most * abs(e_[i][axis]) / d;
    }
    return expected;
  }
  Expected affine(const Three& n, std::size_t axis) const {
    Expected expected;
    for (std::size_t i = 0; i < 3; ++i) {
      expected.slope += n[i] * e_[i][axis];
      expected.scale += abs(n[i] * e_[i][axis]);
    }
    return expected;
  }
  const Three& w() const { return w_; }

 private:
  Rational at(std::size_t i, const Rational& u, const Rational& v) const {
    return e_[i][0] * u + e_[i][1] * v + e_[i][2];
  }

  Three w_;
  std::array<Three, 3> e_;  ///< the rows of the inverse
  Rational determinant_;
};

/// Checks the error in ulp(max(|slope|, scale)). An infinity is accepted only if the value before
/// rounding may lie beyond the floats.
::testing::AssertionResult is_within(float value, const Expected& expected, double bound) {
  const Rational size = std::max(Rational(abs(expected.slope)), expected.scale);
  const Rational unit = float_ulp(size);
  if (std::isinf(value)) {
    const Rational reached =
        (value > 0 ? expected.slope : Rational(-expected.slope)) + Rational(bound - 0.5) * unit;
    if (reached >= power_of_two(128) - power_of_two(103)) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << value << " for " << expected.slope.get_d();
  }
  if (std::isnan(value)) return ::testing::AssertionFailure() << "not a number";
  const Rational error = abs(Rational(value) - expected.slope) / unit;
  if (error <= Rational(bound)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << value << " for " << expected.slope.get_d()
                                       << " is off by " << error.get_d() << " of " << unit.get_d();
}

/// One part of a triangle with its values and derivatives prepared.
struct Prepared {
  State state;
  SmallMesh mesh;
  Weights weights;
  TriangleValues values;
  TriangleDerivatives derivatives;

  Prepared() = default;
  Prepared(const Prepared&) = delete;  // the source refers to the mesh
  Prepared& operator=(const Prepared&) = delete;
  ~Prepared() = default;

  ValueSource source() const {
    const std::span<const float> all(mesh.attributes);
    const std::size_t count = state.attributes.size();
    return {{mesh.positions[0], mesh.positions[1], mesh.positions[2]},
            {all.subspan(0, count), all.subspan(count, count), all.subspan(2 * count, count)},
            {}};
  }
  void set_up(const ValueSource& of) {
    set_up_values(state, of, weights, values);
    set_up_derivatives(state, of, weights, values, derivatives);
  }
  Three attribute(std::size_t a) const {
    const std::size_t count = state.attributes.size();
    return {mesh.attributes[a], mesh.attributes[count + a], mesh.attributes[2 * count + a]};
  }
};

Rational greatest(const Three& r) { return std::max({abs(r[0]), abs(r[1]), abs(r[2])}); }

/// `shares[i]` are the shares of the three vertices in corner i.
void expect_derivatives(const Prepared& p, const Truth& truth,
                        const std::array<std::array<double, 3>, 3>& shares, double u, double v,
                        int& certain) {
  const DerivativeSite site = derivative_site(p.values, p.weights, u, v);
  DerivativeSite doubtful = site;
  doubtful.is_certain = false;
  certain += site.is_certain ? 1 : 0;
  const bool is_in_front = truth.reciprocal_w(u, v) > 0;
  for (std::size_t a = 0; a < p.state.attributes.size(); ++a) {
    const Interpolation interpolation = p.state.attributes[a].interpolation;
    const bool is_smooth = interpolation == Interpolation::smooth;
    if (is_smooth && !is_in_front) continue;
    const Three of_vertices = p.attribute(a);
    Three n;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Rational w = is_smooth ? Rational(1) : Rational(p.mesh.positions[k].w);
        n[i] += Rational(shares[i][k]) * of_vertices[k] * w;
      }
    }
    const Slopes found = rounded(derivatives_at(p.derivatives, p.weights, a, site));
    const Slopes summed = rounded(derivatives_at(p.derivatives, p.weights, a, doubtful));
    for (std::size_t axis = 0; axis < 2; ++axis) {
      Expected expected;
      if (is_smooth) {
        expected = truth.smooth(n, greatest(of_vertices), axis, u, v);
      } else if (interpolation == Interpolation::noperspective) {
        expected = truth.affine(n, axis);
      }
      EXPECT_TRUE(is_within(found[axis], expected, kDerivativeBound)) << "attribute " << a;
      EXPECT_TRUE(is_within(summed[axis], expected, kExactBound)) << "summed, attribute " << a;
    }
  }
}

constexpr std::array<std::array<double, 3>, 3> kVertices{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

void expect_derivatives_of(const FramedDraw& framed, const SampleOffset& at, int& certain) {
  Prepared p;
  p.state = framed.state;
  p.mesh = framed.mesh;
  p.mesh.positions.assign(framed.corners.begin(), framed.corners.end());
  p.weights.set_ideal(framed.corners,
                      edge_functions(framed.corners, framed.orientation, framed.frame, 1),
                      framed.frame);
  p.set_up(p.source());
  expect_derivatives(p, Truth::of(framed.state, framed.corners), kVertices, at.x, at.y, certain);
}

// Samples anywhere, also outside. Kills: a certificate that ignores weights of both signs; a minor
// with the wrong sign; the frame's direction left out.
TEST(Derivatives, AreWithinTheBoundAnywhere) {
  Random random(90);
  int certain = 0;
  for (int i = 0; i < 6'000 && !HasFailure(); ++i) {
    const FramedDraw framed = random_framed_draw(random);
    expect_derivatives_of(framed, random_sample(random, framed.bounds, framed.samples), certain);
  }
  EXPECT_GT(certain, 1'000);
}

/// A triangle around a centre that is almost a line in float precision: most digits of its weights
/// are lost.
FramedDraw sliver_about(Random& random, const SampleOffset& at) {
  FramedDraw framed;
  framed.state = small_state(1'021, 1'021, random.pick({Convention::vulkan, Convention::d3d}));
  framed.state.attributes = {{Interpolation::smooth, Location::sample},
                             {Interpolation::noperspective, Location::sample}};
  framed.bounds = draw_bounds(framed.state, {1'021, 1'021, 1});
  framed.frame = sample_frame(framed.state, framed.bounds, 1);
  const double direction = random.number(24, -2, 1);
  const double width = random.one_in(2) ? 0 : std::ldexp(1.0, random.between(-20, -8));
  double along = 0.5;
  for (glm::vec4& p : framed.corners) {
    const double w = std::abs(random.number(24, -2, 1));
    const double x = 2 * at.x / 1'021 - 1 + along;
    const double y = 2 * at.y / 1'021 - 1 + along * direction + width * random.number(24, -1, 0);
    p = {static_cast<float>(w * x), static_cast<float>(w * y), 0, static_cast<float>(w)};
    along -= std::abs(random.number(24, -2, -1));
  }
  framed.orientation = sgn(exact_coefficients(framed.corners, 1, 0)[0] * framed.corners[0].x +
                           exact_coefficients(framed.corners, 1, 0)[1] * framed.corners[0].y +
                           exact_coefficients(framed.corners, 1, 0)[2] * framed.corners[0].w);
  for (int i = 0; i < 6; ++i) framed.mesh.attributes.push_back(random.real(-1, 1));
  return framed;
}

// Kills: treating every site as certain.
TEST(Derivatives, AreWithinTheBoundOfSlivers) {
  Random random(91);
  int certain = 0;
  int count = 0;
  for (int i = 0; i < 6'000 && !HasFailure(); ++i) {
    const SampleOffset at{random.between(0, 1'020) + 0.5, random.between(0, 1'020) + 0.5};
    const FramedDraw framed = sliver_about(random, at);
    if (framed.orientation == 0) continue;
    expect_derivatives_of(framed, at, certain);
    ++count;
  }
  EXPECT_GT(certain, 300);
  EXPECT_GT(count - certain, 300);
}

/// Checks the derivatives of all pieces of a snapped triangle at a few samples. `samples` counts
/// samples of triangles that clipping left whole, and of cut triangles.
void expect_snapped(Random& random, const State& state, const SmallMesh& mesh,
                    const TargetSize& size, std::array<int, 2>& samples, int& certain) {
  const int bits = unit_bits(*state.snapping);
  const SampleFrame frame = grid_frame(draw_bounds(state, size), bits);
  GridPolygon polygon;
  grid_polygon(state, grid_of(state), {mesh.positions[0], mesh.positions[1], mesh.positions[2]}, {},
               polygon);
  std::vector<GridPiece> fan;
  grid_pieces(polygon.corners, fan);
  const Rational unit = power_of_two(-bits);
  for (const GridPiece& piece : fan) {
    Prepared p;
    p.state = state;
    p.mesh = mesh;
    p.weights.set_placed(piece, polygon.corners, frame);
    ValueSource source = p.source();
    Three x;
    Three y;
    Three w;
    std::array<std::array<double, 3>, 3> shares;
    for (std::size_t i = 0; i < 3; ++i) {
      const GridCorner& corner = polygon.corners[piece.corners[i]];
      source.corners[i] = &corner;
      w[i] = corner.w;
      x[i] = unit * Rational(corner.at.x) * w[i];
      y[i] = unit * Rational(corner.at.y) * w[i];
      shares[i] = corner.share;
    }
    p.set_up(source);
    const Truth truth(x, y, w);
    for (int k = 0; k < 4; ++k) {
      const double u = random.between(0, 16 * size.width - 1) / 16.0;
      const double v = random.between(0, 16 * size.height - 1) / 16.0;
      const GridPoint at{std::llround(std::ldexp(u, bits)), std::llround(std::ldexp(v, bits))};
      const bool is_inside = std::all_of(piece.edges.begin(), piece.edges.end(),
                                         [&at](const GridLine& edge) { return edge.at(at) >= 0; });
      // Far outside, the errors of new corners grow.
      if (polygon.is_cut && !is_inside) continue;
      expect_derivatives(p, truth, shares, u, v, certain);
      ++samples[polygon.is_cut ? 1 : 0];
    }
  }
}

// Kills: grid units mistaken for pixels; a corner's own w left out of a minor.
TEST(Derivatives, OfSnappedPiecesAreWithinTheBound) {
  Random random(92);
  std::array<int, 2> samples{};
  int certain = 0;
  for (int i = 0; i < 8'000 && !::testing::Test::HasFailure(); ++i) {
    RandomDraw draw = random_draw(random);
    draw.state.clip_distance_count = 0;
    draw.state.snapping = Snapping{random.pick({1, 4, 8, 16})};
    draw.state.basis = Basis::snapped;
    if (draw.state.viewport.size.x == 0 || draw.state.viewport.size.y == 0) continue;
    expect_snapped(random, draw.state, draw.mesh, draw.size, samples, certain);
  }
  EXPECT_GT(samples[0], 1'000);
  EXPECT_GT(samples[1], 1'000);
  EXPECT_GT(certain, 300);
}

/// The place where a fragment's attribute is evaluated, derived from the fragments of its pixel.
std::array<Rational, 2> place_of(const Fragments& fragments, std::size_t i, Location location,
                                 const std::vector<std::array<Rational, 2>>& pattern) {
  std::array<Rational, 2> at = pattern[fragments.sample[i]];
  std::size_t count = 0;
  std::size_t first = 16;
  for (std::size_t k = 0; k < fragments.size(); ++k) {
    if (fragments.x[k] != fragments.x[i] || fragments.y[k] != fragments.y[i]) continue;
    first = std::min<std::size_t>(first, fragments.sample[k]);
    ++count;
  }
  if (location == Location::center || (location == Location::centroid && count == pattern.size())) {
    at = {Rational(1) / 2, Rational(1) / 2};
  } else if (location == Location::centroid) {
    at = pattern[first];
  }
  return {fragments.x[i] + at[0], fragments.y[i] + at[1]};
}

/// Compares a whole draw with the triangle of its clip positions; returns the number of fragments.
std::size_t expect_draw(const RandomDraw& draw) {
  Fragments fragments;
  EXPECT_FALSE(draw_fragments(draw.state, draw.mesh.mesh(), draw.size, fragments).error);
  const auto& positions = draw.mesh.positions;
  const Truth truth = Truth::of(draw.state, {positions[0], positions[1], positions[2]});
  if (truth.is_degenerate()) return 0;
  const auto pattern = brute_force_pattern(draw.size.samples);
  const std::size_t attributes = draw.state.attributes.size();
  EXPECT_EQ(fragments.derivatives.size(), fragments.size() * attributes * 2);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    for (std::size_t a = 0; a < attributes; ++a) {
      const Qualifier& qualifier = draw.state.attributes[a];
      const auto [u, v] = place_of(fragments, i, qualifier.location, pattern);
      const bool is_smooth = qualifier.interpolation == Interpolation::smooth;
      if (is_smooth && truth.reciprocal_w(u, v) <= 0) continue;
      Three r;
      Three n;
      for (std::size_t k = 0; k < 3; ++k) {
        r[k] = draw.mesh.attributes[k * attributes + a];
        n[k] = r[k] * truth.w()[k];
      }
      for (std::size_t axis = 0; axis < 2; ++axis) {
        Expected expected;
        if (is_smooth) expected = truth.smooth(r, greatest(r), axis, u, v);
        if (qualifier.interpolation == Interpolation::noperspective) {
          expected = truth.affine(n, axis);
        }
        EXPECT_TRUE(is_within(fragments.derivatives[(i * attributes + a) * 2 + axis], expected,
                              kDerivativeBound))
            << "attribute " << a << " at " << u.get_d() << ", " << v.get_d();
      }
    }
  }
  return fragments.size();
}

// Kills: the derivatives at the sample, although the attribute is evaluated at the centre; the
// derivatives of another lane.
TEST(Derivatives, OfDrawsAreThoseAtTheAttributesPlaces) {
  Random random(93);
  std::size_t fragments = 0;
  std::size_t snapped = 0;
  for (int i = 0; i < 3'000 && !::testing::Test::HasFailure(); ++i) {
    RandomDraw draw = random_draw(random);
    draw.state.derivatives = true;
    draw.state.precision = random.pick({Precision::float64, Precision::float32});
    fragments += expect_draw(draw);
    draw.state.snapping = Snapping{random.pick({1, 4, 8, 16})};
    snapped += expect_draw(draw);
  }
  EXPECT_GT(fragments, 5'000U);
  EXPECT_GT(snapped, 5'000U);
}

/// The triangle with window corners (0, 0), (4, 0) and (0, 4). The corner where r is 1 has w = 2:
/// with r = (0, 1, 0) and 1/w = 1 − u/8, r = u/(8 − u) and ∂r/∂u = 8/(8 − u)².
Fragments of_corner(State state, bool along_v) {
  state.derivatives = true;
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0), at(state, 4, 0, along_v ? 1 : 2),
                    at(state, 0, 4, along_v ? 2 : 1)};
  mesh.attributes = along_v ? std::vector<float>{0, 0, 1} : std::vector<float>{0, 1, 0};
  mesh.triangles = {{0, 1, 2}};
  return fragments_of(state, mesh, {4, 4, 1});
}

// By hand. Kills: ∂r/∂v computed along clip-space y.
TEST(Derivatives, ArePerPixelOfTheWindowAsDisplayed) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    for (const bool is_snapped : {false, true}) {
      State state = small_state(4, 4, convention);
      state.attributes = {{Interpolation::smooth, Location::sample}};
      state.basis = Basis::snapped;
      if (is_snapped) state.snapping = Snapping{8};
      for (const bool along_v : {false, true}) {
        const Fragments fragments = of_corner(state, along_v);
        ASSERT_GE(fragments.size(), 6U);
        for (std::size_t i = 0; i < fragments.size(); ++i) {
          const double along = (along_v ? fragments.y[i] : fragments.x[i]) + 0.5;
          const auto slope = static_cast<float>(8 / ((8 - along) * (8 - along)));
          EXPECT_EQ(fragments.derivatives[2 * i], along_v ? 0 : slope);
          EXPECT_EQ(fragments.derivatives[2 * i + 1], along_v ? slope : 0);
        }
      }
    }
  }
}

// In the mirrored viewport, NDC y = 1 is v = 0: r is 1 there, and 0 at v = 4.
TEST(Derivatives, FollowAMirroredViewport) {
  State state = small_state(4, 4);
  state.derivatives = true;
  state.viewport.origin.y = 4;
  state.viewport.size.y = -4;
  state.attributes = {{Interpolation::noperspective, Location::sample},
                      {Interpolation::smooth, Location::sample}};
  SmallMesh mesh;
  mesh.positions = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}};
  mesh.attributes = {0, 0, 0, 0, 1, 1};
  mesh.triangles = {{0, 1, 2}};
  const Fragments fragments = fragments_of(state, mesh, {4, 4, 1});
  ASSERT_GE(fragments.size(), 6U);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    EXPECT_EQ(fragments.derivatives[4 * i], 0);
    EXPECT_EQ(fragments.derivatives[4 * i + 1], -0.25F);
    EXPECT_EQ(fragments.derivatives[4 * i + 2], 0);
    EXPECT_EQ(fragments.derivatives[4 * i + 3], -0.25F);
  }
}

/// Draws a 4 × 4 target with three attributes that have these same values, one for each
/// interpolation.
Fragments of_values(const std::array<float, 3>& values, float w) {
  State state = small_state(4, 4);
  state.derivatives = true;
  state.attributes = {{Interpolation::smooth, Location::sample},
                      {Interpolation::noperspective, Location::sample},
                      {Interpolation::flat, Location::sample}};
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0), at(state, 4, 0, w), at(state, 0, 4)};
  for (const float value : values) mesh.attributes.insert(mesh.attributes.end(), 3, value);
  mesh.triangles = {{0, 1, 2}};
  return fragments_of(state, mesh, {4, 4, 1});
}

// Kills: a constant whose derivative is the rounding error of its value.
TEST(Derivatives, OfConstantsAreZero) {
  for (const float c : {0.1F, -3e38F, 0x1p-149F, 0.0F}) {
    for (const float w : {1.0F, 0.3F, 1e-20F, 1e20F}) {
      const Fragments fragments = of_values({c, c, c}, w);
      EXPECT_EQ(fragments.derivatives, std::vector<float>(fragments.size() * 6, 0));
    }
  }
}

TEST(Derivatives, OfFlatAttributesAreZero) {
  const Fragments fragments = of_values({1, 2, 4}, 2);
  ASSERT_GT(fragments.size(), 0U);
  EXPECT_NE(fragments.derivatives[0], 0);
  EXPECT_NE(fragments.derivatives[2], 0);
  EXPECT_EQ(fragments.derivatives[4], 0);
  EXPECT_EQ(fragments.derivatives[5], 0);
}

TEST(Derivatives, BeyondTheFloatsAreInfinite) {
  // r runs from −3e38 to 3e38 within 1 1/4 pixels, and then within two.
  for (const float length : {1.25F, 2.0F}) {
    State state = small_state(4, 4);
    state.derivatives = true;
    state.attributes = {{Interpolation::noperspective, Location::sample},
                        {Interpolation::noperspective, Location::sample}};
    SmallMesh mesh = triangle(state, {0, 0}, {length, 0}, {0, 4});
    mesh.attributes = {-3e38F, 3e38F, 3e38F, -3e38F, -3e38F, 3e38F};
    const Fragments fragments = fragments_of(state, mesh, {4, 4, 1});
    ASSERT_GT(fragments.size(), 0U);
    const bool is_beyond = length < 2;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(fragments.derivatives[0], is_beyond ? kInfinity : 3e38F);
    EXPECT_EQ(fragments.derivatives[2], is_beyond ? -kInfinity : -3e38F);
  }
}

TEST(Derivatives, OfWhatIsNoNumberAreSomeNumber) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const float bad : {kInfinity, -kInfinity, kNan}) {
    const Fragments fragments = of_values({bad, 1, 2}, 2);
    EXPECT_EQ(fragments.derivatives.size(), fragments.size() * 6);
    EXPECT_EQ(fragments.derivatives[4], 0);
  }
}

TEST(Derivatives, AreThereOnlyWhereAskedFor) {
  State state = small_state(4, 4);
  state.attributes.resize(1);
  SmallMesh mesh = triangle(state, {0, 0}, {4, 0}, {0, 4});
  mesh.attributes = {0, 1, 2};
  EXPECT_TRUE(fragments_of(state, mesh, {4, 4, 1}).derivatives.empty());

  state.derivatives = true;
  Fragments fragments;
  for (int i = 1; i <= 2; ++i) {
    EXPECT_FALSE(draw_fragments(state, mesh.mesh(), {4, 4, 1}, fragments).error);
  }
  ASSERT_EQ(fragments.derivatives.size(), fragments.size() * 2);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    EXPECT_EQ(fragments.derivatives[2 * i], 0.25F);
    EXPECT_EQ(fragments.derivatives[2 * i + 1], 0.5F);
  }

  Picture framebuffer;
  ASSERT_FALSE(clear(framebuffer, {4, 4, 1}, 1, 1));
  EXPECT_FALSE(draw(state, mesh.mesh(), framebuffer).error);
}

}  // namespace
}  // namespace rastercheck::rasterizer::derivatives_test
