#pragma once

// The verdict of a sample (RULES §2, §3), decided exactly.

#include <optional>

#include "oracle/internal/triangle_setup.h"
#include "records/enclosure.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// The verdict of a sample of any pixel under the scene's contract.
records::SampleVerdict decide(const TriangleSetup& triangle, int x, int y, int sample);

/// The verdict of a point as if it were a sample, ignoring viewport and scissor. Under conservative
/// coverage: of the point's pixel, in viewport and scissor.
records::SampleVerdict decide_point(const TriangleSetup& triangle, const Point& p);

/// Three edge functions whose signs decide most samples.
struct CoverageBoundary {
  /// A sample at which an edge function of this map is negative is forbidden.
  const ProjectiveMap* map;
  /// A sample at which all edge functions (and all clip functionals, if the triangle
  /// `is_cut_by_planes`) are positive is required if is_drawn, else forbidden.
  bool is_drawn;
  /// If true, both rules hold only for edge functions farther from zero than
  /// TriangleSetup::edge_bands or, under conservative coverage, than they change within
  /// decisive_distance() (conservative.h).
  bool has_bands;
};

/// Empty if no single map's edges decide most samples: if the triangle's shape is cut, if its exact
/// positions are degenerate and it has several placements, if its facing is open, if it may be left
/// out, or if nothing is promised about it. Samples near the viewport's sides may still be open
/// (TriangleSetup::has_open_sides).
std::optional<CoverageBoundary> coverage_boundary(const TriangleSetup& triangle);

/// The facing of a triangle of shape cut whose positions are not on one line: drawn, culled, or
/// left open by the contract.
enum class CutFacing { drawn, culled, open };
CutFacing facing_of_cut(const TriangleSetup& triangle);

/// The signed distance from a point to the boundary that decides it, in pixels: the least over all
/// edges, clip functionals and viewport sides, positive inside. With several placements, the
/// distance to the exact triangle's boundary. Empty for a triangle without orientation, and for
/// lines and points.
std::optional<records::Enclosure> boundary_distance(const TriangleSetup& triangle, const Point& p);

}  // namespace rastercheck::oracle
