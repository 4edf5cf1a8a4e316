// Quads drawn as two triangles by method object-projective, compared with the oracle's map of the
// quad.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "rasterizer/methods/object_projective.h"
#include "rasterizer/methods/quad.h"
#include "tests/methods/quad_cases.h"
#include "tests/oracle/four_point_map.h"

namespace rastercheck::quad_drawing_test {
namespace {

using oracle::FourPointMap;
using rasterizer::Fragments;
using rasterizer::Quad;
using rasterizer::QuadResult;

constexpr int kSize = 16;
constexpr int kQuads = 500;
using Corners = std::array<std::size_t, 3>;
using Split = std::array<Corners, 2>;
constexpr Split kSplit{{{0, 1, 2}, {0, 2, 3}}};
constexpr Split kOtherSplit{{{0, 1, 3}, {1, 2, 3}}};

/// Draws a quad with its two parameters as one cluster that has the corners' w_r.
Fragments draw(const Quad& quad, const std::array<double, 4>& w_r, const Split& split) {
  rasterizer::State state;
  state.viewport.size = {kSize, kSize};
  state.attributes = {{}, {}};
  std::vector<float> attributes;
  for (const auto& r : quad.parameters) attributes.insert(attributes.end(), {r.x, r.y});
  std::vector<glm::uvec3> triangles;
  for (const Corners& c : split) triangles.emplace_back(c[0], c[1], c[2]);
  const rasterizer::Mesh mesh{quad.positions, attributes, {}, triangles};
  const std::array<std::size_t, 2> both{0, 1};
  const std::array<rasterizer::ParameterCluster, 1> clusters{{{both, w_r}}};
  Fragments fragments;
  const auto drawn = draw_object_projective(state, mesh, clusters, {kSize, kSize, 1}, fragments);
  EXPECT_FALSE(drawn.error || drawn.cluster_error);
  return fragments;
}

double ulp(double size) { return std::ldexp(1.0, std::max(std::ilogb(size), -126) - 23); }

/// K of object_projective.cpp: Σ |w_r,i| |E|_i / |Σ w_r,i E_i| for one of the two triangles at (u,
/// v).
double condition(const Quad& quad, const std::array<double, 4>& w_r, const Corners& corners,
                 double u, double v) {
  std::array<glm::dvec3, 3> window;
  std::array<glm::dvec3, 3> sizes;
  constexpr double kHalf = kSize / 2.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& p = quad.positions[corners[i]];
    window[i] = glm::dvec3(p.x + p.w, p.y + p.w, p.w / kHalf) * kHalf;
    sizes[i] = glm::dvec3(std::abs(p.x) + std::abs(p.w), std::abs(p.y) + std::abs(p.w),
                          std::abs(p.w) / kHalf) *
               kHalf;
  }
  double weights = 0;
  double weight_sizes = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& j = window[(i + 1) % 3];
    const auto& k = window[(i + 2) % 3];
    weights += w_r[corners[i]] *
               ((j.y * k.z - k.y * j.z) * u + (j.z * k.x - k.z * j.x) * v + j.x * k.y - k.x * j.y);
    const auto& s = sizes[(i + 1) % 3];
    const auto& t = sizes[(i + 2) % 3];
    weight_sizes += w_r[corners[i]] * ((s.y * t.z + t.y * s.z) * u + (s.z * t.x + t.z * s.x) * v +
                                       s.x * t.y + t.x * s.y);
  }
  return weight_sizes / std::abs(weights);
}

/// Compares all fragments of a quad with its exact map.
void judge(const Quad& quad, const std::array<double, 4>& w_r, const Split& split,
           const Fragments& drawn, int& judged) {
  const FourPointMap exact = exact_map(quad).value();
  // The numerator's errors (n = 15), the denominator's (d = 14), and those of w_r (6) in each.
  constexpr double kPerCondition = 2 * (15 + 14 + 2 * 6) * 0x1p-29;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double u = drawn.x[i] + 0.5;
    const double v = drawn.y[i] + 0.5;
    const Corners& corners = split[drawn.triangle[i]];
    const double lost = kPerCondition * condition(quad, w_r, corners, u, v);
    if (!(lost < 0x1p24)) continue;
    // The position in clip space is exact, because kSize is a power of two.
    const auto position = exact.at(2 * u / kSize - 1, 2 * v / kSize - 1);
    ASSERT_TRUE(position.has_value());
    for (std::size_t k = 0; k < 2; ++k) {
      const oracle::Rational& r = (*position)[k];
      const float computed = drawn.attributes[2 * i + k];
      double scale = std::abs(r.enclosure().lo);
      for (const std::size_t c : corners) {
        scale = std::max(scale, double{std::abs(quad.parameters[c][static_cast<int>(k)])});
      }
      const double error = most_error(computed, r) / ulp(scale);
      // The last term covers the enclosure and K, which are computed in double.
      ASSERT_LE(error, 0.5 + 0x1p-29 + lost * (1 + 0x1p-20) + 0x1p-20);
      ++judged;
    }
  }
}

// Kills: weights w_r that are one triangle's own; w_r of corners exchanged; clusters that share a
// denominator.
TEST(QuadDrawing, IsTheOraclesMapOnBothTrianglesWhicheverTheDiagonal) {
  QuadNumbers random(4);
  int judged = 0;
  for (int i = 0; i < kQuads; ++i) {
    const Quad quad = random_quad(random);
    const QuadResult inferred = rasterizer::infer(quad);
    if (inferred.error) continue;
    for (const Split& split : {kSplit, kOtherSplit}) {
      const Fragments drawn = draw(quad, inferred.map.w_r, split);
      judge(quad, inferred.map.w_r, split, drawn, judged);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(judged, 100'000);
}

/// The greatest difference between two drawings of a quad in the same places.
double greatest_difference(const Fragments& a, const Fragments& b) {
  std::array<std::array<float, kSize>, kSize> values{};
  for (std::size_t i = 0; i < a.size(); ++i) values[a.y[i]][a.x[i]] = a.attributes[2 * i];
  double greatest = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    greatest = std::max(greatest, double{std::abs(values[b.y[i]][b.x[i]] - b.attributes[2 * i])});
  }
  return greatest;
}

// The trapezoid (1, 1), (15, 1), (11, 15), (5, 15) with the unit square's corners as parameters.
// With w_r = 1 each triangle is interpolated affinely, and the map bends along the diagonal: at (8,
// 8), where symmetry requires u = 1/2, one diagonal gives 9/14 and the other 5/14.
TEST(QuadDrawing, HasNoSeamWhereOneWeightForAllHas) {
  const auto corner = [](float u, float v) {
    return glm::vec4(2 * u / kSize - 1, 2 * v / kSize - 1, 0, 1);
  };
  const Quad quad{{{corner(1, 1), corner(15, 1), corner(11, 15), corner(5, 15)}},
                  {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
  const QuadResult inferred = rasterizer::infer(quad);
  ASSERT_EQ(inferred.error, std::nullopt);
  const auto difference = [&](const std::array<double, 4>& w_r) {
    return greatest_difference(draw(quad, w_r, kSplit), draw(quad, w_r, kOtherSplit));
  };
  EXPECT_LE(difference(inferred.map.w_r), 0x1p-24);
  EXPECT_GT(difference({1, 1, 1, 1}), 0.25);
}

}  // namespace
}  // namespace rastercheck::quad_drawing_test
