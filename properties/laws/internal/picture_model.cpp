#include "properties/laws/internal/picture_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {
namespace {

constexpr double kMostByte = 255;
constexpr std::size_t kAlpha = 3;

std::size_t channels_of(const cases::Case& c, const cases::Pipeline& pipeline) {
  const bool has_colors = pipeline.shading == cases::Shading::vertex_colors;
  return has_colors ? kAlpha + 1 : c.attributes.size();
}

/// The integer nearest to x >= 0, ties to even; x must be far below 2^52.
double nearest_whole(double x) {
  const double below = std::floor(x);
  const double beyond = x - below;  // exact
  const bool is_odd = std::fmod(below, 2) == 1;
  return beyond > 0.5 || (beyond == 0.5 && is_odd) ? below + 1 : below;
}

/// Clamps to [0, 1]; NaN becomes 0.
double clamped(double value) { return value > 0 ? std::min(value, 1.0) : 0.0; }

/// The float nearest to a number.
double nearest_float(double value) { return static_cast<double>(static_cast<float>(value)); }

/// A colour's channel in the format's units: floats, or steps of 1/255.
struct Colors {
  double least = 0;
  double greatest = 0;
};

class Model {
 public:
  Model(const cases::Case& c, const cases::Pipeline& pipeline,
        const std::optional<cases::PictureBounds>& bounds)
      : pipeline_(&pipeline),
        bounds_(bounds),
        size_(c.framebuffer),
        channels_(channels_of(c, pipeline)) {
    const std::size_t samples = static_cast<std::size_t>(size_.width) *
                                static_cast<std::size_t>(size_.height) *
                                static_cast<std::size_t>(size_.samples);
    depth_.assign(samples, pipeline.clear_depth);
    held_.assign(samples * channels_, {});
    assert(pipeline.blend != cases::Blend::over || channels_ == kAlpha + 1);
    assert(!pipeline.texturing && !pipeline.discard_below);
    assert(pipeline.shading == cases::Shading::attributes ||
           (pipeline.shading == cases::Shading::vertex_colors && c.attributes.size() >= kAlpha));
  }

  void draw(const cases::Fragments& fragments, std::size_t i) {
    const bool is_inside = std::cmp_less(fragments.x[i], size_.width) &&
                           std::cmp_less(fragments.y[i], size_.height) &&
                           std::cmp_less(fragments.sample[i], size_.samples);
    if (!is_inside) return;
    const std::size_t at =
        (static_cast<std::size_t>(fragments.y[i]) * static_cast<std::size_t>(size_.width) +
         fragments.x[i]) *
            static_cast<std::size_t>(size_.samples) +
        fragments.sample[i];
    const float depth = fragments.depth[i];
    if (!passes(pipeline_->depth_function, depth, depth_[at])) return;
    if (pipeline_->writes_depth) depth_[at] = depth;
    blend(fragments.attributes_of(i), at);
  }

  PictureRange pictures() const {
    PictureRange range;
    cases::Picture& least = range.least;
    least.size = size_;
    least.channels = channels_;
    if (pipeline_->resolves) least.size.samples = 1;
    range.greatest = least;
    const auto samples = static_cast<std::size_t>(size_.samples);
    const std::size_t taken = pipeline_->resolves ? samples : 1;
    for (std::size_t first = 0; first < depth_.size(); first += taken) {
      least.depth.push_back(depth_[first]);
      for (std::size_t channel = 0; channel < channels_; ++channel) {
        const Colors colors = resolved(first, taken, channel);
        least.color.push_back(shown(colors.least));
        range.greatest.color.push_back(shown(colors.greatest));
      }
    }
    range.greatest.depth = least.depth;
    return range;
  }

 private:
  bool is_rgba8() const { return pipeline_->format == cases::ColorFormat::rgba8; }

  /// A colour's channel, as a factor in blending (incoming) or in the picture's units (in_units).
  double incoming(float color) const { return is_rgba8() ? clamped(color) : double{color}; }
  double in_units(float color) const {
    return is_rgba8() ? kMostByte * incoming(color) : incoming(color);
  }

  /// Blends a fragment's colour into the sample `at`. Colours of three channels have alpha 1.
  void blend(std::span<const float> attributes, std::size_t at) {
    const auto color = [attributes](std::size_t channel) {
      return channel < attributes.size() ? attributes[channel] : 1.0F;
    };
    const double alpha = pipeline_->blend == cases::Blend::over ? incoming(color(kAlpha)) : 0;
    for (std::size_t channel = 0; channel < channels_; ++channel) {
      Colors& held = held_[at * channels_ + channel];
      held = blended(channel, alpha, color(channel), held);
    }
  }

  Colors blended(std::size_t channel, double alpha, float color, const Colors& present) const {
    const double s = in_units(color);
    if (pipeline_->blend == cases::Blend::off) {
      // Both APIs leave open which byte a NaN becomes.
      if (bounds_ && is_rgba8() && std::isnan(color)) return {0, kMostByte};
      return is_rgba8() ? stored(s, s, bounds_ ? bounds_->byte_store : 0, 0) : Colors{s, s};
    }
    const bool is_additive = pipeline_->blend == cases::Blend::additive;
    const double drawn = is_additive || channel == kAlpha ? s : alpha * s;
    const double share = is_additive ? 1 : 1 - alpha;
    const double one = share * present.least;
    const double other = share * present.greatest;
    if (bounds_ && is_rgba8() && std::isnan(color)) return {0, kMostByte};
    return stored(drawn + std::min(one, other), drawn + std::max(one, other),
                  bounds_ ? bounds_->byte_blend : 0,
                  std::abs(drawn) + std::max(std::abs(one), std::abs(other)));
  }

  /// The range of colours from `least` to `greatest`, once they are stored: rounded to the nearest
  /// float or byte if there are no bounds, else as far off as these allow. `reach` is in steps of a
  /// byte; `size` is the summed size of a float's terms.
  Colors stored(double least, double greatest, double reach, double size) const {
    if (!is_rgba8()) {
      const double error = float_error(size);
      return {nearest_float(least - error), nearest_float(greatest + error)};
    }
    if (!bounds_) {
      return {nearest_whole(std::min(least, kMostByte)),
              nearest_whole(std::min(greatest, kMostByte))};
    }
    // The sum takes the sign from a zero.
    return {std::clamp(std::ceil(least - reach), 0.0, kMostByte) + 0.0,
            std::clamp(std::floor(greatest + reach), 0.0, kMostByte) + 0.0};
  }

  /// A driver may take numbers below the least normal float for 0.
  double float_error(double size) const {
    if (!bounds_ || bounds_->float_error == 0) return 0;
    return bounds_->float_error * 0x1p-24 * size + std::numeric_limits<float>::min();
  }

  /// The colours of `count` samples, resolved; a single sample is unchanged.
  Colors resolved(std::size_t first, std::size_t count, std::size_t channel) const {
    Colors sum = held_[first * channels_ + channel];
    if (count == 1) return sum;
    Colors all = sum;
    double size = std::max(std::abs(sum.least), std::abs(sum.greatest));
    for (std::size_t i = 1; i < count; ++i) {
      const Colors& held = held_[(first + i) * channels_ + channel];
      sum.least += held.least;
      sum.greatest += held.greatest;
      size += std::max(std::abs(held.least), std::abs(held.greatest));
      all.least = std::min(all.least, held.least);
      all.greatest = std::max(all.greatest, held.greatest);
    }
    if (bounds_ && !bounds_->resolves_to_mean) return all;
    const auto n = static_cast<double>(count);
    return stored(sum.least / n, sum.greatest / n, bounds_ ? bounds_->byte_mean : 0, size / n);
  }

  float shown(double held) const {
    return static_cast<float>(is_rgba8() ? held / kMostByte : held);
  }

  const cases::Pipeline* pipeline_;
  std::optional<cases::PictureBounds> bounds_;
  cases::FramebufferSize size_;
  std::size_t channels_;
  std::vector<float> depth_;  ///< [y][x][sample]
  std::vector<Colors> held_;  ///< [y][x][sample][channel]
};

}  // namespace

bool passes(cases::DepthFunction function, float depth, float present) {
  using cases::DepthFunction;
  switch (function) {
    case DepthFunction::always:
      return true;
    case DepthFunction::never:
      return false;
    case DepthFunction::less:
      return depth < present;
    case DepthFunction::equal:
      return depth == present;
    case DepthFunction::less_or_equal:
      return depth <= present;
    case DepthFunction::greater:
      return depth > present;
    case DepthFunction::not_equal:
      return depth != present;
    case DepthFunction::greater_or_equal:
      break;
  }
  return depth >= present;
}

bool PictureRange::has_color(std::size_t index, float drawn) const {
  const float from = least.color[index];
  const float to = greatest.color[index];
  if (from == to || (std::isnan(from) && std::isnan(to))) return is_same(drawn, from);
  if (!std::isfinite(from) || !std::isfinite(to)) return true;
  return from <= drawn && drawn <= to;
}

cases::Picture picture_of(const cases::Case& c, const cases::Fragments& fragments,
                          const cases::Pipeline& pipeline) {
  return range_of(c, fragments, pipeline, std::nullopt).least;
}

PictureRange range_of(const cases::Case& c, const cases::Fragments& fragments,
                      const cases::Pipeline& pipeline,
                      const std::optional<cases::PictureBounds>& bounds) {
  std::vector<std::size_t> order(fragments.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&fragments](std::size_t a, std::size_t b) {
    return fragments.triangle[a] < fragments.triangle[b];
  });
  Model model(c, pipeline, bounds);
  for (const std::size_t i : order) model.draw(fragments, i);
  return model.pictures();
}

}  // namespace rastercheck::properties
