#pragma once

// The limits of a context, queried once, and a check of cases against them.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "backends/size_range.h"
#include "cases/capabilities.h"
#include "cases/case.h"
#include "cases/picture.h"

namespace rastercheck::backends::gl {

struct Capabilities {
  std::string api;  ///< "OpenGL 3.3", for messages such as "OpenGL 3.3 has no ..."
  bool is_es = false;
  int version = 33;  ///< 10 · major + minor
  bool has_clip_control = false;
  bool has_provoking_vertex = false;
  bool has_depth_clamp = false;
  bool has_bias_clamp = false;
  /// Depth images of 16 and 24 bits, whose number of bits the context tells.
  bool has_unorm_depth = false;
  bool has_noperspective = false;
  bool has_sample_qualifier = false;  ///< the `sample` qualifier and interpolateAtOffset()
  bool has_sample_targets = false;    ///< arrays of multisampled images
  bool has_fine_derivatives = false;  ///< dFdxFine() and dFdyFine()
  bool has_float_blend = false;       ///< blending into float32 targets
  bool has_viewport_fractions = false;
  bool has_appending = false;      ///< storage buffers for fragments, and targets without images
  bool clears_beyond_one = false;  ///< clears float depth to values above 1
  int subpixel_bits = 4;
  int viewport_subpixel_bits = 0;
  /// Either 8 or 0. To keep programs few, all of them declare all eight; distances that are not
  /// enabled do not clip.
  int max_clip_distances = 0;
  int max_draw_buffers = 4;
  int max_size = 2048;  ///< of a target, in pixels
  int max_layers = 256;
  int max_samples = 1;
  std::vector<int> sample_counts{1};       ///< up to max_samples, if the context lists them
  std::size_t max_storage = 0;             ///< bytes of a storage buffer
  std::array<float, 2> viewport_bounds{};  ///< pixels; inclusive, for x and y
  std::array<int, 2> max_viewport{};       ///< pixels
  SizeRange line_widths;                   ///< of targets with one sample, rounded to integers
  SizeRange multisampled_line_widths;
  SizeRange point_sizes;

  /// The number of four-float vectors that the clip distances of one vertex take.
  std::size_t clip_vectors() const { return static_cast<std::size_t>(max_clip_distances) / 4; }
};

/// Reads the limits of the current context, which must be at least OpenGL 3.3 or OpenGL ES 3.0.
Capabilities read_capabilities();

/// The cases that a context draws, insofar as its limits show this.
cases::Capabilities drawable(const Capabilities& has);

/// Names the feature of a case that the context lacks; empty if it lacks none. Only a drawing shows
/// how many samples the context really gives, and where they are.
std::string lacks(const Capabilities& has, const cases::Case& c);

/// Names the feature of a picture's pipeline that the context lacks; empty if it lacks none. The
/// picture has `channels` channels.
std::string lacks(const Capabilities& has, const cases::Case& c, const cases::Pipeline& pipeline,
                  std::size_t channels);

}  // namespace rastercheck::backends::gl
