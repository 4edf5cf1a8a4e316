// Passes that take parts of a case away: triangles, state, the camera.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "oracle/transform.h"
#include "properties/campaign/internal/shrink_search.h"

namespace rastercheck::properties {
namespace {

using cases::Case;

/// `size` numbers of each vertex without one of them.
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

/// Vulkan's conventions, and what follows from them.
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

/// Offers one triangle alone. Laws choose what to do with a case by a hash of it, and so may do
/// something else with the triangle than they did with all: the same triangle in other words, with
/// another vertex first and all coordinates times a power of two, gets other choices.
bool offer_alone(ShrinkSearch& search, std::size_t triangle) {
  const Case alone = with_triangles(search.current(), {{triangle}});
  for (const int exponent : {0, 1, -1, 2, -2}) {
    for (const cases::Triangle& order : {cases::Triangle{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}) {
      Case other = alone;
      // Fewer than three vertices where the triangle names one twice.
      for (std::uint32_t& vertex : other.triangles[0]) {
        const auto place = std::find(alone.triangles[0].begin(), alone.triangles[0].end(), vertex);
        vertex =
            alone.triangles[0][order[static_cast<std::size_t>(place - alone.triangles[0].begin())]];
      }
      for (cases::ClipVertex& p : other.positions) {
        for (float* number : {&p.x, &p.y, &p.z, &p.w}) *number = std::ldexp(*number, exponent);
      }
      if (search.offer(std::move(other))) return true;
    }
  }
  return false;
}

/// Puts one end of an edge in the place of the other: of triangles that fill an outline, fewer that
/// fill one, where each that is taken away leaves a hole.
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
  // Triangles are drawn as if alone, so that mostly the one that fails suffices.
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
  offer(all());  // without vertices that nothing uses
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
