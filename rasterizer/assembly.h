#pragma once

// Strips and fans: from indices to the triangles of a Mesh, in the order of vertices that the API
// has them in, so that facing and the provoking vertex (rasterizer.h) are its own. Of the vertices
// 0, 1, 2, … of a strip or fan triangle i is
//
//   | | vulkan, d3d: vertex 0 provokes | opengl: vertex 2 provokes |
//   | strip, i even | i, i + 1, i + 2 | i, i + 1, i + 2 |
//   | strip, i odd | i, i + 2, i + 1 | i + 1, i, i + 2 |
//   | fan | i + 1, i + 2, 0 | 0, i + 1, i + 2 |
//
// as the specifications of OpenGL and Vulkan and the documentation of Direct3D 9 say (later ones
// have no fans). All triangles of a strip are wound as its first. Flat values of triangle i of a
// strip come from vertex i, in OpenGL i + 2; of a fan from i + 1, in OpenGL i + 2; never from the
// hub.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// How indices become triangles. `triangles`: three by three.
enum class Topology { triangles, strip, fan };

/// An index that is no vertex: with the next begins a new list, strip or fan.
inline constexpr std::uint32_t kRestart = 0xffffffff;

/// Appends the triangles of indices, in their order. Indices that are left over, one or two of a
/// list, or a strip or fan of less than three, make none. An error, with `triangles` as before,
/// where there would be more than kMaxTriangles, or where memory runs out. Whether vertices of
/// these indices exist is for the draw to say.
std::optional<Error> assemble(Topology topology, std::span<const std::uint32_t> indices,
                              Convention convention, std::vector<glm::uvec3>& triangles);

}  // namespace rastercheck::rasterizer
