#include "tests/oracle/drawing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "oracle/fragments.h"
#include "oracle/stored_values.h"

namespace rastercheck::oracle {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

void copy_fragment(const cases::Fragments& from, std::size_t i, cases::Fragments& to) {
  const auto values = from.attributes_of(i);
  push(to, from.triangle[i], from.x[i], from.y[i], from.sample[i], from.depth[i],
       {values.begin(), values.end()});
}

float spoiled(float value, Dice& dice) {
  if (!dice.one_in(3)) return value;
  switch (dice.between(0, 15)) {
    case 0:
      return dice.pick({kNan, kInfinity, -kInfinity});
    case 1:
      return dice.pick({0.0F, -0.0F, 0x1p-149F, -0x1p-149F});
    case 2:
      return -value;
    case 3:
      return std::bit_cast<float>(static_cast<std::uint32_t>(dice.bits()));
    default:
      return moved(value, dice.pick({-1000, -17, -4, -2, -1, 1, 1, 2, 3, 16, 300}));
  }
}

/// Moves fragment i to another place, which may lie outside the case.
void misplace(const SceneTruth& scene, Dice& dice, cases::Fragments& drawn, std::size_t i) {
  const cases::Case& c = scene.source();
  switch (dice.between(0, 4)) {
    case 0:
      drawn.triangle[i] =
          static_cast<std::uint32_t>(dice.between(0, static_cast<int>(c.triangles.size())));
      break;
    case 1:
      drawn.sample[i] = static_cast<std::uint8_t>(dice.between(0, c.framebuffer.samples));
      break;
    case 2:
      drawn.x[i] = static_cast<std::uint16_t>(dice.between(0, c.framebuffer.width));
      break;
    default:
      drawn.x[i] = static_cast<std::uint16_t>(dice.between(0, c.framebuffer.width - 1));
      drawn.y[i] = static_cast<std::uint16_t>(dice.between(0, c.framebuffer.height));
  }
}

}  // namespace

float Dice::real(int low, int high) {
  const int mantissa = (1 << 23) + between(0, (1 << 23) - 1);
  const float size = std::ldexp(static_cast<float>(mantissa), between(low, high) - 23);
  return one_in(2) ? size : -size;
}

void push(cases::Fragments& drawn, std::uint32_t triangle, int x, int y, int sample, float depth,
          const std::vector<float>& attributes) {
  drawn.attribute_count = attributes.size();
  drawn.triangle.push_back(triangle);
  drawn.x.push_back(static_cast<std::uint16_t>(x));
  drawn.y.push_back(static_cast<std::uint16_t>(y));
  drawn.sample.push_back(static_cast<std::uint8_t>(sample));
  drawn.depth.push_back(depth);
  drawn.attributes.insert(drawn.attributes.end(), attributes.begin(), attributes.end());
}

cases::Fragments perfect(const SceneTruth& scene) {
  cases::Fragments drawn;
  drawn.attribute_count = scene.source().attributes.size();
  for_each_fragment(scene, [&](const Fragment& f, const TriangleTruth&) {
    std::vector<float> attributes;
    for (const auto& value : f.attributes) {
      attributes.push_back(value ? value->lo.nearest_float() : kNan);
    }
    push(drawn, f.place.triangle, static_cast<int>(f.place.x), static_cast<int>(f.place.y),
         static_cast<int>(f.place.sample),
         f.depth ? stored_depth(f.depth->lo, scene.source().depth_format) : kNan, attributes);
    return true;
  });
  return drawn;
}

cases::Fragments everything(const SceneTruth& scene) {
  const cases::Case& c = scene.source();
  cases::Fragments drawn;
  drawn.attribute_count = c.attributes.size();
  const std::vector<float> attributes(c.attributes.size(), 0.0F);
  for (std::uint32_t t = 0; t < c.triangles.size(); ++t) {
    for (int y = 0; y < c.framebuffer.height; ++y) {
      for (int x = 0; x < c.framebuffer.width; ++x) {
        for (int s = 0; s < c.framebuffer.samples; ++s) push(drawn, t, x, y, s, 0, attributes);
      }
    }
  }
  return drawn;
}

cases::Fragments shuffled(const cases::Fragments& drawn, Dice& dice) {
  std::vector<std::size_t> order(drawn.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[dice.bits() % i]);
  cases::Fragments other;
  other.attribute_count = drawn.attribute_count;
  for (const std::size_t i : order) copy_fragment(drawn, i, other);
  return other;
}

float moved(float value, int steps) {
  for (int i = 0; i < std::abs(steps); ++i) {
    value = std::nextafter(value, steps < 0 ? -kInfinity : kInfinity);
  }
  return value;
}

cases::Fragments spoiled(const SceneTruth& scene, const cases::Fragments& drawn, Dice& dice) {
  cases::Fragments other;
  other.attribute_count = drawn.attribute_count;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (dice.one_in(16)) continue;
    const int times = dice.one_in(16) ? 2 : 1;
    for (int t = 0; t < times; ++t) copy_fragment(drawn, i, other);
    if (dice.one_in(16)) misplace(scene, dice, other, other.size() - 1);
  }
  for (float& value : other.attributes) value = spoiled(value, dice);
  for (float& value : other.depth) value = spoiled(value, dice);
  return dice.one_in(2) ? shuffled(other, dice) : other;
}

}  // namespace rastercheck::oracle
