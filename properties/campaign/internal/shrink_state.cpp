// Passes that take parts of a case away: triangles, state, the camera.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "oracle/transform.h"
#include "properties/campaign/internal/shrink_search.h"

namespace rastercheck::properties {
namespace {

using cases::Case;

/// Removes number `column` from each vertex's `size` numbers.
void erase_column(std::vector<float>& values, std::size_t size, std::size_t column) {
  std::vector<float> rest;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % size != column) rest.push_back(values[i]);
  }
  values = std::move(rest);
}

void erase_attribute(Case& c, std::size_t attribute) {
  erase_column(c.attribute_values, c.attributes.size(), attribute);
  c.attributes.erase(c.attributes.begin() + static_cast<std::ptrdiff_t>(attribute));
}

void erase_clip_distance(Case& c, std::size_t distance) {
  erase_column(c.clip_distances, c.clip_distance_count, distance);
  --c.clip_distance_count;
}

/// Sets Vulkan's rules and the defaults that follow from them.
void use_vulkan(Case& c) {
  c.rules = cases::Rules::vulkan;
  c.basis = cases::default_basis(c.rules);
  c.fill_rule = cases::default_fill_rule(c.rules);
}

void simplify_attributes(ShrinkSearch& search) {
  search.offer_changed([](Case& c) {
    c.attributes.clear();
    c.attribute_values.clear();
  });
  for (std::size_t i = search.current().attributes.size(); i-- > 0;) {
    if (search.offer_changed([i](Case& c) { erase_attribute(c, i); })) continue;
    search.offer_changed([i](Case& c) { c.attributes[i].location = cases::Location::sample; });
    search.offer_changed(
        [i](Case& c) { c.attributes[i].interpolation = cases::Interpolation::smooth; });
  }
}

/// Offers one triangle alone, if necessary with other choices: the same `choices` may lead a law to
/// choose differently for one triangle than for all.
bool offer_alone(ShrinkSearch& search, std::size_t triangle) {
  constexpr std::uint64_t kMostOther = 15;
  Case alone = with_triangles(search.current(), {{triangle}});
  if (search.offer(alone)) return true;
  for (std::uint64_t other = 0; other < kMostOther; ++other) {
    // Laws take successive choices from different bits of the number, so the multiplication changes
    // all bits and not only the lowest.
    alone.choices = other * 0x9e3779b97f4a7c15U;
    if (search.offer(alone)) return true;
  }
  return false;
}

/// Collapses an edge to one end. This removes triangles without leaving a hole; removing a triangle
/// alone would leave one.
void collapse_edges(ShrinkSearch& search) {
  for (std::size_t i = 0; i < search.current().triangles.size() * 3; ++i) {
    const cases::Triangle& triangle = search.current().triangles[i / 3];
    const std::uint32_t from = triangle[i % 3];
    const std::uint32_t to = triangle[(i + 1) % 3];
    Case candidate = search.current();
    std::vector<std::size_t> rest;
    for (std::size_t t = 0; t < candidate.triangles.size(); ++t) {
      cases::Triangle& moved = candidate.triangles[t];
      std::replace(moved.begin(), moved.end(), from, to);
      const bool is_line = moved[0] == moved[1] || moved[1] == moved[2] || moved[2] == moved[0];
      if (!is_line) rest.push_back(t);
    }
    if (!rest.empty() && search.offer(with_triangles(candidate, rest))) i = 0;
  }
}

}  // namespace

void drop_triangles(ShrinkSearch& search) {
  const auto offer = [&search](const std::vector<std::size_t>& triangles) {
    return search.offer(with_triangles(search.current(), triangles));
  };
  const auto all = [&search] {
    std::vector<std::size_t> indices(search.current().triangles.size());
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    return indices;
  };
  // Each triangle is drawn as if alone, so the failing triangle mostly suffices.
  if (!search.check().violations.empty()) {
    const std::size_t guilty = search.check().violations.front().place.triangle;
    const std::size_t count = search.current().triangles.size();
    if (count > 1 && guilty < count && offer_alone(search, guilty)) return;
  }
  for (std::size_t part = search.current().triangles.size() / 2; part > 0; part /= 2) {
    for (std::size_t first = 0; first < search.current().triangles.size();) {
      std::vector<std::size_t> rest = all();
      const std::size_t last = std::min(first + part, rest.size());
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(first),
                 rest.begin() + static_cast<std::ptrdiff_t>(last));
      if (rest.empty() || !offer(rest)) first = last;
    }
  }
  if (search.current().triangles.size() > 1) collapse_edges(search);
  offer(all());  // drops unused vertices
}

void simplify_state(ShrinkSearch& search) {
  for (int samples = 1; samples < search.current().framebuffer.samples; samples *= 2) {
    if (search.offer_changed([samples](Case& c) { c.framebuffer.samples = samples; })) break;
  }
  search.offer_changed([](Case& c) { c.coverage.reset(); });
  search.offer_changed([](Case& c) {
    if (c.coverage) c.coverage = cases::Snapping();
  });
  search.offer_changed(&use_vulkan);
  search.offer_changed([](Case& c) { c.basis = cases::default_basis(c.rules); });
  search.offer_changed([](Case& c) { c.fill_rule = cases::default_fill_rule(c.rules); });
  search.offer_changed([](Case& c) { c.cull = cases::Cull::none; });
  search.offer_changed([](Case& c) { c.front_face = cases::FrontFace::ccw; });
  search.offer_changed([](Case& c) { c.scissor.reset(); });
  search.offer_changed([](Case& c) { c.depth_test = cases::DepthTest::none; });
  search.offer_changed([](Case& c) { c.depth_clear.reset(); });
  search.offer_changed([](Case& c) { c.depth_clamp = false; });
  search.offer_changed([](Case& c) { c.depth_bias = {}; });
  search.offer_changed([](Case& c) { c.depth_bias.clamp = 0; });
  search.offer_changed([](Case& c) { c.depth_bias.slope = 0; });
  search.offer_changed([](Case& c) { c.depth_bias.constant = 0; });
  search.offer_changed([](Case& c) { c.depth_format = cases::DepthFormat::float32; });
  search.offer_changed([](Case& c) {
    c.viewport.min_depth = 0;
    c.viewport.max_depth = 1;
  });
  for (std::size_t i = search.current().clip_distance_count; i-- > 0;) {
    search.offer_changed([i](Case& c) { erase_clip_distance(c, i); });
  }
  simplify_attributes(search);
}

void drop_camera(ShrinkSearch& search) {
  if (!search.current().camera) return;
  if (const Result<Case> clip = oracle::to_clip_case(search.current(), "")) {
    if (search.offer(*clip)) return;
  }
  search.offer_changed([](Case& c) { c.camera.reset(); });
  for (cases::Matrix4 cases::Camera::*const matrix :
       {&cases::Camera::model, &cases::Camera::view, &cases::Camera::projection}) {
    search.offer_changed([matrix](Case& c) {
      if (c.camera) (*c.camera).*matrix = cases::kIdentity;
    });
    for (std::size_t i = 0; i < cases::kIdentity.size() && search.current().camera; ++i) {
      search.offer_changed([&](Case& c) { ((*c.camera).*matrix)[i] = cases::kIdentity[i]; });
    }
  }
}

}  // namespace rastercheck::properties
