#pragma once

// A depth bias adds an offset to all depths of a triangle (RULES §8):
//
//   o = m · slope + r · constant,    limited by the bias's clamp,
//
// where m is how steep the triangle's plane of depths is, and r is the unit of the depth format. A
// contract may leave both open (cases::BiasPromise), and the vertices' positions as well.
//
// Open positions. With the affine map T(p) = p + A p + c of placement_filter.h, a moved triangle
// has at T(p) the depth d that the exact one has at p. So its gradient is (1 + A)^-T ∇d. As ρ
// bounds A in the maximum norm, it bounds A^T in the sum norm, and
//
//   |∇d' − ∇d|_1 <= ρ/(1 − ρ) |∇d|_1.
//
// If ρ is too large for this, a placed triangle's z_x and z_y are found at the corners of the
// placements: each is a linear fraction of every vertex coordinate, hence monotone. If placements
// may turn the triangle round, or if clipping made new vertices, nothing bounds m.

#include <optional>

#include "oracle/internal/ulp_error.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

struct TriangleSetup;

/// The offsets that the contract allows, in units of depth.
struct DepthOffset {
  FractionRange exact;
  records::Enclosure near;  ///< encloses `exact` in doubles
  bool is_single = true;    ///< the contract allows one only
};

/// Empty if nothing bounds the offset. The case must have a bias.
std::optional<DepthOffset> depth_offset(const TriangleSetup& triangle);

/// The offset of a plane with these slopes per pixel, and with the unit of the triangle's format,
/// by the greatest of both slopes. The contract must not leave the unit open.
Field offset_of_slopes(const TriangleSetup& triangle, const Field& along_x, const Field& along_y);

}  // namespace rastercheck::oracle
