#pragma once

// Cases small enough to be checked by hand.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "cases/case.h"

namespace rastercheck::oracle {

/// One triangle of clip positions on a width × height framebuffer that the viewport fills;
/// `values[i]` are vertex i's attributes, all smooth.
inline cases::Case small_case(cases::Rules rules, int width, int height,
                              const std::array<cases::ClipVertex, 3>& positions,
                              const std::array<std::vector<float>, 3>& values = {}) {
  cases::Case c;
  c.rules = rules;
  c.fill_rule = cases::default_fill_rule(rules);
  c.basis = cases::default_basis(rules);
  c.framebuffer = {width, height, 1};
  c.viewport.width = static_cast<float>(width);
  c.viewport.height = static_cast<float>(height);
  c.positions.assign(positions.begin(), positions.end());
  for (std::size_t a = 0; a < values[0].size(); ++a) {
    c.attributes.push_back(
        {"a" + std::to_string(a), cases::Interpolation::smooth, cases::Location::sample});
  }
  for (const std::vector<float>& vertex : values) {
    c.attribute_values.insert(c.attribute_values.end(), vertex.begin(), vertex.end());
  }
  c.triangles = {{0, 1, 2}};
  return c;
}

}  // namespace rastercheck::oracle
