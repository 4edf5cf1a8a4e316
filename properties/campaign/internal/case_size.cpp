#include "properties/campaign/internal/case_size.h"

#include <algorithm>
#include <cmath>

namespace rastercheck::properties {
namespace {

std::uint64_t count(bool is) { return is ? 1 : 0; }

std::uint64_t state_of(const cases::Case& c) {
  std::uint64_t state = 0;
  for (int samples = c.framebuffer.samples; samples > 1; samples /= 2) ++state;
  if (c.coverage) {
    const cases::Snapping usual;
    state += 1 + count(c.coverage->subpixel_bits != usual.subpixel_bits) +
             count(c.coverage->rounding != usual.rounding) +
             count(c.coverage->position_error != usual.position_error);
  }
  state += count(c.rules != cases::Rules::vulkan);
  state += count(c.basis != cases::default_basis(c.rules));
  state += count(c.fill_rule != cases::default_fill_rule(c.rules));
  state += count(c.cull != cases::Cull::none);
  state += count(c.front_face != cases::FrontFace::ccw);
  state += count(c.scissor.has_value());
  state += count(c.depth_test != cases::DepthTest::none);
  state += count(c.depth_clear.has_value());
  state += count(c.depth_clamp);
  state += count(!c.depth_bias.is_none());
  state += count(c.depth_format != cases::DepthFormat::float32);
  state += count(c.viewport.min_depth != 0 || c.viewport.max_depth != 1);
  state += count(c.choices.has_value());
  state += c.clip_distance_count;
  for (const cases::Attribute& attribute : c.attributes) {
    state += 1 + count(attribute.interpolation != cases::Interpolation::smooth) +
             count(attribute.location != cases::Location::sample);
  }
  return state;
}

std::uint64_t camera_of(const cases::Case& c) {
  if (!c.camera) return 0;
  std::uint64_t size = 1;
  for (const cases::Matrix4* matrix : {&c.camera->model, &c.camera->view, &c.camera->projection}) {
    for (std::size_t i = 0; i < matrix->size(); ++i) {
      size += count((*matrix)[i] != cases::kIdentity[i]);
    }
  }
  return size;
}

std::uint64_t bits_of(float value) {
  return static_cast<std::uint64_t>(significant_bits(value)) + count(std::signbit(value));
}

}  // namespace

int significant_bits(float value) {
  if (value == 0) return 0;
  int exponent = 0;
  double significand = std::frexp(static_cast<double>(value), &exponent);
  int bits = 0;
  while (significand != 0) {
    significand = 2 * significand - std::trunc(2 * significand);
    ++bits;
  }
  return bits;
}

WindowPoint window_point(const cases::Viewport& viewport, const cases::ClipVertex& vertex) {
  const double half_width = static_cast<double>(viewport.width) / 2;
  const double half_height = static_cast<double>(viewport.height) / 2;
  const double w = vertex.w;
  return {vertex.x / w * half_width + (viewport.x + half_width),
          vertex.y / w * half_height + (viewport.y + half_height)};
}

int window_bits(double coordinate) {
  int bits = 0;
  while (bits <= kMostWindowBits && coordinate != std::trunc(coordinate)) {
    coordinate *= 2;
    ++bits;
  }
  return bits;
}

std::vector<float*> numbers_of(cases::Case& c) {
  std::vector<float*> numbers;
  for (cases::ClipVertex& vertex : c.positions) {
    for (float* number : {&vertex.x, &vertex.y, &vertex.z, &vertex.w}) numbers.push_back(number);
  }
  for (float& value : c.attribute_values) numbers.push_back(&value);
  for (float& distance : c.clip_distances) numbers.push_back(&distance);
  if (c.camera) {
    for (cases::Matrix4* matrix : {&c.camera->model, &c.camera->view, &c.camera->projection}) {
      for (float& number : *matrix) numbers.push_back(&number);
    }
  }
  return numbers;
}

CaseSize size_of(const cases::Case& c) {
  CaseSize size;
  size.triangles = c.triangles.size();
  size.vertices = c.positions.size();
  size.state = state_of(c);
  size.camera = camera_of(c);
  size.pixels = static_cast<std::uint64_t>(c.framebuffer.width) *
                static_cast<std::uint64_t>(c.framebuffer.height);
  double viewport = 0;
  for (const float number : {c.viewport.width, c.viewport.height, c.viewport.x, c.viewport.y}) {
    viewport += std::abs(number);
    size.bits += bits_of(number);
  }
  // All sizes beyond 2^53 count as equal.
  size.viewport = static_cast<std::uint64_t>(std::ceil(std::min(viewport, 0x1p53)));
  size.bits += bits_of(c.viewport.min_depth) + bits_of(c.viewport.max_depth);
  for (const cases::ClipVertex& vertex : c.positions) {
    size.other_w += count(vertex.w != 1);
    int bits = 2 * (kMostWindowBits + 1);
    if (vertex.w > 0 && !c.camera) {
      const WindowPoint point = window_point(c.viewport, vertex);
      bits = window_bits(point.u) + window_bits(point.v);
    }
    size.off_grid += static_cast<std::uint64_t>(bits);
  }
  cases::Case copy = c;
  for (const float* number : numbers_of(copy)) {
    size.bits += bits_of(*number);
    if (*number != 0) {
      size.exponents += static_cast<std::uint64_t>(std::abs(std::ilogb(*number)));
    }
  }
  return size;
}

}  // namespace rastercheck::properties
