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

}  // namespace

std::optional<Error> assemble(Topology topology, std::span<const std::uint32_t> indices,
                              Convention convention, std::vector<glm::uvec3>& triangles) {
  std::size_t count = 0;
  for_each_run(indices, [&](Indices run) { count += triangle_count(topology, run.size()); });
  const std::size_t before = triangles.size();
  if (before > kMaxTriangles || count > kMaxTriangles - before) return Error::triangle_count;
  if (const auto error = try_allocating([&] { triangles.resize(before + count); })) return error;
  auto next = triangles.begin() + static_cast<std::ptrdiff_t>(before);
  for_each_run(indices, [&](Indices run) {
    for (std::size_t i = 0; i < triangle_count(topology, run.size()); ++i) {
      *next++ = triangle(topology, convention, run, i);
    }
  });
  return std::nullopt;
}

}  // namespace rastercheck::rasterizer
