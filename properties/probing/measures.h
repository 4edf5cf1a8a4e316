#pragma once

// The measures of a probe, in the order in which each builds on those before it. What one finds it
// adds to the subject's rows and terms.

#include <vector>

#include "properties/probing/grid.h"
#include "properties/probing/subject.h"

namespace rastercheck::properties {

/// What later measures ask of earlier ones.
struct Sight {
  GridFit fit;
  std::vector<FineDrawing> drawings;  ///< that the grid was read from
  /// Whether it rounds as a case asks for: what depends on a grid is then measured on one of
  /// kAskedBits.
  bool follows_coverage = false;
};

/// The grid asked for to see whether it is followed, and on which all else is measured then.
inline constexpr int kAskedBits = 8;

/// Subpixel grid, rounding, and what is left of position errors.
void measure_grid(Subject& subject, Sight& sight);
/// Who owns samples on edges.
void measure_ties(Subject& subject, const Sight& sight);
/// From which positions attributes, depth and facing come.
void measure_basis(Subject& subject, const Sight& sight);
/// By which arithmetic values are evaluated.
void measure_evaluation(Subject& subject);
/// What becomes of triangles cut by the near and far planes and by w = 0.
void measure_clipping(Subject& subject);
/// How far out vertices may lie.
void measure_reach(Subject& subject);
/// Least and greatest numbers, subnormal ones and overflow.
void measure_numbers(Subject& subject);
/// Whether the same case is the same picture, and which values come back to the bit.
void measure_repetition(Subject& subject);
/// How far values are off, by generator; and whether coverage keeps to what was measured.
void measure_precision(Subject& subject, const Progress& progress);

}  // namespace rastercheck::properties
