#pragma once

// Depths as unorm formats store them, k/(2^n − 1) with an integer k, and how to recover k from what
// a shader fetches. A fetched float need not be the nearest one to k/(2^n − 1), so each driver's
// conversion is found out before it is relied on.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cases/error.h"

namespace rastercheck::backends {

/// Returns the float32 nearest to k/(2^bits − 1), where 0 <= k < 2^bits and bits <= 24. Different k
/// give different floats.
float unorm_depth(std::uint32_t k, int bits);

/// How shaders convert k to float32: `divided` rounds k/(2^n − 1) to the nearest; `multiplied` is
/// the float32 product of k and the float32 nearest to 1/(2^n − 1). With 24 bits, the product is 1
/// for both of the greatest k.
enum class UnormFetch { divided, multiplied };
float fetched_depth(std::uint32_t k, int bits, UnormFetch how);

/// Numbers of a format that together tell how shaders convert: numbers that the conversions turn
/// into different floats, and others. Each is stored exactly if an image is cleared to its
/// unorm_depth(), whether the driver truncates or rounds to the nearest.
inline constexpr std::size_t kTellingDepths = 64;
std::vector<std::uint32_t> telling_depths(int bits);

/// Returns the conversion that a driver uses, given what its shaders fetch for telling_depths();
/// empty if the driver uses none of UnormFetch.
std::optional<UnormFetch> fetch_of(std::span<const float> fetched, int bits);

/// How depths that were read back were stored.
struct DepthReading {
  int bits = 0;                     ///< of a unorm format; 0 for float32
  std::optional<UnormFetch> fetch;  ///< set if a shader fetched the depths of a unorm format

  /// Turns a depth that was read back into the one that was stored. Fails with
  /// Failure::unsupported if several stored depths would read alike.
  Result<float> stored(float read) const;
};

}  // namespace rastercheck::backends
