#include "properties/fitting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "cases/capabilities.h"
#include "properties/random_state.h"

namespace rastercheck::properties {
namespace {

using cases::Capabilities;
using cases::Feature;

template <typename T>
T fitting(Draw& draw, const T& chosen, const std::vector<T>& all) {
  if (std::find(all.begin(), all.end(), chosen) != all.end()) return chosen;
  return all[static_cast<std::size_t>(draw.between(0, static_cast<int>(all.size()) - 1))];
}

/// Rounds the viewport down to whole pixels; sizes stay at least one pixel.
void drop_fractions(cases::Viewport& viewport) {
  viewport.x = std::floor(viewport.x);
  viewport.y = std::floor(viewport.y);
  for (float* const size : {&viewport.width, &viewport.height}) {
    const float whole = std::floor(std::fabs(*size));
    *size = std::copysign(std::max(whole, 1.0F), *size);
  }
}

void fit_viewport(const Capabilities& has, cases::Case& c) {
  cases::Viewport& viewport = c.viewport;
  if (!has.has(Feature::viewport_fractions)) drop_fractions(viewport);
  const auto most = static_cast<float>(has.max_viewport);
  viewport.width = std::clamp(viewport.width, -most, most);
  viewport.height = std::clamp(viewport.height, -most, most);
  for (float* const depth : {&viewport.min_depth, &viewport.max_depth}) {
    if (!has.numbers.has(*depth)) *depth = has.numbers.least;
  }
}

/// Returns an interpolation that the backend supports, preferably `chosen`; `chosen` if the backend
/// supports none.
cases::Interpolation fitting_interpolation(Draw& draw, const Capabilities& has,
                                           cases::Interpolation chosen) {
  constexpr std::array kFeatures{Feature::smooth, Feature::noperspective, Feature::flat};
  std::vector<cases::Interpolation> all;
  for (const auto one : {cases::Interpolation::smooth, cases::Interpolation::noperspective,
                         cases::Interpolation::flat}) {
    if (has.has(kFeatures[static_cast<std::size_t>(one)])) all.push_back(one);
  }
  return all.empty() ? chosen : fitting(draw, chosen, all);
}

void fit_attributes(Draw& draw, const Capabilities& has, cases::Case& c) {
  const bool has_any =
      has.has(Feature::smooth) || has.has(Feature::noperspective) || has.has(Feature::flat);
  const std::size_t most = has_any ? has.max_attributes : 0;
  const std::size_t count = c.attributes.size();
  if (count > most) {
    std::vector<float> kept;
    for (std::size_t v = 0; count > 0 && v * count < c.attribute_values.size(); ++v) {
      const auto of_vertex = c.attributes_of(v).first(most);
      kept.insert(kept.end(), of_vertex.begin(), of_vertex.end());
    }
    c.attribute_values = std::move(kept);
    c.attributes.resize(most);
  }
  for (cases::Attribute& a : c.attributes) {
    a.interpolation = fitting_interpolation(draw, has, a.interpolation);
  }
}

void drop_clip_distances(const Capabilities& has, cases::Case& c) {
  const std::size_t most = has.max_clip_distances;
  const std::size_t count = c.clip_distance_count;
  if (count <= most) return;
  std::vector<float> kept;
  for (std::size_t v = 0; v * count < c.clip_distances.size(); ++v) {
    const auto of_vertex = c.clip_distances_of(v).first(most);
    kept.insert(kept.end(), of_vertex.begin(), of_vertex.end());
  }
  c.clip_distances = std::move(kept);
  c.clip_distance_count = most;
}

/// Returns `number` if it is in range; else a number with the same sign and digits and an exponent
/// in range (the least magnitude if the range is too narrow).
float within(const cases::MagnitudeRange& range, float number) {
  if (range.has(number)) return number;
  int exponent = 0;
  const float digits = std::frexp(number, &exponent);  // 1/2 to 1
  const int lowest = range.least > 0 ? std::ilogb(range.least) + 2 : -125;
  const int highest = std::ilogb(range.greatest) - 1;
  const int span = highest - lowest;
  if (span < 1) return std::copysign(range.least, number);
  const int offset = ((exponent - lowest) % span + span) % span;
  return std::ldexp(digits, lowest + offset);
}

/// Reflects a vertex's coordinate at the viewport's sides until it is inside. Clamping would put
/// whole triangles onto a side.
float folded(float coordinate, float w) {
  if (std::fabs(coordinate) <= w) return coordinate;
  const double turns =
      std::fabs(std::remainder(double{coordinate} / double{w} + 1, 4.0));  // 0 to 2
  return std::clamp(static_cast<float>((turns - 1) * double{w}), -w, w);
}

/// A backend that loses subnormal numbers takes such a clamp for none.
void fit_bias(const Capabilities& has, cases::Case& c) {
  cases::DepthBias& bias = c.depth_bias;
  for (float* const number : {&bias.constant, &bias.slope, &bias.clamp}) {
    *number = within(has.numbers, *number);
  }
}

void fit_vertices(const Capabilities& has, cases::Case& c) {
  for (float& value : c.attribute_values) value = within(has.numbers, value);
  for (float& distance : c.clip_distances) distance = within(has.numbers, distance);
  if (c.camera) return;  // its clip positions are not computed yet
  for (cases::ClipVertex& p : c.positions) {
    p = {within(has.numbers, p.x), within(has.numbers, p.y), within(has.numbers, p.z),
         within(has.numbers, p.w)};
    const bool has_behind = has.has(Feature::nonpositive_w) && has.has(Feature::side_clipping);
    if (!has_behind && p.w <= 0) p.w = p.w < 0 ? -p.w : 1;
    if (!has.has(Feature::side_clipping)) {
      p.x = folded(p.x, p.w);
      p.y = folded(p.y, p.w);
    }
    if (!has.has(Feature::depth_clipping) && !c.depth_clamp && p.w > 0) {
      p.z = std::clamp(p.z, near_depth(c) * p.w, p.w);
    }
  }
}

/// Replaces the interpolation that the backend lacks by one that it supports; false if it supports
/// none.
bool replace_interpolation(cases::Case& c, Feature lacking, const Capabilities& has) {
  constexpr std::array kFeatures{Feature::smooth, Feature::noperspective, Feature::flat};
  const auto other = std::find_if(kFeatures.begin(), kFeatures.end(),
                                  [&has](Feature feature) { return has.has(feature); });
  if (other == kFeatures.end()) return false;
  for (cases::Attribute& a : c.attributes) {
    if (kFeatures[static_cast<std::size_t>(a.interpolation)] != lacking) continue;
    a.interpolation = static_cast<cases::Interpolation>(other - kFeatures.begin());
  }
  return true;
}

}  // namespace

bool leave_out(cases::Case& c, cases::Feature feature, const cases::Capabilities& has) {
  const auto replace = [&c](cases::Location location) {
    if (c.framebuffer.samples == 1) return;  // with one sample, all locations are the same
    for (cases::Attribute& a : c.attributes) {
      if (a.location == location) a.location = cases::Location::sample;
    }
  };
  switch (feature) {
    case Feature::clip_distances:
      c.clip_distances.clear();
      c.clip_distance_count = 0;
      return true;
    case Feature::depth_clamp:
      c.depth_clamp = false;
      return true;
    case Feature::depth_range:
      c.viewport.min_depth = 0;
      c.viewport.max_depth = 1;
      return true;
    case Feature::depth_test:
      c.depth_test = cases::DepthTest::none;
      return true;
    case Feature::depth_clear:
      c.depth_clear.reset();
      return true;
    case Feature::depth_bias:
      c.depth_bias = {};
      return true;
    case Feature::unorm_depth:
      c.depth_format = cases::DepthFormat::float32;
      return true;
    case Feature::viewport:
      c.viewport.x = 0;
      c.viewport.y = 0;
      c.viewport.width = static_cast<float>(c.framebuffer.width);
      c.viewport.height = static_cast<float>(c.framebuffer.height);
      return true;
    case Feature::scissor:
      c.scissor.reset();
      return true;
    case Feature::culling:
      c.cull = cases::Cull::none;
      return true;
    case Feature::center:
      replace(cases::Location::center);
      return true;
    case Feature::centroid:
      replace(cases::Location::centroid);
      return true;
    case Feature::smooth:
    case Feature::noperspective:
    case Feature::flat:
      return replace_interpolation(c, feature, has);
    case Feature::nonpositive_w:
    case Feature::depth_clipping:
    case Feature::side_clipping:
    case Feature::viewport_fractions:
      break;
  }
  return false;
}

cases::FramebufferSize fitted_size(const Capabilities& has, cases::FramebufferSize size) {
  for (int* const side : {&size.width, &size.height}) {
    const int fitted = std::min(*side, has.max_size);
    *side = std::max(fitted - fitted % has.size_multiple, has.size_multiple);
  }
  return size;
}

cases::Rules fitting_rules(Draw& draw, cases::Rules chosen) {
  return fitting(draw, chosen, draw.capabilities().rules);
}

int fitting_samples(Draw& draw, int chosen) {
  return fitting(draw, chosen, draw.capabilities().sample_counts);
}

void fit_state(Draw& draw, cases::Case& c) {
  const Capabilities& has = draw.capabilities();
  if (has.is_everything()) return;
  c.framebuffer = fitted_size(has, c.framebuffer);
  fit_attributes(draw, has, c);
  for (const Feature feature : has.lacks) leave_out(c, feature, has);
  fit_viewport(has, c);
  fit_bias(has, c);
  drop_clip_distances(has, c);
}

void fit_case(Draw& draw, cases::Case& c) {
  const Capabilities& has = draw.capabilities();
  if (has.is_everything()) return;
  c.rules = fitting_rules(draw, c.rules);
  c.framebuffer.samples = fitting_samples(draw, c.framebuffer.samples);
  fit_state(draw, c);
  if (c.rules == cases::Rules::d3d && c.viewport.min_depth > c.viewport.max_depth) {
    std::swap(c.viewport.min_depth, c.viewport.max_depth);
  }
  fit_vertices(has, c);
}

}  // namespace rastercheck::properties
