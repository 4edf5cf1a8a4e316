#include "properties/laws/internal/picture_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties {
namespace {

using cases::Interpolation;
using cases::Location;

/// z/w in eighths, like some pipelines' clear depths.
float eighth(Draw& draw) {
  const int eighths = draw.between(1, 7);
  return static_cast<float>(eighths) / 8;
}

void add_vertex_about(Draw& draw, cases::Case& c, float depth, bool is_flat) {
  const WindowPoint p = draw.one_in(3) ? visible_sample(draw, c) : point_about(draw, c);
  const float w = is_flat ? draw.pick(std::array{1.0F, 1.0F, 2.0F}) : draw.uniform(0.25F, 4);
  add_vertex(c, at_window(c, p, depth, w));
}

/// Adds triangles parallel to the screen. Any two have the same depth everywhere or clearly
/// different depths.
void add_sheets(Draw& draw, cases::Case& c, int count) {
  for (int i = 0; i < count; ++i) {
    const float depth = eighth(draw);
    for (int corner = 0; corner < 3; ++corner) add_vertex_about(draw, c, depth, true);
  }
}

/// Adds triangles tilted in any direction, which pass through each other.
void add_tilted(Draw& draw, cases::Case& c, int count) {
  for (int i = 0; i < 3 * count; ++i) {
    const float depth = random_depth(draw, c);
    add_vertex_about(draw, c, depth, false);
  }
}

/// Adds the same triangle several times, with different attribute values, so that depths are equal
/// at every sample.
void add_repeated(Draw& draw, cases::Case& c, int count) {
  add_tilted(draw, c, 1);
  for (int i = 1; i < count; ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) add_vertex(c, c.positions[corner]);
  }
}

/// Adds triangles around a common first vertex. Each triangle shares an edge with the previous one,
/// and the fan folds over itself.
void add_fan(Draw& draw, cases::Case& c, int count) {
  add_tilted(draw, c, 1);
  for (int i = 1; i < count; ++i) {
    const cases::ClipVertex hub = c.positions[0];
    const cases::ClipVertex last = c.positions.back();
    add_vertex(c, hub);
    add_vertex(c, last);
    const float depth = eighth(draw);
    add_vertex_about(draw, c, depth, false);
  }
}

/// Adds triangles with some vertices behind the eye.
void add_through_eye(Draw& draw, cases::Case& c, int count) {
  add_tilted(draw, c, count);
  for (cases::ClipVertex& p : c.positions) {
    if (draw.one_in(4)) p.w = -p.w;
  }
}

float color(Draw& draw, std::size_t channel) {
  if (channel == 3) {
    return draw.one_in(4) ? draw.pick(std::array{0.0F, 0.5F, 1.0F}) : draw.uniform(-0.5F, 1.5F);
  }
  const int eighths = draw.between(-2, 10);
  const float free = draw.uniform(-0.25F, 1.25F);
  return draw.one_in(3) ? static_cast<float>(eighths) / 8 : free;
}

void set_colors(Draw& draw, cases::Case& c) {
  c.attributes.clear();
  c.attribute_values.clear();
  // Most users' attributes are smooth and located at the sample; rasterizers may have kernels for
  // them alone.
  const bool are_ordinary = draw.one_in(2);
  for (const char* name : {"red", "green", "blue", "alpha"}) {
    const auto interpolation =
        draw.pick(std::array{Interpolation::smooth, Interpolation::smooth,
                             Interpolation::noperspective, Interpolation::flat});
    const auto location = draw.pick(std::array{Location::sample, Location::sample, Location::sample,
                                               Location::center, Location::centroid});
    c.attributes.push_back({name, interpolation, location});
    if (are_ordinary) c.attributes.back() = {name, Interpolation::smooth, Location::sample};
  }
  if (draw.one_in(4)) c.attributes.pop_back();
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    for (std::size_t channel = 0; channel < c.attributes.size(); ++channel) {
      c.attribute_values.push_back(color(draw, channel));
    }
  }
}

}  // namespace

Generated overlapping_case(Draw& draw) {
  StateRequest request;
  request.least_side = 16;
  request.most_side = 32;
  Generated made;
  cases::Case& c = made.source;
  c = random_state(draw, request);
  c.depth_test = cases::DepthTest::none;
  if (!draw.one_in(4)) c.cull = cases::Cull::none;
  const int triangles = draw.between(2, 3 + draw.size() / 25);
  switch (draw.between(0, 5)) {
    case 0:
      made.stratum = "tilted";
      add_tilted(draw, c, triangles);
      break;
    case 1:
      made.stratum = "repeated";
      add_repeated(draw, c, triangles);
      break;
    case 2:
      made.stratum = "fans";
      add_fan(draw, c, triangles);
      break;
    case 3:
      made.stratum = "through eye";
      add_through_eye(draw, c, triangles);
      break;
    default:
      made.stratum = "sheets";
      add_sheets(draw, c, triangles);
  }
  add_separate_triangles(c);
  if (draw.one_in(4)) {
    add_attribute_values(draw, c);
  } else {
    set_colors(draw, c);
  }
  add_clip_distances(draw, c);
  return made;
}

bool draws_pictures(backends::Backend& backend) { return backend.picture_drawer() != nullptr; }

bool keeps_fragments_in_pictures(backends::Backend& backend) {
  return draws_pictures(backend) && keeps_fragments_in_pictures(backend.contract({}));
}

bool keeps_fragments_in_pictures(const cases::Contract& contract) {
  return !contract.picture_bounds || contract.picture_bounds->keeps_fragments;
}

bool draws_differences(backends::Backend& backend) {
  return draws_pictures(backend) &&
         (backend.contract({}).quad_share.has_value() || draws_differences_of_values(backend));
}

bool draws_differences_of_values(backends::Backend& backend) {
  const cases::Contract contract = backend.contract({});
  return contract.picture_bounds && keeps_fragments_in_pictures(contract);
}

bool may_be_cut(const cases::Case& c, std::uint32_t triangle) {
  const auto is_outside = [&](std::uint32_t vertex) {
    const cases::ClipVertex& p = c.positions[vertex];
    const float nearest = c.rules == cases::Rules::opengl ? -p.w : 0;
    const bool is_inside =
        p.w > 0 && std::abs(p.x) <= p.w && std::abs(p.y) <= p.w && p.z >= nearest && p.z <= p.w;
    const auto distances = c.clip_distances_of(vertex);
    return !is_inside ||
           std::any_of(distances.begin(), distances.end(), [](float d) { return !(d >= 0); });
  };
  const cases::Triangle& corners = c.triangles[triangle];
  return std::any_of(corners.begin(), corners.end(), is_outside);
}

}  // namespace rastercheck::properties
