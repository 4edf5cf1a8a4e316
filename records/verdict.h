#pragma once

#include <string_view>

namespace rastercheck::records {

/// What the rules say of a sample and a triangle (RULES §2): it has to be drawn, must not be drawn,
/// or either is right. There is no fourth answer.
enum class Verdict { required, forbidden, permitted };

/// Why a verdict is what it is.
enum class Reason {
  inside,     ///< required: strictly inside every edge
  tie,        ///< on an edge or clip-distance boundary, decided by (or left open by) the tie rule
  snapping,   ///< permitted: inside for some placements of the snapped vertices only
  clip_edge,  ///< permitted: within the clip tolerance of a clip edge or of an edge that was cut,
              ///< or on the far border of the viewport
  nonpositive_w,  ///< permitted: the same, of a triangle cut because some w <= 0
  depth,          ///< permitted: which of several fragments is nearest is left open
  outside,        ///< forbidden: beyond an edge
  clipped,        ///< forbidden: beyond a clip plane or a clip distance
  viewport,       ///< forbidden: outside the viewport, scissor or framebuffer
  culled,         ///< forbidden: the triangle faces the wrong way
  degenerate,     ///< forbidden: the triangle is seen edge-on or has no area
};

/// The answer for one sample.
struct SampleVerdict {
  Verdict verdict = Verdict::forbidden;
  Reason reason = Reason::outside;
};

/// The words that JSON output and tables use: "required", "tie", "clip edge", "w <= 0", …
std::string_view to_string(Verdict verdict);
std::string_view to_string(Reason reason);

}  // namespace rastercheck::records
