// Passes that make a case's numbers simpler: w, positions, bits, exponents, the viewport.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "properties/campaign/internal/shrink_search.h"

namespace rastercheck::properties {
namespace {

using cases::Case;
using cases::ClipVertex;

/// Returns the nearest number of `bits` significant bits.
float with_bits(float value, int bits) {
  int exponent = 0;
  const double significand = std::frexp(static_cast<double>(value), &exponent);
  const double rounded = std::nearbyint(std::ldexp(significand, bits));
  const auto result = static_cast<float>(std::ldexp(rounded, exponent - bits));
  return std::isfinite(result) ? result : value;
}

/// Numbers of significant bits to try, fewest first.
constexpr std::array kBits{1, 2, 3, 4, 6, 8, 12, 16, 20};

/// A range of a case's numbers, as indices into numbers_of().
struct Group {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Returns four ranges: all numbers; positions; attributes and clip distances; the camera.
std::array<Group, 4> groups_of(const Case& c) {
  const std::size_t positions = c.positions.size() * 4;
  const std::size_t values = positions + c.attribute_values.size() + c.clip_distances.size();
  const std::size_t all = values + (c.camera ? std::size_t{48} : 0);
  return {{{0, all}, {0, positions}, {positions, values}, {values, all}}};
}

/// Offers the current case with `change` applied to every number of a group.
bool offer_group(ShrinkSearch& search, const Group& group,
                 const std::function<float(float)>& change) {
  return search.offer_changed([&](Case& c) {
    const std::vector<float*> numbers = numbers_of(c);
    for (std::size_t i = group.first; i < group.last; ++i) *numbers[i] = change(*numbers[i]);
  });
}

/// Moves a vertex with w > 0 to the nearest point of the grid of 2^-bits pixels.
void snap(const cases::Viewport& viewport, ClipVertex& vertex, int bits, bool is_x, bool is_y) {
  const WindowPoint point = window_point(viewport, vertex);
  const auto to_clip = [&](double window, double start, double size) {
    const double on_grid = std::ldexp(std::nearbyint(std::ldexp(window, bits)), -bits);
    const double ndc = (on_grid - start - size / 2) / (size / 2);
    const auto clip = static_cast<float>(ndc * vertex.w);
    return std::isfinite(clip) ? clip : 0;
  };
  if (is_x) vertex.x = to_clip(point.u, viewport.x, viewport.width);
  if (is_y) vertex.y = to_clip(point.v, viewport.y, viewport.height);
}

bool has_grid(const ClipVertex& vertex) { return vertex.w > 0; }

/// Returns the vertex with w = 1 at the same place in the window.
ClipVertex divided(const ClipVertex& vertex) {
  const ClipVertex other{vertex.x / vertex.w, vertex.y / vertex.w, vertex.z / vertex.w, 1};
  const bool is_finite = std::isfinite(other.x) && std::isfinite(other.y) && std::isfinite(other.z);
  return is_finite ? other : vertex;
}

/// Multiplies the numbers by 2^-k; all must stay finite.
void scale(const std::vector<float*>& numbers, int k) {
  for (float* number : numbers) *number = std::ldexp(*number, -k);
}

/// Returns the exponent of the greatest magnitude, or 0 if all numbers are 0.
int greatest_exponent(const std::vector<float*>& numbers) {
  float greatest = 0;
  for (const float* number : numbers) greatest = std::max(greatest, std::abs(*number));
  return greatest == 0 ? 0 : std::ilogb(greatest);
}

/// Changes all vertices alike: a failure that depends on three numbers together often vanishes if
/// one changes.
void level_columns(ShrinkSearch& search) {
  const auto set_z = [&search](const std::function<float(float)>& z_of_w) {
    return search.offer_changed([&](Case& c) {
      for (ClipVertex& vertex : c.positions) vertex.z = z_of_w(vertex.w);
    });
  };
  if (!set_z([](float /*w*/) { return 0.0F; })) set_z([](float w) { return w / 2; });
  for (float ClipVertex::*const number : {&ClipVertex::x, &ClipVertex::y}) {
    search.offer_changed([number](Case& c) {
      for (ClipVertex& vertex : c.positions) vertex.*number = 0;
    });
  }
  const std::size_t columns = search.current().attributes.size();
  for (std::size_t column = 0; column < columns; ++column) {
    for (const float value : {0.0F, 1.0F}) {
      const bool is_taken = search.offer_changed([&](Case& c) {
        for (std::size_t i = column; i < c.attribute_values.size(); i += columns) {
          c.attribute_values[i] = value;
        }
      });
      if (is_taken) break;
    }
  }
}

/// Removes columns or rows at the end of the framebuffer, at best all that lie beyond the failure.
void crop_end(ShrinkSearch& search, int cases::FramebufferSize::*side,
              std::uint32_t cases::SamplePlace::*at) {
  if (search.check().violations.empty()) return;
  const auto least = static_cast<int>(search.check().violations.front().place.*at) + 1;
  const auto offer = [&](int size) {
    return size < search.current().framebuffer.*side &&
           search.offer_changed([=](Case& c) { c.framebuffer.*side = size; });
  };
  if (offer(least)) return;
  // If this cut is refused, tries smaller ones. If the law then fails in another pixel, smaller
  // cuts together may remove even more columns or rows.
  for (int step = search.current().framebuffer.*side / 2; step > 0; step /= 2) {
    while (search.current().framebuffer.*side - step >= 1 &&
           offer(search.current().framebuffer.*side - step)) {
    }
  }
}

/// If the failure lies at least this far from the start, rows or columns before it are removed in
/// multiples of this number.
constexpr std::uint32_t kFar = 8;

void crop_start(ShrinkSearch& search, int cases::FramebufferSize::*side,
                float cases::Viewport::*start, int cases::Scissor::*scissor,
                std::uint32_t cases::SamplePlace::*at) {
  if (search.check().violations.empty()) return;
  const std::uint32_t place = search.check().violations.front().place.*at;
  if (place < kFar) return;
  const auto gone = static_cast<int>(place - place % kFar);
  search.offer_changed([=](Case& c) {
    if (c.framebuffer.*side <= gone) return;
    c.framebuffer.*side -= gone;
    c.viewport.*start -= static_cast<float>(gone);
    if (c.scissor) (*c.scissor).*scissor -= gone;
  });
}

void whole_framebuffer(Case& c, int width, int height) {
  c.framebuffer.width = width;
  c.framebuffer.height = height;
  c.viewport.x = 0;
  c.viewport.y = 0;
  c.viewport.width = static_cast<float>(width);
  c.viewport.height = static_cast<float>(height);
}

}  // namespace

void set_w_to_one(ShrinkSearch& search) {
  const auto set_to_one = [](ClipVertex& vertex) { vertex.w = 1; };
  const auto divide = [](ClipVertex& vertex) {
    if (vertex.w != 0) vertex = divided(vertex);
  };
  search.offer_changed(
      [&](Case& c) { std::for_each(c.positions.begin(), c.positions.end(), divide); });
  search.offer_changed(
      [&](Case& c) { std::for_each(c.positions.begin(), c.positions.end(), set_to_one); });
  for (std::size_t i = 0; i < search.current().positions.size(); ++i) {
    if (search.offer_changed([&](Case& c) { divide(c.positions[i]); })) continue;
    search.offer_changed([&](Case& c) { set_to_one(c.positions[i]); });
  }
}

void move_to_grid(ShrinkSearch& search) {
  if (search.current().camera) return;
  const auto snap_one = [](Case& c, std::size_t i, int bits, bool is_x, bool is_y) {
    if (has_grid(c.positions[i])) snap(c.viewport, c.positions[i], bits, is_x, is_y);
  };
  for (int bits = 0; bits <= kMostWindowBits; ++bits) {
    const bool is_taken = search.offer_changed([&](Case& c) {
      for (std::size_t i = 0; i < c.positions.size(); ++i) snap_one(c, i, bits, true, true);
    });
    if (is_taken) break;
  }
  for (std::size_t i = 0; i < search.current().positions.size(); ++i) {
    for (int bits = 0; bits <= kMostWindowBits; ++bits) {
      if (search.offer_changed([&](Case& c) { snap_one(c, i, bits, true, true); })) break;
      const bool is_x = search.offer_changed([&](Case& c) { snap_one(c, i, bits, true, false); });
      const bool is_y = search.offer_changed([&](Case& c) { snap_one(c, i, bits, false, true); });
      if (is_x && is_y) break;
    }
  }
}

void drop_bits(ShrinkSearch& search) {
  level_columns(search);
  for (const Group& group : groups_of(search.current())) {
    for (const int bits : kBits) {
      if (offer_group(search, group, [bits](float v) { return with_bits(v, bits); })) break;
    }
  }
  const std::size_t count = groups_of(search.current())[0].last;
  for (std::size_t i = 0; i < count && !search.is_over(); ++i) {
    const Group one{i, i + 1};
    if (offer_group(search, one, [](float /*v*/) { return 0.0F; })) continue;
    offer_group(search, one, [](float v) { return std::abs(v); });
    if (offer_group(search, one, [](float /*v*/) { return 1.0F; })) continue;
    for (const int bits : kBits) {
      if (offer_group(search, one, [bits](float v) { return with_bits(v, bits); })) break;
    }
  }
}

void lessen_exponents(ShrinkSearch& search) {
  // Scales all positions, one vertex, or one attribute or clip distance: a mere change of units.
  search.offer_changed([](Case& c) {
    std::vector<float*> numbers = numbers_of(c);
    numbers.resize(c.positions.size() * 4);
    scale(numbers, greatest_exponent(numbers));
  });
  for (std::size_t i = 0; i < search.current().positions.size(); ++i) {
    search.offer_changed([i](Case& c) {
      ClipVertex& vertex = c.positions[i];
      const std::vector<float*> numbers{&vertex.x, &vertex.y, &vertex.z, &vertex.w};
      scale(numbers, greatest_exponent(numbers));
    });
  }
  const auto scale_column = [&search](std::vector<float> Case::*values, std::size_t columns) {
    for (std::size_t column = 0; column < columns; ++column) {
      search.offer_changed([&](Case& c) {
        std::vector<float*> numbers;
        for (std::size_t i = column; i < (c.*values).size(); i += columns) {
          numbers.push_back(&(c.*values)[i]);
        }
        scale(numbers, greatest_exponent(numbers));
      });
    }
  };
  scale_column(&Case::attribute_values, search.current().attributes.size());
  scale_column(&Case::clip_distances, search.current().clip_distance_count);
  const std::size_t count = groups_of(search.current())[0].last;
  for (std::size_t i = 0; i < count && !search.is_over(); ++i) {
    const Group one{i, i + 1};
    for (const int divisor : {0, 4, 2}) {  // divides the exponent; 0 sets it to 0
      const bool is_taken = offer_group(search, one, [divisor](float v) {
        if (v == 0) return v;
        const int exponent = std::ilogb(v);
        return std::ldexp(v, (divisor == 0 ? 0 : exponent / divisor) - exponent);
      });
      if (is_taken) break;
    }
  }
}

void shrink_viewport(ShrinkSearch& search) {
  const cases::FramebufferSize& size = search.current().framebuffer;
  const auto height_at = [](int n, const Case& c) { return std::min(n, c.framebuffer.height); };
  for (int n = 1; n < std::max(size.width, size.height); n *= 2) {
    const bool is_taken = search.offer_changed(
        [&](Case& c) { whole_framebuffer(c, std::min(n, c.framebuffer.width), height_at(n, c)); });
    if (is_taken) break;
  }
  search.offer_changed(
      [](Case& c) { whole_framebuffer(c, c.framebuffer.width, c.framebuffer.height); });
  crop_end(search, &cases::FramebufferSize::width, &cases::SamplePlace::x);
  crop_end(search, &cases::FramebufferSize::height, &cases::SamplePlace::y);
  crop_start(search, &cases::FramebufferSize::width, &cases::Viewport::x, &cases::Scissor::x,
             &cases::SamplePlace::x);
  crop_start(search, &cases::FramebufferSize::height, &cases::Viewport::y, &cases::Scissor::y,
             &cases::SamplePlace::y);
  for (float cases::Viewport::*const number : {&cases::Viewport::x, &cases::Viewport::y}) {
    search.offer_changed([number](Case& c) { c.viewport.*number = 0; });
    search.offer_changed(
        [number](Case& c) { c.viewport.*number = std::trunc(c.viewport.*number); });
  }
  for (float cases::Viewport::*const number : {&cases::Viewport::width, &cases::Viewport::height}) {
    for (const float n : {1.0F, 2.0F, 4.0F, 8.0F, 16.0F, 32.0F}) {
      if (n >= std::abs(search.current().viewport.*number)) break;
      if (search.offer_changed([=](Case& c) { c.viewport.*number = n; })) break;
    }
    search.offer_changed([number](Case& c) { c.viewport.*number = std::abs(c.viewport.*number); });
    search.offer_changed([number](Case& c) {
      const float whole = std::trunc(c.viewport.*number);
      if (whole != 0) c.viewport.*number = whole;
    });
  }
}

}  // namespace rastercheck::properties
