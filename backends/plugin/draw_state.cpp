#include "backends/plugin/draw_state.h"

#include <cstdint>

#include "cases/sample_pattern.h"

namespace rastercheck::backends {
namespace {

std::uint32_t rules_of(cases::Rules rules) {
  if (rules == cases::Rules::opengl) return RASTERCHECK_RULES_OPENGL;
  return rules == cases::Rules::vulkan ? RASTERCHECK_RULES_VULKAN : RASTERCHECK_RULES_D3D;
}

std::uint32_t cull_of(cases::Cull cull) {
  if (cull == cases::Cull::none) return RASTERCHECK_CULL_NONE;
  return cull == cases::Cull::back ? RASTERCHECK_CULL_BACK : RASTERCHECK_CULL_FRONT;
}

std::uint32_t basis_of(cases::Basis basis) {
  if (basis == cases::Basis::ideal) return RASTERCHECK_BASIS_IDEAL;
  return basis == cases::Basis::snapped ? RASTERCHECK_BASIS_SNAPPED : RASTERCHECK_BASIS_UNSPECIFIED;
}

std::uint32_t primitive_of(cases::Primitive primitive) {
  if (primitive == cases::Primitive::triangles) return RASTERCHECK_TRIANGLES;
  return primitive == cases::Primitive::lines ? RASTERCHECK_LINES : RASTERCHECK_POINTS;
}

std::uint32_t mode_of(cases::LineMode mode) {
  if (mode == cases::LineMode::rectangular) return RASTERCHECK_LINE_RECTANGULAR;
  return mode == cases::LineMode::parallelogram ? RASTERCHECK_LINE_PARALLELOGRAM
                                                : RASTERCHECK_LINE_BRESENHAM;
}

rastercheck_attribute attribute_of(const cases::Attribute& attribute) {
  rastercheck_attribute a{};
  a.interpolation = attribute.interpolation == cases::Interpolation::smooth ? RASTERCHECK_SMOOTH
                    : attribute.interpolation == cases::Interpolation::flat
                        ? RASTERCHECK_FLAT
                        : RASTERCHECK_NOPERSPECTIVE;
  a.location = attribute.location == cases::Location::sample   ? RASTERCHECK_AT_SAMPLE
               : attribute.location == cases::Location::center ? RASTERCHECK_AT_CENTER
                                                               : RASTERCHECK_AT_CENTROID;
  return a;
}

}  // namespace

rastercheck_draw draw_state(const cases::Case& c, const cases::Contract& promised) {
  rastercheck_draw draw{};
  draw.size = sizeof draw;
  draw.rules = rules_of(c.rules);
  draw.width = static_cast<std::uint32_t>(c.framebuffer.width);
  draw.height = static_cast<std::uint32_t>(c.framebuffer.height);
  draw.samples = static_cast<std::uint32_t>(c.framebuffer.samples);
  draw.viewport_x = c.viewport.x;
  draw.viewport_y = c.viewport.y;
  draw.viewport_width = c.viewport.width;
  draw.viewport_height = c.viewport.height;
  draw.min_depth = c.viewport.min_depth;
  draw.max_depth = c.viewport.max_depth;
  const cases::Scissor scissor =
      c.scissor.value_or(cases::Scissor{0, 0, c.framebuffer.width, c.framebuffer.height});
  draw.scissor_x = scissor.x;
  draw.scissor_y = scissor.y;
  draw.scissor_width = scissor.width;
  draw.scissor_height = scissor.height;
  draw.cull = cull_of(c.cull);
  draw.front_face = c.front_face == cases::FrontFace::ccw ? RASTERCHECK_FRONT_FACE_CCW
                                                          : RASTERCHECK_FRONT_FACE_CW;
  draw.depth_test = c.depth_test == cases::DepthTest::none ? 0 : 1;
  draw.depth_clear = promised.depth_beginning(c.depth_clear);
  draw.depth_clamp = c.depth_clamp ? 1 : 0;
  draw.bias_constant = c.depth_bias.constant;
  draw.bias_slope = c.depth_bias.slope;
  draw.bias_clamp = c.depth_bias.clamp;
  draw.depth_bits = static_cast<std::uint32_t>(cases::unorm_bits(c.depth_format));
  draw.primitive = primitive_of(c.primitive);
  draw.line_mode = mode_of(c.line_mode);
  draw.line_width = c.line_width;
  draw.point_size = c.point_size;
  draw.coverage = c.coverage ? RASTERCHECK_COVERAGE_SNAPPED : RASTERCHECK_COVERAGE_EXACT;
  if (c.coverage) {
    draw.subpixel_bits = static_cast<std::uint32_t>(c.coverage->subpixel_bits);
    draw.rounding = c.coverage->rounding == cases::Rounding::half_up
                        ? RASTERCHECK_ROUNDING_HALF_UP
                        : RASTERCHECK_ROUNDING_NEAREST_EVEN;
  }
  draw.tie_rule = c.fill_rule == cases::TieRule::top_left ? RASTERCHECK_TIE_RULE_TOP_LEFT
                                                          : RASTERCHECK_TIE_RULE_BOTTOM_LEFT;
  draw.basis = basis_of(promised.coverage ? c.basis : cases::Basis::ideal);
  draw.vertex_count = static_cast<std::uint32_t>(c.positions.size());
  draw.attribute_count = static_cast<std::uint32_t>(c.attributes.size());
  draw.clip_distance_count = static_cast<std::uint32_t>(c.clip_distance_count);
  return draw;
}

std::vector<float> sample_places(const cases::Case& c) {
  std::vector<float> places;
  for (const auto& p : cases::standard_pattern(c.framebuffer.samples)) {
    places.insert(places.end(), {static_cast<float>(p.x) / 16, static_cast<float>(p.y) / 16});
  }
  return places;
}

std::vector<rastercheck_attribute> plugin_attributes(const cases::Case& c) {
  std::vector<rastercheck_attribute> attributes;
  attributes.reserve(c.attributes.size());
  for (const cases::Attribute& a : c.attributes) attributes.push_back(attribute_of(a));
  return attributes;
}

}  // namespace rastercheck::backends
