#pragma once

// What a context can draw of cases: its limits, asked once, and which cases are beyond these.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "cases/capabilities.h"
#include "cases/case.h"

namespace rastercheck::backends::gl {

struct Capabilities {
  std::string api;  ///< "OpenGL 3.3", as in "OpenGL 3.3 has no ..."
  bool is_es = false;
  int version = 33;  ///< 10 · major + minor
  bool has_clip_control = false;
  bool has_provoking_vertex = false;
  bool has_depth_clamp = false;
  bool has_noperspective = false;
  bool has_sample_qualifier = false;  ///< and interpolateAtOffset()
  bool has_sample_targets = false;    ///< multisampled arrays
  bool has_viewport_fractions = false;
  bool has_appending = false;      ///< storage buffers for fragments, targets without images
  bool clears_beyond_one = false;  ///< float depth, to a value above 1
  int subpixel_bits = 4;
  int viewport_subpixel_bits = 0;
  /// Eight or none. Programs are to be few, and so have all of them; what is not enabled does not
  /// clip.
  int max_clip_distances = 0;
  int max_draw_buffers = 4;
  int max_size = 2048;  ///< of a target, in pixels
  int max_layers = 256;
  int max_samples = 1;
  std::vector<int> sample_counts{1};       ///< those up to it, as far as the context says which
  std::size_t max_storage = 0;             ///< of a storage buffer, bytes
  std::array<float, 2> viewport_bounds{};  ///< pixels, inclusive, of x and y
  std::array<int, 2> max_viewport{};       ///< pixels

  /// Vectors of four floats that clip distances take in a vertex.
  std::size_t clip_vectors() const { return static_cast<std::size_t>(max_clip_distances) / 4; }
};

/// Of the context that is current, which is at least OpenGL 3.3 or OpenGL ES 3.0.
Capabilities read_capabilities();

/// Which cases a context draws, as far as it can say.
cases::Capabilities drawable(const Capabilities& has);

/// What of a case a context lacks, in words; empty where it lacks nothing. How many samples it
/// really gives, and where these are, is to be seen when it draws.
std::string lacks(const Capabilities& has, const cases::Case& c);

}  // namespace rastercheck::backends::gl
