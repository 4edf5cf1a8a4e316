#include "rasterizer/assembly.h"

#include <algorithm>
#include <cstddef>

#include "rasterizer/internal/try_allocating.h"

namespace rastercheck::rasterizer {
namespace {

using Indices = std::span<const std::uint32_t>;

/// Calls `call` for each list, strip or fan, in order.
template <typename Call>
void for_each_run(Indices indices, const Call& call) {
  while (!indices.empty()) {
    const auto end = std::find(indices.begin(), indices.end(), kRestart);
    const auto length = static_cast<std::size_t>(end - indices.begin());
    call(indices.first(length));
    indices = indices.subspan(std::min(length + 1, indices.size()));
  }
}

std::size_t triangle_count(Topology topology, std::size_t indices) {
  if (topology == Topology::triangles) return indices / 3;
  return indices < 3 ? 0 : indices - 2;
}

/// Returns triangle i of a list, strip or fan.
glm::uvec3 triangle(Topology topology, Convention convention, Indices run, std::size_t i) {
  const bool is_last_provoking = convention == Convention::opengl;
  switch (topology) {
    case Topology::triangles:
      return {run[3 * i], run[3 * i + 1], run[3 * i + 2]};
    case Topology::strip:
      if (i % 2 == 0) return {run[i], run[i + 1], run[i + 2]};
      // Swaps two vertices and leaves the provoking vertex in its place.
      if (is_last_provoking) return {run[i + 1], run[i], run[i + 2]};
      return {run[i], run[i + 2], run[i + 1]};
    case Topology::fan:
      break;
  }
  if (is_last_provoking) return {run[0], run[i + 1], run[i + 2]};
  return {run[i + 1], run[i + 2], run[0]};
}

std::size_t line_count(LineTopology topology, std::size_t indices) {
  if (topology == LineTopology::list) return indices / 2;
  return indices < 2 ? 0 : indices - 1;
}

/// Appends `count(run)` primitives for each run of indices, `primitive(run, i)` for i from 0 on.
template <typename Count, typename Primitive>
std::optional<Error> append(Indices indices, const Count& count, const Primitive& primitive,
                            std::vector<glm::uvec3>& to) {
  std::size_t more = 0;
  for_each_run(indices, [&](Indices run) { more += count(run.size()); });
  const std::size_t before = to.size();
  if (before > kMaxTriangles || more > kMaxTriangles - before) return Error::triangle_count;
  if (const auto error = try_allocating([&] { to.resize(before + more); })) return error;
  auto next = to.begin() + static_cast<std::ptrdiff_t>(before);
  for_each_run(indices, [&](Indices run) {
    for (std::size_t i = 0; i < count(run.size()); ++i) *next++ = primitive(run, i);
  });
  return std::nullopt;
}

}  // namespace

std::optional<Error> assemble(Topology topology, std::span<const std::uint32_t> indices,
                              Convention convention, std::vector<glm::uvec3>& triangles) {
  return append(
      indices, [topology](std::size_t size) { return triangle_count(topology, size); },
      [topology, convention](Indices run, std::size_t i) {
        return triangle(topology, convention, run, i);
      },
      triangles);
}

std::optional<Error> assemble_lines(LineTopology topology, std::span<const std::uint32_t> indices,
                                    std::vector<glm::uvec3>& lines) {
  return append(
      indices, [topology](std::size_t size) { return line_count(topology, size); },
      [topology](Indices run, std::size_t i) -> glm::uvec3 {
        const std::size_t first = topology == LineTopology::list ? 2 * i : i;
        return {run[first], run[first + 1], run[first + 1]};
      },
      lines);
}

}  // namespace rastercheck::rasterizer
