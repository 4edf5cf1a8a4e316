#pragma once

// What a backend promises about coverage and attributes (RULES §3). A Contract decides verdicts.

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "cases/coverage.h"

namespace rastercheck::cases {

struct Case;
struct Viewport;
enum class Interpolation;

/// What smooth values are held against: what is linear in clip space, as the rules have it (RULES
/// §1), or, of a method that never divides, what is linear in window space, as if they were
/// noperspective.
enum class Claim { perspective, affine };

/// How far a value may be beyond what coverage and basis leave open, in scale ULP (RULES §5):
///
///   constant + per_horizon · g + per_condition · K + range_share · (max r_i − min r_i)/ulp
///
/// both numbers of the exact triangle. g = the greatest 1/w of what is drawn of it / 1/w at the
/// fragment, and 1 for what is linear in window space. Interpolating r/w and 1/w is off by a share
/// of the greatest 1/w, and so loses digits of r towards the horizon, where 1/w is small.
///
/// K is how much of its digits a weight E_i loses that is evaluated as the plane A u + B v + C,
/// with coefficients that are differences of products: with |X|_i = |x_i W/2| + |w_i| (|x0| +
/// |W/2|), |Y|_i alike, and |E|_i(u, v) what E_i is made of,
///
///   |E|_i = (|Y|_j |w_k| + |Y|_k |w_j|) |u| + (|X|_j |w_k| + |X|_k |w_j|) |v|
///           + |X|_j |Y|_k + |X|_k |Y|_j,
///   K = Σ |E|_i / Σ E_i,   of what is linear in window space Σ |w_i| |E|_i / Σ w_i E_i.
///
/// It has no bound for slivers and towards the horizon; where per_condition · K, or the constant,
/// reaches 2^24 all digits of a value may be lost, and nothing is promised, not even a number.
///
/// The last part is for what is an approximation by design: a share of the range of the vertices'
/// values, in ulp(max |r_i|).
///
/// Of depth the constant alone counts.
struct ValueBound {
  float constant = 0.5F;
  float per_horizon = 0;
  float per_condition = 0;
  float range_share = 0;
  bool operator==(const ValueBound&) const = default;

  /// Whether it is the same everywhere on a triangle.
  bool is_uniform() const { return per_horizon == 0 && per_condition == 0; }
  /// Whether it is `constant` everywhere.
  bool is_constant() const { return is_uniform() && range_share == 0; }
};

/// Flat attributes are copies and have no bound but 0.
struct ValueBounds {
  ValueBound smooth;
  ValueBound noperspective;
  ValueBound depth;  ///< ULP of max(|n|, |f|)
  bool operator==(const ValueBounds&) const = default;
};

/// How far filtered colours of a W×H texture may be off, in units of a whole channel:
///
///   W (share · max|s| + constant) + H (share · max|t| + constant) + units · 2^-24
///
/// with max|s| and max|t| the greatest coordinates of the vertices drawn, or of the fragment where
/// these are greater, and the units those of the filter: a colour changes by at most 1 from one
/// texel to the next. Trilinear ones are those of a level of detail whose derivatives d are off by
/// no more than derivative_share · max(|d|, M), M as of Contract::derivative_bound.
struct TextureBounds {
  float coordinate_share = 0;
  float coordinate_constant = 0;
  float bilinear = 0;   ///< units
  float trilinear = 0;  ///< units
  float derivative_share = 0;
  bool operator==(const TextureBounds&) const = default;
};

/// Magnitudes, inclusive; 0 is always among them.
struct MagnitudeRange {
  float least = 0;
  float greatest = std::numeric_limits<float>::max();
  bool operator==(const MagnitudeRange&) const = default;

  bool has(float number) const {
    const float magnitude = std::fabs(number);
    return magnitude == 0 || (magnitude >= least && magnitude <= greatest);
  }
};

/// Holds what is promised of one triangle. Its members mean what those of the same name in Snapping
/// and Contract do, if there are any.
struct TrianglePromise {
  /// Whether anything is; otherwise it may be drawn anywhere, and with any values.
  bool is_made = true;
  float position_error = 0;
  double clip_tolerance = 1;
  double clip_error = 0;
  /// How far inside the viewport's sides samples may be missing, and how far outside drawn, in grid
  /// units, of one that is cut there. Only where coverage is snapped.
  double side_tolerance = 0;
  ValueBounds bounds;
  bool operator==(const TrianglePromise&) const = default;
};

/// From one pixel to the next 1/w may fall to a share of this and differences still mean something.
inline constexpr float kMostQuadHorizon = 0x1p16F;

struct Contract {
  Coverage coverage;
  Basis basis = Basis::ideal;
  TieRule tie_rule = TieRule::top_left;
  /// A vertex outside the viewport whose window position is farther than this from the window
  /// origin in x or y, in pixels, may be clipped. Only where `coverage` is snapped. D3D: 2^15.
  /// Clipped at the viewport: 0.
  float guard_band = 32768;
  /// Whether vertices are placed on points of `coverage`'s grid; else anywhere between those they
  /// may be placed on: a backend that rounds nothing to a grid and is merely a little off.
  bool is_on_grid = true;
  /// How far an edge that was cut by a clip plane, and the clip edge itself, may be off besides the
  /// position error, in grid units per axis. Only where `coverage` is snapped.
  double clip_tolerance = 1;
  /// By how much of max|z| + max|w| of a triangle's vertices, or of the greatest of its clip
  /// distances, the distance of a point from a plane that cuts the triangle may be off besides: the
  /// new vertices of one plane are what the next one cuts. Only where `coverage` is snapped.
  double clip_error = 0;
  /// How far the viewport's sides may lie from where a case has them, along either axis, in pixels:
  /// all of the case is drawn by one viewport whose sides are no farther off, the same one wherever
  /// the same is asked for, with positions rounded after that. Nothing is promised of viewports
  /// that are no larger than twice that. Only where `coverage` is snapped.
  double viewport_error = 0;
  /// Names what its depth tests compare. Rounding keeps the order of depths, but may make equal
  /// ones of depths that are no farther apart than a step; equal float32 may be different float64.
  DepthFormat depth_format = DepthFormat::float32;
  Claim claims = Claim::perspective;
  ValueBounds bounds;
  /// Whether triangles of one plane, z/w the same at all vertices, have one depth (RULES §6); the
  /// bound alone allows two where the exact depth lies near the middle between two floats.
  bool keeps_equal_depth = false;
  /// Whether an attribute with the same value at all vertices, to the bit, has it everywhere, to
  /// the bit but for a zero's sign (keeps_sign_of_zero), whatever its bound.
  bool keeps_constants = false;
  /// Whether a sample that lies exactly at a vertex, w > 0, has the vertex's value, to the bit;
  /// zeros of either sign are alike. That is the vertex as the basis places it.
  bool keeps_vertex_values = false;
  /// Whether an interpolated attribute that is the same zero at all vertices keeps its sign; flat
  /// ones do.
  bool keeps_sign_of_zero = true;
  /// Whether a fragment has the same bits whatever else is drawn with: where other faces are
  /// culled, with and without a depth test, whatever the power of two that clip coordinates or
  /// attributes are multiplied by. Without it only the same commands and other scissors leave bits,
  /// as of the APIs.
  bool is_invariant = true;
  /// How far screen derivatives of attributes may be off, each in ulp(max(|d|, M)) of float32: d
  /// the exact ∂r/∂u (∂r/∂v likewise) and M the size of the terms that it is the difference of,
  ///
  ///   smooth         M = max|r_i| Σ|∂E_i/∂u| / Σ E_i
  ///   noperspective  M = Σ|r_i w_i ∂E_i/∂u| / Σ w_i E_i
  ///
  /// Nothing: none are promised.
  std::optional<float> derivative_bound;
  /// How far the clip positions f of its vertex stage may be off, besides half an ulp: for each
  /// coordinate k of a case with a camera
  ///
  ///   |f − clip_k| <= transform_bound · 2^-53 · (|P| |V| |M| |p|)_k + ulp(f) / 2
  ///
  /// with P, V, M the camera's matrices, p the position and |·| of each number of them. Nothing:
  /// it has no vertex stage, or promises nothing of it.
  std::optional<float> transform_bound;
  /// How far the unit normals of its vertex stage may be off. The image of a normal n is m = C n,
  /// with C the cofactors of the model's upper left 3×3 part, times the sign of its determinant (+
  /// of 0); for each component i
  ///
  ///   |f_i − m_i / ‖m‖| <= normal_bound · 2^-53 · ‖|C| |n|‖ / ‖m‖ + 4 · 2^-53 + ulp(f_i) / 2
  ///
  /// and f = 0 where m = 0. Nothing: none are promised.
  std::optional<float> normal_bound;
  /// How far differences across quads (cases::Shading) may be off. With r the value at the fragment
  /// and r' at its neighbour, each that of the triangle's own map there, drawn or not,
  ///
  ///   |f − (r_odd − r_even)| <= quad_share (M + g M') + ulp(f) / 2
  ///
  /// where M = max(max|r_i|, |r|), M' alike of r', and g = max(1, 1/w at the fragment / 1/w at its
  /// neighbour), 1 of noperspective values: towards the horizon r/w loses digits. Of neighbours
  /// with 1/w <= 0 or g > kMostQuadHorizon, and of centroids of several samples, which need not
  /// have a place beyond the triangle, nothing is promised. Nothing: none are promised at all.
  std::optional<float> quad_share;
  /// Of filtered textures. Nothing: it has none, or promises nothing of them.
  std::optional<TextureBounds> texture_bounds;
  /// Nothing is promised of a triangle with a clip position or clip distance beyond these, of a
  /// value of an attribute, unless it is flat, that one of the triangle's vertices has beyond them,
  /// and of a case whose depth range ends beyond them.
  MagnitudeRange numbers;
  /// Overrides the members above, triangle by triangle, of a backend that promises more of one than
  /// of another; these are then no less than any triangle's. Empty: all are promised the same.
  std::vector<TrianglePromise> triangles;
  bool operator==(const Contract&) const = default;

  /// Whether values of attributes declared so are claimed to be linear in window space.
  bool is_affine(Interpolation declared) const;
  /// Whether it leaves more than one answer open, so that values are ranges.
  bool is_unspecified() const {
    return basis == Basis::unspecified || has_open_viewport() ||
           (coverage &&
            (coverage->rounding == Rounding::unspecified || coverage->position_error > 0));
  }
  /// Whether several viewports may be drawn by.
  bool has_open_viewport() const { return coverage && viewport_error > 0; }
};

/// How far two depths are apart at most that rounding to a format may make equal, rounded upwards;
/// 0 of floats.
double depth_step(DepthFormat format);

/// How many pixels of a viewport one of the smallest is at most that may be drawn by, where sides
/// may be `error` pixels off; infinite where it may vanish.
double most_growth(const Viewport& viewport, double error);

/// Gives what a contract promises of a triangle (an index into the case's). Numbers are not looked
/// at of a case with a camera, whose clip positions are nobody's yet.
TrianglePromise promise_of(const Contract& contract, const Case& c, std::size_t triangle);

/// Whether a contract promises anything of an attribute's values on a triangle of which it does.
bool promises_values_of(const Contract& contract, const Case& c, std::size_t triangle,
                        std::size_t attribute);

/// Whether a contract promises anything of a case without a camera whose triangles have numbers
/// that it makes promises of.
bool promises_depth_range_of(const Contract& contract, const Case& c);

/// Whether a contract promises something of each triangle, and each value, of a case without a
/// camera.
bool promises_all_of(const Contract& contract, const Case& c);

/// The contract a Case asks for itself: what `oracle` prints and what `cpu` draws.
Contract contract_of(const Case& c);

}  // namespace rastercheck::cases
