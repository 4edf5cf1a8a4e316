// Compares the maps that rasterizer/methods/quad.h infers in double with the oracle's.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "rasterizer/methods/quad.h"
#include "tests/methods/quad_cases.h"
#include "tests/oracle/four_point_map.h"

namespace rastercheck::quad_map_test {
namespace {

using oracle::FourPointError;
using oracle::FourPointMap;
using oracle::PlanePoint;
using oracle::Rational;
using rasterizer::Quad;
using rasterizer::QuadError;
using rasterizer::QuadResult;
using rasterizer::SizedMatrix;

constexpr int kQuads = 6000;
constexpr double kUnit = 0x1p-53;

PlanePoint plane_point(const glm::dvec3& p) {
  return {Rational(p.x), Rational(p.y), Rational(p.z)};
}

/// x/z and y/z of a matrix times p, with the bound of quad.cpp; nullopt if the bound is infinite.
struct Bounded {
  glm::dvec2 value;
  glm::dvec2 bound;
};
std::optional<Bounded> divided(const SizedMatrix& m, const glm::dvec3& p) {
  const glm::dvec3 image = m.matrix * p;
  // The error of H p, including the three roundings of this product.
  const glm::dvec3 error = (rasterizer::kMatrixError + 3 * kUnit) * (m.sizes * glm::abs(p));
  const double least = std::abs(image.z) - error.z;
  if (!(least > 0)) return std::nullopt;
  const glm::dvec2 value(image.x / image.z, image.y / image.z);
  // The rounding of the division, and that of the enclosure it is compared with.
  const auto bound = [&](double r, double of_numerator) {
    return (of_numerator + std::abs(r) * error.z) / least + 3 * kUnit * std::abs(r) + 0x1p-1070;
  };
  return Bounded{value, {bound(value.x, error.x), bound(value.y, error.y)}};
}

/// Compares the map with an exact one at p.
struct Agreement {
  int judged = 0;
  double nearest = 0;  ///< largest error as a share of its bound
};
void expect_images_agree(const SizedMatrix& m, const FourPointMap& exact, const glm::dvec3& p,
                         Agreement& agreement) {
  const std::optional<Bounded> computed = divided(m, p);
  if (!computed) return;
  ++agreement.judged;
  const auto position = oracle::position_of(exact.at(plane_point(p)));
  ASSERT_TRUE(position.has_value());
  for (int k = 0; k < 2; ++k) {
    const double error = most_error(computed->value[k], (*position)[static_cast<std::size_t>(k)]);
    EXPECT_LE(error, computed->bound[k]);
    agreement.nearest = std::max(agreement.nearest, error / computed->bound[k]);
  }
}

// The map is refused exactly if three corners, or three parameter points, lie on a line.
TEST(QuadMap, IsRefusedJustWhereTheOracleRefuses) {
  QuadNumbers random(1);
  int refused = 0;
  int convex = 0;
  for (int i = 0; i < kQuads; ++i) {
    const Quad quad = random_quad(random);
    const std::optional<QuadError> error = rasterizer::infer(quad).error;
    const auto exact = exact_map(quad);
    if (error == QuadError::corners_in_line || error == QuadError::parameters_in_line) {
      ++refused;
      ASSERT_FALSE(exact.has_value());
      EXPECT_EQ(exact.error().side == FourPointError::Side::from,
                error == QuadError::corners_in_line);
    } else if (error != QuadError::not_convex) {
      ASSERT_TRUE(exact.has_value());
      ++convex;
    }
  }
  EXPECT_GT(refused, kQuads / 20);
  EXPECT_GT(convex, kQuads / 2);
}

// The exact matrix maps corner 0 to (u, v, 1), and corner i to (u, v, 1) w_r,i/w_r,0.
TEST(QuadMap, HasTheOraclesWeights) {
  QuadNumbers random(2);
  double worst = 0;
  for (int i = 0; i < kQuads; ++i) {
    const Quad quad = random_quad(random);
    const QuadResult inferred = rasterizer::infer(quad);
    if (inferred.error) continue;
    const FourPointMap exact = exact_map(quad).value();
    const std::array<double, 4>& w_r = inferred.map.w_r;
    for (std::size_t k = 1; k < 4; ++k) {
      const auto& p = quad.positions[k];
      const Rational ratio = exact.at(plane_point({p.x, p.y, p.w})).t;
      const double computed = w_r[k] / w_r[0];
      const double share = most_error(computed, ratio) / std::abs(computed);
      EXPECT_LE(share, 2 * rasterizer::kWeightError + 2 * kUnit);
      worst = std::max(worst, share);
    }
  }
  EXPECT_GT(worst, 2 * kUnit);
}

TEST(QuadMap, IsTheOraclesWithinItsBoundBothWays) {
  QuadNumbers random(3);
  Agreement agreement;
  for (int i = 0; i < kQuads; ++i) {
    const Quad quad = random_quad(random);
    const QuadResult inferred = rasterizer::infer(quad);
    if (inferred.error) continue;
    const FourPointMap exact = exact_map(quad).value();
    const FourPointMap back = FourPointMap::infer(parameters_of(quad), positions_of(quad)).value();
    for (int place = 0; place < 4; ++place) {
      const glm::dvec3 on_screen(random.fraction(), random.fraction(), 1);
      expect_images_agree(inferred.map.to_parameters, exact, on_screen, agreement);
      const glm::dvec3 parameters(3 * random.fraction(), 5 * random.fraction(), 1);
      expect_images_agree(inferred.map.to_clip, back, parameters, agreement);
    }
  }
  EXPECT_GT(agreement.judged, 4 * kQuads);
  EXPECT_GT(agreement.nearest, 0.05);
}

}  // namespace
}  // namespace rastercheck::quad_map_test
