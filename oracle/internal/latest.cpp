#include "oracle/internal/latest.h"

#include <algorithm>

#include "oracle/internal/scene.h"

namespace rastercheck::oracle {

LatestBand::LatestBand(const SceneTruth& scene, int y0, int y1, PreparedTriangles& triangles)
    : scene_(&scene), y0_(y0), y1_(y1), triangles_(&triangles) {
  const cases::FramebufferSize& size = scene.source().framebuffer;
  samples_.resize(static_cast<std::size_t>(y1 - y0) * static_cast<std::size_t>(size.width) *
                  static_cast<std::size_t>(size.samples));
}

void LatestBand::add(std::uint32_t triangle, records::LevelCounts& levels) {
  const PreparedTriangles::Prepared& prepared = triangles_->of(triangle);
  if (prepared.filter->is_empty()) return;
  const cases::FramebufferSize& size = scene_->source().framebuffer;
  const PixelBox& box = prepared.filter->box();
  for (int y = std::max(y0_, box.y0); y < std::min(y1_, box.y1); ++y) {
    row_.classify(*prepared.truth, *prepared.filter, y, levels);
    Sample* const samples =
        samples_.data() + static_cast<std::ptrdiff_t>(y - y0_) * size.width * size.samples;
    row_.for_each_covered([&](int x, int s, const records::SampleVerdict& decision) {
      Sample& sample = samples[x * size.samples + s];
      if (decision.verdict == records::Verdict::required) {
        sample.required = Candidate{triangle, decision};
        sample.permitted.clear();
      } else {
        sample.permitted.push_back({triangle, decision});
      }
    });
  }
}

void LatestBand::for_each_answer(const NearestBand::Take& take) {
  const cases::FramebufferSize& size = scene_->source().framebuffer;
  std::vector<Candidate> candidates;
  auto sample = samples_.begin();
  for (int y = y0_; y < y1_; ++y) {
    for (int x = 0; x < size.width; ++x) {
      for (int s = 0; s < size.samples; ++s, ++sample) {
        candidates.clear();
        if (sample->required) candidates.push_back(*sample->required);
        candidates.insert(candidates.end(), sample->permitted.begin(), sample->permitted.end());
        if (!candidates.empty()) take(y, x, s, candidates, sample->required.has_value());
      }
    }
  }
}

}  // namespace rastercheck::oracle
