#pragma once

// Depths as unorm formats store them, k/(2^n − 1) with an integer k, and how to recover k from what
// a shader fetches. A fetched float need not be the nearest one to k/(2^n − 1), so each driver's
// conversion is found out before it is relied on.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::backends {

/// Returns the float32 nearest to k/(2^bits − 1), where 0 <= k < 2^bits and bits <= 24. Different k
/// give different floats.
float unorm_depth(std::uint32_t k, int bits);

/// How shaders convert k to float32: `divided` rounds k/(2^n − 1) to the nearest; `multiplied` is
/// the float32 product of k and the float32 nearest to 1/(2^n − 1). With 24 bits, the product is 1
/// for both of the greatest k, and different k have different products otherwise.
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

  /// True if a depth that was read back as `read` may have been stored as 1 or as a step less.
  bool is_open(float read) const;
  /// Turns a depth that was read back into the one that was stored. If it is open, `is_one` tells
  /// which it is. Fails if nothing is read back as this.
  Result<float> stored(float read, bool is_one) const;
};

/// A triangle over all samples of a case's framebuffer, with depth 1. Its attributes are the
/// case's, all 0. Where drawing it with the depth test `equal` leaves a fragment, 1 is stored.
cases::Case covering_at_one(const cases::Case& c);

}  // namespace rastercheck::backends
