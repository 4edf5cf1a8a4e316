#include "rasterizer/methods/object_projective.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "rasterizer/methods/internal/counted.h"
#include "rasterizer/methods/method.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::object_projective_test {
namespace {

constexpr TargetSize kFour{4, 4, 1};

/// A draw of `clusters`, one attribute each, in the order of the attributes.
struct ClusterDraw {
  State state = small_state(4, 4);
  SmallMesh mesh;
  std::vector<std::vector<double>> w_r;

  ClusterDrawResult draw(Fragments& fragments) const {
    std::vector<std::size_t> attributes(w_r.size());
    std::vector<ParameterCluster> clusters;
    for (std::size_t c = 0; c < w_r.size(); ++c) {
      attributes[c] = c;
      clusters.push_back({std::span(&attributes[c], 1), w_r[c]});
    }
    return draw_object_projective(state, mesh.mesh(), clusters, kFour, fragments);
  }
  Fragments fragments() const {
    Fragments drawn;
    const ClusterDrawResult result = draw(drawn);
    EXPECT_EQ(result.error, std::nullopt);
    EXPECT_EQ(result.cluster_error, std::nullopt);
    return drawn;
  }
};

/// The same fragments with only one of their attributes.
Fragments only(const Fragments& all, std::size_t attribute) {
  Fragments one = all;
  one.attributes.clear();
  const std::size_t count = all.attributes.size() / all.size();
  for (std::size_t i = 0; i < all.size(); ++i) {
    one.attributes.push_back(all.attributes[i * count + attribute]);
  }
  return one;
}

// Kills: 1 or w used for w_r; one w_r for all clusters. The window's corners (0,0), (4,0), (0,4)
// have w = 1, 2, 1, and three parameters have the values 0, 1, 0 there. With w_r = 1, a parameter
// is rational-linear's u/8 over (8 − u)/8. With w_r = w = 1, 2, 1, it is linear in the window, u/4.
// With w_r = 3, 1, 3, its numerator is u/8 and its denominator 3 (4 − u)/4 + u/8 = (24 − 5u)/8.
TEST(ObjectProjective, HasAWeightForEachCluster) {
  ClusterDraw draw;
  draw.state.attributes = {{}, {}, {}};
  draw.mesh.positions = {at(draw.state, 0, 0), at(draw.state, 4, 0, 2), at(draw.state, 0, 4)};
  draw.mesh.attributes = {0, 0, 0, 1, 1, 1, 0, 0, 0};
  draw.mesh.triangles = {{0, 1, 2}};
  draw.w_r = {{1, 1, 1}, {1, 2, 1}, {3, 1, 3}};
  const Fragments drawn = draw.fragments();
  expect_values(only(drawn, 0), [](double u, double) { return u / (8 - u); });
  expect_values(only(drawn, 1), [](double u, double) { return u / 4; });
  expect_values(only(drawn, 2), [](double u, double) { return u / (24 - 5 * u); });
}

// A wall whose z = w − 1 goes from 0 to 1 along x is lit by a slide projector. The coordinates (s,
// t, q) are affine on the wall, with s = 0, 2, 0 and q = 1, 4, 1 at the corners, and the slide is
// read at s/q. With w = 1, 2, 1 the planes of s/w and q/w are u/4 and 1 + u/4 (from 1 to 4/2 over 4
// pixels): s/q = u/(4 + u). Rational-linear's mean of the corners' s/q = 0, 1/2, 0 would be
// (u/16)/((8 − u)/8) = u/(16 − 2u).
TEST(ObjectProjective, ShowsASlide) {
  ClusterDraw draw;
  draw.state.attributes = {{}};
  draw.mesh.positions = {at(draw.state, 0, 0, 1, 0), at(draw.state, 4, 0, 2, 0.5F),
                         at(draw.state, 0, 4, 1, 0)};
  draw.mesh.attributes = {0, 0.5F, 0};
  draw.mesh.triangles = {{0, 1, 2}};
  draw.w_r = {{1, 4, 1}};
  expect_values(draw.fragments(), [](double u, double) { return u / (4 + u); });
  draw.w_r = {};
  expect_values(draw.fragments(), [](double u, double) { return u / (16 - 2 * u); });
}

// A modelling transform with perspective, (x, y, z) to (x, y, z, 1 + x) = (x w_o, …, w_o), bends an
// object's triangle (0,0), (1,0), (0,1) with w_o = 1, 2, 1; a camera without perspective shows it,
// so that w = w_o. The object's own x has w_r = 1. The world's x, which is x/w_o, has w_r = w_o and
// is affine on the screen, where u = 8 x/w_o.
TEST(ObjectProjective, FollowsAPerspectiveModel) {
  ClusterDraw draw;
  draw.state.attributes = {{}, {}};
  draw.mesh.positions = {at(draw.state, 0, 0, 1), at(draw.state, 4, 0, 2), at(draw.state, 0, 4, 1)};
  draw.mesh.attributes = {0, 0, 1, 0.5F, 0, 0};
  draw.mesh.triangles = {{0, 1, 2}};
  draw.w_r = {{1, 1, 1}, {1, 2, 1}};
  const Fragments drawn = draw.fragments();
  expect_values(only(drawn, 0), [](double u, double) { return u / (8 - u); });
  expect_values(only(drawn, 1), [](double u, double) { return u / 8; });
}

// Kills: a result that depends on the sign of w_r, or on a common factor.
TEST(ObjectProjective, DoesNotDependOnAFactorOfAllWeights) {
  ClusterDraw draw;
  draw.state.attributes = {{}};
  draw.mesh.positions = {at(draw.state, 0, 0), at(draw.state, 4, 0, 2), at(draw.state, 0, 4)};
  draw.mesh.attributes = {0, 1, 0};
  draw.mesh.triangles = {{0, 1, 2}};
  for (const double factor : {-1.0, 0x1p-60, -0x1p60}) {
    draw.w_r = {{3 * factor, factor, 3 * factor}};
    expect_values(draw.fragments(), [](double u, double) { return u / (24 - 5 * u); });
  }
}

// The corners are (0, 0) and (0, 4) with w = 1, and (−4, 0) with w = −1, so that the triangle lies
// to the right of u = 0 and reaches to infinity. λ_1 = −u/4 is affine and 1 at that corner: e_1 =
// λ_1/w_1 = u/4, e_0 + e_2 = 1 + u/4. With w_r = 2, 1, 2 and the values 0, 1, 0, r = (u/4)/(2 (1 +
// u/4) + u/4) = u/(8 + 3u).
TEST(ObjectProjective, DrawsBehindTheEye) {
  ClusterDraw draw;
  draw.state.attributes = {{}};
  draw.mesh.positions = {at(draw.state, 0, 0), at(draw.state, -4, 0, -1), at(draw.state, 0, 4)};
  draw.mesh.attributes = {0, 1, 0};
  draw.mesh.triangles = {{0, 1, 2}};
  draw.w_r = {{2, 1, 2}};
  expect_values(draw.fragments(), [](double u, double) { return u / (8 + 3 * u); });
}

TEST(ObjectProjective, RefusesWhatHasAPole) {
  ClusterDraw draw;
  draw.state.attributes = {{}, {Interpolation::flat}};
  draw.mesh = triangle(draw.state, {0, 0}, {4, 0}, {0, 4});
  draw.mesh.attributes = {0, 0, 1, 0, 0, 0};
  const auto error = [&](const std::vector<std::vector<double>>& w_r) {
    draw.w_r = w_r;
    Fragments fragments;
    const ClusterDrawResult result = draw.draw(fragments);
    EXPECT_EQ(result.error, std::nullopt);
    EXPECT_EQ(fragments.size() == 0, result.cluster_error.has_value());
    return result.cluster_error;
  };
  const double infinite = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error({{1, 1, 1}}), std::nullopt);
  EXPECT_EQ(error({{-1, -2, -1}}), std::nullopt);
  EXPECT_EQ(error({{1, 0, 1}}), ClusterError::w_r_zero);
  EXPECT_EQ(error({{1, -0.0, 1}}), ClusterError::w_r_zero);
  EXPECT_EQ(error({{1, -1, 1}}), ClusterError::w_r_two_signs);
  EXPECT_EQ(error({{1, 1, -1}}), ClusterError::w_r_two_signs);
  for (const double bad : {nan, infinite, -infinite, 0x1p65, 0x1p-65}) {
    EXPECT_EQ(error({{1, 1, bad}}), ClusterError::w_r_range);
  }
  EXPECT_EQ(error({{1, 1}}), ClusterError::w_r_count);
  EXPECT_EQ(error({{1, 1, 1, 1}}), ClusterError::w_r_count);
  // The second cluster's attribute is flat.
  EXPECT_EQ(error({{1, 1, 1}, {1, 1, 1}}), ClusterError::attribute);
  // There is no third attribute.
  draw.state.attributes[1] = {};
  EXPECT_EQ(error({{1, 1, 1}, {1, 1, 1}}), std::nullopt);
  EXPECT_EQ(error({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), ClusterError::attribute);
  for (const ClusterError each :
       {ClusterError::attribute, ClusterError::w_r_count, ClusterError::w_r_zero,
        ClusterError::w_r_range, ClusterError::w_r_two_signs}) {
    EXPECT_FALSE(to_string(each).empty());
  }
}

TEST(ObjectProjective, RefusesAnAttributeInTwoClustersAndNone) {
  const State state = [] {
    State s = small_state(4, 4);
    s.attributes = {{}};
    return s;
  }();
  SmallMesh mesh = triangle(state, {0, 0}, {4, 0}, {0, 4});
  mesh.attributes = {0, 1, 0};
  const std::array<double, 3> w_r{1, 1, 1};
  const std::array<std::size_t, 1> first{0};
  const std::array<ParameterCluster, 2> twice{{{first, w_r}, {first, w_r}}};
  const std::array<ParameterCluster, 1> none{{{{}, w_r}}};
  Fragments fragments;
  EXPECT_EQ(draw_object_projective(state, mesh.mesh(), twice, kFour, fragments).cluster_error,
            ClusterError::attribute);
  EXPECT_EQ(draw_object_projective(state, mesh.mesh(), none, kFour, fragments).cluster_error,
            ClusterError::attribute);
  EXPECT_EQ(draw_object_projective(state, mesh.mesh(), none, {4, 4, 3}, fragments).error,
            Error::sample_count);
  EXPECT_EQ(fragments.size(), 0U);
}

// Kills: a check of w_r at vertices that no triangle uses; w_r that is not looked up by the
// vertex's index.
TEST(ObjectProjective, TakesWeightsByVertexIndex) {
  ClusterDraw draw;
  draw.state.attributes = {{}};
  draw.mesh.positions = {
      at(draw.state, 0, 4), {0, 0, 0, 0}, at(draw.state, 0, 0), at(draw.state, 4, 0, 2)};
  draw.mesh.attributes = {0, 7, 0, 1};
  draw.mesh.triangles = {{2, 3, 0}};
  draw.w_r = {{3, 0, 3, 1}};
  expect_values(draw.fragments(), [](double u, double) { return u / (24 - 5 * u); });
}

// Three rows take 6 products and 3 sums each, and three planes 9 products and 6 sums each. A vertex
// multiplies two values. A place evaluates three planes and divides twice.
TEST(ObjectProjective, CountsItsOperations) {
  const OperationCounts counts = find_method("object-projective")->operations();
  EXPECT_EQ(counts.per_vertex, (Operations{0, 2, 0}));
  EXPECT_EQ(counts.per_polygon, (Operations{27, 45, 0}));
  EXPECT_EQ(counts.per_pixel, (Operations{6, 6, 2}));
  EXPECT_EQ(counts.per_row, Operations{});
}

}  // namespace
}  // namespace rastercheck::rasterizer::object_projective_test
