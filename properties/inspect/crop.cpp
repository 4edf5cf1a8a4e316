#include "properties/inspect/crop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "records/inspection.h"

namespace rastercheck::properties {
namespace {

using oracle::PixelBox;

/// Maximum number of samples in a crop.
constexpr std::uint32_t kMostSamples = records::kMostInspected * records::kMostInspected;
/// Pixels shown around those that the triangle touches.
constexpr int kMargin = 2;

PixelBox intersection(const PixelBox& a, const PixelBox& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// Returns a part of [from, to) no longer than `most`, with `at` as near to its middle as possible.
std::pair<int, int> part_around(int at, int from, int to, int most) {
  const int first = std::clamp(at - most / 2, from, std::max(from, to - most));
  return {first, std::min(first + most, to)};
}

}  // namespace

PixelBox hull(const PixelBox& a, const PixelBox& b) {
  if (a.x0 >= a.x1 || a.y0 >= a.y1) return b;
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

PixelBox crop_around(const cases::Case& c, const PixelBox& touched, const cases::SamplePlace& at,
                     std::uint32_t most_values) {
  const cases::FramebufferSize& size = c.framebuffer;
  const PixelBox shown = intersection(
      {touched.x0 - kMargin, touched.y0 - kMargin, touched.x1 + kMargin, touched.y1 + kMargin},
      {0, 0, size.width, size.height});
  const auto samples = static_cast<std::uint32_t>(size.samples);
  const auto values = static_cast<std::uint32_t>(c.attributes.size() + 1);
  const std::uint32_t most = std::min(kMostSamples, most_values / values) / samples;
  const int side = std::max(1, static_cast<int>(std::sqrt(most)));
  const auto [x0, x1] = part_around(static_cast<int>(at.x), shown.x0, shown.x1, side);
  const auto [y0, y1] = part_around(static_cast<int>(at.y), shown.y0, shown.y1, side);
  return {x0, y0, x1, y1};
}

}  // namespace rastercheck::properties
