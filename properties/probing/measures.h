#pragma once

// The measures of a probe; each builds on the ones before it and adds its results to the subject's
// rows and terms.

#include <map>
#include <optional>
#include <vector>

#include "cases/coverage.h"
#include "properties/probing/grid.h"
#include "properties/probing/subject.h"

namespace rastercheck::properties {

/// The range of k − d (2^b − 1) over depths d that are stored as k in a unorm format of b bits.
struct StoredError {
  double least = 0;
  double greatest = 0;
};

/// Returns the k whose depth k/(2^bits − 1) a backend hands over as the nearest float32; empty if
/// `depth` is no such float32.
std::optional<std::uint32_t> number_of_depth(float depth, int bits);

/// Results that later measures need.
struct Sight {
  GridFit fit;
  std::vector<FineDrawing> drawings;  ///< from which the grid was measured
  /// True if whole pixels are covered, as declared: no grid and no ties are measured then.
  bool is_conservative = false;
  /// True if the backend rounds to the grid that a case asks for. Grid-dependent measures then use
  /// a grid of kAskedBits.
  bool follows_coverage = false;
  /// The error of stored depths, by unorm format, for the formats that were drawn.
  std::map<cases::DepthFormat, StoredError> stored;
};

/// Bits of the grid that the probe asks for in its measures, if the backend rounds to the grid that
/// a case asks for. To find out whether it does, the probe asks for one bit less.
inline constexpr int kAskedBits = 8;

/// Measures the subpixel grid, its rounding, and remaining position errors.
void measure_grid(Subject& subject, Sight& sight);
/// Measures who owns samples on edges.
void measure_ties(Subject& subject, const Sight& sight);
/// Measures from which positions (snapped or not) attributes, depth and facing are computed.
void measure_basis(Subject& subject, const Sight& sight);
/// Measures the arithmetic by which values are evaluated.
void measure_evaluation(Subject& subject);
/// Measures how triangles are cut by the near and far planes and by w = 0.
void measure_clipping(Subject& subject);
/// Measures how far out vertices may lie.
void measure_reach(Subject& subject);
/// Measures which of two fragments a depth test keeps.
void measure_depth_test(Subject& subject);
/// Measures how depths are rounded to unorm formats.
void measure_depth_store(Subject& subject, Sight& sight);
/// Measures what a depth bias adds to depths, and how the sum is limited.
void measure_depth_bias(Subject& subject, Sight& sight);
/// Measures how fragments become a picture: stored in bytes, blended, resolved, and what is drawn
/// of their differences across quads.
void measure_pictures(Subject& subject);
/// Measures the weights of bilinear filtering, and which texel is looked up at a border.
void measure_textures(Subject& subject);
/// Measures which samples lines and points cover, and how their sizes are rounded.
void measure_primitives(Subject& subject);
/// Measures the least and greatest usable numbers, including subnormal numbers and overflow.
void measure_numbers(Subject& subject);
/// Measures whether the same case gives the same picture, and which values are returned exactly.
void measure_repetition(Subject& subject);
/// Measures errors of values, by generator, and whether coverage agrees with the earlier measures.
void measure_precision(Subject& subject);

}  // namespace rastercheck::properties
