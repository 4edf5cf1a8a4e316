#include "oracle/internal/scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rastercheck::oracle {
namespace {

Ring half(const Ring& value) { return value * Ring(0.5); }

RingMatrix4 exact_matrix(const cases::Matrix4& rows) {
  RingMatrix4 matrix;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    matrix(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) =
        exact_ring(rows[i]);
  }
  return matrix;
}

PixelBox framebuffer_pixels(const cases::Case& c) {
  PixelBox box{0, 0, c.framebuffer.width, c.framebuffer.height};
  if (c.scissor) {
    const cases::Scissor& s = *c.scissor;
    box = intersection(box, {s.x, s.y, s.x + s.width, s.y + s.height});
  }
  return box;
}

/// Returns the first pixel, and one past the last, that a closed range of window coordinates
/// touches, within [0, cases::kMaxSize].
std::pair<int, int> touched_pixels(const Ring& lo, const Ring& hi) {
  const Ring most(cases::kMaxSize);
  const Ring from = std::clamp(lo, Ring(0), most);
  const Ring to = std::clamp(hi, Ring(-1), most);
  return {static_cast<int>(floor_to_long(Field(from))),
          static_cast<int>(floor_to_long(Field(to))) + 1};
}

/// The pixels of [0, cases::kMaxSize] that lie wholly in a range of window coordinates.
std::pair<int, int> held_pixels(const Ring& lo, const Ring& hi) {
  const Ring most(cases::kMaxSize);
  return {static_cast<int>(ceil_to_long(Field(std::clamp(lo, Ring(0), most)))),
          static_cast<int>(floor_to_long(Field(std::clamp(hi, Ring(0), most))))};
}

/// Top and left are as displayed. A left edge's inward normal has A > 0; a top edge's has B > 0
/// where window y points down.
TieOrder tie_order(cases::TieRule rule, bool window_y_up) {
  using cases::TieRule;
  const bool is_top = rule == TieRule::top_left || rule == TieRule::top_right ||
                      rule == TieRule::top_then_left || rule == TieRule::top_then_right;
  const bool is_left = rule == TieRule::top_left || rule == TieRule::bottom_left ||
                       rule == TieRule::top_then_left || rule == TieRule::bottom_then_left;
  const bool asks_a_first = rule == TieRule::top_left || rule == TieRule::bottom_left ||
                            rule == TieRule::top_right || rule == TieRule::bottom_right;
  return {asks_a_first, is_left ? 1 : -1, is_top == !window_y_up ? 1 : -1};
}

RingVector4 exact_position(const cases::ClipVertex& p) {
  return {exact_ring(p.x), exact_ring(p.y), exact_ring(p.z), exact_ring(p.w)};
}

Conventions conventions_of(cases::Rules rules) {
  switch (rules) {
    case cases::Rules::opengl:
      return {.window_y_up = true,
              .ndc_y_follows_window_y = true,
              .near_z = -1,
              .depth_is_halved = true,
              .depth_always_clamped = false,
              .provoking_vertex = 2,
              .clip_distance_zero_inside = false,
              .far_border_permitted = true,
              .centroid_is_a_sample = false};
    case cases::Rules::vulkan:
      return {.window_y_up = false,
              .ndc_y_follows_window_y = true,
              .near_z = 0,
              .depth_is_halved = false,
              .depth_always_clamped = false,
              .provoking_vertex = 0,
              .clip_distance_zero_inside = false,
              .far_border_permitted = true,
              .centroid_is_a_sample = false};
    case cases::Rules::d3d:
      break;
  }
  return {.window_y_up = false,
          .ndc_y_follows_window_y = false,
          .near_z = 0,
          .depth_is_halved = false,
          .depth_always_clamped = true,
          .provoking_vertex = 0,
          .clip_distance_zero_inside = true,
          .far_border_permitted = false,
          .centroid_is_a_sample = true};
}

}  // namespace

PixelBox intersection(const PixelBox& a, const PixelBox& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

std::vector<RingVector4> clip_positions(const cases::Case& c) {
  std::vector<RingVector4> positions;
  positions.reserve(c.positions.size());
  for (const cases::ClipVertex& p : c.positions) positions.push_back(exact_position(p));
  if (c.camera) {
    const RingMatrix4 view_model = exact_matrix(c.camera->view) * exact_matrix(c.camera->model);
    const RingMatrix4 matrix = exact_matrix(c.camera->projection) * view_model;
    for (RingVector4& p : positions) p = (matrix * p).eval();
  }
  return positions;
}

Scene::Scene(const cases::Case& c, const cases::Contract& contract)
    : case_(&c),
      contract_(&contract),
      conventions_(conventions_of(c.rules)),
      ties_(tie_order(contract.tie_rule, conventions_.window_y_up)) {
  set_units();
  const cases::Viewport& v = c.viewport;
  const Ring x0 = exact_ring(v.x);
  const Ring y0 = exact_ring(v.y);
  const Ring x1 = x0 + exact_ring(v.width);
  const Ring y1 = y0 + exact_ring(v.height);
  viewport_lo_ = {std::min(x0, x1), std::min(y0, y1)};
  viewport_hi_ = {std::max(x0, x1), std::max(y0, y1)};
  // The ranges are closed, because a sample on the far border may lie in a pixel that begins there.
  const auto [left, right] = touched_pixels(viewport_lo_.u, viewport_hi_.u);
  const auto [low, high] = touched_pixels(viewport_lo_.v, viewport_hi_.v);
  target_pixels_ = framebuffer_pixels(c);
  pixels_ = intersection(target_pixels_, {left, low, right, high});
  // Samples lie at least 1/16 before the far sides of their pixel, so a pixel that ends with the
  // viewport has no sample on the viewport's border.
  const auto [inner_left, inner_right] = held_pixels(viewport_lo_.u, viewport_hi_.u);
  const auto [inner_low, inner_high] = held_pixels(viewport_lo_.v, viewport_hi_.v);
  inner_pixels_ = intersection(pixels_, {inner_left, inner_low, inner_right, inner_high});

  if (c.camera) transformed_ = clip_positions(c);
  half_size_ = {half(exact_ring(v.width)), half(exact_ring(v.height))};
  middle_ = {x0 + half_size_[0], y0 + half_size_[1]};
  for (Ring* in_pixels : {&viewport_lo_.u, &viewport_lo_.v, &viewport_hi_.u, &viewport_hi_.v,
                          &half_size_[0], &half_size_[1], &middle_[0], &middle_[1]}) {
    if (!is_in_pixels_) *in_pixels = *in_pixels * units_per_pixel_;
  }
  if (!conventions_.ndc_y_follows_window_y) half_size_[1] = -half_size_[1];

  set_guard_band();
  min_depth_ = exact_ring(v.min_depth);
  depth_range_ = exact_ring(v.max_depth) - min_depth_;
  least_depth_ = std::min(exact_ring(v.min_depth), exact_ring(v.max_depth));
  greatest_depth_ = std::max(exact_ring(v.min_depth), exact_ring(v.max_depth));
  const bool is_to_range = case_->depth_clamp || conventions_.depth_always_clamped;
  clamp_least_ = is_to_range ? least_depth_ : Ring(0);
  clamp_greatest_ = is_to_range ? greatest_depth_ : Ring(1);
}

/// Chooses the least number of units in which the contract's grid is dyadic and its sample position
/// is a multiple of 1/16, as all sample positions are.
void Scene::set_units() {
  const int odd_steps = contract_->coverage ? contract_->coverage->odd_steps : 1;
  int units = odd_steps;
  if (has_own_sample()) {
    constexpr int kSixteenths = 16;
    const cases::PixelFraction& at = *contract_->sample_position;
    const int common = std::gcd(at.parts, std::gcd(at.x, at.y));
    const int parts = at.parts / common;
    units = std::lcm(units, parts / std::gcd(parts, kSixteenths));
    // Exact: each coordinate is a multiple of 1/parts, and parts divides 16 · units.
    const auto sixteenths = [&](int part) {
      return static_cast<int>(std::int64_t{part} * kSixteenths * units / at.parts);
    };
    pattern_ = {{sixteenths(at.x), sixteenths(at.y)}};
  } else {
    for (const cases::SamplePosition& at : cases::standard_pattern(case_->framebuffer.samples)) {
      pattern_.push_back({at.x * units, at.y * units});
    }
  }
  is_in_pixels_ = units == 1;
  units_per_pixel_ = Ring(units);
  if (contract_->coverage) {
    const int whole_units = units / odd_steps;  // without a remainder
    grid_unit_ = std::ldexp(whole_units, -contract_->coverage->subpixel_bits);
  }
}

void Scene::set_guard_band() {
  guard_band_lo_ = viewport_lo_;
  guard_band_hi_ = viewport_hi_;
  if (contract_->guard_beyond_viewport) {
    const Ring beyond = exact_ring(*contract_->guard_beyond_viewport) * units_per_pixel_;
    guard_band_lo_ = {viewport_lo_.u - beyond, viewport_lo_.v - beyond};
    guard_band_hi_ = {viewport_hi_.u + beyond, viewport_hi_.v + beyond};
    return;
  }
  const Ring band = exact_ring(contract_->guard_band) * units_per_pixel_;
  // If viewport and guard band do not overlap along an axis, a vertex between them lies in neither,
  // so along this axis the box stays that of the viewport.
  if (viewport_lo_.u <= band && viewport_hi_.u >= -band) {
    guard_band_lo_.u = std::min(-band, viewport_lo_.u);
    guard_band_hi_.u = std::max(band, viewport_hi_.u);
  }
  if (viewport_lo_.v <= band && viewport_hi_.v >= -band) {
    guard_band_lo_.v = std::min(-band, viewport_lo_.v);
    guard_band_hi_.v = std::max(band, viewport_hi_.v);
  }
}

RingVector4 Scene::clip_position(std::size_t vertex) const {
  return case_->camera ? transformed_[vertex] : exact_position(case_->positions[vertex]);
}

RingVector3 Scene::window_column(std::size_t vertex) const {
  const RingVector4 p = clip_position(vertex);
  return {p[0] * half_size_[0] + p[3] * middle_[0], p[1] * half_size_[1] + p[3] * middle_[1], p[3]};
}

Point Scene::sample_point(int x, int y, int sample) const {
  const cases::SamplePosition& s = pattern_[static_cast<std::size_t>(sample)];
  if (is_in_pixels_) return {Ring(x + s.x / 16.0), Ring(y + s.y / 16.0)};
  return {Ring(x) * units_per_pixel_ + Ring(s.x / 16.0),
          Ring(y) * units_per_pixel_ + Ring(s.y / 16.0)};
}

Point Scene::center_point(int x, int y) const {
  return has_own_sample() ? sample_point(x, y, 0) : pixel_middle(x, y);
}

Point Scene::pixel_middle(int x, int y) const {
  Point middle{Ring(x + 0.5), Ring(y + 0.5)};
  if (is_in_pixels_) return middle;
  return {middle.u * units_per_pixel_, middle.v * units_per_pixel_};
}

ViewportSide Scene::viewport_side(const Point& p) const {
  if (p.u < viewport_lo_.u || p.v < viewport_lo_.v || p.u > viewport_hi_.u ||
      p.v > viewport_hi_.v) {
    return ViewportSide::outside;
  }
  if (p.u == viewport_hi_.u || p.v == viewport_hi_.v) {
    return conventions_.far_border_permitted ? ViewportSide::far_border : ViewportSide::outside;
  }
  return ViewportSide::inside;
}

bool Scene::is_within(const Ring& distance, const Point& p) const {
  const auto is_near = [&distance](const Ring& side, const Ring& at) {
    return magnitude(at - side) <= distance;
  };
  const auto is_between = [&distance](const Ring& lo, const Ring& hi, const Ring& at) {
    return at >= lo - distance && at <= hi + distance;
  };
  const bool is_beside = is_between(viewport_lo_.u, viewport_hi_.u, p.u) &&
                         is_between(viewport_lo_.v, viewport_hi_.v, p.v);
  return is_beside && (is_near(viewport_lo_.u, p.u) || is_near(viewport_hi_.u, p.u) ||
                       is_near(viewport_lo_.v, p.v) || is_near(viewport_hi_.v, p.v));
}

bool Scene::has_samples_within(double distance) const {
  if (!is_in_pixels_) return true;
  const cases::Viewport& v = case_->viewport;
  const auto is_near = [distance](double side, int sixteenths) {
    const double from = side - sixteenths / 16.0;
    const double beyond = from - std::floor(from);
    // Far more than the rounding of a float32 side.
    constexpr double kSlack = 0x1p-20;
    return std::min(beyond, 1 - beyond) <= distance + kSlack;
  };
  return std::any_of(pattern_.begin(), pattern_.end(), [&](const cases::SamplePosition& sample) {
    const double x = double{v.x};
    const double y = double{v.y};
    return is_near(x, sample.x) || is_near(x + double{v.width}, sample.x) || is_near(y, sample.y) ||
           is_near(y + double{v.height}, sample.y);
  });
}

bool Scene::is_culled(int orientation) const {
  if (!culls_anything()) return false;
  const bool counter_clockwise = (orientation > 0) == conventions_.window_y_up;
  const cases::Winding winding =
      counter_clockwise ? cases::Winding::counter_clockwise : cases::Winding::clockwise;
  if (contract_->culls == winding) return true;
  if (case_->cull == cases::Cull::none) return false;
  const bool front = counter_clockwise == (case_->front_face == cases::FrontFace::ccw);
  return front == (case_->cull == cases::Cull::front);
}

Ring Scene::depth_numerator(std::size_t vertex) const {
  const RingVector4 p = clip_position(vertex);
  return depth_numerator(p[2], p[3]);
}

Ring Scene::depth_numerator(const Ring& z, const Ring& w) const {
  const Ring share = depth_range_ * (conventions_.depth_is_halved ? half(z + w) : z);
  return sign_of(min_depth_) == 0 ? share : min_depth_ * w + share;
}

/// Sums with a bias are clamped, as is what a unorm format stores. All other depths lie within the
/// range by themselves, because the near and far plane clip.
bool Scene::clamps_depth() const {
  return case_->depth_clamp || conventions_.depth_always_clamped || stores_depths();
}

bool Scene::is_affine(std::size_t attribute) const {
  return contract_->is_affine(case_->attributes[attribute].interpolation);
}

}  // namespace rastercheck::oracle
