#pragma once

// Which cases a backend draws: what random cases are made for. A backend draws a case with none of
// the features that it lacks, within these numbers.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/names.h"

namespace rastercheck::cases {

/// Lists what a case may need besides rules, sizes and numbers.
enum class Feature {
  nonpositive_w,       ///< a triangle's vertex with w <= 0
  depth_clipping,      ///< a vertex beyond the near or far plane, without depth clamp
  side_clipping,       ///< a triangle's vertex beyond the viewport's sides, or behind the eye
  clip_distances,      ///< any
  depth_clamp,         ///< of cases by other rules than D3D's, too
  depth_range,         ///< any but 0 to 1
  depth_test,          ///< any but none
  depth_clear,         ///< a depth buffer that has to begin with anything but 1
  viewport,            ///< any but the whole framebuffer
  viewport_fractions,  ///< sides between pixels
  scissor,             ///< any
  culling,             ///< of either side
  smooth,              ///< attributes of that interpolation
  noperspective,       ///< likewise
  flat,                ///< likewise
  center,              ///< attributes at the centre of pixels of several samples
  centroid,            ///< at their centroid
};
constexpr auto names_of(Feature /*type*/) {
  return std::to_array<std::string_view>(
      {"nonpositive_w", "depth_clipping", "side_clipping", "clip_distances", "depth_clamp",
       "depth_range", "depth_test", "depth_clear", "viewport", "viewport_fractions", "scissor",
       "culling", "smooth", "noperspective", "flat", "center", "centroid"});
}
inline constexpr std::size_t kFeatures = 17;
/// For readers: "vertices with w <= 0".
std::string_view to_string(Feature feature);
/// "D3D's rules".
std::string_view words_for(Rules rules);

/// Whether a case without a camera needs it; of one with a camera, whose clip positions are
/// nobody's yet, nothing is said of positions.
bool needs(const Case& c, Feature feature);

struct Capabilities {
  std::vector<Rules> rules{Rules::opengl, Rules::vulkan, Rules::d3d};  ///< in this order
  std::vector<int> sample_counts{1, 2, 4, 8, 16};                      ///< likewise
  std::vector<Feature> lacks = {};  ///< in the enumeration's order, each once
  int max_size = kMaxSize;          ///< of a framebuffer's width and height, pixels
  int max_viewport = kMaxSize;      ///< of a viewport's, pixels
  std::size_t max_attributes = kMaxAttributes;
  std::size_t max_clip_distances = kMaxClipDistances;
  /// Magnitudes of positions, clip distances, attributes and the depth range; nothing is promised
  /// of others.
  MagnitudeRange numbers;
  bool operator==(const Capabilities&) const = default;

  bool is_everything() const { return *this == Capabilities(); }
  bool has(Feature feature) const;
};

/// Names the first thing in a case that is beyond these, for readers; empty if nothing is. It does
/// not look at numbers: what nothing is promised of may be drawn all the same.
std::string lacked_by(const Capabilities& capabilities, const Case& c);

/// Whether its members are such as they may be, and there are cases within them.
bool has_meaning(const Capabilities& capabilities);

}  // namespace rastercheck::cases
