#include "backends/indexed_draw.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "backends/primitive_vertices.h"
#include "cases/topology.h"

namespace rastercheck::backends {
namespace {

/// The primitives of a run of `count` vertices, as indices into the run.
std::vector<cases::Triangle> primitives_of_run(const cases::Case& c, cases::Topology topology,
                                               std::uint32_t count) {
  if (c.primitive == cases::Primitive::triangles) {
    return cases::triangles_of(topology, count, c.rules);
  }
  const auto size = static_cast<std::uint32_t>(vertices_per(c.primitive));
  const std::uint32_t step = topology == cases::Topology::strip ? 1 : size;
  std::vector<cases::Triangle> primitives;
  for (std::uint32_t first = 0; first + size <= count; first += step) {
    const std::uint32_t last = first + size - 1;
    primitives.push_back({first, last, last});
  }
  return primitives;
}

/// The vertex that gives a primitive its flat values. A case repeats the last vertex of a line, so
/// the last one is always the third.
std::uint32_t provoking(cases::Rules rules, const cases::Triangle& primitive) {
  return rules == cases::Rules::opengl ? primitive[2] : primitive[0];
}

}  // namespace

std::vector<std::span<const std::uint32_t>> runs_of(std::span<const std::uint32_t> order) {
  std::vector<std::span<const std::uint32_t>> runs;
  auto begin = order.begin();
  while (begin != order.end()) {
    const auto end = std::find(begin, order.end(), cases::kRestart);
    if (begin != end) runs.emplace_back(begin, end);
    begin = end == order.end() ? end : end + 1;
  }
  return runs;
}

Result<IndexedDraw> indexed_draw(const cases::Case& c, cases::Topology topology,
                                 std::span<const std::uint32_t> indices) {
  if (!cases::has_topology(c.primitive, topology)) {
    return tl::unexpected(Error{"", "", std::string(cases::kNoSuchTopology), Failure::unsupported});
  }
  IndexedDraw draw;
  draw.topology = topology;
  const auto restarts = std::ranges::count(indices, cases::kRestart);
  auto place = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(indices.size()) - restarts);
  draw.vertices.resize(place);
  draw.numbers.resize(place);
  for (const std::uint32_t index : indices) {
    if (index == cases::kRestart) {
      draw.order.push_back(index);
      continue;
    }
    if (index >= c.positions.size()) return tl::unexpected(Error{"", "", "no such vertex"});
    draw.vertices[--place] = index;
    draw.order.push_back(place);
  }
  for (const std::span<const std::uint32_t> run : runs_of(draw.order)) {
    for (const cases::Triangle& of_run :
         primitives_of_run(c, topology, static_cast<std::uint32_t>(run.size()))) {
      cases::Triangle of_case{};
      std::ranges::transform(of_run, of_case.begin(),
                             [&](std::uint32_t i) { return draw.vertices[run[i]]; });
      draw.primitives.push_back(of_case);
      draw.numbers[run[provoking(c.rules, of_run)]] = static_cast<float>(draw.primitives.size());
    }
  }
  return draw;
}

}  // namespace rastercheck::backends
