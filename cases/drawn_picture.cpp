#include "cases/drawn_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

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

/// Returns the number that enters the mean over a pixel's samples.
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

/// Returns the number that a fragment contributes to a channel. Premultiplied colours are
/// multiplied by the fragment's alpha.
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

/// Each sample's fragments, the last one drawn first.
struct Stacks {
  std::vector<std::size_t> top;    ///< [y][x][sample]
  std::vector<std::size_t> below;  ///< [fragment]
};

Stacks stacks_of(const FramebufferSize& size, const Fragments& drawn) {
  const auto width = static_cast<std::size_t>(size.width);
  const auto samples = static_cast<std::size_t>(size.samples);
  std::vector<std::size_t> order(drawn.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto is_earlier = [&drawn](std::size_t a, std::size_t b) {
    return drawn.triangle[a] < drawn.triangle[b];
  };
  if (!std::is_sorted(order.begin(), order.end(), is_earlier)) {
    std::stable_sort(order.begin(), order.end(), is_earlier);
  }
  Stacks stacks;
  stacks.top.assign(width * static_cast<std::size_t>(size.height) * samples, kNothingDrawn);
  stacks.below.assign(drawn.size(), kNothingDrawn);
  for (const std::size_t i : order) {
    const std::size_t at = (drawn.y[i] * width + drawn.x[i]) * samples + drawn.sample[i];
    if (at >= stacks.top.size()) continue;
    stacks.below[i] = stacks.top[at];
    stacks.top[at] = i;
  }
  return stacks;
}

/// Draws fragments into the samples of a picture, as a plain program does.
class Painter {
 public:
  Painter(const PictureView& view, const Fragments& drawn)
      : view_(&view), drawn_(&drawn), stacks_(stacks_of(view.size, drawn)) {}

  /// The stored value of a sample's channel after all its fragments.
  float value_of(std::size_t sample, std::size_t channel) const {
    const Storage storage = view_->channels[channel].storage;
    const std::size_t last = stacks_.top[sample];
    const float background = stored(storage, background_number(*view_, channel));
    if (last == kNothingDrawn) return background;
    if (!view_->is_blended(channel)) {
      return stored(storage, source_number(*view_, channel, *drawn_, last));
    }
    std::vector<std::size_t> layers;
    for (std::size_t i = last; i != kNothingDrawn; i = stacks_.below[i]) layers.push_back(i);
    float value = background;
    std::reverse(layers.begin(), layers.end());
    for (const std::size_t layer : layers) {
      value = stored(storage, blended(channel, layer, averaged(storage, ResolveOf::linear, value)));
    }
    return value;
  }

 private:
  /// Integer channels (unorm and sRGB) stand for numbers from 0 to 1, so numbers are clamped before
  /// they are blended.
  double held(std::size_t channel, double number) const {
    const Storage storage = view_->channels[channel].storage;
    const bool is_float = storage == Storage::float32 || storage == Storage::float16;
    return is_float ? number : std::clamp(number, 0.0, 1.0);
  }

  double blended(std::size_t channel, std::size_t fragment, double target) const {
    const double source = held(channel, source_number(*view_, channel, *drawn_, fragment));
    if (view_->blend == Blend::additive) return source + target;
    const std::size_t alpha_channel = *view_->alpha_channel;
    const double alpha =
        held(channel, shown_number(view_->channels[alpha_channel], *drawn_, fragment));
    const bool is_complete = view_->alpha == Alpha::premultiplied || channel == alpha_channel;
    return (is_complete ? source : alpha * source) + (1 - alpha) * target;
  }

  const PictureView* view_;
  const Fragments* drawn_;
  Stacks stacks_;
};

}  // namespace

PictureFile picture_of(const PictureView& view, const PictureFile& layout, const Fragments& drawn) {
  PictureFile picture = layout;
  picture.values.assign(picture.value_count(), 0);
  const auto samples = static_cast<std::size_t>(view.size.samples);
  const Painter painter(view, drawn);
  const auto width = static_cast<std::size_t>(view.size.width);
  for (int row = 0; row < view.size.height; ++row) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t at = (static_cast<std::size_t>(view.flipped(row)) * width + x) * samples;
      for (std::size_t c = 0; c < view.channels.size(); ++c) {
        const ShownChannel& channel = view.channels[c];
        float value = painter.value_of(at, c);
        if (samples > 1) {
          double sum = 0;
          for (std::size_t s = 0; s < samples; ++s) {
            sum += averaged(channel.storage, view.resolve, painter.value_of(at + s, c));
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
