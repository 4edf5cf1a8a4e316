#pragma once

// Random cases for laws about the oracle itself. Each statement draws at most once, because the
// order of draws within one expression differs between compilers.

#include <rapidcheck.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "cases/case.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle {

/// Any finite float32, by its bits: all exponents are equally likely.
inline float any_float() {
  const auto bits = *rc::gen::arbitrary<std::uint32_t>();
  const float value = std::bit_cast<float>(bits);
  return std::isfinite(value) ? value : std::bit_cast<float>(bits & 0xbfffffffU);
}

/// k/64 with |k| <= 64·limit: positions of this form hit samples and each other exactly.
inline float grid_float(int limit) {
  const int k = *rc::gen::inRange(-64 * limit, 64 * limit + 1);
  return static_cast<float>(k) / 64.0F;
}

/// A number with up to 24 random bits, uniform within ±limit.
inline float ordinary_float(float limit) {
  const int mantissa = *rc::gen::inRange(-(1 << 24), (1 << 24) + 1);
  return static_cast<float>(mantissa) * 0x1p-24F * limit;
}

inline float random_float(float limit) {
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return any_float();
    case 1:
      return grid_float(static_cast<int>(limit));
    default:
      return ordinary_float(limit);
  }
}

/// A vertex with any w: positive, negative, zero, tiny, huge.
inline cases::ClipVertex random_vertex() {
  const float x = random_float(2);
  const float y = random_float(2);
  const float z = random_float(1);
  const float w = *rc::gen::inRange(0, 3) == 0 ? random_float(2) : std::abs(grid_float(4));
  return {x, y, z, w};
}

template <typename Enum>
Enum one_of(std::initializer_list<Enum> choices) {
  return *rc::gen::elementOf(std::vector<Enum>(choices));
}

/// One triangle with random state, drawn exactly: samples, rules, viewport, culling, qualifiers,
/// clip distances.
inline cases::Case random_exact_case() {
  const cases::ClipVertex first = random_vertex();
  const cases::ClipVertex second = random_vertex();
  const cases::ClipVertex third = random_vertex();
  const auto rules = one_of({cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d});
  cases::Case c = small_case(rules, 6, 5, {first, second, third});
  c.framebuffer.samples = one_of({1, 1, 2, 4, 8, 16});
  c.fill_rule = one_of({cases::TieRule::top_left, cases::TieRule::bottom_left});
  c.cull = one_of({cases::Cull::none, cases::Cull::none, cases::Cull::back, cases::Cull::front});
  c.front_face = one_of({cases::FrontFace::ccw, cases::FrontFace::cw});
  c.viewport.x = one_of({0.0F, 1.0F, 0.25F, -2.0F});
  c.viewport.y = one_of({0.0F, -0.5F, 1.0F});
  c.viewport.height *= one_of({1.0F, 1.0F, -1.0F});
  if (c.viewport.height < 0) c.viewport.y += 5;
  c.viewport.min_depth = one_of({0.0F, 0.25F});
  c.viewport.max_depth = one_of({1.0F, 0.75F});
  c.depth_clamp = *rc::gen::inRange(0, 4) == 0;
  for (int a = 0; a < 3; ++a) {
    c.attributes.push_back(
        {"a" + std::to_string(a),
         one_of({cases::Interpolation::smooth, cases::Interpolation::noperspective,
                 cases::Interpolation::flat}),
         one_of({cases::Location::sample, cases::Location::center})});
  }
  for (int i = 0; i < 9; ++i) c.attribute_values.push_back(random_float(4));
  c.clip_distance_count = static_cast<std::size_t>(*rc::gen::inRange(0, 3));
  for (std::size_t i = 0; i < 3 * c.clip_distance_count; ++i) {
    c.clip_distances.push_back(grid_float(1));
  }
  return c;
}

/// Makes the first triangle cover most of its target, unless a vertex lies behind the eye.
inline void cover_most(cases::Case& c) {
  constexpr std::array<std::array<float, 2>, 3> kCorners{{{-2, -2}, {3, -2}, {-2, 3}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const float x = kCorners[i][0] + grid_float(1);
    const float y = kCorners[i][1] + grid_float(1);
    const auto w = one_of({1.0F, 1.0F, 1.0F, 3.0F, 0x1p-20F, 0x1p40F, -0.5F});
    const auto z = one_of({0.0F, 0.5F, 0.3F, 1.0F});
    c.positions[i] = {x * w, y * w, z * w, w};
  }
  c.cull = cases::Cull::none;
  c.clip_distance_count = 0;
  c.clip_distances.clear();
}

}  // namespace rastercheck::oracle
