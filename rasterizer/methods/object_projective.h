#pragma once

// Draws with object-projective parameters: clusters of attributes, each cluster with its own w_r at
// every vertex (Heckbert & Moreton 1991, §3.4). The mathematics is in object_projective.cpp.
//
// Sources of w_r:
// - Parameters given at the four corners of a quad: QuadMap::w_r (quad.h), the same for both of its
//   triangles, so that no seam appears between them.
// - A projective texture (a slide projector): texture coordinates (s, t, q) are affine in object
//   space, the texture is read at (s/q, t/q), and w_r = q.
// - A modelling transform with perspective, which maps an object's points to (x w_o, y w_o, z w_o,
//   w_o): parameters that are affine in the object's space have w_r = 1; parameters that are affine
//   after the transform, such as world positions, have w_r = w_o.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Attributes that share one w_r: for each attribute u, u w_r is affine in object space, and so is
/// w_r. A factor common to all w_r of a triangle changes nothing.
struct ParameterCluster {
  std::span<const std::size_t> attributes;  ///< indices of the state's attributes; all smooth
  std::span<const double> w_r;              ///< [vertex]
};

/// Why clusters were refused; nothing is drawn then. Only w_r of vertices in a triangle are
/// checked.
enum class ClusterError {
  attribute,      ///< an attribute is unknown, not smooth or in two clusters; or none is given
  w_r_count,      ///< not one w_r for each vertex
  w_r_zero,       ///< a vertex whose parameters are at infinity
  w_r_range,      ///< a w_r is not finite, or not from 2^-64 to 2^64 in magnitude
  w_r_two_signs,  ///< w_r changes sign within a triangle, so parameters are infinite inside it
};

/// One sentence that explains the error and names the argument.
std::string_view to_string(ClusterError error);

/// At most one error is set; if so, nothing was drawn.
struct ClusterDrawResult {
  std::optional<Error> error;
  std::optional<ClusterError> cluster_error;
  DrawCounts counts;
};

/// Appends the fragments of every triangle, drawn by method object-projective. Smooth attributes in
/// no cluster have w_r = 1.
ClusterDrawResult draw_object_projective(const State& state, const Mesh& mesh,
                                         std::span<const ParameterCluster> clusters,
                                         const TargetSize& size, Fragments& fragments);

}  // namespace rastercheck::rasterizer
