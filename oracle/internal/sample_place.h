#pragma once

#include <compare>
#include <cstdint>

#include "cases/framebuffer.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// A sample of a triangle; compares in the order of fragments.
struct SamplePlace {
  std::uint32_t triangle = 0;
  std::uint32_t y = 0;
  std::uint32_t x = 0;
  std::uint32_t sample = 0;
  auto operator<=>(const SamplePlace&) const = default;
};

inline SamplePlace place_of(const cases::Framebuffer& drawn, std::size_t fragment) {
  return {drawn.triangle[fragment], drawn.y[fragment], drawn.x[fragment], drawn.sample[fragment]};
}

inline SamplePlace place_of(const records::WorstError& error) {
  return {error.triangle, error.y, error.x, error.sample};
}

}  // namespace rastercheck::oracle
