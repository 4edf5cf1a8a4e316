#include "backends/unorm_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rastercheck::backends {
namespace {

double steps_of(int bits) { return std::ldexp(1.0, bits) - 1; }

/// The integers that a driver's shaders fetch as `read`, in ascending order.
std::vector<std::uint32_t> integers_read_as(float read, int bits, UnormFetch how) {
  // Each conversion is off by at most two roundings to float32, which is less than two steps.
  constexpr double kReach = 2;
  const double about = std::round(double{read} * steps_of(bits));
  std::vector<std::uint32_t> found;
  for (double k = about - kReach; k <= about + kReach; ++k) {
    if (!(k >= 0 && k <= steps_of(bits))) continue;
    const auto integer = static_cast<std::uint32_t>(k);
    if (fetched_depth(integer, bits, how) == read) found.push_back(integer);
  }
  return found;
}

bool tells(std::uint32_t k, int bits) {
  return fetched_depth(k, bits, UnormFetch::divided) !=
         fetched_depth(k, bits, UnormFetch::multiplied);
}

}  // namespace

// Injective: neighbouring k/(2^n − 1) are farther apart than 2^-n, which for n <= 24 is at least
// the distance of neighbouring floats below 1.
float unorm_depth(std::uint32_t k, int bits) {
  // The quotient in double is off by 2^-53, and k/(2^n − 1) with n <= 24 is never that close to the
  // middle between two floats: a middle has at most 25 digits, and differs from the quotient by a
  // multiple of 2^-50/(2^n − 1) times 2^n at least.
  return static_cast<float>(k / steps_of(bits));
}

float fetched_depth(std::uint32_t k, int bits, UnormFetch how) {
  if (how == UnormFetch::divided) return unorm_depth(k, bits);
  return static_cast<float>(k) * static_cast<float>(1 / steps_of(bits));
}

std::vector<std::uint32_t> telling_depths(int bits) {
  const std::uint32_t greatest = (std::uint32_t{1} << static_cast<unsigned>(bits)) - 1;
  // In the upper half of the range, unorm_depth(k) (2^n − 1) lies in [k, k + 1/2), also as float32,
  // for 24 bits; the floats of shorter formats are much closer to k than half a step.
  const std::uint32_t least = bits == 24 ? (greatest + 1) / 2 : 0;
  std::vector<std::uint32_t> all;
  constexpr std::size_t kTelling = kTellingDepths / 2;
  const std::uint32_t step = (greatest - least) / kTelling;
  for (std::uint32_t i = 0; i < kTelling; ++i) {
    std::uint32_t k = least + i * step;
    all.push_back(k);
    while (k < greatest && !tells(k, bits)) ++k;
    all.push_back(k);
  }
  return all;
}

std::optional<UnormFetch> fetch_of(std::span<const float> fetched, int bits) {
  const std::vector<std::uint32_t> stored = telling_depths(bits);
  for (const UnormFetch how : {UnormFetch::divided, UnormFetch::multiplied}) {
    const bool is_this = std::equal(
        stored.begin(), stored.end(), fetched.begin(), fetched.end(),
        [&](std::uint32_t k, float read) { return fetched_depth(k, bits, how) == read; });
    if (is_this) return how;
  }
  return std::nullopt;
}

Result<float> DepthReading::stored(float read) const {
  if (bits == 0 || !fetch) return read;
  const std::vector<std::uint32_t> found = integers_read_as(read, bits, *fetch);
  if (found.size() == 1) return unorm_depth(found[0], bits);
  if (found.empty()) {
    return tl::unexpected(
        Error{"", "", fmt::format("a depth of {} bits was fetched as {}", bits, read)});
  }
  return tl::unexpected(
      Error{"", "",
            fmt::format("its shaders fetch a depth of {} bits as {}, whether it is {} or {} steps",
                        bits, read, found[0], found[1]),
            Failure::unsupported});
}

}  // namespace rastercheck::backends
