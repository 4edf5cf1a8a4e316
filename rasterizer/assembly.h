#pragma once

// Turns the indices of strips and fans into triangles of a Mesh, and those of strips into lines.
// Each triangle has the vertex order of the API, so facing and the provoking vertex (rasterizer.h)
// match the API. For a strip or fan with vertices 0, 1, 2, …, triangle i is
//
//   | | vulkan, d3d: vertex 0 provokes | opengl: vertex 2 provokes |
//   | strip, i even | i, i + 1, i + 2 | i, i + 1, i + 2 |
//   | strip, i odd | i, i + 2, i + 1 | i + 1, i, i + 2 |
//   | fan | i + 1, i + 2, 0 | 0, i + 1, i + 2 |
//
// as the specifications of OpenGL and Vulkan and the documentation of Direct3D 9 say (later
// versions have no fans). All triangles of a strip wind like its first. Triangle i of a strip takes
// flat values from vertex i (OpenGL: i + 2); triangle i of a fan takes them from vertex i + 1
// (OpenGL: i + 2), never from the hub.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// How indices become triangles. `triangles`: every three indices make one.
enum class Topology { triangles, strip, fan };

/// Restart index: names no vertex; the next index begins a new list, strip or fan.
inline constexpr std::uint32_t kRestart = 0xffffffff;

/// Appends the triangles of the indices, in order. Ignores left-over indices: one or two at the end
/// of a list, or a strip or fan of fewer than three. Returns an error, with `triangles` unchanged,
/// if `triangles` would grow beyond kMaxTriangles or memory runs out. Does not check that the
/// vertices exist; the draw checks that.
std::optional<Error> assemble(Topology topology, std::span<const std::uint32_t> indices,
                              Convention convention, std::vector<glm::uvec3>& triangles);

/// How indices become lines: every two of a list make one, every two neighbours of a strip.
enum class LineTopology { list, strip };

/// Like assemble(), but appends lines as Mesh has them: (a, b, b). Ignores an index that is left
/// over at the end of a list, and a strip of one.
std::optional<Error> assemble_lines(LineTopology topology, std::span<const std::uint32_t> indices,
                                    std::vector<glm::uvec3>& lines);

}  // namespace rastercheck::rasterizer
