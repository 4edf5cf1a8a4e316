#pragma once

// The rasterizer's steps before triangles are drawn, applied to cases: the vertex stage and the
// assembly of strips and fans.

#include <cstdint>
#include <span>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/picture.h"

namespace rastercheck::backends {

/// Returns the clip positions of a case with a camera. Fails if the case has none.
Result<std::vector<cases::ClipVertex>> transformed(const cases::Case& c);

/// Returns unit normals in world space, one for each normal in object space.
Result<std::vector<cases::Normal>> transformed_normals(const cases::Matrix4& model,
                                                       std::span<const cases::Normal> normals);

/// Returns the case with its triangles replaced by those of a list, strip or fan of its vertices,
/// or its lines by those of a list or strip. Fails if an index is not that of a vertex, with
/// Failure::unsupported if the case's primitives have no such topology.
Result<cases::Case> assembled(const cases::Case& c, cases::Topology topology,
                              std::span<const std::uint32_t> indices);

}  // namespace rastercheck::backends
