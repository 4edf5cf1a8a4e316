#include "properties/random_floats.h"

#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>

#include "properties/float_numbers.h"

namespace rastercheck::properties {
namespace {

constexpr std::uint32_t kSignBit = 0x80000000U;

float with_sign(Draw& draw, std::uint32_t magnitude) {
  const bool is_negative = draw.one_in(2);
  return std::bit_cast<float>(is_negative ? magnitude | kSignBit : magnitude);
}

}  // namespace

float float_by_bits(Draw& draw) {
  constexpr int kLargest = 0x7f7fffff;
  const auto magnitude = static_cast<std::uint32_t>(draw.between(0, kLargest));
  return with_sign(draw, magnitude);
}

float any_zero(Draw& draw) { return with_sign(draw, 0); }

float subnormal_float(Draw& draw) {
  const int bits = draw.between(0, 22);
  const auto below = static_cast<std::uint32_t>(draw.bits(bits));
  return with_sign(draw, (1U << bits) | below);
}

float huge_float(Draw& draw) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  if (draw.one_in(4)) return draw.one_in(2) ? kLargest : -kLargest;
  return draw.spread(120, 127);
}

float dyadic_float(Draw& draw, int most, int bits) {
  assert(0 < most && 0 <= bits && bits <= 24 && most <= (1 << (24 - bits)));
  const int units = 1 << bits;
  const int n = draw.between(-most * units, most * units);
  return static_cast<float>(n) / static_cast<float>(units);
}

float float_near(Draw& draw, float target, int most_exponent) {
  assert(0 <= most_exponent && most_exponent <= 23);
  const int exponent = draw.between(0, most_exponent);
  const int most = 1 << exponent;
  const int steps = draw.between(-most, most);
  return stepped(target, steps);
}

float nudged(Draw& draw, float value) {
  const int steps = draw.between(-1, 1);
  return steps == 0 ? value : stepped(value, steps);
}

float any_float(Draw& draw) {
  switch (draw.between(0, 9)) {
    case 0:
    case 1:
      return float_by_bits(draw);
    case 2:
      return draw.spread(-149, 127);
    case 3:
      return draw.spread(-24, 24);
    case 4:
      return any_zero(draw);
    case 5:
      return subnormal_float(draw);
    case 6:
      return huge_float(draw);
    case 7: {
      const float target = draw.pick(std::array{1.0F, -1.0F, 0.5F, 2.0F, 0x1p-126F, 0x1p24F});
      return float_near(draw, target, 2);
    }
    default: {
      const int bits = draw.between(0, 12);
      return dyadic_float(draw, 16, bits);
    }
  }
}

}  // namespace rastercheck::properties
