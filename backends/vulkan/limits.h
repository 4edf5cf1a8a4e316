#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "cases/capabilities.h"
#include "cases/case.h"

namespace rastercheck::backends::vulkan {

/// What a device can do, as far as cases depend on it. Sizes and bounds inclusive.
struct Limits {
  int max_width = 0;           ///< of a framebuffer, pixels
  int max_height = 0;          ///< pixels
  unsigned sample_counts = 1;  ///< one bit for each count, at the count's own value
  bool standard_sample_locations = false;
  std::array<float, 2> max_viewport{};     ///< width and height, pixels
  std::array<float, 2> viewport_bounds{};  ///< least and greatest x and y of a viewport's borders
  int viewport_subpixel_bits = 0;
  int subpixel_bits = 4;
  int clip_distances = 0;
  bool sample_rate_shading = false;
  bool depth_clamp = false;
  bool depth_clip_control = false;  ///< clip depth −w…w
  bool provoking_vertex_last = false;
  bool fragment_stores = false;  ///< fragment shaders write to storage buffers
  std::size_t max_storage = 0;   ///< of a storage buffer, bytes
  int slots = 3;                 ///< that one drawing can write (slots.h)
};

/// Which cases a device draws.
cases::Capabilities drawable(const Limits& limits);

/// What of a case a device lacks, in words; empty where it draws it.
std::string lacks(const Limits& limits, const cases::Case& c);

}  // namespace rastercheck::backends::vulkan
