#include "tests/properties/probing/own_picture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace rastercheck::properties {
namespace {

constexpr double kMostOfByte = 255;

/// Draws the fragments of a case into a picture.
class Canvas {
 public:
  Canvas(const cases::Case& c, const cases::Pipeline& pipeline, const OwnPicture& wrong,
         const cases::Fragments& fragments)
      : pipeline_(&pipeline), wrong_(&wrong), fragments_(&fragments) {
    picture_.size = c.framebuffer;
    picture_.channels = c.attributes.size();
    picture_.depth.assign(static_cast<std::size_t>(c.framebuffer.width) *
                              static_cast<std::size_t>(c.framebuffer.height) *
                              static_cast<std::size_t>(c.framebuffer.samples),
                          pipeline.clear_depth);
    held_.assign(picture_.depth.size() * picture_.channels, 0);
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      at_[{fragments.triangle[i], fragments.x[i], fragments.y[i]}] = i;
    }
  }

  cases::Picture draw() {
    std::vector<std::size_t> order(fragments_->size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return fragments_->triangle[a] < fragments_->triangle[b];
    });
    for (const std::size_t i : order) draw(i);
    if (pipeline_->resolves) resolve();
    for (const double held : held_) {
      picture_.color.push_back(static_cast<float>(is_bytes() ? held / kMostOfByte : held));
    }
    return picture_;
  }

 private:
  bool is_bytes() const { return pipeline_->format == cases::ColorFormat::rgba8; }

  double stored(double color, const std::function<double(double)>& store) const {
    const double rounded = store ? store(color) : std::nearbyint(color);
    return std::clamp(rounded, 0.0, kMostOfByte);
  }

  void draw(std::size_t i) {
    const std::size_t sample =
        (fragments_->y[i] * static_cast<std::size_t>(picture_.size.width) + fragments_->x[i]) *
            static_cast<std::size_t>(picture_.size.samples) +
        fragments_->sample[i];
    picture_.depth[sample] = fragments_->depth[i];
    std::vector<double> color;
    for (std::size_t a = 0; a < picture_.channels; ++a) {
      const double shaded = shade(i, a);
      color.push_back(is_bytes() ? std::clamp(shaded, 0.0, 1.0) : shaded);
    }
    for (std::size_t a = 0; a < picture_.channels; ++a) {
      double& held = held_[sample * picture_.channels + a];
      held = blend(color, a, held);
    }
  }

  double blend(const std::vector<double>& color, std::size_t a, double held) const {
    const double own = is_bytes() ? kMostOfByte * color[a] : color[a];
    if (pipeline_->blend == cases::Blend::off) {
      return is_bytes() ? stored(own, wrong_->store) : own;
    }
    double sum = own + held;
    if (pipeline_->blend == cases::Blend::over) {
      const double alpha = color.back();
      sum = (a + 1 == color.size() ? own : alpha * own) + (1 - alpha) * held;
    }
    if (is_bytes()) return stored(sum, wrong_->store_blended);
    return static_cast<double>(static_cast<float>(wrong_->blended ? wrong_->blended(sum) : sum));
  }

  double value(std::size_t i, std::size_t a) const {
    const float drawn = fragments_->attributes_of(i)[a];
    return static_cast<double>(wrong_->value ? wrong_->value(drawn) : drawn);
  }

  double shade(std::size_t i, std::size_t a) const {
    if (pipeline_->texturing) return look_up(value(i, 0), a);
    switch (pipeline_->shading) {
      case cases::Shading::differences_along_x:
        return difference(i, a, true);
      case cases::Shading::differences_along_y:
        return difference(i, a, false);
      default:
        return value(i, a);
    }
  }

  double look_up(double s, std::size_t channel) const {
    const cases::Texturing& texturing = *pipeline_->texturing;
    const auto texel = [&](double index) {
      const double clamped = std::clamp(index, 0.0, texturing.texture.width - 1.0);
      return texturing.texture.texels[4 * static_cast<std::size_t>(clamped) + channel] /
             kMostOfByte;
    };
    const double place = s * texturing.texture.width;
    if (texturing.filter == cases::Filter::nearest) {
      return texel(std::floor(wrong_->texel ? wrong_->texel(place) : place));
    }
    const double first = std::floor(place - 0.5);
    const double exact = place - 0.5 - first;
    const double share = wrong_->weight ? wrong_->weight(exact) : exact;
    return (1 - share) * texel(first) + share * texel(first + 1);
  }

  /// 0 if a pixel of the quad is not drawn.
  double difference(std::size_t i, std::size_t a, bool is_along_x) const {
    const std::uint32_t triangle = fragments_->triangle[i];
    const std::uint32_t x = fragments_->x[i];
    const std::uint32_t y = fragments_->y[i];
    const auto in_row = [&](std::uint32_t row) {
      double both[2] = {0, 0};
      for (std::uint32_t column = 0; column < 2; ++column) {
        const auto found = at_.find(is_along_x ? std::tuple(triangle, (x & ~1U) + column, row)
                                               : std::tuple(triangle, row, (y & ~1U) + column));
        if (found == at_.end()) return 0.0;
        both[column] = value(found->second, a);
      }
      return both[1] - both[0];
    };
    const std::uint32_t row = is_along_x ? y : x;
    const double own = in_row(row);
    return wrong_->difference ? wrong_->difference(own, in_row(row & ~1U), in_row(row | 1U)) : own;
  }

  void resolve() {
    const auto count = static_cast<std::size_t>(picture_.size.samples);
    std::vector<double> resolved;
    std::vector<float> depth;
    for (std::size_t first = 0; first < picture_.depth.size(); first += count) {
      depth.push_back(picture_.depth[first]);
      for (std::size_t a = 0; a < picture_.channels; ++a) {
        std::vector<double> samples;
        for (std::size_t k = 0; k < count; ++k) {
          samples.push_back(held_[(first + k) * picture_.channels + a]);
        }
        const double mean =
            std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(count);
        const double color = wrong_->resolve ? wrong_->resolve(samples) : mean;
        resolved.push_back(is_bytes() ? stored(color, {}) : color);
      }
    }
    held_ = std::move(resolved);
    picture_.depth = std::move(depth);
    picture_.size.samples = 1;
  }

  const cases::Pipeline* pipeline_;
  const OwnPicture* wrong_;
  const cases::Fragments* fragments_;
  cases::Picture picture_;
  std::vector<double> held_;  ///< floats, or steps of 1/255
  /// The fragment of a triangle at a pixel (x, y).
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::size_t> at_;
};

}  // namespace

Result<cases::Picture> OwnPictureBackend::draw_picture(const cases::Case& c,
                                                       const cases::Pipeline& pipeline) {
  if (refuses && refuses(c, pipeline)) {
    return tl::unexpected(Error{"", "", "not that picture", Failure::unsupported});
  }
  const Result<backends::Drawn> drawn = cpu_->draw(c);
  if (!drawn) return tl::unexpected(drawn.error());
  return Canvas(c, pipeline, wrong_, drawn->fragments).draw();
}

}  // namespace rastercheck::properties
