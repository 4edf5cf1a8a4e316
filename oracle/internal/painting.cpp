#include "oracle/internal/painting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "oracle/internal/floating_point.h"
#include "oracle/stored_values.h"

namespace rastercheck::oracle {
namespace {

using cases::Alpha;
using cases::Blend;
using cases::Storage;

constexpr double kBeyondAll = std::numeric_limits<double>::infinity();
/// If the terms are larger than this, an intermediate sum may overflow.
constexpr double kHalfOfFloats = std::numeric_limits<float>::max() / 2.0;

bool is_integer(Storage storage) {
  return storage != Storage::float32 && storage != Storage::float16;
}

double greatest_size(const ValueSpan& span) {
  return std::max(std::abs(span.lo), std::abs(span.hi));
}

ValueSpan clamped(const ValueSpan& span) {
  if (span.is_free) return span;
  return {std::clamp(span.lo, 0.0, 1.0), std::clamp(span.hi, 0.0, 1.0), false};
}

/// Rounds to float32. Not inlined: of two such roundings side by side, GCC 12 makes none (its SLP
/// vectorizer forms double → float → double of a pair, and a later pass drops that).
[[gnu::noinline]] double to_float(double number) { return double{static_cast<float>(number)}; }

bool is_fraction(const ValueSpan& span) { return !span.is_free && span.lo >= 0 && span.hi <= 1; }

}  // namespace

ValueSpan exactly(double number) { return {number, number, false}; }

ValueSpan product_of(const ValueSpan& a, const ValueSpan& b) {
  if (a.is_free || b.is_free) return {};
  const std::array corners{a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi};
  // A product is NaN if it is 0 times infinity.
  if (std::any_of(corners.begin(), corners.end(), [](double one) { return std::isnan(one); })) {
    return {};
  }
  const auto [least, greatest] = std::minmax_element(corners.begin(), corners.end());
  const double lo = std::nextafter(*least, -kBeyondAll);
  const double hi = std::nextafter(*greatest, kBeyondAll);
  return {std::min(lo, to_float(lo)), std::max(hi, to_float(hi)), false};
}

ValueSpan mixed(const Mixture& mixture) {
  const auto& [source, alpha, held, multiplies, covers] = mixture;
  if (source.is_free || alpha.is_free || held.is_free) return {};
  const double a = greatest_size(alpha);
  const double s = greatest_size(source);
  const double d = greatest_size(held);
  const double size = (multiplies ? a : 1) * s + (covers ? 1 + a : 1) * d;
  // If the size is NaN, this comparison is false, so the result is free.
  if (!(std::max(size, s + d) < kHalfOfFloats)) return {};
  double least = kBeyondAll;
  double greatest = -kBeyondAll;
  for (const double one_alpha : {alpha.lo, alpha.hi}) {
    for (const double one_source : {source.lo, source.hi}) {
      for (const double one_held : {held.lo, held.hi}) {
        const double sum =
            (multiplies ? one_alpha : 1) * one_source + (covers ? 1 - one_alpha : 1) * one_held;
        least = std::min(least, sum);
        greatest = std::max(greatest, sum);
      }
    }
  }
  const double slack = size * 0x1p-21 + 0x1p-148;
  return {least - slack, greatest + slack, false};
}

Painting::Painting(const cases::PictureView& view) : view_(&view) {
  const DefaultFloatingPoint floating_point;
  for (std::size_t c = 0; c < view.channels.size(); ++c) {
    const cases::ShownChannel& channel = view.channels[c];
    ValueSpan background = exactly(double{channel.background});
    if (channel.shows == cases::Shown::nothing) background = {};
    if (view.is_color(c) && view.alpha == Alpha::premultiplied) {
      const ValueSpan alpha = exactly(double{view.channels[*view.alpha_channel].background});
      background = product_of(background, alpha);
    }
    background_.push_back(background);
    held_.push_back(view.is_blended(c) ? held_in(c) : background);
  }
}

/// The range of the stored background's numbers, decoded from the target's storage.
ValueSpan Painting::held_in(std::size_t channel) const {
  const ValueSpan& background = background_[channel];
  const Storage storage = view_->channels[channel].storage;
  if (background.is_free) return background;
  const StoredNumbers stored =
      values_stored_of(storage, view_->rounding, {background.lo, background.hi});
  const double least = number_of_stored(storage, stored.least);
  const double greatest = number_of_stored(storage, stored.greatest);
  const double decoding = storage == Storage::srgb8 ? 0x1p-19 : 0;
  return {least * (1 - decoding), greatest * (1 + decoding), false};
}

bool Painting::needs_alpha(std::size_t channel) const {
  return view_->is_color(channel) &&
         (view_->alpha == Alpha::premultiplied || view_->blend == Blend::over);
}

ValueSpan Painting::painted(std::size_t channel, const ValueSpan& shown,
                            const ValueSpan& alpha) const {
  if (view_->is_blended(channel)) return blended(channel, shown, alpha);
  return needs_alpha(channel) ? product_of(shown, alpha) : shown;
}

ValueSpan Painting::blended(std::size_t channel, const ValueSpan& shown,
                            const ValueSpan& alpha) const {
  const bool clamps = is_integer(view_->channels[channel].storage);
  Mixture mixture{shown, alpha, held_[channel], true, view_->blend == Blend::over};
  if (channel == view_->alpha_channel) {
    // For the alpha channel, the source is 1 · alpha.
    mixture.source = exactly(1);
    mixture.alpha = shown;
  } else if (!needs_alpha(channel)) {
    mixture.multiplies = false;
  } else if (view_->alpha == Alpha::premultiplied && clamps &&
             !(is_fraction(shown) && is_fraction(alpha))) {
    // The product is clamped, not its factors.
    mixture.source = product_of(shown, alpha);
    mixture.multiplies = false;
  }
  if (clamps) {
    mixture.source = clamped(mixture.source);
    mixture.alpha = clamped(mixture.alpha);
  }
  return mixed(mixture);
}

}  // namespace rastercheck::oracle
