#include "oracle/internal/layers.h"

#include <algorithm>

#include "oracle/internal/scene.h"

namespace rastercheck::oracle {

LayerBand::LayerBand(const SceneTruth& scene, int y0, int y1, PreparedTriangles& triangles)
    : scene_(&scene), y0_(y0), y1_(y1), triangles_(&triangles) {
  const cases::FramebufferSize& size = scene.source().framebuffer;
  covered_.resize(static_cast<std::size_t>(y1 - y0) * static_cast<std::size_t>(size.width) *
                  static_cast<std::size_t>(size.samples));
  overlaps_.resize(covered_.size());
}

void LayerBand::add(std::uint32_t triangle) {
  const PreparedTriangles::Prepared& prepared = triangles_->of(triangle);
  if (prepared.filter->is_empty()) return;
  const cases::FramebufferSize& size = scene_->source().framebuffer;
  const auto width = static_cast<std::size_t>(size.width);
  const auto samples = static_cast<std::size_t>(size.samples);
  const PixelBox& box = prepared.filter->box();
  records::LevelCounts unused;
  for (int y = std::max(y0_, box.y0); y < std::min(y1_, box.y1); ++y) {
    row_.classify(*prepared.truth, *prepared.filter, y, unused);
    row_.for_each_covered([&](int x, int s, const records::SampleVerdict&) {
      const std::size_t pixel =
          static_cast<std::size_t>(y - y0_) * width + static_cast<std::size_t>(x);
      const std::size_t sample = pixel * samples + static_cast<std::size_t>(s);
      overlaps_[sample] = overlaps_[sample] || covered_[sample];
      covered_[sample] = true;
    });
  }
}

}  // namespace rastercheck::oracle
