#pragma once

// What comes before triangles are drawn, in the words of cases: the rasterizer's vertex stage and
// its strips and fans.

#include <cstdint>
#include <span>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/picture.h"

namespace rastercheck::backends {

/// The clip positions of a case with a camera; fails where it has none.
Result<std::vector<cases::ClipVertex>> transformed(const cases::Case& c);

/// Unit normals in world space, one for each of those in object space.
Result<std::vector<cases::Normal>> transformed_normals(const cases::Matrix4& model,
                                                       std::span<const cases::Normal> normals);

/// The case with the triangles of a list, strip or fan of its vertices in place of its own; fails
/// where one has an index beyond the vertices.
Result<cases::Case> assembled(const cases::Case& c, cases::Topology topology,
                              std::span<const std::uint32_t> indices);

}  // namespace rastercheck::backends
