#include "properties/laws/internal/primitive_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cases/names.h"
#include "properties/generator.h"

namespace rastercheck::properties {
namespace {

bool is_inside(const cases::Case& c, std::uint32_t vertex) {
  const cases::ClipVertex& p = c.positions[vertex];
  const float near = c.rules == cases::Rules::opengl ? -p.w : 0.0F;
  const auto distances = c.clip_distances_of(vertex);
  return p.w > 0 && std::abs(p.x) < p.w && std::abs(p.y) < p.w && near < p.z && p.z < p.w &&
         std::all_of(distances.begin(), distances.end(), [](float d) { return d > 0; });
}

}  // namespace

bool draws_lines(backends::Backend& backend) {
  return backend.about().capabilities.draws(cases::Primitive::lines);
}
bool draws_points(backends::Backend& backend) {
  return backend.about().capabilities.draws(cases::Primitive::points);
}

Generated random_lines(Draw& draw) {
  cases::Case c = find_generator("lines")->make(draw);
  std::string stratum(cases::name_of(c.line_mode));
  return {std::move(c), std::move(stratum)};
}

Generated random_points(Draw& draw) { return {find_generator("points")->make(draw), "points"}; }

void set_area_mode(Draw& draw, cases::Case& c) {
  c.line_mode = draw.pick(std::array{cases::LineMode::rectangular, cases::LineMode::parallelogram});
}

void set_square_viewport(Draw& draw, cases::Case& c) {
  const int side = draw.one_in(2) ? 16 : 32;
  c.framebuffer.width = side;
  c.framebuffer.height = side;
  c.viewport.x = 0;
  c.viewport.y = 0;
  c.viewport.width = static_cast<float>(side);
  c.viewport.height = static_cast<float>(side);
}

void leave_out_flat_attributes(cases::Case& c) {
  for (cases::Attribute& attribute : c.attributes) {
    if (attribute.interpolation == cases::Interpolation::flat) {
      attribute.interpolation = cases::Interpolation::smooth;
    }
  }
}

void leave_out_centroids(cases::Case& c) {
  for (cases::Attribute& attribute : c.attributes) {
    if (attribute.location == cases::Location::centroid) {
      attribute.location = cases::Location::center;
    }
  }
}

bool is_inside(const cases::Case& c, const cases::Triangle& vertices) {
  return std::all_of(vertices.begin(), vertices.end(),
                     [&c](std::uint32_t vertex) { return is_inside(c, vertex); });
}

double floor_to_eighths(double at) { return std::floor(at * 8) / 8; }

bool is_on_eighths(const WindowPoint& p) {
  return floor_to_eighths(p.u) == p.u && floor_to_eighths(p.v) == p.v;
}

bool keeps_eighths(const cases::Contract& contract) {
  if (!contract.has_one_owner_of_ties()) return false;
  const auto& grid = contract.coverage;
  return !grid || (std::fmod(grid->steps(), 8.0) == 0 && grid->position_error == 0);
}

void for_each_sample(
    const cases::Case& c, const cases::Contract& contract,
    const std::function<void(const cases::SamplePlace&, const WindowPoint&)>& visit) {
  const std::vector<WindowPoint> pattern = sample_points(c, contract);
  const cases::Scissor all{0, 0, c.framebuffer.width, c.framebuffer.height};
  const cases::Scissor scissor = c.scissor.value_or(all);
  for (int y = std::max(scissor.y, 0); y < std::min(scissor.y + scissor.height, all.height); ++y) {
    for (int x = std::max(scissor.x, 0); x < std::min(scissor.x + scissor.width, all.width); ++x) {
      for (std::uint32_t s = 0; s < pattern.size(); ++s) {
        visit({0, static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x), s},
              {x + pattern[s].u, y + pattern[s].v});
      }
    }
  }
}

}  // namespace rastercheck::properties
