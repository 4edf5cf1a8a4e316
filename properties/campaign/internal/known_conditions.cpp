#include "properties/campaign/internal/known_conditions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "properties/judged_law.h"
#include "properties/window_position.h"
#include "records/histogram.h"

namespace rastercheck::properties {
namespace {

using cases::Case;
using cases::ClipVertex;
using records::KnownFact;
using records::KnownLimit;

/// A violation and a triangle to which it may belong.
struct ConditionQuestion {
  const Case* clip;
  const records::Violation* violation;
  const cases::Triangle* triangle;

  std::array<ClipVertex, 3> vertices() const {
    const auto& at = clip->positions;
    const cases::Triangle& t = *triangle;
    return {at[t[0]], at[t[1]], at[t[2]]};
  }
  template <typename Is>
  bool some_vertex(const Is& is) const {
    const auto all = vertices();
    return std::any_of(all.begin(), all.end(), is);
  }
};

/// Returns the clip z of the near plane at the w of this vertex.
float least_depth(const Case& c, const ClipVertex& v) {
  return c.rules == cases::Rules::opengl ? -v.w : 0;
}

bool is_beyond_depth(const Case& c, const ClipVertex& v) {
  return !c.depth_clamp && (v.z < least_depth(c, v) || v.z > v.w);
}

bool is_clipped(const ConditionQuestion& of) {
  const bool is_outside = of.some_vertex([&of](const ClipVertex& v) {
    return v.w <= 0 || std::abs(v.x) > v.w || std::abs(v.y) > v.w || is_beyond_depth(*of.clip, v);
  });
  const auto is_cut_off = [&of](std::uint32_t vertex) {
    const auto distances = of.clip->clip_distances_of(vertex);
    return std::any_of(distances.begin(), distances.end(), [](float d) { return d < 0; });
  };
  return is_outside || std::any_of(of.triangle->begin(), of.triangle->end(), is_cut_off);
}

bool is_fractional(const cases::Viewport& viewport) {
  const std::array<double, 4> edges{viewport.x, viewport.y,
                                    static_cast<double>(viewport.x) + viewport.width,
                                    static_cast<double>(viewport.y) + viewport.height};
  return std::any_of(edges.begin(), edges.end(), [](double e) { return e != std::floor(e); });
}

bool is_beyond_viewport(const cases::Viewport& viewport, const records::Violation& violation) {
  const auto is_beyond = [](double at, double origin, double size) {
    return at < std::min(origin, origin + size) || at >= std::max(origin, origin + size);
  };
  return violation.has_place() && (is_beyond(violation.place.x + 0.5, viewport.x, viewport.width) ||
                                   is_beyond(violation.place.y + 0.5, viewport.y, viewport.height));
}

bool is_so(KnownFact fact, const ConditionQuestion& of) {
  const Case& c = *of.clip;
  switch (fact) {
    case KnownFact::nonpositive_w:
      return of.some_vertex([](const ClipVertex& v) { return v.w <= 0; });
    case KnownFact::clipped:
      return is_clipped(of);
    case KnownFact::depth_clipped:
      return of.some_vertex([&c](const ClipVertex& v) { return is_beyond_depth(c, v); });
    case KnownFact::before_near:
      return of.some_vertex(
          [&c](const ClipVertex& v) { return v.w > 0 && v.z < least_depth(c, v); });
    case KnownFact::beyond_far:
      return of.some_vertex([](const ClipVertex& v) { return v.w > 0 && v.z > v.w; });
    case KnownFact::perspective: {
      const float w = of.vertices()[0].w;
      return of.some_vertex([w](const ClipVertex& v) { return v.w != w; });
    }
    case KnownFact::tie: {
      const auto& distance = of.violation->distance;
      return distance && distance->lo == 0 && distance->hi == 0;
    }
    case KnownFact::degenerate:
      // A degenerate triangle has no inside, so its violations have no distance.
      return of.violation->kind == records::AttributeKind::coverage && !of.violation->distance &&
             of.violation->has_place() && of.violation->place.triangle < c.triangles.size() &&
             is_sample_of(c, of.violation->place);
    case KnownFact::clip_distances:
      return c.clip_distance_count > 0;
    case KnownFact::depth_clamp:
      return c.depth_clamp;
    case KnownFact::depth_test:
      return c.depth_test != cases::DepthTest::none;
    case KnownFact::depth_clear:
      return c.depth_clear.has_value();
    case KnownFact::depth_bias:
      return !c.depth_bias.is_none();
    case KnownFact::unorm_depth:
      return cases::unorm_bits(c.depth_format) != 0;
    case KnownFact::snapped:
      return c.coverage.has_value();
    case KnownFact::scissor:
      return c.scissor.has_value();
    case KnownFact::culling:
      return c.cull != cases::Cull::none;
    case KnownFact::reversed_depth_range:
      return c.viewport.min_depth > c.viewport.max_depth;
    case KnownFact::negative_height:
      return c.viewport.height < 0;
    case KnownFact::fractional_viewport:
      return is_fractional(c.viewport);
    case KnownFact::beyond_viewport:
      break;
  }
  return is_beyond_viewport(c.viewport, *of.violation);
}

double largest_coordinate(const ConditionQuestion& of) {
  double largest = 0;
  for (const ClipVertex& v : of.vertices()) {
    if (v.w == 0) return std::numeric_limits<double>::infinity();
    const WindowPoint p = window_point(*of.clip, v);
    largest = std::max({largest, std::abs(p.u), std::abs(p.v)});
  }
  return largest;
}

std::optional<double> w_ratio(const ConditionQuestion& of) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (const ClipVertex& v : of.vertices()) {
    least = std::min(least, std::abs(double{v.w}));
    most = std::max(most, std::abs(double{v.w}));
  }
  if (most == 0) return std::nullopt;
  return most / least;
}

/// Returns twice the area divided by the length of the longest edge. The direction of y does not
/// matter.
std::optional<double> height(const ConditionQuestion& of) {
  std::array<WindowPoint, 3> p{};
  const auto all = of.vertices();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!(all[i].w > 0)) return std::nullopt;
    p[i] = window_point(*of.clip, all[i]);
  }
  double longest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const WindowPoint& next = p[(i + 1) % p.size()];
    longest = std::max(longest, std::hypot(next.u - p[i].u, next.v - p[i].v));
  }
  if (longest == 0) return 0;
  const double doubled_area =
      (p[1].u - p[0].u) * (p[2].v - p[0].v) - (p[2].u - p[0].u) * (p[1].v - p[0].v);
  return std::abs(doubled_area) / longest;
}

/// Returns the magnitudes of the violation's attribute at the three vertices.
std::vector<double> magnitudes(const ConditionQuestion& of) {
  std::vector<double> all;
  const auto attribute = of.violation->attribute;
  if (!attribute || *attribute >= of.clip->attributes.size()) return all;
  for (const std::uint32_t vertex : *of.triangle) {
    all.push_back(std::abs(double{of.clip->attributes_of(vertex)[*attribute]}));
  }
  return all;
}

std::optional<double> largest_value(const ConditionQuestion& of) {
  const std::vector<double> all = magnitudes(of);
  if (all.empty()) return std::nullopt;
  return *std::max_element(all.begin(), all.end());
}

std::optional<double> least_value(const ConditionQuestion& of) {
  std::vector<double> all = magnitudes(of);
  std::erase(all, 0.0);
  if (all.empty()) return std::nullopt;
  return *std::min_element(all.begin(), all.end());
}

std::optional<double> measure(KnownLimit limit, const ConditionQuestion& of) {
  const records::Violation& violation = *of.violation;
  switch (limit) {
    case KnownLimit::error_at_most:
      return violation.error ? std::optional(records::magnitude_bound(*violation.error))
                             : std::nullopt;
    case KnownLimit::distance_at_most:
      return violation.distance ? std::optional(records::magnitude_bound(*violation.distance))
                                : std::nullopt;
    case KnownLimit::largest_coordinate_at_least:
      return largest_coordinate(of);
    case KnownLimit::w_ratio_at_least:
      return w_ratio(of);
    case KnownLimit::height_at_most:
      return height(of);
    case KnownLimit::largest_value_at_least:
      return largest_value(of);
    case KnownLimit::least_value_at_most:
      return least_value(of);
    case KnownLimit::point_size_at_most:
      break;
  }
  const bool is_point = of.clip->primitive == cases::Primitive::points;
  return is_point ? std::optional<double>(of.clip->point_size) : std::nullopt;
}

template <typename T>
bool is_among(const std::vector<T>& all, const T& one) {
  return all.empty() || std::find(all.begin(), all.end(), one) != all.end();
}

bool meets_lists(const records::KnownConditions& when, const Case& c,
                 const records::Violation& violation) {
  if (!is_among(when.rules, c.rules) || !is_among(when.primitives, c.primitive) ||
      !is_among(when.samples, c.framebuffer.samples) ||
      !is_among(when.attribute_kinds, violation.kind) ||
      violation.note.find(when.note) == std::string::npos) {
    return false;
  }
  if (when.interpolations.empty() && when.locations.empty()) return true;
  const auto attribute = violation.attribute;
  if (!attribute || *attribute >= c.attributes.size()) return false;
  const cases::Attribute& varying = c.attributes[*attribute];
  return is_among(when.interpolations, varying.interpolation) &&
         is_among(when.locations, varying.location);
}

bool meets_of_triangle(const records::KnownConditions& when, const ConditionQuestion& of) {
  const bool facts_are_so = std::all_of(when.facts.begin(), when.facts.end(), [&of](const auto& f) {
    return is_so(f.first, of) == f.second;
  });
  return facts_are_so &&
         std::all_of(when.limits.begin(), when.limits.end(), [&of](const auto& limit) {
           const std::optional<double> measured = measure(limit.first, of);
           if (!measured) return false;
           return is_least(limit.first) ? *measured >= limit.second : *measured <= limit.second;
         });
}

}  // namespace

bool meets(const records::KnownConditions& when, const Case& clip,
           const records::Violation& violation) {
  if (!meets_lists(when, clip, violation)) return false;
  const auto meets_of = [&](const cases::Triangle& triangle) {
    return meets_of_triangle(when, {&clip, &violation, &triangle});
  };
  if (violation.has_place() && violation.place.triangle < clip.triangles.size()) {
    return meets_of(clip.triangles[violation.place.triangle]);
  }
  return std::any_of(clip.triangles.begin(), clip.triangles.end(), meets_of);
}

}  // namespace rastercheck::properties
