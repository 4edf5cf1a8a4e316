#pragma once

// Random quads, and the oracle's answers about them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <tl/expected.hpp>

#include "rasterizer/methods/quad.h"
#include "tests/oracle/four_point_map.h"

namespace rastercheck {

/// Random numbers, the same in every run.
class QuadNumbers {
 public:
  explicit QuadNumbers(std::uint64_t seed) : engine_(seed) {}

  /// An integer from low to high, both included.
  int between(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  /// A multiple of 2^-23 within ±1.
  float fraction() { return std::ldexp(static_cast<float>(between(-(1 << 23), 1 << 23)), -23); }

 private:
  std::mt19937_64 engine_;
};

/// Half of the quads lie on a coarse grid, where three corners often lie on a line; the others use
/// all digits. Some quads have corners near those of a square, which makes most of these quads
/// convex.
inline rasterizer::Quad random_quad(QuadNumbers& random) {
  constexpr std::array<std::array<float, 2>, 4> kSquare{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const bool is_coarse = random.between(0, 1) == 0;
  const auto number = [&](float size) {
    return is_coarse ? static_cast<float>(random.between(-2, 2)) / 2 * size
                     : random.fraction() * size;
  };
  const float spread = std::ldexp(1.0F, random.between(-12, 2));
  const float parameter_spread = std::ldexp(1.0F, random.between(-12, 1));
  const bool has_any_w = random.between(0, 3) == 0;
  rasterizer::Quad quad;
  for (std::size_t i = 0; i < 4; ++i) {
    const float w =
        has_any_w ? number(4) : std::ldexp(1 + std::abs(number(1)), random.between(-4, 4));
    const float x = kSquare[i][0] + number(spread);
    const float y = kSquare[i][1] + number(spread);
    quad.positions[i] = {x * w, y * w, 0, w};
    quad.parameters[i] = {3 * kSquare[i][0] + number(3 * parameter_spread),
                          5 * kSquare[i][1] + number(5 * parameter_spread)};
  }
  return quad;
}

/// Clip positions (x, y, w) as points of the plane.
inline oracle::FourPoints positions_of(const rasterizer::Quad& quad) {
  oracle::FourPoints points;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& p = quad.positions[i];
    points[i] = {oracle::Rational(p.x), oracle::Rational(p.y), oracle::Rational(p.w)};
  }
  return points;
}

inline oracle::FourPoints parameters_of(const rasterizer::Quad& quad) {
  oracle::FourPoints points;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& r = quad.parameters[i];
    points[i] = {oracle::Rational(r.x), oracle::Rational(r.y)};
  }
  return points;
}

/// The exact map of clip positions (x, y, w) to parameters.
inline tl::expected<oracle::FourPointMap, oracle::FourPointError> exact_map(
    const rasterizer::Quad& quad) {
  return oracle::FourPointMap::infer(positions_of(quad), parameters_of(quad));
}

/// The largest error that a double may have, given the enclosure of the exact number.
inline double most_error(double computed, const oracle::Rational& exact) {
  const records::Enclosure around = exact.enclosure();
  return std::max(std::abs(computed - around.lo), std::abs(computed - around.hi));
}

}  // namespace rastercheck
