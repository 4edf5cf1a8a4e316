#include "properties/float_numbers.h"

namespace rastercheck::properties {
namespace {

/// Maps floats to integers in the same order; both zeros map to 0.
std::int32_t rank_of(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto magnitude = static_cast<std::int32_t>(bits & 0x7fffffffU);
  return (bits >> 31) != 0 ? -magnitude : magnitude;
}

}  // namespace

float to_float(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

float stepped(float value, int steps) {
  constexpr std::int64_t kMost = 0x7f7fffff;
  const std::int64_t rank = std::clamp(std::int64_t{rank_of(value)} + steps, -kMost, kMost);
  const auto magnitude = static_cast<std::uint32_t>(rank < 0 ? -rank : rank);
  return std::bit_cast<float>(rank < 0 ? magnitude | 0x80000000U : magnitude);
}

}  // namespace rastercheck::properties
