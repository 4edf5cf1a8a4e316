#pragma once

#include <bit>
#include <cstdint>

namespace rastercheck::cases {

/// The number that a binary16 (IEEE 754-2019, §3.6) holds, exactly; NaN keeps its payload.
inline float float_of_half(std::uint16_t half) {
  const std::uint32_t sign = std::uint32_t{half} >> 15U << 31U;
  const std::uint32_t exponent = half >> 10U & 31U;
  const std::uint32_t fraction = half & 1023U;
  constexpr std::uint32_t kBias = 127 - 15;
  if (exponent == 31) return std::bit_cast<float>(sign | 0xffU << 23U | fraction << 13U);
  if (exponent != 0) {
    return std::bit_cast<float>(sign | (exponent + kBias) << 23U | fraction << 13U);
  }
  const float magnitude = static_cast<float>(fraction) * 0x1p-24F;
  return sign == 0 ? magnitude : -magnitude;
}

/// The nearest binary16, ties to even; numbers from 65520 on become infinite. NaN keeps the upper
/// bits of its payload, and stays NaN.
inline std::uint16_t half_of_float(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint16_t>(bits >> 16U & 0x8000U);
  const std::uint32_t magnitude = bits & 0x7fffffffU;
  constexpr std::uint32_t kInfinity = 0x7f800000U;
  if (magnitude > kInfinity) {
    return static_cast<std::uint16_t>(sign | 0x7e00U | (magnitude >> 13U & 0x3ffU));
  }
  if (magnitude >= 0x477ff000U) return static_cast<std::uint16_t>(sign | 0x7c00U);  // 65520
  if (magnitude < 0x38800000U) {
    // Below 2^-14, binary16 has multiples of 2^-24. In [1/2, 1), float32 numbers are multiples of
    // 2^-24, too, so adding 1/2 rounds to such a multiple.
    const float rounded = std::bit_cast<float>(magnitude) + 0.5F;
    return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(rounded) - 0x3f000000U));
  }
  const std::uint32_t is_odd = magnitude >> 13U & 1U;
  const std::uint32_t rounded = magnitude - (112U << 23U) + 0xfffU + is_odd;
  return static_cast<std::uint16_t>(sign | rounded >> 13U);
}

}  // namespace rastercheck::cases
