#pragma once

// What a driver gets to draw a strip, fan or list of indices, and how its fragments tell their
// primitive: each vertex carries, as a flat value, the number of the primitive that it provokes. So
// a driver that takes flat values from another vertex than its API says draws other numbers.

#include <cstdint>
#include <span>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/picture.h"

namespace rastercheck::backends {

/// A draw of indices. Each index that names a vertex has a place of its own in the vertices that
/// the driver gets, since a vertex cannot carry the numbers of two primitives. Places run against
/// the indices, so that a driver that ignores them draws something else.
struct IndexedDraw {
  cases::Topology topology = cases::Topology::strip;
  std::vector<std::uint32_t> vertices;  ///< [place]: the case's vertex
  std::vector<float> numbers;           ///< [place]: its primitive's number from 1 on; 0: of none
  std::vector<std::uint32_t> order;     ///< what is drawn: places, and cases::kRestart in between
  std::vector<cases::Triangle> primitives;  ///< the case's vertices of each
};

/// Turns indices into a draw of a case's kind of primitives. Fails if an index is not that of a
/// vertex, with Failure::unsupported if cases::has_topology() is false.
Result<IndexedDraw> indexed_draw(const cases::Case& c, cases::Topology topology,
                                 std::span<const std::uint32_t> indices);

/// The parts of `order` between restarts that are not empty.
std::vector<std::span<const std::uint32_t>> runs_of(std::span<const std::uint32_t> order);

}  // namespace rastercheck::backends
