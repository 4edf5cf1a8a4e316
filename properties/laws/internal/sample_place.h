#pragma once

// Samples of a framebuffer, whatever triangle is drawn there.

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>

#include "cases/framebuffer.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {

/// y, x, sample.
using SamplePlace = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;

inline SamplePlace sample_of(const FragmentPlace& place) {
  return {place.y, place.x, place.sample};
}

/// The fragment that is left at each sample; of several, the first.
inline std::map<SamplePlace, std::size_t> fragments_by_sample(const cases::Framebuffer& drawn) {
  std::map<SamplePlace, std::size_t> left;
  for (std::size_t i = 0; i < drawn.size(); ++i) left.emplace(sample_of(place_of(drawn, i)), i);
  return left;
}

}  // namespace rastercheck::properties
