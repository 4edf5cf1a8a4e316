#include "properties/campaign/internal/variations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "cases/capabilities.h"
#include "oracle/transform.h"
#include "properties/campaign/internal/case_size.h"
#include "properties/campaign/shrink.h"
#include "properties/fitting.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties {
namespace {

using cases::Case;
using cases::ClipVertex;
using cases::Feature;
using cases::SamplePlace;

/// True if all vertices have window positions, and these may be changed.
bool has_window_points(const Case& c) {
  const bool has_area = c.viewport.width != 0 && c.viewport.height != 0;
  return !c.camera && has_area && !c.positions.empty() &&
         std::all_of(c.positions.begin(), c.positions.end(),
                     [](const ClipVertex& p) { return p.w > 0; });
}

/// Returns the window position of a vertex with w > 0. As in at_window(), D3D's y runs the other
/// way.
WindowPoint window_place(cases::Rules rules, const cases::Viewport& viewport,
                         const ClipVertex& vertex) {
  WindowPoint p = window_point(viewport, vertex);
  if (rules == cases::Rules::d3d) p.v = 2 * double{viewport.y} + double{viewport.height} - p.v;
  return p;
}

/// Moves each vertex to the window position that `moved` returns for its present position.
template <typename Moved>
void move_vertices(Case& c, const cases::Viewport& viewport, const Moved& moved) {
  for (ClipVertex& p : c.positions) {
    p = at_window(c, moved(window_place(c.rules, viewport, p)), p.z / p.w, p.w);
  }
}

/// Gives the case another viewport and keeps all window positions.
bool change_viewport(Case& c, const cases::Viewport& viewport) {
  if (!has_window_points(c) || viewport == c.viewport) return false;
  const cases::Viewport before = std::exchange(c.viewport, viewport);
  move_vertices(c, before, [](const WindowPoint& p) { return p; });
  return true;
}

struct Box {
  WindowPoint low;
  WindowPoint high;

  double size() const { return std::max(high.u - low.u, high.v - low.v); }
};

/// Returns the bounding box of all vertices; requires has_window_points().
Box box_of(const Case& c) {
  const WindowPoint first = window_place(c.rules, c.viewport, c.positions.front());
  Box box{first, first};
  for (const ClipVertex& vertex : c.positions) {
    const WindowPoint p = window_place(c.rules, c.viewport, vertex);
    box.low = {std::min(box.low.u, p.u), std::min(box.low.v, p.v)};
    box.high = {std::max(box.high.u, p.u), std::max(box.high.v, p.v)};
  }
  return box;
}

/// Scales everything about the pixel where the case fails.
bool scale_about(Case& c, const SamplePlace& at, double factor) {
  const WindowPoint middle{at.x + 0.5, at.y + 0.5};
  move_vertices(c, c.viewport, [&](const WindowPoint& p) {
    return WindowPoint{middle.u + (p.u - middle.u) * factor, middle.v + (p.v - middle.v) * factor};
  });
  return true;
}

template <Feature feature>
bool take_feature(Case& c, const SamplePlace& /*at*/) {
  if (!cases::needs(c, feature)) return false;
  cases::Capabilities has;
  has.lacks = {feature};
  return leave_out(c, feature, has);
}

bool take_several_triangles(Case& c, const SamplePlace& at) {
  if (c.triangles.size() < 2 || at.triangle >= c.triangles.size()) return false;
  const std::array<std::size_t, 1> one{at.triangle};
  c = with_triangles(c, one);
  return true;
}

bool take_camera(Case& c, const SamplePlace& /*at*/) {
  if (!c.camera) return false;
  const Result<cases::ClipCase> clip = oracle::to_clip_case(c, "");
  if (!clip) return false;
  c = *clip;
  return true;
}

bool take_nonpositive_w(Case& c, const SamplePlace& /*at*/) {
  if (c.camera || !cases::needs(c, Feature::nonpositive_w)) return false;
  for (ClipVertex& p : c.positions) {
    if (p.w < 0) p = {-p.x, -p.y, -p.z, -p.w};
    if (p.w == 0) p.w = 1;
  }
  return true;
}

bool take_perspective(Case& c, const SamplePlace& /*at*/) {
  if (!has_window_points(c)) return false;
  const bool is_flat = std::all_of(c.positions.begin(), c.positions.end(),
                                   [&c](const ClipVertex& p) { return p.w == c.positions[0].w; });
  if (is_flat) return false;
  for (ClipVertex& p : c.positions) p = {p.x / p.w, p.y / p.w, p.z / p.w, 1};
  return true;
}

/// Moves vertices that are beyond a depth plane to the middle of the depth range.
template <typename IsBeyond>
bool take_beyond(Case& c, const IsBeyond& is_beyond) {
  if (c.camera) return false;
  bool is_some = false;
  for (ClipVertex& p : c.positions) {
    if (!(p.w > 0) || !is_beyond(p)) continue;
    p.z = (near_depth(c) + 1) / 2 * p.w;
    is_some = true;
  }
  return is_some;
}

bool take_near_plane(Case& c, const SamplePlace& /*at*/) {
  return take_beyond(c, [&c](const ClipVertex& p) { return p.z < near_depth(c) * p.w; });
}

bool take_far_plane(Case& c, const SamplePlace& /*at*/) {
  return take_beyond(c, [](const ClipVertex& p) { return p.z > p.w; });
}

/// Returns the least power of two that is at least `size`.
float power_above(double size) {
  return static_cast<float>(std::exp2(std::ceil(std::log2(std::max(size, 1.0)))));
}

bool take_sides(Case& c, const SamplePlace& /*at*/) {
  if (!has_window_points(c) || !cases::needs(c, Feature::side_clipping)) return false;
  const Box box = box_of(c);
  constexpr double kFar = 4096;  // every driver's viewports reach this far
  const bool is_near =
      std::abs(box.low.u) < kFar && std::abs(box.low.v) < kFar && box.size() < kFar;
  if (!is_near) return false;
  cases::Viewport wide = c.viewport;
  wide.x = static_cast<float>(std::floor(box.low.u));
  wide.y = static_cast<float>(std::floor(box.low.v));
  wide.width = power_above(box.high.u - double{wide.x});
  wide.height = power_above(box.high.v - double{wide.y});
  return change_viewport(c, wide);
}

bool take_viewport_place(Case& c, const SamplePlace& /*at*/) {
  cases::Viewport whole = c.viewport;
  whole.x = 0;
  whole.y = 0;
  whole.width = static_cast<float>(c.framebuffer.width);
  whole.height = static_cast<float>(c.framebuffer.height);
  return change_viewport(c, whole);
}

bool take_fractions(Case& c, const SamplePlace& /*at*/) {
  if (!cases::needs(c, Feature::viewport_fractions)) return false;
  cases::Viewport whole = c.viewport;
  for (float* const number : {&whole.x, &whole.y, &whole.width, &whole.height}) {
    const float rounded = std::floor(*number);
    *number = rounded == 0 && *number != 0 ? 1 : rounded;
  }
  return change_viewport(c, whole);
}

bool take_negative_height(Case& c, const SamplePlace& /*at*/) {
  if (!(c.viewport.height < 0)) return false;
  cases::Viewport upright = c.viewport;
  upright.y += upright.height;
  upright.height = -upright.height;
  return change_viewport(c, upright);
}

/// Moves all vertices by less than the distance between samples of a pixel, in a direction that no
/// edge of simple slope has.
bool take_tie(Case& c, const SamplePlace& /*at*/) {
  if (!has_window_points(c)) return false;
  constexpr double kRight = 3.0 / 128;
  constexpr double kDown = 5.0 / 256;
  move_vertices(c, c.viewport, [](const WindowPoint& p) {
    return WindowPoint{p.u + kRight, p.v + kDown};
  });
  return true;
}

constexpr double kScale = 16;

bool take_smallness(Case& c, const SamplePlace& at) {
  if (!has_window_points(c) || !(box_of(c).size() < kScale)) return false;
  return scale_about(c, at, kScale);
}

bool take_largeness(Case& c, const SamplePlace& at) {
  constexpr double kLarge = 64;
  if (!has_window_points(c) || !(box_of(c).size() > kLarge)) return false;
  return scale_about(c, at, kLarge / 4 / box_of(c).size());
}

/// Moves the vertex opposite a thin triangle's longest edge away from that edge.
bool take_thinness(Case& c, const SamplePlace& at) {
  if (!has_window_points(c) || at.triangle >= c.triangles.size()) return false;
  const cases::Triangle& t = c.triangles[at.triangle];
  std::array<WindowPoint, 3> p{};
  for (std::size_t i = 0; i < 3; ++i) p[i] = window_place(c.rules, c.viewport, c.positions[t[i]]);
  const auto length = [&p](std::size_t i) {
    const WindowPoint& a = p[(i + 1) % 3];
    const WindowPoint& b = p[(i + 2) % 3];
    return std::hypot(b.u - a.u, b.v - a.v);
  };
  std::size_t apex = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (length(i) > length(apex)) apex = i;
  }
  const WindowPoint& a = p[(apex + 1) % 3];
  const WindowPoint& b = p[(apex + 2) % 3];
  const double longest = length(apex);
  if (longest == 0) return false;
  const WindowPoint across{-(b.v - a.v) / longest, (b.u - a.u) / longest};
  const double height = (p[apex].u - a.u) * across.u + (p[apex].v - a.v) * across.v;
  constexpr double kThin = 1.0 / 16;
  if (std::abs(height) >= kThin * longest) return false;
  const double more = std::copysign(longest / 2, height) - height;
  ClipVertex& vertex = c.positions[t[apex]];
  vertex = at_window(c, {p[apex].u + across.u * more, p[apex].v + across.v * more},
                     vertex.z / vertex.w, vertex.w);
  return true;
}

bool take_far_pixels(Case& c, const SamplePlace& at) {
  constexpr std::uint32_t kBlock = 64;
  const std::uint32_t left = at.x / kBlock * kBlock;
  const std::uint32_t up = at.y / kBlock * kBlock;
  if ((left == 0 && up == 0) || c.scissor) return false;
  // A fragment may lie outside the framebuffer.
  if (std::cmp_greater_equal(left, c.framebuffer.width) ||
      std::cmp_greater_equal(up, c.framebuffer.height)) {
    return false;
  }
  c.viewport.x -= static_cast<float>(left);
  c.viewport.y -= static_cast<float>(up);
  c.framebuffer.width -= static_cast<int>(left);
  c.framebuffer.height -= static_cast<int>(up);
  return true;
}

bool take_samples(Case& c, const SamplePlace& /*at*/) {
  return std::exchange(c.framebuffer.samples, 1) != 1;
}

bool take_snapping(Case& c, const SamplePlace& /*at*/) {
  return std::exchange(c.coverage, std::nullopt).has_value();
}

bool take_rules(Case& c, const SamplePlace& /*at*/) {
  if (c.rules == cases::Rules::vulkan) return false;
  const bool has_usual_basis = c.basis == cases::default_basis(c.rules);
  const bool has_usual_rule = c.fill_rule == cases::default_fill_rule(c.rules);
  c.rules = cases::Rules::vulkan;
  if (has_usual_basis) c.basis = cases::default_basis(c.rules);
  if (has_usual_rule) c.fill_rule = cases::default_fill_rule(c.rules);
  return true;
}

bool take_fill_rule(Case& c, const SamplePlace& /*at*/) {
  const cases::TieRule usual = cases::default_fill_rule(c.rules);
  return std::exchange(c.fill_rule, usual) != usual;
}

bool take_side(Case& c, const SamplePlace& /*at*/) {
  if (c.cull != cases::Cull::none) return false;
  for (cases::Triangle& t : c.triangles) std::swap(t[1], t[2]);
  return !c.triangles.empty();
}

bool take_locations(Case& c, const SamplePlace& /*at*/) {
  bool is_some = false;
  for (cases::Attribute& a : c.attributes) {
    if (std::exchange(a.location, cases::Location::sample) != cases::Location::sample) {
      is_some = true;
    }
  }
  return is_some && c.framebuffer.samples > 1;
}

template <cases::Interpolation interpolation>
bool take_interpolation(Case& c, const SamplePlace& /*at*/) {
  bool is_some = false;
  for (cases::Attribute& a : c.attributes) {
    if (a.interpolation != interpolation) continue;
    a.interpolation = cases::Interpolation::smooth;
    is_some = true;
  }
  return is_some;
}

/// Gives all attributes different values of few bits.
void set_plain_values(Case& c) {
  const std::size_t count = c.attributes.size();
  for (std::size_t i = 0; i < c.attribute_values.size(); ++i) {
    constexpr std::array kPlain{0.25F, 0.5F, 0.75F, 1.0F};
    c.attribute_values[i] = kPlain[(i / count + i % count) % kPlain.size()];
  }
}

template <typename IsSpecial>
bool take_values(Case& c, const IsSpecial& is_special) {
  if (c.attributes.empty() ||
      std::none_of(c.attribute_values.begin(), c.attribute_values.end(), is_special)) {
    return false;
  }
  set_plain_values(c);
  return true;
}

bool take_large_values(Case& c, const SamplePlace& /*at*/) {
  return take_values(c, [](float value) { return std::abs(value) > 0x1p64F; });
}

bool take_small_values(Case& c, const SamplePlace& /*at*/) {
  return take_values(c, [](float value) { return value != 0 && std::abs(value) < 0x1p-64F; });
}

constexpr std::array kVariations{
    Variation{"triangles", "there are several triangles", "there is one triangle",
              &take_several_triangles},
    Variation{"camera", "there is a camera", "clip positions are given instead of the camera",
              &take_camera},
    Variation{"w <= 0", "a vertex has w <= 0", "all w are positive", &take_nonpositive_w},
    Variation{"near plane", "the near plane cuts the triangle",
              "no vertex is in front of the near plane", &take_near_plane},
    Variation{"far plane", "the far plane cuts the triangle", "no vertex is beyond the far plane",
              &take_far_plane},
    Variation{"clip distances", "there are clip distances", "there are no clip distances",
              &take_feature<Feature::clip_distances>},
    Variation{"sides", "a vertex lies beyond the viewport's sides",
              "the viewport reaches all vertices", &take_sides},
    Variation{"perspective", "w differs between vertices", "all w are 1", &take_perspective},
    Variation{"samples", "a pixel has several samples", "a pixel has one sample", &take_samples},
    Variation{"locations", "attributes are taken at centres or centroids",
              "attributes are taken at samples", &take_locations},
    Variation{"noperspective", "attributes are noperspective",
              "noperspective attributes are smooth",
              &take_interpolation<cases::Interpolation::noperspective>},
    Variation{"flat", "attributes are flat", "flat attributes are smooth",
              &take_interpolation<cases::Interpolation::flat>},
    Variation{"snapping", "positions are snapped to a grid", "no positions are snapped",
              &take_snapping},
    Variation{"fill rule", "the fill rule is not the default", "the fill rule is the default",
              &take_fill_rule},
    Variation{"rules", "the rules are not Vulkan's", "the rules are Vulkan's", &take_rules},
    Variation{"tie", "a sample lies exactly on an edge", "no sample lies on an edge", &take_tie},
    Variation{"small", "the triangle is small", "the triangle is 16 times as large",
              &take_smallness},
    Variation{"large", "the triangle is large", "the triangle is 16 pixels large", &take_largeness},
    Variation{"thin", "the triangle is thin", "the triangle is half as high as long",
              &take_thinness},
    Variation{"far pixels", "pixels are beyond column or row 63",
              "pixels are nearer the target's corner", &take_far_pixels},
    Variation{"side", "the triangle is seen from this side",
              "the triangle is seen from the other side", &take_side},
    Variation{"large values", "values are above 2^64", "values are about 1", &take_large_values},
    Variation{"small values", "values are below 2^-64", "values are about 1", &take_small_values},
    Variation{"depth clamp", "depth is clamped", "depth is not clamped",
              &take_feature<Feature::depth_clamp>},
    Variation{"depth bias", "depth is biased", "depth is not biased",
              &take_feature<Feature::depth_bias>},
    Variation{"unorm depth", "depth is stored in a unorm format", "depth is stored as float32",
              &take_feature<Feature::unorm_depth>},
    Variation{"depth range", "the depth range is not 0 to 1", "the depth range is 0 to 1",
              &take_feature<Feature::depth_range>},
    Variation{"depth test", "there is a depth test", "there is no depth test",
              &take_feature<Feature::depth_test>},
    Variation{"depth clear", "the depth buffer is not cleared to 1",
              "the depth buffer is cleared to 1", &take_feature<Feature::depth_clear>},
    Variation{"scissor", "there is a scissor", "there is no scissor",
              &take_feature<Feature::scissor>},
    Variation{"culling", "faces are culled", "no faces are culled",
              &take_feature<Feature::culling>},
    Variation{"fractions", "the viewport's sides lie between pixels",
              "the viewport's sides lie on whole pixels", &take_fractions},
    Variation{"negative height", "the viewport's height is negative",
              "the viewport's height is positive", &take_negative_height},
    Variation{"viewport", "the viewport is not the whole target",
              "the viewport is the whole target", &take_viewport_place}};

}  // namespace

std::span<const Variation> variations() { return kVariations; }

bool take_away(const Variation& variation, Case& c, const SamplePlace& at) {
  Case other = c;
  if (!variation.change(other, at)) return false;
  const std::vector<float*> numbers = numbers_of(other);
  const bool is_finite = std::all_of(numbers.begin(), numbers.end(),
                                     [](const float* number) { return std::isfinite(*number); });
  if (!is_finite || other == c) return false;
  c = std::move(other);
  return true;
}

const Variation* find_variation(std::string_view id) {
  const auto found = std::find_if(kVariations.begin(), kVariations.end(),
                                  [id](const Variation& one) { return one.id == id; });
  return found == kVariations.end() ? nullptr : &*found;
}

}  // namespace rastercheck::properties
