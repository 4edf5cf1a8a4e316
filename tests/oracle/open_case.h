#pragma once

// Random cases and contracts that leave open where vertices are placed.

#include <rapidcheck.h>

#include <cmath>
#include <string>

#include "cases/contract.h"
#include "tests/oracle/random_case.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle {

/// A vertex around the target, usually in front of the eye.
inline cases::ClipVertex open_vertex(bool is_on_grid, int size) {
  const auto w = one_of({1.0F, 1.0F, 1.5F, 0.37F, 4.0F, 0x1p-20F, 30.0F});
  const float x = is_on_grid ? std::floor(ordinary_float(2) * static_cast<float>(size)) /
                                   static_cast<float>(size)
                             : ordinary_float(1.5F);
  const float y = ordinary_float(1.5F);
  const auto z = one_of({0.5F, 0.5F, 0.1F, 0.73F, 0.999F, 1.0F});
  const auto beyond = one_of({0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.6F});
  return {x * w, y * w, (z + beyond) * w, w};
}

inline cases::Snapping open_snapping() {
  cases::Snapping snapping;
  snapping.subpixel_bits = one_of({0, 2, 4, 8, 8, 12});
  snapping.rounding = one_of(
      {cases::Rounding::unspecified, cases::Rounding::unspecified, cases::Rounding::nearest_even});
  snapping.position_error = one_of({0.0F, 0.0F, 0.01F, 0.75F});
  return snapping;
}

/// One triangle, usually of a few to several dozen pixels, with attributes that vary by much,
/// by little or not at all.
inline cases::Case open_case() {
  const int size = one_of({4, 9, 24});
  const auto is_on_grid = *rc::gen::inRange(0, 4) == 0;
  const cases::ClipVertex a = open_vertex(is_on_grid, size);
  const cases::ClipVertex b = open_vertex(is_on_grid, size);
  const cases::ClipVertex c = open_vertex(is_on_grid, size);
  const auto rules = one_of({cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d});
  cases::Case made = small_case(rules, size, size, {a, b, c});
  made.framebuffer.samples = one_of({1, 1, 4});
  made.depth_clamp = *rc::gen::inRange(0, 4) == 0;
  if (*rc::gen::inRange(0, 4) == 0) made.viewport.max_depth = 0.75F;
  for (int i = 0; i < 3; ++i) {
    made.attributes.push_back(
        {"a" + std::to_string(i),
         one_of({cases::Interpolation::smooth, cases::Interpolation::noperspective}),
         one_of({cases::Location::sample, cases::Location::center, cases::Location::centroid})});
  }
  // Sometimes the first attribute varies along x only, so that moves along y hardly change it.
  const auto is_along_x = *rc::gen::inRange(0, 3) == 0;
  const auto is_zero = *rc::gen::inRange(0, 5) == 0;
  for (std::size_t vertex = 0; vertex < 3; ++vertex) {
    const cases::ClipVertex& p = made.positions[vertex];
    const float varying = is_along_x ? p.x / p.w : ordinary_float(4);
    const float almost_constant = 3 + 0x1p-21F * static_cast<float>(*rc::gen::inRange(0, 3));
    const auto any = *rc::gen::inRange(0, 5) == 0 ? random_float(4) : ordinary_float(1);
    made.attribute_values.insert(made.attribute_values.end(),
                                 {varying, almost_constant, is_zero ? 0.0F : any});
  }
  made.coverage = open_snapping();
  made.basis = one_of({cases::Basis::unspecified, cases::Basis::unspecified, cases::Basis::snapped,
                       cases::Basis::ideal});
  return made;
}

inline cases::Contract open_contract(const cases::Case& c) {
  cases::Contract contract = cases::contract_of(c);
  contract.is_on_grid = *rc::gen::arbitrary<bool>();
  contract.keeps_sign_of_zero = *rc::gen::arbitrary<bool>();
  contract.viewport_error = one_of({0.0, 0.0, 0.0, 0.125, 1.0});
  contract.bounds.smooth = one_of<cases::ValueBound>({{0.5F, 0}, {8, 0}, {300, 0}, {0.5F, 0.25F}});
  contract.bounds.noperspective.constant = one_of({0.5F, 4.0F, 1000.0F});
  contract.bounds.depth.constant = one_of({0.5F, 1.0F, 50.0F});
  return contract;
}

}  // namespace rastercheck::oracle
