#pragma once

// Drawing with parameters that are object-projective: clusters of them, each with its own w_r at
// every vertex (seed 002 §3.4). The mathematics is in object_projective.cpp.
//
// Where a w_r comes from:
// - Parameters given at the four corners of a quad: QuadMap::w_r (quad.h), the same for both of its
//   triangles, which then have no seam.
// - A projective texture (a slide projector): texture coordinates (s, t, q) are affine in object
//   space, the texture is read at (s/q, t/q), and w_r = q.
// - A modelling transform with perspective: it takes an object's points to (x w_o, y w_o, z w_o,
//   w_o), parameters that are affine in the object's space have w_r = 1, and what is affine beyond
//   the transform, as positions in the world are, has w_r = w_o.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Parameters that are affine to each other: u w_r and w_r are affine in object space. A factor
/// that all w_r of a triangle share changes nothing.
struct ParameterCluster {
  std::span<const std::size_t> attributes;  ///< those of the state that it has; all smooth
  std::span<const double> w_r;              ///< [vertex]
};

/// Why clusters were refused; nothing is drawn then. The w_r are looked at where a triangle is.
enum class ClusterError {
  attribute,      ///< not the state's, not smooth, or in two clusters; a cluster without any
  w_r_count,      ///< not one for each vertex
  w_r_zero,       ///< a vertex whose parameters are at infinity
  w_r_range,      ///< not from 2^-64 to 2^64 in magnitude, or not finite
  w_r_two_signs,  ///< within a triangle: somewhere inside its parameters are infinite
};

/// One sentence about an error, naming the argument.
std::string_view to_string(ClusterError error);

/// At most one error is set, and nothing was drawn where one is.
struct ClusterDrawResult {
  std::optional<Error> error;
  std::optional<ClusterError> cluster_error;
  DrawCounts counts;
};

/// Appends the fragments of every triangle, as method object-projective. Smooth attributes that are
/// in no cluster have w_r = 1.
ClusterDrawResult draw_object_projective(const State& state, const Mesh& mesh,
                                         std::span<const ParameterCluster> clusters,
                                         const TargetSize& size, Fragments& fragments);

}  // namespace rastercheck::rasterizer
