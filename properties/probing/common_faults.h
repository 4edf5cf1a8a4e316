#pragma once

// What those who write their first rasterizer get wrong: each fault is told from drawings alone, by
// an explanation that accounts for (nearly) all of them where a drawing as asked does not. Later
// measures would measure nonsense, so the probe ends after these.
//
// A backend may be off by a margin, whatever its grid, position error or tie rule
// (placement.h): no sample that lies nearer to an edge counts. Several faults at once are named
// where each is visible by itself.

#include <array>
#include <string>
#include <vector>

#include "properties/probing/placement.h"
#include "properties/probing/subject.h"

namespace rastercheck::properties {

/// Adds the faults to the subject's result. A fault that the backend's contract permits becomes a
/// row instead, and later measures are made.
void find_common_faults(Subject& subject);

/// The drawing that shows most faults: triangles with vertices at whole pixels, with attributes
/// and depths that differ at all vertices.
struct FirstDrawing {
  FineDrawing drawing;
  std::vector<std::array<float, 3>> depths;  ///< [triangle][vertex] window depths
};

/// A fault as it was found.
struct FoundFault {
  std::string id;
  std::string what;  ///< names the row, if the fault is permitted
  std::string sentence;
  records::Sureness sureness;
};

/// Finds attributes of other vertices, in another order, or with their bytes reversed
/// (value_faults.cpp).
std::vector<FoundFault> attribute_faults(const FirstDrawing& first, const Placement& placement);
/// Finds a depth that is constant, reversed, or of another range.
std::vector<FoundFault> depth_faults(const FirstDrawing& first, const Placement& placement);

}  // namespace rastercheck::properties
