#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "cases/picture.h"

namespace rastercheck::cases {

constexpr auto names_of(Topology /*type*/) {
  return std::to_array<std::string_view>({"triangles", "strip", "fan"});
}

/// True if primitives have that topology: lines have lists and strips, points neither.
constexpr bool has_topology(Primitive primitive, Topology topology) {
  return primitive == Primitive::triangles ||
         (primitive == Primitive::lines && topology != Topology::fan);
}
/// What is said of others.
inline constexpr std::string_view kNoSuchTopology = "the case's primitives have no such topology";

/// Returns the triangles of `count` successive vertices, as indices into these. Every triangle of a
/// strip or fan has the winding of the first one, and the API's provoking vertex where cases have
/// it: last under OpenGL, else first. Vertices beyond the last whole triangle draw nothing.
/// Source: OpenGL 4.6 table 10.1 and section 13.4; Vulkan 1.3, section 20.1.
std::vector<Triangle> triangles_of(Topology topology, std::uint32_t count, Rules rules);

}  // namespace rastercheck::cases
