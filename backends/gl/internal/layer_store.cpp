#include "backends/gl/internal/layer_store.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace rastercheck::backends::gl {

Result<Layers*> LayerStore::get(const LayerShape& shape) {
  constexpr std::size_t kMostKept = 4;
  const auto found = std::find_if(recent_.begin(), recent_.end(),
                                  [&](const Layers& layers) { return layers.shape() == shape; });
  if (found != recent_.end()) {
    recent_.splice(recent_.end(), recent_, found);
    return &recent_.back();
  }
  if (recent_.size() == kMostKept) recent_.pop_front();
  Result<Layers> made = Layers::create(*has_, copies_, shape);
  if (!made) return tl::unexpected(made.error());
  recent_.push_back(*std::move(made));
  return &recent_.back();
}

Result<std::vector<std::size_t>> LayerStore::sample_order(const LayerShape& shape) {
  const int samples = shape.size.samples;
  if (const auto known = sample_orders_.find(samples); known != sample_orders_.end()) {
    return known->second;
  }
  const Result<Layers*> layers = get(shape);
  if (!layers) return tl::unexpected(layers.error());
  Result<std::vector<std::size_t>> order = (*layers)->sample_order();
  if (order) sample_orders_[samples] = *order;
  return order;
}

Result<DepthReading> LayerStore::depth_reading(const cases::Case& c) {
  const int bits = cases::unorm_bits(c.depth_format);
  const int samples = c.framebuffer.samples;
  if (bits == 0 || (samples == 1 && !has_->is_es)) return DepthReading{bits, std::nullopt};
  const auto [known, is_new] = fetches_.try_emplace({bits, samples});
  if (is_new) {
    const std::vector<std::uint32_t> depths = telling_depths(bits);
    const Result<Layers*> layers =
        get({{1, 1, samples}, static_cast<int>(depths.size()), 0, c.depth_format});
    if (!layers) {
      fetches_.erase(known);
      return tl::unexpected(layers.error());
    }
    LayerContent content;
    std::vector<float> fetched;
    fetched.reserve(depths.size());
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const GLfloat cleared = unorm_depth(depths[i], bits);
      glBindFramebuffer(GL_FRAMEBUFFER, (*layers)->framebuffer(i));
      glDisable(GL_SCISSOR_TEST);
      glDepthMask(GL_TRUE);
      glClearBufferfv(GL_DEPTH, 0, &cleared);
      if (auto read = (*layers)->read(i, {}, content); !read) return tl::unexpected(read.error());
      fetched.push_back(content.depth[0]);
    }
    known->second = fetch_of(fetched, bits);
  }
  if (known->second) return DepthReading{bits, known->second};
  return unsupported(fmt::format("its shaders do not fetch depths of {} bits exactly", bits));
}

}  // namespace rastercheck::backends::gl
