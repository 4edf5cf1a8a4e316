#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "backends/size_range.h"
#include "cases/capabilities.h"
#include "cases/case.h"
#include "cases/picture.h"

namespace rastercheck::backends::vulkan {

/// The limits of a device that matter for cases. Sizes and bounds are inclusive.
struct Limits {
  int max_width = 0;           ///< of a framebuffer, pixels
  int max_height = 0;          ///< pixels
  unsigned sample_counts = 1;  ///< bit mask; the bit for n samples has the value n
  bool standard_sample_locations = false;
  std::array<float, 2> max_viewport{};     ///< width and height, pixels
  std::array<float, 2> viewport_bounds{};  ///< least and greatest x and y of a viewport's sides
  int viewport_subpixel_bits = 0;
  int subpixel_bits = 4;
  int subtexel_bits = 4;
  int clip_distances = 0;
  bool sample_rate_shading = false;
  bool depth_clamp = false;
  bool depth_bias_clamp = false;
  /// Bit masks like `sample_counts`, of depth images of 16 and 24 bits; 0: there are none.
  unsigned unorm16_samples = 0;
  unsigned unorm24_samples = 0;
  bool depth_clip_control = false;  ///< clip depth from −w to w
  bool provoking_vertex_last = false;
  bool fragment_stores = false;  ///< fragment shaders can write to storage buffers
  std::size_t max_storage = 0;   ///< bytes of a storage buffer
  int slots = 3;                 ///< slots that one draw can write (slots.h)
  bool float_blending = false;   ///< blends colours of float32
  unsigned byte_samples = 1;     ///< bit mask like `sample_counts`, of images with bytes as colours
  int max_texture = 0;           ///< width and height of a texture, texels
  SizeRange line_widths;         ///< 1 alone without wideLines
  SizeRange point_sizes;         ///< 1 alone without largePoints
  bool strict_lines = false;     ///< lines of the default mode are rectangles, else parallelograms
  bool rectangular_lines = false;
  bool bresenham_lines = false;
};

/// The cases that a device can draw.
cases::Capabilities drawable(const Limits& limits);

/// Names the feature of a case that the device lacks; empty if it lacks none.
std::string lacks(const Limits& limits, const cases::Case& c);
/// Names what a pipeline for a picture needs beyond that and the device lacks; empty if it lacks
/// nothing.
std::string lacks_for_picture(const Limits& limits, const cases::Case& c,
                              const cases::Pipeline& pipeline);

}  // namespace rastercheck::backends::vulkan
