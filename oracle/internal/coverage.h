#pragma once

// The verdict of a sample (RULES §2, §3), decided exactly.

#include <optional>

#include "oracle/internal/triangle_setup.h"
#include "records/enclosure.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// The verdict of a sample of any pixel, drawn as the scene's contract allows.
records::SampleVerdict decide(const TriangleSetup& triangle, int x, int y, int sample);

/// The verdict of a point as if it were a sample, whatever viewport and scissor say.
records::SampleVerdict decide_point(const TriangleSetup& triangle, const Point& p);

/// What decides most samples by the signs of three edge functions.
struct CoverageBoundary {
  /// Forbidden where an edge of this map is negative.
  const ProjectiveMap* map;
  /// Where all edges are positive, and so are the clip functionals of a triangle that
  /// `is_cut_by_planes`: required, else forbidden.
  bool is_drawn;
  /// Both hold only of edges that are farther from zero than TriangleSetup::edge_bands.
  bool has_bands;
};

/// Nothing where no map's edges say so much: of a triangle that was snapped and cut, one whose
/// facing is open, or one of which nothing is promised. Samples near the viewport's sides may be
/// open all the same (TriangleSetup::has_open_sides).
std::optional<CoverageBoundary> coverage_boundary(const TriangleSetup& triangle);

/// What becomes of a triangle of shape cut, whose positions are not on one line: drawn, culled, or
/// left open by its contract.
enum class CutFacing { drawn, culled, open };
CutFacing facing_of_cut(const TriangleSetup& triangle);

/// The signed distance from a point to the boundary that decides it, in pixels: the least over all
/// edges, clip functionals and viewport sides, positive inside. Of a triangle with several
/// placements: of the exact one. Nothing for a triangle without orientation.
std::optional<records::Enclosure> boundary_distance(const TriangleSetup& triangle, const Point& p);

}  // namespace rastercheck::oracle
