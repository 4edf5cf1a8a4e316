#include "cases/drawn_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "cases/internal/half.h"

namespace rastercheck::cases {
namespace {

constexpr std::size_t kNothingDrawn = SIZE_MAX;

float code_of(double encoded, double greatest) {
  if (!(encoded > 0)) return 0;
  return static_cast<float>(std::floor(std::min(encoded, 1.0) * greatest + 0.5));
}

double encoded_srgb(double number) {
  const double n = std::clamp(number, 0.0, 1.0);
  return n <= 0.0031308 ? 12.92 * n : 1.055 * std::pow(n, 1 / 2.4) - 0.055;
}

double decoded_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

float stored(Storage storage, double number) {
  switch (storage) {
    case Storage::float32:
      return static_cast<float>(number);
    case Storage::float16:
      return float_of_half(half_of_float(static_cast<float>(number)));
    case Storage::unorm8:
      return code_of(number, 255);
    case Storage::unorm16:
      return code_of(number, 65535);
    case Storage::srgb8:
      break;
  }
  return std::isnan(number) ? 0 : code_of(encoded_srgb(number), 255);
}

/// Returns the number that the mean over samples is taken of.
double averaged(Storage storage, ResolveOf resolve, float value) {
  switch (storage) {
    case Storage::float32:
    case Storage::float16:
      return double{value};
    case Storage::unorm8:
      return double{value} / 255;
    case Storage::unorm16:
      return double{value} / 65535;
    case Storage::srgb8:
      break;
  }
  return resolve == ResolveOf::linear ? decoded_srgb(double{value} / 255) : double{value} / 255;
}

/// Returns the number that a channel shows of a fragment, before it is stored.
double shown_number(const ShownChannel& channel, const Fragments& drawn, std::size_t fragment) {
  switch (channel.shows) {
    case Shown::attribute:
      return double{drawn.attributes_of(fragment)[channel.attribute]};
    case Shown::depth:
      return double{drawn.depth[fragment]};
    case Shown::triangle:
      break;
    case Shown::coverage:
    case Shown::constant:
    case Shown::nothing:
      return double{channel.constant};
  }
  const std::uint32_t number = drawn.triangle[fragment] + 1;
  switch (channel.storage) {
    case Storage::unorm8:
      return (number & 0xffU) / 255.0;
    case Storage::srgb8:
      return decoded_srgb((number & 0xffU) / 255.0);
    case Storage::unorm16:
      return (number & 0xffffU) / 65535.0;
    case Storage::float32:
    case Storage::float16:
      break;
  }
  return number;
}

/// Returns what a channel takes of a fragment: premultiplied colours are multiplied by its alpha.
double source_number(const PictureView& view, std::size_t channel, const Fragments& drawn,
                     std::size_t fragment) {
  const double number = shown_number(view.channels[channel], drawn, fragment);
  if (view.alpha == Alpha::straight || !view.is_color(channel)) return number;
  return number * shown_number(view.channels[*view.alpha_channel], drawn, fragment);
}

double background_number(const PictureView& view, std::size_t channel) {
  const double number{view.channels[channel].background};
  if (view.alpha == Alpha::straight || !view.is_color(channel)) return number;
  return number * double{view.channels[*view.alpha_channel].background};
}

/// [y][x][sample]: the fragment drawn last.
std::vector<std::size_t> last_fragments(const FramebufferSize& size, const Fragments& drawn) {
  const auto width = static_cast<std::size_t>(size.width);
  const auto samples = static_cast<std::size_t>(size.samples);
  std::vector<std::size_t> last(width * static_cast<std::size_t>(size.height) * samples,
                                kNothingDrawn);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const std::size_t at = (drawn.y[i] * width + drawn.x[i]) * samples + drawn.sample[i];
    const bool is_later = at < last.size() && (last[at] == kNothingDrawn ||
                                               drawn.triangle[last[at]] <= drawn.triangle[i]);
    if (is_later) last[at] = i;
  }
  return last;
}

}  // namespace

PictureFile picture_of(const PictureView& view, const PictureFile& layout, const Fragments& drawn) {
  PictureFile picture = layout;
  picture.values.assign(picture.value_count(), 0);
  const auto samples = static_cast<std::size_t>(view.size.samples);
  const std::vector<std::size_t> last = last_fragments(view.size, drawn);
  const auto width = static_cast<std::size_t>(view.size.width);
  for (int row = 0; row < view.size.height; ++row) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t at = (static_cast<std::size_t>(view.flipped(row)) * width + x) * samples;
      for (std::size_t c = 0; c < view.channels.size(); ++c) {
        const ShownChannel& channel = view.channels[c];
        const auto value_of = [&](std::size_t sample) {
          const std::size_t fragment = last[at + sample];
          return stored(channel.storage, fragment == kNothingDrawn
                                             ? background_number(view, c)
                                             : source_number(view, c, drawn, fragment));
        };
        float value = value_of(0);
        if (samples > 1) {
          double sum = 0;
          for (std::size_t s = 0; s < samples; ++s) {
            sum += averaged(channel.storage, view.resolve, value_of(s));
          }
          const bool is_encoded =
              view.resolve == ResolveOf::stored && channel.storage == Storage::srgb8;
          value = stored(is_encoded ? Storage::unorm8 : channel.storage,
                         sum / static_cast<double>(samples));
        }
        picture.values[(static_cast<std::size_t>(row) * width + x) * view.channels.size() + c] =
            value;
      }
    }
  }
  return picture;
}

}  // namespace rastercheck::cases
