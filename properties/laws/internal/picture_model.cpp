#include "properties/laws/internal/picture_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

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

class Model {
 public:
  Model(const cases::Case& c, const cases::Pipeline& pipeline)
      : pipeline_(&pipeline), size_(c.framebuffer), channels_(channels_of(c, pipeline)) {
    const std::size_t samples = static_cast<std::size_t>(size_.width) *
                                static_cast<std::size_t>(size_.height) *
                                static_cast<std::size_t>(size_.samples);
    depth_.assign(samples, pipeline.clear_depth);
    held_.assign(samples * channels_, 0.0);
    assert(pipeline.blend != cases::Blend::over || channels_ == kAlpha + 1);
    assert(!pipeline.texturing);
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

  cases::Picture picture() const {
    cases::Picture picture;
    picture.size = size_;
    picture.channels = channels_;
    if (pipeline_->resolves) picture.size.samples = 1;
    const auto samples = static_cast<std::size_t>(size_.samples);
    const std::size_t taken = pipeline_->resolves ? samples : 1;
    for (std::size_t first = 0; first < depth_.size(); first += taken) {
      picture.depth.push_back(depth_[first]);
      for (std::size_t channel = 0; channel < channels_; ++channel) {
        picture.color.push_back(shown(mean(first, taken, channel)));
      }
    }
    return picture;
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
      double& held = held_[at * channels_ + channel];
      held = stored(blended(channel, alpha, in_units(color(channel)), held));
    }
  }

  double blended(std::size_t channel, double alpha, double s, double present) const {
    if (pipeline_->blend == cases::Blend::off) return s;
    if (pipeline_->blend == cases::Blend::additive) return s + present;
    const double drawn = channel == kAlpha ? s : alpha * s;
    const double left = (1 - alpha) * present;
    return drawn + left;
  }

  /// A colour rounded to the picture's format: to a float, or to a byte as an integer.
  double stored(double color) const {
    if (is_rgba8()) return nearest_whole(std::min(color, kMostByte));
    return static_cast<double>(static_cast<float>(color));
  }

  /// The mean of `count` samples, rounded to the picture's format; a single sample is unchanged.
  double mean(std::size_t first, std::size_t count, std::size_t channel) const {
    if (count == 1) return held_[first * channels_ + channel];
    double sum = held_[first * channels_ + channel];
    for (std::size_t i = 1; i < count; ++i) sum += held_[(first + i) * channels_ + channel];
    const double quotient = sum / static_cast<double>(count);
    return is_rgba8() ? nearest_whole(quotient) : static_cast<double>(static_cast<float>(quotient));
  }

  float shown(double held) const {
    return static_cast<float>(is_rgba8() ? held / kMostByte : held);
  }

  const cases::Pipeline* pipeline_;
  cases::FramebufferSize size_;
  std::size_t channels_;
  std::vector<float> depth_;  ///< [y][x][sample]
  std::vector<double> held_;  ///< [y][x][sample][channel]: floats, or bytes
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

cases::Picture picture_of(const cases::Case& c, const cases::Fragments& fragments,
                          const cases::Pipeline& pipeline) {
  std::vector<std::size_t> order(fragments.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&fragments](std::size_t a, std::size_t b) {
    return fragments.triangle[a] < fragments.triangle[b];
  });
  Model model(c, pipeline);
  for (const std::size_t i : order) model.draw(fragments, i);
  return model.picture();
}

}  // namespace rastercheck::properties
