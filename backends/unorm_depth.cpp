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
  std::vector<std::uint32_t> found;
  // Each conversion is off by at most two roundings to float32, which is less than two steps.
  constexpr int kReach = 2;
  const double about = std::round(double{read} * steps_of(bits));
  const bool is_in_range = about >= 0 && about <= steps_of(bits);
  if (!is_in_range) return found;
  for (int i = -kReach; i <= kReach; ++i) {
    const double k = about + i;
    if (k < 0 || k > steps_of(bits)) continue;
    const auto integer = static_cast<std::uint32_t>(k);
    if (fetched_depth(integer, bits, how) == read) found.push_back(integer);
  }
  return found;
}

bool tells(std::uint32_t k, int bits) {
  return fetched_depth(k, bits, UnormFetch::divided) !=
         fetched_depth(k, bits, UnormFetch::multiplied);
}

/// True if clearing to unorm_depth(k) stores k, whether the driver truncates or rounds to the
/// nearest: the float is no less than k/(2^n − 1), and is less than half a step more. Rounding the
/// product with 2^n − 1 to float32 keeps it from k to there. The product in double is exact.
bool is_stored_alike(std::uint32_t k, int bits) {
  return double{unorm_depth(k, bits)} * steps_of(bits) >= static_cast<double>(k);
}

}  // namespace

// Injective: neighbouring k/(2^n − 1) are farther apart than 2^-n, which for n <= 24 is at least
// the distance of neighbouring floats below 1.
float unorm_depth(std::uint32_t k, int bits) {
  // Rounding twice gives the nearest float: a middle between two floats near 2^-a is m/2^(a + 25),
  // and k/(2^n − 1) is either exact or differs from it by 2^-(a + 25)/(2^n − 1) or more, which for
  // n <= 24 exceeds the error of the quotient in double, 2^-(a + 53).
  return static_cast<float>(k / steps_of(bits));
}

float fetched_depth(std::uint32_t k, int bits, UnormFetch how) {
  if (how == UnormFetch::divided) return unorm_depth(k, bits);
  return static_cast<float>(k) * static_cast<float>(1 / steps_of(bits));
}

std::vector<std::uint32_t> telling_depths(int bits) {
  constexpr std::uint32_t kPairs = kTellingDepths / 2;
  const std::uint32_t greatest = (std::uint32_t{1} << static_cast<unsigned>(bits)) - 1;
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < kPairs; ++i) {
    std::uint32_t k = i * (greatest / kPairs);
    while (!is_stored_alike(k, bits)) ++k;
    all.push_back(k);
    // 0 and the greatest k are stored alike.
    while (k < greatest && !(tells(k, bits) && is_stored_alike(k, bits))) ++k;
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

bool DepthReading::is_open(float read) const {
  return bits != 0 && fetch && integers_read_as(read, bits, *fetch).size() > 1;
}

Result<float> DepthReading::stored(float read, bool is_one) const {
  if (bits == 0 || !fetch) return read;
  const std::vector<std::uint32_t> found = integers_read_as(read, bits, *fetch);
  if (!found.empty()) return unorm_depth(is_one ? found.back() : found.front(), bits);
  return tl::unexpected(
      Error{"", "", fmt::format("a depth of {} bits was fetched as {}", bits, read)});
}

cases::Case covering_at_one(const cases::Case& c) {
  cases::Case all;
  all.rules = c.rules;
  all.framebuffer = c.framebuffer;
  all.viewport = {
      0, 0, static_cast<float>(c.framebuffer.width), static_cast<float>(c.framebuffer.height),
      0, 1};
  all.depth_format = c.depth_format;
  all.attributes = c.attributes;
  all.positions = {{-1, -1, 1, 1}, {3, -1, 1, 1}, {-1, 3, 1, 1}};
  all.attribute_values.assign(3 * c.attributes.size(), 0.0F);
  all.triangles = {{0, 1, 2}};
  return all;
}

}  // namespace rastercheck::backends
