#include "reports/internal/picture_colors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rastercheck::reports {
namespace {

constexpr Color kNotFinite{255, 0, 255};

float greatest_stored(cases::Storage storage) {
  switch (storage) {
    case cases::Storage::unorm8:
    case cases::Storage::srgb8:
      return 255;
    case cases::Storage::unorm16:
      return 65535;
    case cases::Storage::float32:
    case cases::Storage::float16:
      break;
  }
  return 1;
}

/// The file's channels for red, green and blue.
std::array<std::size_t, 3> shown_channels(const cases::PictureFile& picture) {
  const auto named = [&picture](const char* name) {
    return static_cast<std::size_t>(
        std::find(picture.channels.begin(), picture.channels.end(), name) -
        picture.channels.begin());
  };
  const std::array<std::size_t, 3> by_name{named("R"), named("G"), named("B")};
  const std::size_t count = picture.channels.size();
  if (std::all_of(by_name.begin(), by_name.end(), [&](std::size_t c) { return c < count; })) {
    return by_name;
  }
  if (count >= 3) return {0, 1, 2};
  // Two channels are red and green, one is grey.
  return {0, count - 1, 0};
}

}  // namespace

PictureColors::PictureColors(const cases::PictureFile& picture)
    : channels_(shown_channels(picture)) {
  const std::size_t pixels =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const std::size_t channel = channels_[i];
    const float greatest = greatest_stored(picture.stored[channel]);
    ranges_[i] = {0, greatest};
    if (greatest > 1) continue;
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
      const float value = picture.values[pixel * picture.channels.size() + channel];
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (low >= 0 && high <= 1) continue;
    if (low > high) continue;  // not one finite number
    ranges_[i] = {low, high > low ? high : low + 1};
    is_stretched_ = true;
  }
}

Color PictureColors::of(const float* stored) const {
  Color color{};
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const double value = stored[channels_[i]];
    if (!std::isfinite(value)) return kNotFinite;
    const double low = ranges_[i].low;
    const double share = (value - low) / (ranges_[i].high - low);
    color[i] = static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255));
  }
  return color;
}

Image image_of(const cases::PictureFile& picture, const PictureColors& colors, bool is_upwards) {
  Image image = Image::filled(picture.width, picture.height, {});
  for (int row = 0; row < picture.height; ++row) {
    const int shown = is_upwards ? picture.height - 1 - row : row;
    for (int x = 0; x < picture.width; ++x) {
      image.set(x, shown, colors.of(picture.pixel(x, row)));
    }
  }
  return image;
}

}  // namespace rastercheck::reports
