#include "properties/random_state.h"

#include <algorithm>
#include <array>
#include <string>

#include "properties/fitting.h"
#include "properties/random_floats.h"

namespace rastercheck::properties {
namespace {

using cases::Case;

/// Returns the side of a square framebuffer with about as many samples as one of `side` pixels with
/// a single sample each.
int side_with_samples(int side, int samples) {
  switch (samples) {
    case 1:
      return side;
    case 2:
      return side * 3 / 4;
    case 4:
      return side / 2;
    case 8:
      return side * 3 / 8;
    default:
      return side / 4;
  }
}

int random_side(Draw& draw, const StateRequest& request, int samples) {
  if (request.is_on_grid) {
    const int side = draw.pick(std::array{8, 16, 16, 32, 32, 64});
    const int chosen = std::clamp(side, request.least_side, request.most_side);
    return std::max(4, samples > 1 ? chosen / (samples > 4 ? 4 : 2) : chosen);
  }
  const int side = draw.between(request.least_side, request.most_side);
  return std::max(4, side_with_samples(side, samples));
}

/// Makes rows longer than a block of 64 pixels, but about as many samples as in other cases.
void set_wide_size(Draw& draw, cases::FramebufferSize& size) {
  const int most_width = size.samples == 1 ? 200 : (size.samples <= 4 ? 128 : 80);
  const int most_height = size.samples == 1 ? 12 : (size.samples <= 4 ? 6 : 4);
  size.width = draw.between(65, most_width);
  size.height = draw.between(4, most_height);
}

/// Mirrors the picture; the viewport still covers the same pixels.
void turn_width(cases::Viewport& viewport) {
  viewport.x += viewport.width;
  viewport.width = -viewport.width;
}

/// Sets a viewport of the framebuffer's size; in half of the calls, its origin moves on the 2^-4
/// grid, its width may double and its height may halve.
void set_grid_viewport(Draw& draw, Case& c) {
  cases::Viewport& viewport = c.viewport;
  viewport.width = static_cast<float>(c.framebuffer.width);
  viewport.height = static_cast<float>(c.framebuffer.height);
  if (draw.one_in(2)) return;
  const int x = draw.between(-48, 48);
  const int y = draw.between(-48, 48);
  viewport.x = static_cast<float>(x) / 16;
  viewport.y = static_cast<float>(y) / 16;
  if (draw.one_in(4)) viewport.width *= 2;
  if (draw.one_in(4)) viewport.height /= 2;
}

/// Sets a viewport many times larger than the framebuffer, with arbitrary whole or fractional
/// sides. The framebuffer shows a part of the viewport far from the viewport's origin.
void set_distant_viewport(Draw& draw, Case& c) {
  cases::Viewport& viewport = c.viewport;
  const int width = draw.between(257, cases::kMaxSize);
  const int height = draw.between(257, cases::kMaxSize);
  const bool is_fractional = draw.one_in(2);
  viewport.width = static_cast<float>(width) - (is_fractional ? draw.unit() : 0.0F);
  viewport.height = static_cast<float>(height) - (is_fractional ? draw.unit() : 0.0F);
  const float part_x = draw.unit();
  const float part_y = draw.unit();
  viewport.x = -part_x * (viewport.width - static_cast<float>(c.framebuffer.width));
  viewport.y = -part_y * (viewport.height - static_cast<float>(c.framebuffer.height));
}

/// Sets a viewport that may begin and end anywhere but covers part of the framebuffer.
void set_free_viewport(Draw& draw, Case& c) {
  const auto width = static_cast<float>(c.framebuffer.width);
  const auto height = static_cast<float>(c.framebuffer.height);
  cases::Viewport& viewport = c.viewport;
  viewport.width = width;
  viewport.height = height;
  if (draw.one_in(32)) {
    set_distant_viewport(draw, c);
    return;
  }
  switch (draw.between(0, 5)) {
    case 0:
    case 1:
    case 2:
      return;
    case 3: {  // smaller or larger by whole pixels
      const int x = draw.between(-3, 3);
      const int y = draw.between(-3, 3);
      const int more_width = draw.between(-3, 8);
      const int more_height = draw.between(-3, 8);
      viewport.x = static_cast<float>(x);
      viewport.y = static_cast<float>(y);
      viewport.width = width + static_cast<float>(more_width);
      viewport.height = height + static_cast<float>(more_height);
      return;
    }
    case 4: {  // in sixteenths, so that borders may lie on samples
      const int x = draw.between(-32, 32);
      const int y = draw.between(-32, 32);
      const int less_width = draw.between(0, 40);
      const int less_height = draw.between(0, 40);
      viewport.x = static_cast<float>(x) / 16;
      viewport.y = static_cast<float>(y) / 16;
      viewport.width = width - static_cast<float>(less_width) / 16;
      viewport.height = height - static_cast<float>(less_height) / 16;
      return;
    }
    default:  // any fraction
      viewport.x = draw.uniform(-2, 2);
      viewport.y = draw.uniform(-2, 2);
      viewport.width = draw.uniform(width / 2, width * 1.25F);
      viewport.height = draw.uniform(height / 2, height * 1.25F);
  }
}

void set_depth_range(Draw& draw, Case& c) {
  if (!draw.one_in(3)) return;
  const int first = draw.between(0, 16);
  const int second = draw.between(0, 16);
  const bool is_free = draw.one_in(3);
  float n = static_cast<float>(first) / 16;
  float f = static_cast<float>(second) / 16;
  if (is_free) {
    n = draw.unit();
    f = draw.unit();
  }
  if (draw.one_in(16)) f = n;
  if (c.rules == cases::Rules::d3d && n > f) std::swap(n, f);
  c.viewport.min_depth = n;
  c.viewport.max_depth = f;
}

void set_scissor(Draw& draw, Case& c) {
  if (!draw.one_in(8)) return;
  const int width = c.framebuffer.width;
  const int height = c.framebuffer.height;
  cases::Scissor scissor;
  scissor.x = draw.between(-2, width / 2);
  scissor.y = draw.between(-2, height / 2);
  scissor.width = draw.between(width / 4, width + 2);
  scissor.height = draw.between(height / 4, height + 2);
  c.scissor = scissor;
}

void set_attributes(Draw& draw, Case& c) {
  using cases::Interpolation;
  using cases::Location;
  int count = draw.pick(std::array{0, 1, 1, 1, 2, 2, 2, 3});
  if (draw.one_in(48)) count = draw.between(4, 9);
  for (int a = 0; a < count; ++a) {
    const auto interpolation = draw.pick(
        std::array{Interpolation::smooth, Interpolation::smooth, Interpolation::smooth,
                   Interpolation::smooth, Interpolation::smooth, Interpolation::noperspective,
                   Interpolation::noperspective, Interpolation::flat});
    const auto location = draw.pick(std::array{Location::sample, Location::sample, Location::sample,
                                               Location::sample, Location::sample, Location::center,
                                               Location::center, Location::centroid});
    c.attributes.push_back({"a" + std::to_string(a), interpolation, location});
  }
}

void set_bias(Draw& draw, Case& c) {
  cases::DepthBias& bias = c.depth_bias;
  if (draw.one_in(8)) return;
  switch (draw.between(0, 7)) {
    case 0:
      break;
    case 1:
      bias.constant = draw.spread(-6, 0);
      break;
    case 2:
      bias.constant = draw.spread(8, 34);
      break;
    case 3:
      bias.constant = any_float(draw);
      break;
    default: {
      const int whole = draw.between(-16, 16);
      bias.constant = static_cast<float>(whole);
    }
  }
  switch (draw.between(0, 7)) {
    case 0:
      bias.slope = draw.spread(-24, 24);
      break;
    case 1:
      bias.slope = any_float(draw);
      break;
    case 2:
    case 3: {
      const int halves = draw.between(-6, 6);
      bias.slope = static_cast<float>(halves) / 2;
      break;
    }
    case 4:
      bias.slope = draw.uniform(-2, 2);
      break;
    default:
      break;
  }
  if (!draw.one_in(3)) return;
  switch (draw.between(0, 3)) {
    case 0:
      bias.clamp = draw.spread(-24, -12);
      break;
    case 1:
      bias.clamp = draw.spread(-10, 0);
      break;
    case 2:
      bias.clamp = any_float(draw);
      break;
    default:
      bias.clamp = draw.pick(std::array{0x1p-16F, -0x1p-16F, 0x1p-15F, -0x1p-24F, 0.25F, -0.25F});
  }
}

/// How the values of one attribute are made.
enum class Values {
  ordinary,
  constant,
  close,
  zeros,
  integers,
  mixed,
  huge,
  tiny,
  one_stands_out,
  any
};

float random_value(Draw& draw, Values kind) {
  switch (kind) {
    case Values::zeros:
      return draw.one_in(2) ? -0.0F : 0.0F;
    case Values::integers: {
      const int n = draw.between(-8, 8);
      return static_cast<float>(n);
    }
    case Values::mixed:
      return draw.spread(-24, 24);
    case Values::huge:
      return draw.spread(100, 127);
    case Values::tiny:
      return draw.spread(-149, -110);
    case Values::one_stands_out:
      return draw.one_in(3) ? draw.spread(0, 20) : 0.0F;
    case Values::any:
      return any_float(draw);
    default:
      return draw.uniform(-1, 1);
  }
}

}  // namespace

Case random_state(Draw& draw, const StateRequest& request) {
  using cases::Rules;
  Case c;
  c.rules = draw.pick(std::array{Rules::opengl, Rules::vulkan, Rules::d3d});
  c.rules = fitting_rules(draw, c.rules);
  c.basis = cases::default_basis(c.rules);
  c.fill_rule = cases::default_fill_rule(c.rules);
  if (draw.one_in(8)) {
    c.fill_rule = draw.pick(std::array{cases::TieRule::top_left, cases::TieRule::bottom_left});
  }
  if (draw.one_in(4)) {
    const int bits = draw.pick(std::array{4, 8, 8, 8, 12, 16});
    c.coverage = cases::Snapping{bits, cases::Rounding::nearest_even, 0};
    c.basis = draw.pick(std::array{cases::Basis::ideal, cases::Basis::snapped});
  }
  c.framebuffer.samples = draw.pick(std::array{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 4, 4, 4, 2, 8, 16});
  c.framebuffer.samples = fitting_samples(draw, c.framebuffer.samples);
  if (request.is_wide) {
    set_wide_size(draw, c.framebuffer);
  } else {
    c.framebuffer.width = random_side(draw, request, c.framebuffer.samples);
    c.framebuffer.height = random_side(draw, request, c.framebuffer.samples);
  }

  if (request.is_on_grid) {
    set_grid_viewport(draw, c);
  } else {
    set_free_viewport(draw, c);
  }
  if (c.rules == Rules::vulkan && draw.one_in(4)) {
    c.viewport.y += c.viewport.height;
    c.viewport.height = -c.viewport.height;
  }
  if (draw.one_in(24)) turn_width(c.viewport);
  set_depth_range(draw, c);

  if (draw.one_in(6)) c.cull = draw.pick(std::array{cases::Cull::back, cases::Cull::front});
  if (draw.one_in(4)) c.front_face = cases::FrontFace::cw;
  set_scissor(draw, c);
  c.depth_clamp = draw.one_in(8);
  if (draw.one_in(16)) c.depth_test = cases::DepthTest::less;
  set_attributes(draw, c);
  if (request.has_clip_distances && draw.one_in(10)) {
    c.clip_distance_count = draw.one_in(3) ? 2 : 1;
    if (draw.one_in(6)) {
      c.clip_distance_count =
          static_cast<std::size_t>(draw.between(3, static_cast<int>(cases::kMaxClipDistances)));
    }
  }
  fit_state(draw, c);
  return c;
}

void set_snapped_coverage(Draw& draw, Case& c) {
  c.coverage = cases::Snapping{draw.between(4, cases::kMaxSubpixelBits)};
  c.basis = draw.pick(std::array{cases::Basis::ideal, cases::Basis::snapped});
}

void set_depth_storage(Draw& draw, Case& c) {
  using cases::DepthFormat;
  c.depth_format =
      draw.pick(std::array{DepthFormat::float32, DepthFormat::float32, DepthFormat::unorm16,
                           DepthFormat::unorm16, DepthFormat::unorm24});
  set_bias(draw, c);
}

void add_attribute_values(Draw& draw, Case& c) {
  const std::size_t count = c.attributes.size();
  c.attribute_values.assign(c.positions.size() * count, 0.0F);
  for (std::size_t a = 0; a < count; ++a) {
    const auto kind = draw.pick(std::array{
        Values::ordinary, Values::ordinary, Values::ordinary, Values::ordinary, Values::ordinary,
        Values::constant, Values::zeros, Values::integers, Values::integers, Values::mixed,
        Values::huge, Values::tiny, Values::one_stands_out, Values::close, Values::any});
    const float constant = draw.spread(-4, 4);
    for (std::size_t v = 0; v < c.positions.size(); ++v) {
      float& value = c.attribute_values[v * count + a];
      switch (kind) {
        case Values::constant:
          value = constant;
          break;
        case Values::close:
          value = float_near(draw, constant, 4);
          break;
        default:
          value = random_value(draw, kind);
      }
    }
  }
}

void ensure_attribute(Case& c) {
  if (!c.attributes.empty()) return;
  c.attributes.emplace_back();
  c.attributes.back().name = "a0";
  c.attribute_values.assign(c.positions.size(), 0);
}

void ensure_attribute(Draw& draw, Case& c) {
  if (!c.attributes.empty()) return;
  ensure_attribute(c);
  for (float& value : c.attribute_values) value = draw.spread(-8, 8);
}

void add_separate_triangles(Case& c) {
  const auto count = static_cast<std::uint32_t>(c.positions.size());
  for (std::uint32_t first = 0; first + 2 < count; first += 3) {
    c.triangles.push_back({first, first + 1, first + 2});
  }
}

void add_clip_distances(Draw& draw, Case& c) {
  const std::size_t count = c.positions.size() * c.clip_distance_count;
  c.clip_distances.clear();
  for (std::size_t i = 0; i < count; ++i) {
    // With three or more distances, each is negative less often; otherwise little would be left
    // inside.
    const int chances = c.clip_distance_count > 2 ? 16 : 6;
    switch (draw.between(0, chances - 1)) {
      case 0:
        c.clip_distances.push_back(draw.uniform(-1, 0));
        break;
      case 1:
        c.clip_distances.push_back(0.0F);
        break;
      default:
        c.clip_distances.push_back(draw.uniform(0, 1));
    }
  }
}

}  // namespace rastercheck::properties
