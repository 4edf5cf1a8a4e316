#pragma once

// Conservative coverage: the verdict of a whole pixel (cases::Conservative, RULES §11), decided
// exactly.
//
// Let S(r) be the open square of half-width 1/2 + r around the pixel's centre, and T the triangle
// inside its clip planes, user clip distances and the viewport.
//
//   outer   S(growth) meets T: required.  The closed S(growth + error) misses T: forbidden.
//   inner   S(0) does not lie in T: forbidden.  S(error) lies in T: required.
//
// Exact shape, a triangle with area. T is an intersection of half-planes: the edges E_i >= 0, the
// clip functionals, the viewport's sides. Where all E_i >= 0, 1/w > 0 follows (Σ E_i w_i > 0), so
// vertices with w <= 0 need no special care. Separating axes would need the vertices of T; cutting
// the square by every half-plane (convex_region.h) does not.
//
//   An open square meets a convex set with inner points iff the two have inner points in common,
//   that is, iff what the cuts leave of the closed square has an area. A convex polygon with an
//   area keeps one when it is cut by line >= 0 iff the line is positive at some corner.
//   A square of half-width h around c lies in a half-plane iff line(c) >= h (|A| + |B|).
//
// If clip planes leave only an edge or a corner of the triangle, T has no area. Pixels that T
// touches are then permitted.
//
// A pixel whose open square misses the viewport is never covered. The viewport is one more
// intersection, and does not grow.
//
// Positions that may move. Snapping moves vertices, and clipping's new vertices, by at most `reach`
// = ρ along each axis (TriangleSetup). A moved polygon's point Σ λ_i p'_i is within ρ of the point
// Σ λ_i p_i of the unmoved one, and the other way round. So if S(r − ρ) meets the unmoved T, S(r)
// meets every moved one, as a point that moves by at most ρ stays in S(r); and if the closed
// S(r + ρ) misses T, S(r) misses every moved one. If S(r + ρ) lies in T, all points of S(r) are
// within ρ of T's points only, and stay inside every moved T (TriangleSetup::edge_bands); if S(0)
// lies in a moved T, S(−ρ) lies in the unmoved one. The viewport's sides do not move, but a common
// point may move across them: the viewport shrinks by ρ where a pixel has to be required and grows
// by ρ where it has to be forbidden.
//
// Triangles without area (det M = 0) are projected from the weights λ: {λ_i >= 0, Σ λ_i = 1}, cut
// by the clip planes, which are linear in λ. S(r) is the set of λ with lo w < X < hi w along both
// axes, X = Σ λ_i X_i and w = Σ λ_i w_i; this implies w > 0. The conditions are linear in λ, too,
// so the same cuts decide.

#include "oracle/internal/number.h"
#include "oracle/internal/scene.h"
#include "oracle/internal/triangle_setup.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// The verdict of a pixel, and so of all its samples. The contract must be conservative, and
/// something must be promised about the triangle.
records::SampleVerdict decide_conservatively(const TriangleSetup& triangle, int x, int y);

/// How far beyond the triangle and its moved positions, per axis, a permitted pixel may reach, and
/// one pixel more; 0 if coverage is not conservative, or inner.
Ring conservative_spread(const Scene& scene);

/// True if shifted edges may meet far beyond the triangle's box, so that any pixel may be
/// permitted.
bool may_cover_far_pixels(const TriangleSetup& triangle);

/// The distance, per axis, from the triangle's boundary beyond which a sample decides its pixel: a
/// sample farther inside is in a required pixel, and a sample farther outside in a forbidden one.
/// Empty if there is no such distance: if positions may turn the triangle round, if it may be moved
/// by a pixel or more, and for the shapes that decide_conservatively() judges by other means.
std::optional<Ring> decisive_distance(const TriangleSetup& triangle);

/// Whether culling keeps a triangle in every reading of the contract, in none, or in some.
enum class Facing { drawn, culled, open };
Facing conservative_facing(const TriangleSetup& triangle);

}  // namespace rastercheck::oracle
