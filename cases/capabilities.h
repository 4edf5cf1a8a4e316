#pragma once

// The cases that a backend can draw; random cases are generated within these capabilities. A
// backend draws every case that stays within these limits and needs none of the features that the
// backend lacks.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/names.h"

namespace rastercheck::cases {

/// A feature that a case may need besides rules, primitives, sizes and numbers.
enum class Feature {
  nonpositive_w,       ///< a triangle's vertex with w <= 0
  depth_clipping,      ///< a vertex beyond the near or far plane, without depth clamp
  side_clipping,       ///< a triangle's vertex beyond the viewport's sides, or behind the eye
  clip_distances,      ///< user clip distances
  depth_clamp,         ///< depth clamp, under any rules, not only D3D's
  depth_range,         ///< a depth range other than 0 to 1
  depth_test,          ///< a depth test other than `none`
  depth_clear,         ///< a depth buffer whose initial value is not 1
  depth_bias,          ///< something added to depths
  unorm_depth,         ///< depths stored in a unorm format
  viewport,            ///< a viewport other than the whole framebuffer
  viewport_fractions,  ///< viewport sides between pixels
  scissor,             ///< a scissor
  culling,             ///< culling of front or back faces
  smooth,              ///< attributes with this interpolation
  noperspective,       ///< attributes with this interpolation
  flat,                ///< attributes with this interpolation
  center,              ///< attributes at the centre of pixels with several samples
  centroid,            ///< likewise, at the centroid
};
constexpr auto names_of(Feature /*type*/) {
  return std::to_array<std::string_view>({"nonpositive_w", "depth_clipping", "side_clipping",
                                          "clip_distances", "depth_clamp", "depth_range",
                                          "depth_test", "depth_clear", "depth_bias", "unorm_depth",
                                          "viewport", "viewport_fractions", "scissor", "culling",
                                          "smooth", "noperspective", "flat", "center", "centroid"});
}
inline constexpr std::size_t kFeatures = 19;
/// For readers: "vertices with w <= 0".
std::string_view to_string(Feature feature);
/// For readers: "D3D's rules".
std::string_view words_for(Rules rules);

/// True if a case needs the feature. Ignores the positions of a case with a camera, because its
/// clip positions depend on the backend.
bool needs(const Case& c, Feature feature);

struct Capabilities {
  std::vector<Rules> rules{Rules::opengl, Rules::vulkan, Rules::d3d};  ///< in this order
  std::vector<int> sample_counts{1, 2, 4, 8, 16};                      ///< in this order
  std::vector<Primitive> primitives{Primitive::triangles};  ///< in the enumeration's order
  std::vector<Feature> lacks = {};  ///< in the enumeration's order, each once
  int max_size = kMaxSize;          ///< largest width and height of a framebuffer, pixels
  int size_multiple = 1;            ///< width and height of a framebuffer are multiples of this
  int max_viewport = kMaxSize;      ///< largest width and height of a viewport, pixels
  std::size_t max_attributes = kMaxAttributes;
  std::size_t max_clip_distances = kMaxClipDistances;
  /// Magnitudes of positions, clip distances, attributes and the depth range; nothing is promised
  /// about other magnitudes.
  MagnitudeRange numbers;
  bool operator==(const Capabilities&) const = default;

  /// True if nothing limits cases of triangles.
  bool is_everything() const;
  bool has(Feature feature) const;
  /// True if `primitives` has this one.
  bool draws(Primitive primitive) const;
};

/// Names the first thing in a case that exceeds the capabilities, for readers; empty if nothing
/// does. Ignores `numbers`, because a backend may draw numbers that it promises nothing about.
std::string lacked_by(const Capabilities& capabilities, const Case& c);

/// True if the members have valid values and at least one case fits them.
bool has_meaning(const Capabilities& capabilities);

}  // namespace rastercheck::cases
