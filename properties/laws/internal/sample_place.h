#pragma once

// Samples of a framebuffer, regardless of the triangle drawn there.

#include <cstddef>
#include <map>

#include "cases/fragments.h"
#include "cases/sample_place.h"

namespace rastercheck::properties {

/// The same sample with triangle 0.
inline cases::SamplePlace sample_of(cases::SamplePlace place) {
  place.triangle = 0;
  return place;
}

/// The index of the fragment at each sample (sample_of); the first one if a sample has several.
inline std::map<cases::SamplePlace, std::size_t> fragments_by_sample(
    const cases::Fragments& drawn) {
  std::map<cases::SamplePlace, std::size_t> left;
  for (std::size_t i = 0; i < drawn.size(); ++i) left.emplace(sample_of(drawn.place_of(i)), i);
  return left;
}

}  // namespace rastercheck::properties
