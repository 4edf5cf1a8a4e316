#include "backends/cpu/case_state.h"

#include <algorithm>
#include <string>

namespace rastercheck::backends {

namespace ras = rasterizer;

namespace {

ras::Cull cull(cases::Cull cull) {
  switch (cull) {
    case cases::Cull::none:
      return ras::Cull::none;
    case cases::Cull::back:
      return ras::Cull::back;
    case cases::Cull::front:
      break;
  }
  return ras::Cull::front;
}

ras::Primitive primitive(cases::Primitive primitive) {
  switch (primitive) {
    case cases::Primitive::triangles:
      return ras::Primitive::triangles;
    case cases::Primitive::lines:
      return ras::Primitive::lines;
    case cases::Primitive::points:
      break;
  }
  return ras::Primitive::points;
}

ras::LineMode line_mode(cases::LineMode mode) {
  switch (mode) {
    case cases::LineMode::rectangular:
      return ras::LineMode::rectangular;
    case cases::LineMode::parallelogram:
      return ras::LineMode::parallelogram;
    case cases::LineMode::bresenham:
      break;
  }
  return ras::LineMode::bresenham;
}

ras::Qualifier qualifier(const cases::Attribute& attribute) {
  ras::Qualifier q;
  switch (attribute.interpolation) {
    case cases::Interpolation::smooth:
      q.interpolation = ras::Interpolation::smooth;
      break;
    case cases::Interpolation::noperspective:
      q.interpolation = ras::Interpolation::noperspective;
      break;
    case cases::Interpolation::flat:
      q.interpolation = ras::Interpolation::flat;
      break;
  }
  switch (attribute.location) {
    case cases::Location::sample:
      q.location = ras::Location::sample;
      break;
    case cases::Location::center:
      q.location = ras::Location::center;
      break;
    case cases::Location::centroid:
      q.location = ras::Location::centroid;
      break;
  }
  return q;
}

}  // namespace

ras::Convention convention(cases::Rules rules) {
  switch (rules) {
    case cases::Rules::opengl:
      return ras::Convention::opengl;
    case cases::Rules::vulkan:
      return ras::Convention::vulkan;
    case cases::Rules::d3d:
      break;
  }
  return ras::Convention::d3d;
}

ras::DepthTest depth_test(cases::DepthFunction function) {
  switch (function) {
    case cases::DepthFunction::always:
      return ras::DepthTest::always;
    case cases::DepthFunction::never:
      return ras::DepthTest::never;
    case cases::DepthFunction::less:
      return ras::DepthTest::less;
    case cases::DepthFunction::equal:
      return ras::DepthTest::equal;
    case cases::DepthFunction::less_or_equal:
      return ras::DepthTest::less_or_equal;
    case cases::DepthFunction::greater:
      return ras::DepthTest::greater;
    case cases::DepthFunction::not_equal:
      return ras::DepthTest::not_equal;
    case cases::DepthFunction::greater_or_equal:
      break;
  }
  return ras::DepthTest::greater_or_equal;
}

ras::Blend blend(cases::Blend blend) {
  switch (blend) {
    case cases::Blend::off:
      return ras::Blend::off;
    case cases::Blend::over:
      return ras::Blend::over;
    case cases::Blend::additive:
      break;
  }
  return ras::Blend::additive;
}

ras::Wrap wrap(cases::Wrap wrap) {
  switch (wrap) {
    case cases::Wrap::repeat:
      return ras::Wrap::repeat;
    case cases::Wrap::clamp:
      return ras::Wrap::clamp;
    case cases::Wrap::mirror:
      break;
  }
  return ras::Wrap::mirror;
}

ras::Filter filter(cases::Filter filter) {
  switch (filter) {
    case cases::Filter::nearest:
      return ras::Filter::nearest;
    case cases::Filter::bilinear:
      return ras::Filter::bilinear;
    case cases::Filter::trilinear:
      break;
  }
  return ras::Filter::trilinear;
}

ras::ColorFormat format(cases::ColorFormat format) {
  return format == cases::ColorFormat::rgba8 ? ras::ColorFormat::rgba8 : ras::ColorFormat::float32;
}

ras::DepthFormat format(cases::DepthFormat format) {
  switch (format) {
    case cases::DepthFormat::unorm16:
      return ras::DepthFormat::unorm16;
    case cases::DepthFormat::unorm24:
      return ras::DepthFormat::unorm24;
    case cases::DepthFormat::float32:
    case cases::DepthFormat::float64:
    case cases::DepthFormat::unorm32:
      break;  // no case asks for the last two
  }
  return ras::DepthFormat::float32;
}

ras::Rounding rounding(cases::Rounding asked_for) {
  if (asked_for == cases::Rounding::floor) return ras::Rounding::floor;
  return asked_for == cases::Rounding::half_up ? ras::Rounding::half_up
                                               : ras::Rounding::nearest_even;
}

ras::Snapping snapping(const cases::Snapping& asked_for) {
  return {asked_for.subpixel_bits, rounding(asked_for.rounding)};
}

ras::State state_of(const cases::Case& c, ras::Conservative conservative) {
  ras::State s;
  s.convention = convention(c.rules);
  s.primitive = primitive(c.primitive);
  s.line_mode = line_mode(c.line_mode);
  s.line_width = c.line_width;
  s.point_size = c.point_size;
  s.viewport = {{c.viewport.x, c.viewport.y},
                {c.viewport.width, c.viewport.height},
                c.viewport.min_depth,
                c.viewport.max_depth};
  if (c.scissor) s.scissor = {{c.scissor->x, c.scissor->y}, {c.scissor->width, c.scissor->height}};
  s.cull = cull(c.cull);
  s.front_face = c.front_face == cases::FrontFace::ccw ? ras::FrontFace::ccw : ras::FrontFace::cw;
  s.fill_rule = c.fill_rule == cases::TieRule::top_left ? ras::FillRule::top_left
                                                        : ras::FillRule::bottom_left;
  s.depth_clamp = c.depth_clamp;
  s.depth_bias = {c.depth_bias.constant, c.depth_bias.slope, c.depth_bias.clamp};
  s.depth_format = format(c.depth_format);
  for (const cases::Attribute& attribute : c.attributes) {
    s.attributes.push_back(qualifier(attribute));
  }
  s.clip_distance_count = c.clip_distance_count;
  s.conservative = conservative;
  if (c.coverage && conservative == ras::Conservative::off) s.snapping = snapping(*c.coverage);
  s.basis = c.basis == cases::Basis::ideal ? ras::Basis::ideal : ras::Basis::snapped;
  return s;
}

float stored_clear(const cases::Case& c, float depth) {
  return ras::stored_depth(format(c.depth_format), depth);
}

std::optional<float> stored_clear(const cases::Case& c) {
  if (!c.depth_clear) return std::nullopt;
  return stored_clear(c, *c.depth_clear);
}

void promise_depths(const cases::Case& c, cases::Contract& contract) {
  // The bounds, rounded up to short decimals. Depths are rounded to float32 or stored as integers,
  // which has no bound in the contract's terms.
  constexpr float kBound = 0.51F;
  constexpr float kBoundBeforeStoring = 0.01F;
  static_assert(kBound >= ras::kValueBound && kBoundBeforeStoring >= ras::kValueBound - 0.5);
  const bool is_float = format(c.depth_format) == ras::DepthFormat::float32;
  contract.bounds.depth = {is_float ? kBound : kBoundBeforeStoring};
  contract.depth_format = c.depth_format;
  contract.depth_bias.unit =
      c.rules == cases::Rules::d3d ? cases::BiasUnit::least_value : cases::BiasUnit::power;
}

CaseMesh::CaseMesh(const cases::Case& c) : case_(c) {
  positions_.reserve(c.positions.size());
  for (const cases::ClipVertex& p : c.positions) positions_.emplace_back(p.x, p.y, p.z, p.w);
  triangles_.reserve(c.triangles.size());
  for (const cases::Triangle& t : c.triangles) triangles_.emplace_back(t[0], t[1], t[2]);
}

ras::Mesh CaseMesh::mesh() const {
  return {positions_, case_.attribute_values, case_.clip_distances, triangles_};
}

ras::TargetSize target_size(const cases::Case& c) {
  return {c.framebuffer.width, c.framebuffer.height, c.framebuffer.samples};
}

Error refused(ras::Error error) { return {"", "", std::string(ras::to_string(error))}; }

}  // namespace rastercheck::backends
