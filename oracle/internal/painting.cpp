#include "oracle/internal/painting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rastercheck::oracle {
namespace {

using cases::Alpha;

constexpr double kBeyondAll = std::numeric_limits<double>::infinity();

}  // namespace

ValueSpan exactly(double number) { return {number, number, false}; }

ValueSpan product_of(const ValueSpan& a, const ValueSpan& b) {
  if (a.is_free || b.is_free) return {};
  const std::array corners{a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi};
  // 0 times infinity.
  if (std::any_of(corners.begin(), corners.end(), [](double one) { return std::isnan(one); })) {
    return {};
  }
  const auto [least, greatest] = std::minmax_element(corners.begin(), corners.end());
  const double lo = std::nextafter(*least, -kBeyondAll);
  const double hi = std::nextafter(*greatest, kBeyondAll);
  return {std::min(lo, double{static_cast<float>(lo)}),
          std::max(hi, double{static_cast<float>(hi)}), false};
}

Painting::Painting(const cases::PictureView& view) : view_(&view) {
  for (std::size_t c = 0; c < view.channels.size(); ++c) {
    const cases::ShownChannel& channel = view.channels[c];
    ValueSpan background = exactly(double{channel.background});
    if (channel.shows == cases::Shown::nothing) background = {};
    if (needs_alpha(c)) {
      const auto alpha = exactly(double{view.channels[*view.alpha_channel].background});
      background = product_of(background, alpha);
    }
    background_.push_back(background);
  }
}

bool Painting::needs_alpha(std::size_t channel) const {
  return view_->is_color(channel) && view_->alpha == Alpha::premultiplied;
}

ValueSpan Painting::painted(std::size_t channel, const ValueSpan& shown,
                            const ValueSpan& alpha) const {
  return needs_alpha(channel) ? product_of(shown, alpha) : shown;
}

}  // namespace rastercheck::oracle
