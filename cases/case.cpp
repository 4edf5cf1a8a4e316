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

Basis default_basis(Rules rules) { return rules == Rules::d3d ? Basis::snapped : Basis::ideal; }

}  // namespace rastercheck::cases
