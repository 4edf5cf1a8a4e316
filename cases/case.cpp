#include "cases/case.h"

namespace rastercheck::cases {

std::span<const float> Case::attributes_of(std::size_t vertex) const {
  return std::span(attribute_values).subspan(vertex * attributes.size(), attributes.size());
}

std::span<const float> Case::clip_distances_of(std::size_t vertex) const {
  return std::span(clip_distances).subspan(vertex * clip_distance_count, clip_distance_count);
}

TieRule default_fill_rule(Rules rules) {
  return rules == Rules::opengl ? TieRule::bottom_left : TieRule::top_left;
}

LineMode default_line_mode(Rules rules, int samples) {
  const bool is_thin = rules == Rules::d3d || (rules == Rules::opengl && samples == 1);
  return is_thin ? LineMode::bresenham : LineMode::rectangular;
}

Basis default_basis(Rules rules) { return rules == Rules::d3d ? Basis::snapped : Basis::ideal; }

}  // namespace rastercheck::cases
