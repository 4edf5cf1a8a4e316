#pragma once

#include <array>
#include <string_view>

#include "cases/names.h"

namespace rastercheck::records {

/// The rules' answer for a sample and a triangle (RULES §2): must be drawn, must not be drawn, or
/// may be either. A fourth answer does not exist.
enum class Verdict { required, forbidden, permitted };

/// The reason for a verdict.
enum class Reason {
  inside,     ///< required: strictly inside every edge
  tie,        ///< on an edge or clip-distance boundary, decided by (or left open by) the tie rule
  snapping,   ///< permitted: inside only for some placements of the snapped vertices
  clip_edge,  ///< permitted: within the clip tolerance of a clip edge or of an edge that was cut,
              ///< or on the far border of the viewport
  nonpositive_w,  ///< permitted: as `clip_edge`, for a triangle cut because some w <= 0
  depth,          ///< permitted: which of several fragments is nearest is left open
  not_promised,   ///< permitted: the contract promises nothing about the triangle
  outside,        ///< forbidden: beyond an edge, or on an edge that does not own the sample
  clipped,        ///< forbidden: beyond a clip plane or a clip distance
  viewport,       ///< forbidden: outside the viewport, scissor or framebuffer; permitted: inside
                  ///< only some of the viewports that the contract allows
  culled,         ///< forbidden: the triangle faces the wrong way
  degenerate,     ///< forbidden: the triangle is seen edge-on or has no area; permitted: nothing
                  ///< says whether such a triangle covers the pixel
  conservative,   ///< permitted: within the error of conservative coverage
};

/// The answer for one sample.
struct SampleVerdict {
  Verdict verdict = Verdict::forbidden;
  Reason reason = Reason::outside;
};

/// The names in JSON output and tables.
constexpr auto names_of(Verdict /*type*/) {
  return std::to_array<std::string_view>({"required", "forbidden", "permitted"});
}
constexpr auto names_of(Reason /*type*/) {
  return std::to_array<std::string_view>({"inside", "tie", "snapping", "clip edge", "w <= 0",
                                          "depth", "not promised", "outside", "clipped", "viewport",
                                          "culled", "degenerate", "conservative"});
}
constexpr std::string_view to_string(Verdict verdict) { return cases::name_of(verdict); }
constexpr std::string_view to_string(Reason reason) { return cases::name_of(reason); }

}  // namespace rastercheck::records
