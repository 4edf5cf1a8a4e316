#include "cases/fragment_collector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace rastercheck::cases {

FragmentCollector::FragmentCollector(const Case& c) : case_(c) {}

std::string FragmentCollector::add(const SamplePlace& at, float depth,
                                   std::span<const float> attributes) {
  const auto beyond = [](std::uint32_t index, auto count) {
    return index >= static_cast<std::uint32_t>(count);
  };
  const FramebufferSize& size = case_.framebuffer;
  if (beyond(at.triangle, case_.triangles.size())) {
    return fmt::format("triangle {} of {}", at.triangle, case_.triangles.size());
  }
  if (beyond(at.x, size.width) || beyond(at.y, size.height) || beyond(at.sample, size.samples)) {
    return fmt::format("pixel {}, {}, sample {} of {} x {} pixels, {} samples", at.x, at.y,
                       at.sample, size.width, size.height, size.samples);
  }
  if (attributes.size() != case_.attributes.size()) {
    return fmt::format("{} attributes of {}", attributes.size(), case_.attributes.size());
  }
  places_.push_back(at);
  depths_.push_back(depth);
  attributes_.insert(attributes_.end(), attributes.begin(), attributes.end());
  return {};
}

tl::expected<Fragments, std::string> FragmentCollector::take() {
  std::vector<std::size_t> order(places_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [this](std::size_t a, std::size_t b) { return places_[a] < places_[b]; });
  Fragments drawn;
  drawn.attribute_count = case_.attributes.size();
  const SamplePlace* last = nullptr;
  for (const std::size_t i : order) {
    const SamplePlace& at = places_[i];
    if (last != nullptr && *last == at) {
      return tl::unexpected(fmt::format("pixel {}, {}, sample {} has two fragments of triangle {}",
                                        at.x, at.y, at.sample, at.triangle));
    }
    last = &at;
    drawn.triangle.push_back(at.triangle);
    drawn.x.push_back(static_cast<std::uint16_t>(at.x));
    drawn.y.push_back(static_cast<std::uint16_t>(at.y));
    drawn.sample.push_back(static_cast<std::uint8_t>(at.sample));
    drawn.depth.push_back(depths_[i]);
    const float* const own = attributes_.data() + i * drawn.attribute_count;
    drawn.attributes.insert(drawn.attributes.end(), own, own + drawn.attribute_count);
  }
  return drawn;
}

}  // namespace rastercheck::cases
