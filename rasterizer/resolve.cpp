#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "rasterizer/internal/checked_frame.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {
namespace {

/// Writes the means of in[pixel][sample][channel] to out[pixel][channel].
template <typename Values, typename Mean>
void put_means(const Values& in, std::size_t samples, std::size_t channels, const Mean& mean,
               Values& out) {
  const std::size_t pixels = channels == 0 ? 0 : out.size() / channels;
  for (std::size_t p = 0; p < pixels; ++p) {
    for (std::size_t k = 0; k < channels; ++k) {
      // In double, in which the bytes of 16 samples, and most floats, are summed without rounding.
      // The sum starts with the first value, not with 0, so that the mean of zeros keeps their
      // sign.
      double sum = in[p * samples * channels + k];
      for (std::size_t s = 1; s < samples; ++s) sum += in[(p * samples + s) * channels + k];
      out[p * channels + k] = mean(sum / static_cast<double>(samples));
    }
  }
}

}  // namespace

std::optional<Error> resolve(const Picture& from, Picture& into) {
  if (const std::optional<Error> error = check_framebuffer(from)) return error;
  const ColorFormat old_format = into.format;
  into.format = from.format;
  const TargetSize size{from.size.width, from.size.height, 1};
  if (const auto error = resize(into, size, from.attribute_count)) {
    into.format = old_format;
    return error;
  }
  const auto samples = static_cast<std::size_t>(from.size.samples);
  for (std::size_t p = 0; p < into.depth.size(); ++p) into.depth[p] = from.depth[p * samples];
  put_means(
      from.attributes, samples, from.attribute_count,
      [](double mean) { return static_cast<float>(mean); }, into.attributes);
  put_means(
      from.bytes, samples, from.attribute_count,
      [](double mean) { return static_cast<std::uint8_t>(std::nearbyint(mean)); }, into.bytes);
  return std::nullopt;
}

}  // namespace rastercheck::rasterizer
