#include "properties/campaign/sabotage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "cases/sample_pattern.h"
#include "cases/sample_place.h"
#include "oracle/judge.h"

namespace rastercheck::properties {
namespace {

using cases::Case;
using cases::Fragments;
using cases::SamplePlace;
using records::Defect;

// --- Drawings ------------------------------------------------------------------------------------

/// True if two drawings are equal to the bit.
bool are_same(const Fragments& a, const Fragments& b) {
  const auto are = [](const std::vector<float>& x, const std::vector<float>& y) {
    return x.size() == y.size() &&
           (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) == 0);
  };
  return a.triangle == b.triangle && a.x == b.x && a.y == b.y && a.sample == b.sample &&
         are(a.depth, b.depth) && are(a.attributes, b.attributes);
}

std::optional<Fragments> unless_same(const Drawing& drawing, Fragments other) {
  if (are_same(*drawing.fragments, other)) return std::nullopt;
  return other;
}

std::optional<Fragments> redrawn(const Drawing& drawing, const Case& other) {
  std::optional<Fragments> drawn = drawing.draw(other);
  if (!drawn) return std::nullopt;
  return unless_same(drawing, *std::move(drawn));
}

/// Adds a copy of a fragment at another place. Derivatives are not judged here and are left out.
void append(Fragments& to, const Fragments& from, std::size_t i, const SamplePlace& place) {
  to.triangle.push_back(place.triangle);
  to.x.push_back(static_cast<std::uint16_t>(place.x));
  to.y.push_back(static_cast<std::uint16_t>(place.y));
  to.sample.push_back(static_cast<std::uint8_t>(place.sample));
  to.depth.push_back(from.depth[i]);
  const auto values = from.attributes_of(i);
  to.attributes.insert(to.attributes.end(), values.begin(), values.end());
}

/// Returns the drawing without its lost fragments; empty if none is lost.
template <typename Lost>
std::optional<Fragments> without(const Drawing& drawing, const Lost& is_lost) {
  const Fragments& drawn = *drawing.fragments;
  Fragments other;
  other.attribute_count = drawn.attribute_count;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (!is_lost(i)) append(other, drawn, i, drawn.place_of(i));
  }
  if (other.size() == drawn.size()) return std::nullopt;
  return other;
}

// --- Geometry ------------------------------------------------------------------------------------

/// A window position, in pixels.
struct Point {
  double x = 0;
  double y = 0;
};

Point point_of(const Case& c, const SamplePlace& place) {
  const auto pattern = cases::standard_pattern(c.framebuffer.samples);
  if (place.sample >= pattern.size()) return {place.x + 0.5, place.y + 0.5};
  return {place.x + pattern[place.sample].x / 16.0, place.y + pattern[place.sample].y / 16.0};
}

/// A triangle's window positions and depths in doubles: exact enough for defects, all of which
/// exceed the resolution of float32. Meaningless for a triangle with a w <= 0 or without area.
class NearTriangle {
 public:
  NearTriangle(const Case& c, std::size_t triangle) : indices_(c.triangles[triangle]) {
    for (std::size_t i = 0; i < 3; ++i) {
      const cases::ClipVertex& p = c.positions[indices_[i]];
      if (!(p.w > 0)) is_whole_ = false;
      const double sign = c.rules == cases::Rules::d3d ? -1 : 1;
      w_[i] = double{p.w};
      at_[i].x = (p.x / w_[i] + 1) * double{c.viewport.width} / 2 + double{c.viewport.x};
      at_[i].y = (sign * p.y / w_[i] + 1) * double{c.viewport.height} / 2 + double{c.viewport.y};
      const double near = c.rules == cases::Rules::opengl ? -1 : 0;
      depth_[i] = double{c.viewport.min_depth} +
                  (p.z / w_[i] - near) / (1 - near) *
                      (double{c.viewport.max_depth} - double{c.viewport.min_depth});
    }
    area_ = edge(0, at_[0]) + edge(1, at_[0]) + edge(2, at_[0]);
  }

  bool is_whole() const { return is_whole_ && area_ != 0; }
  const cases::Triangle& indices() const { return indices_; }

  double attribute(const Case& c, std::size_t a, bool is_perspective, Point at) const {
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) values[i] = double{c.attributes_of(indices_[i])[a]};
    return interpolated(values, is_perspective, at);
  }
  double depth(Point at) const { return interpolated(depth_, false, at); }

  /// Returns the distance in pixels from the line through corners i + 1 and i + 2, positive inside.
  double distance(std::size_t i, Point at) const {
    const Point& a = at_[(i + 1) % 3];
    const Point& b = at_[(i + 2) % 3];
    return edge(i, at) / std::hypot(b.x - a.x, b.y - a.y) * (area_ < 0 ? -1 : 1);
  }
  /// Returns the distance from the nearest of the three lines, negative outside.
  double distance(Point at) const {
    return std::min({distance(0, at), distance(1, at), distance(2, at)});
  }

 private:
  double edge(std::size_t i, Point p) const {
    const Point& a = at_[(i + 1) % 3];
    const Point& b = at_[(i + 2) % 3];
    return (a.x - p.x) * (b.y - p.y) - (b.x - p.x) * (a.y - p.y);
  }
  double interpolated(const std::array<double, 3>& values, bool is_perspective, Point at) const {
    double sum = 0;
    double weights = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double weight = is_perspective ? edge(i, at) / w_[i] : edge(i, at);
      sum += weight * values[i];
      weights += weight;
    }
    return sum / weights;
  }

  cases::Triangle indices_;
  std::array<Point, 3> at_{};
  std::array<double, 3> w_{};
  std::array<double, 3> depth_{};
  double area_ = 0;
  bool is_whole_ = true;
};

std::vector<NearTriangle> triangles_of(const Case& c) {
  std::vector<NearTriangle> triangles;
  triangles.reserve(c.triangles.size());
  for (std::size_t t = 0; t < c.triangles.size(); ++t) triangles.emplace_back(c, t);
  return triangles;
}

// --- Coverage ------------------------------------------------------------------------------------

/// Moves all vertices right by 1/kParts pixel.
template <int kParts>
std::optional<Fragments> moved(const Drawing& drawing) {
  Case other = *drawing.source;
  const double step = 2 / (kParts * double{other.viewport.width});
  for (cases::ClipVertex& p : other.positions) {
    p.x = static_cast<float>(double{p.x} + double{p.w} * step);
  }
  return redrawn(drawing, other);
}

/// True for the distances at which a defect may add or remove a sample: at most 1/kParts pixel from
/// the boundary, but more than a 16th of that.
template <int kParts>
bool is_in_reach(double pixels) {
  return pixels <= 1.0 / kParts && pixels > 1.0 / (kParts * 16);
}

/// Removes one sample: among the inner samples that is_in_reach() accepts, the one farthest from
/// the boundary.
template <int kParts>
std::optional<Fragments> one_missing(const Drawing& drawing) {
  const Fragments& drawn = *drawing.fragments;
  const std::vector<NearTriangle> triangles = triangles_of(*drawing.source);
  std::optional<std::size_t> lost;
  double farthest = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const NearTriangle& triangle = triangles[drawn.triangle[i]];
    if (!triangle.is_whole()) continue;
    const double inside = triangle.distance(point_of(*drawing.source, drawn.place_of(i)));
    if (!is_in_reach<kParts>(inside) || inside <= farthest) continue;
    farthest = inside;
    lost = i;
  }
  if (!lost) return std::nullopt;
  return without(drawing, [&lost](std::size_t i) { return i == *lost; });
}

/// Returns the places beside a fragment: all samples of its pixel, and the same sample of the four
/// neighbouring pixels.
std::vector<SamplePlace> places_beside(const Case& c, const SamplePlace& place) {
  std::vector<SamplePlace> all;
  for (std::uint32_t s = 0; std::cmp_less(s, c.framebuffer.samples); ++s) {
    all.push_back({place.triangle, place.y, place.x, s});
  }
  if (place.x > 0) all.push_back({place.triangle, place.y, place.x - 1, place.sample});
  if (place.y > 0) all.push_back({place.triangle, place.y - 1, place.x, place.sample});
  if (std::cmp_less(place.x + 1, c.framebuffer.width)) {
    all.push_back({place.triangle, place.y, place.x + 1, place.sample});
  }
  if (std::cmp_less(place.y + 1, c.framebuffer.height)) {
    all.push_back({place.triangle, place.y + 1, place.x, place.sample});
  }
  return all;
}

/// Adds one sample: among the outer places that is_in_reach() accepts, the one farthest from the
/// boundary.
template <int kParts>
std::optional<Fragments> one_extra(const Drawing& drawing) {
  const Case& c = *drawing.source;
  const Fragments& drawn = *drawing.fragments;
  const std::vector<NearTriangle> triangles = triangles_of(c);
  std::set<SamplePlace> there;
  for (std::size_t i = 0; i < drawn.size(); ++i) there.insert(drawn.place_of(i));
  std::optional<std::pair<std::size_t, SamplePlace>> extra;
  double farthest = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const NearTriangle& triangle = triangles[drawn.triangle[i]];
    if (!triangle.is_whole()) continue;
    for (const SamplePlace& place : places_beside(c, drawn.place_of(i))) {
      const double outside = -triangle.distance(point_of(c, place));
      if (!is_in_reach<kParts>(outside) || outside <= farthest || there.contains(place)) continue;
      farthest = outside;
      extra = {i, place};
    }
  }
  if (!extra) return std::nullopt;
  Fragments other = drawn;
  other.derivatives.clear();
  append(other, drawn, extra->first, extra->second);
  return other;
}

/// Loses the fragments within a quarter pixel of an edge that two triangles share, as if the two
/// were drawn from differently rounded vertices.
std::optional<Fragments> crack(const Drawing& drawing) {
  constexpr double kPixels = 0.25;
  const Case& c = *drawing.source;
  const Fragments& drawn = *drawing.fragments;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  const auto edge_of = [](const cases::Triangle& triangle, std::size_t i) {
    // std::minmax() of two numbers returns references to them; of a list it returns copies.
    return std::minmax({triangle[(i + 1) % 3], triangle[(i + 2) % 3]});
  };
  for (const cases::Triangle& triangle : c.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[edge_of(triangle, i)];
  }
  const std::vector<NearTriangle> triangles = triangles_of(c);
  return without(drawing, [&](std::size_t f) {
    const NearTriangle& triangle = triangles[drawn.triangle[f]];
    if (!triangle.is_whole()) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool is_shared = edges[edge_of(triangle.indices(), i)] > 1;
      if (is_shared && triangle.distance(i, point_of(c, drawn.place_of(f))) <= kPixels) return true;
    }
    return false;
  });
}

std::optional<Fragments> reordered_samples(const Drawing& drawing) {
  Fragments other = *drawing.fragments;
  const int count = drawing.source->framebuffer.samples;
  for (std::uint8_t& sample : other.sample) {
    sample = static_cast<std::uint8_t>((sample + 1) % count);
  }
  return unless_same(drawing, std::move(other));
}

// --- Values --------------------------------------------------------------------------------------

/// Returns the drawing with all attribute values except flat ones changed by `change(fragment,
/// attribute, value)`.
template <typename Change>
std::optional<Fragments> with_values(const Drawing& drawing, const Change& change) {
  Fragments other = *drawing.fragments;
  const std::size_t count = other.attribute_count;
  for (std::size_t i = 0; i < other.size(); ++i) {
    for (std::size_t a = 0; a < count; ++a) {
      if (drawing.source->attributes[a].interpolation == cases::Interpolation::flat) continue;
      float& value = other.attributes[i * count + a];
      value = change(i, a, value);
    }
  }
  return unless_same(drawing, std::move(other));
}

template <typename Change>
std::optional<Fragments> with_depths(const Drawing& drawing, const Change& change) {
  Fragments other = *drawing.fragments;
  for (std::size_t i = 0; i < other.size(); ++i) other.depth[i] = change(i, other.depth[i]);
  return unless_same(drawing, std::move(other));
}

float scaled(float value, int parts, int of) {
  return static_cast<float>(double{value} * parts / of);
}

template <int kParts, int kOf>
std::optional<Fragments> scale_values(const Drawing& drawing) {
  return with_values(
      drawing, [](std::size_t, std::size_t, float value) { return scaled(value, kParts, kOf); });
}

template <int kParts, int kOf>
std::optional<Fragments> scale_depths(const Drawing& drawing) {
  return with_depths(drawing, [](std::size_t, float value) { return scaled(value, kParts, kOf); });
}

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

std::optional<Fragments> no_values(const Drawing& drawing) {
  return with_values(drawing, [](std::size_t, std::size_t, float) { return kNaN; });
}

std::optional<Fragments> no_depths(const Drawing& drawing) {
  return with_depths(drawing, [](std::size_t, float) { return kNaN; });
}

std::optional<Fragments> one_number(const Drawing& drawing) {
  return with_values(drawing, [](std::size_t, std::size_t, float) { return 12345.0F; });
}

/// Returns the spacing of float32 numbers at a magnitude.
double spacing_at(float magnitude) {
  return double{std::nextafter(magnitude, std::numeric_limits<float>::infinity())} -
         double{magnitude};
}

template <int kUlp>
std::optional<Fragments> values_off(const Drawing& drawing) {
  const Case& c = *drawing.source;
  const Fragments& drawn = *drawing.fragments;
  return with_values(drawing, [&](std::size_t i, std::size_t a, float value) {
    float greatest = 0;
    for (const std::uint32_t vertex : c.triangles[drawn.triangle[i]]) {
      greatest = std::max(greatest, std::abs(c.attributes_of(vertex)[a]));
    }
    return static_cast<float>(double{value} + kUlp * spacing_at(greatest));
  });
}

template <int kUlp>
std::optional<Fragments> depths_off(const Drawing& drawing) {
  const cases::Viewport& viewport = drawing.source->viewport;
  const double off = kUlp * spacing_at(std::max(viewport.min_depth, viewport.max_depth));
  return with_depths(
      drawing, [off](std::size_t, float value) { return static_cast<float>(double{value} + off); });
}

/// Adds `difference(triangle, attribute, place)` to the drawn values, which leaves the drawing's
/// own rounding errors as they are.
template <typename Difference>
std::optional<Fragments> add_to_values(const Drawing& drawing, const Difference& difference) {
  const Fragments& drawn = *drawing.fragments;
  const std::vector<NearTriangle> triangles = triangles_of(*drawing.source);
  return with_values(drawing, [&](std::size_t i, std::size_t a, float value) {
    const NearTriangle& triangle = triangles[drawn.triangle[i]];
    if (!triangle.is_whole()) return value;
    const Point at = point_of(*drawing.source, drawn.place_of(i));
    return static_cast<float>(double{value} + difference(triangle, a, at));
  });
}

Point half_a_pixel_from(Point at) { return {at.x + 0.5, at.y + 0.5}; }

bool is_smooth(const Case& c, std::size_t attribute) {
  return c.attributes[attribute].interpolation == cases::Interpolation::smooth;
}

std::optional<Fragments> values_half_a_pixel_off(const Drawing& drawing) {
  const Case& c = *drawing.source;
  return add_to_values(drawing, [&c](const NearTriangle& t, std::size_t a, Point at) {
    return t.attribute(c, a, is_smooth(c, a), half_a_pixel_from(at)) -
           t.attribute(c, a, is_smooth(c, a), at);
  });
}

std::optional<Fragments> depths_half_a_pixel_off(const Drawing& drawing) {
  const Fragments& drawn = *drawing.fragments;
  const std::vector<NearTriangle> triangles = triangles_of(*drawing.source);
  return with_depths(drawing, [&](std::size_t i, float value) {
    const NearTriangle& triangle = triangles[drawn.triangle[i]];
    if (!triangle.is_whole()) return value;
    const Point at = point_of(*drawing.source, drawn.place_of(i));
    const double off = triangle.depth(half_a_pixel_from(at)) - triangle.depth(at);
    return static_cast<float>(double{value} + off);
  });
}

std::optional<Fragments> affine_for_perspective(const Drawing& drawing) {
  const Case& c = *drawing.source;
  return add_to_values(drawing, [&c](const NearTriangle& t, std::size_t a, Point at) {
    return is_smooth(c, a) ? t.attribute(c, a, false, at) - t.attribute(c, a, true, at) : 0.0;
  });
}

std::optional<Fragments> values_of_another(const Drawing& drawing) {
  const Case& c = *drawing.source;
  const Fragments& drawn = *drawing.fragments;
  const std::vector<NearTriangle> triangles = triangles_of(c);
  return with_values(drawing, [&](std::size_t i, std::size_t a, float value) {
    const NearTriangle& other = triangles[(drawn.triangle[i] + 1) % triangles.size()];
    if (triangles.size() == 1 || !other.is_whole()) return value;
    const Point at = point_of(c, drawn.place_of(i));
    return static_cast<float>(other.attribute(c, a, is_smooth(c, a), at));
  });
}

std::optional<Fragments> centroid_for_centre(const Drawing& drawing) {
  Case other = *drawing.source;
  if (other.framebuffer.samples == 1) return std::nullopt;
  for (cases::Attribute& attribute : other.attributes) {
    if (attribute.location == cases::Location::center) {
      attribute.location = cases::Location::centroid;
    }
  }
  if (other.attributes == drawing.source->attributes) return std::nullopt;
  return redrawn(drawing, other);
}

constexpr auto kSabotages = std::to_array<Sabotage>({
    {Defect::moved_half, &moved<2>},
    {Defect::moved_16th, &moved<16>},
    {Defect::moved_64th, &moved<64>},
    {Defect::moved_256th, &moved<256>},
    {Defect::moved_1024th, &moved<1024>},
    {Defect::extra_pixel, &one_extra<1>, kCoverageAlone},
    {Defect::extra_16th, &one_extra<16>, kCoverageAlone},
    {Defect::extra_256th, &one_extra<256>, kCoverageAlone},
    {Defect::missing_pixel, &one_missing<1>, kCoverageAlone},
    {Defect::missing_16th, &one_missing<16>, kCoverageAlone},
    {Defect::missing_256th, &one_missing<256>, kCoverageAlone},
    {Defect::crack, &crack, kCoverageAlone},
    {Defect::sample_order, &reordered_samples},
    {Defect::values_97, &scale_values<97, 100>, kValuesAlone},
    {Defect::values_99, &scale_values<99, 100>, kValuesAlone},
    {Defect::values_999, &scale_values<999, 1000>, kValuesAlone},
    {Defect::values_99999, &scale_values<99999, 100000>, kValuesAlone},
    {Defect::values_8_ulp, &values_off<8>, kValuesAlone},
    {Defect::values_2_ulp, &values_off<2>, kValuesAlone},
    {Defect::values_half_pixel, &values_half_a_pixel_off, kValuesAlone},
    {Defect::values_affine, &affine_for_perspective, kValuesAlone},
    {Defect::values_of_another, &values_of_another, kValuesAlone},
    {Defect::values_centroid, &centroid_for_centre, kValuesAlone},
    {Defect::values_nan, &no_values, kValuesAlone},
    {Defect::values_12345, &one_number, kValuesAlone},
    {Defect::depth_90, &scale_depths<90, 100>, kValuesAlone},
    {Defect::depth_99, &scale_depths<99, 100>, kValuesAlone},
    {Defect::depth_999, &scale_depths<999, 1000>, kValuesAlone},
    {Defect::depth_99999, &scale_depths<99999, 100000>, kValuesAlone},
    {Defect::depth_8_ulp, &depths_off<8>, kValuesAlone},
    {Defect::depth_2_ulp, &depths_off<2>, kValuesAlone},
    {Defect::depth_half_pixel, &depths_half_a_pixel_off, kValuesAlone},
    {Defect::depth_nan, &no_depths, kValuesAlone},
});
static_assert(kSabotages.size() == names_of(Defect{}).size());

bool has_wrong_class(const records::ClassCounts& classes) {
  for (std::size_t i = 0; i < classes.counts.size(); ++i) {
    const auto fragment_class = static_cast<records::FragmentClass>(i);
    if (fragment_class != records::FragmentClass::correct && classes.counts[i] > 0) return true;
  }
  return false;
}

}  // namespace

std::span<const Sabotage> sabotages() { return kSabotages; }

bool has_wrong(const cases::ClipCase& source, const cases::Contract& contract,
               const Fragments& drawn, const JudgeRequest& request) {
  const oracle::SceneTruth scene(source, contract);
  oracle::JudgeOptions options;
  options.judges_values = request.judges_values;
  options.self_check_one_in = 0;
  const records::Judgement judged = oracle::judge(scene, drawn, options).judgement;
  return std::any_of(judged.errors.begin(), judged.errors.end(), [&request](const auto& of_kind) {
    const bool is_coverage = of_kind.first == records::AttributeKind::coverage;
    return (is_coverage ? request.counts_coverage : request.judges_values) &&
           has_wrong_class(of_kind.second.classes);
  });
}

}  // namespace rastercheck::properties
