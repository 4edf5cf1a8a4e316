#pragma once

// A backend's promises about coverage and attributes (RULES §3). Verdicts are decided by a
// Contract.

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

/// How smooth values are claimed to interpolate. `perspective`: linearly in clip space, as the
/// rules say (RULES §1). `affine`: linearly in window space, as if noperspective, by methods that
/// never divide.
enum class Claim { perspective, affine };

/// The largest allowed excess of a value beyond what coverage and basis leave open, in scale ULP
/// (RULES §5):
///
///   constant + per_horizon · g + per_condition · K + range_share · (max r_i − min r_i)/ulp
///            + absolute / ulp
///
/// where g and K refer to the exact triangle. g is the greatest 1/w of the drawn part divided by
/// 1/w at the fragment, and 1 for values linear in window space. Interpolating r/w and 1/w has an
/// error that is a share of the greatest 1/w, and so loses digits of r towards the horizon, where
/// 1/w is small.
///
/// K measures the digits that a weight E_i loses when it is evaluated as the plane A u + B v + C,
/// whose coefficients are differences of products: with |X|_i = |x_i W/2| + |w_i| (|x0| + |W/2|),
/// |Y|_i likewise, and |E|_i(u, v) the sum of the sizes of E_i's terms,
///
///   |E|_i = (|Y|_j |w_k| + |Y|_k |w_j|) |u| + (|X|_j |w_k| + |X|_k |w_j|) |v|
///           + |X|_j |Y|_k + |X|_k |Y|_j,
///   K = Σ |E|_i / Σ E_i,   or Σ |w_i| |E|_i / Σ w_i E_i for values linear in window space.
///
/// A line's weights are −g_b and g_a (RULES §10), with n and g made of sums of products likewise:
/// |n|_x = |w_a| |X|_b + |w_b| |X|_a and |g|_k = |n|_x (|u| |w_k| + |X|_k) + |n|_y (|v| |w_k| +
/// |Y|_k). K of a point is 1. With some w <= 0, a line has no g.
///
/// K is unbounded for slivers and towards the horizon. If per_condition · K, or the constant,
/// reaches 2^24, all digits of a value may be lost, and nothing is promised; the value may even be
/// NaN.
///
/// The last two terms are for methods that approximate by design, or that store a value in a few
/// bits: a share of the range of the vertices' values, and an error in units of the value itself
/// (1/510 for values in [0, 1] that are stored in 8 bits). ulp is that of max |r_i| there.
///
/// For depth, only `constant` and `absolute` count, and ulp is that of max(|n|, |f|). The bound is
/// that of the depth before it is stored in a unorm format.
struct ValueBound {
  float constant = 0.5F;
  float per_horizon = 0;
  float per_condition = 0;
  float range_share = 0;
  float absolute = 0;
  bool operator==(const ValueBound&) const = default;

  /// True if the bound is the same everywhere on a triangle.
  bool is_uniform() const { return per_horizon == 0 && per_condition == 0; }
  /// True if the bound is `constant` everywhere.
  bool is_constant() const { return is_uniform() && range_share == 0 && absolute == 0; }
};

/// Bounds by kind of value. Flat attributes are copies: their bound is 0.
struct ValueBounds {
  ValueBound smooth;
  ValueBound noperspective;
  ValueBound depth;  ///< in ULP of max(|n|, |f|)
  bool operator==(const ValueBounds&) const = default;
};

/// The largest allowed error of filtered colours of a W×H texture, in units of a whole channel:
///
///   W (share · max|s| + constant) + H (share · max|t| + constant) + units · 2^-24
///
/// where max|s| and max|t| are the greatest coordinates of the drawn vertices, or of the fragment
/// if greater, and `units` is the member named after the filter. Coordinate errors in texels count
/// in full, because a colour changes by at most 1 from one texel to the next. Trilinear colours may
/// use any level of detail whose derivatives d are off by at most derivative_share · max(|d|, M),
/// with M as in Contract::derivative_bound.
struct TextureBounds {
  float coordinate_share = 0;
  float coordinate_constant = 0;
  float bilinear = 0;   ///< `units` for the bilinear filter
  float trilinear = 0;  ///< `units` for the trilinear filter
  float derivative_share = 0;
  bool operator==(const TextureBounds&) const = default;
};

/// How pictures may differ from those of the rules (properties/laws/internal/picture_model.h), for
/// a backend that does not promise these to the bit.
struct PictureBounds {
  /// True if a picture's fragments have the depths and attributes that the backend draws as
  /// fragments of the same case, to the bit. A contract of a case may have false where that of
  /// another has true.
  bool keeps_fragments = true;
  /// True if a resolved colour is the mean of a pixel's samples; else it is anywhere between the
  /// least and the greatest of them.
  bool resolves_to_mean = true;
  /// The largest error of a colour that is blended into float32, in units of 2^-24 of the summed
  /// sizes of the products that are added; of a mean of float32 colours and of a difference across
  /// a quad likewise; and of a texel's colour k/255, in units of 2^-24.
  float float_error = 0;
  /// The largest distance between a colour times 255 and the byte that it is stored as: without and
  /// with blending, and as the mean of a pixel's samples.
  float byte_store = 0.5F;
  float byte_blend = 0.5F;
  float byte_mean = 0.5F;
  /// How far from its coordinates a texel may be looked up, along either axis: a share of the
  /// distance from coordinate 0, and a distance in texels. The coordinates are those that the
  /// backend draws as a fragment if pictures keep fragments, and any that are permitted if not.
  float texel_share = 0;
  float texel_distance = 0;
  bool operator==(const PictureBounds&) const = default;
};

/// A range of magnitudes, inclusive; 0 always belongs to it.
struct MagnitudeRange {
  float least = 0;
  float greatest = std::numeric_limits<float>::max();
  bool operator==(const MagnitudeRange&) const = default;

  bool has(float number) const {
    const float magnitude = std::fabs(number);
    return magnitude == 0 || (magnitude >= least && magnitude <= greatest);
  }
};

/// The promises about one triangle. A member means the same as the member of that name in Snapping
/// or Contract, if one exists.
struct TrianglePromise {
  /// If false, nothing is promised: the triangle may be drawn anywhere, with any values.
  bool is_made = true;
  float position_error = 0;
  double clip_tolerance = 1;
  double clip_error = 0;
  /// For a triangle cut at the viewport's sides: how far inside the sides samples may be missing,
  /// and how far outside the sides samples may be drawn, in grid units. Only if coverage is
  /// snapped.
  double side_tolerance = 0;
  ValueBounds bounds;
  bool operator==(const TrianglePromise&) const = default;
};

/// A position within a pixel, as fractions x/parts and y/parts of a pixel from its corner of least
/// window x and y; 0 <= x, y < parts.
struct PixelFraction {
  int x = 0;
  int y = 0;
  int parts = 1;  ///< 1…kMostPixelParts
  bool operator==(const PixelFraction&) const = default;
};
inline constexpr int kMostPixelParts = 256;

/// The orientation of a triangle as displayed.
enum class Winding { none, clockwise, counter_clockwise };

/// Which fragments a depth test keeps: those whose depth has this relation to the stored one. With
/// the last two, depth is reversed: greater is nearer. A pipeline's DepthFunction has all
/// relations.
enum class KeptDepth { less, less_or_equal, greater, greater_or_equal };

/// On which sides of its exact range a depth may lie. `nearer` and `farther` follow the depth test:
/// less is nearer unless depth is reversed.
enum class DepthError { either_side, never_nearer, never_farther };

/// How steep a plane of depths is held to be, the m of cases::DepthBias, from its derivatives z_x
/// and z_y by window x and y: max(|z_x|, |z_y|), sqrt(z_x² + z_y²), or anything from one to the
/// other.
enum class BiasSlope { greatest, root, between };

/// The r of cases::DepthBias in a unorm format of b bits: 2^-b, 2^(1−b), either of these or what
/// lies between them, the least positive value of the format as float32, or anything from 0 to
/// 2^(1−b).
enum class BiasUnit { power, double_power, either_power, least_value, open };

/// The r of cases::DepthBias in float32 is 2^(e−23), where e is the exponent of the greatest depth
/// of a triangle. `vertices`: of its three vertices, each clamped to the viewport's depth range; a
/// vertex with w <= 0 counts as the range's greater end. `open`: of its vertices or of those of the
/// clipped triangle or of a part of that.
enum class BiasExponent { vertices, open };

/// How a backend carries out a case's bias (RULES §8). The biased depth is then clamped: under
/// `d3d`, and with depth clamp, to the viewport's depth range, else to [0, 1].
struct BiasPromise {
  BiasSlope slope = BiasSlope::greatest;
  BiasUnit unit = BiasUnit::power;
  BiasExponent exponent = BiasExponent::vertices;
  bool operator==(const BiasPromise&) const = default;
};

/// Which number of a unorm format a depth d may become, where d · (2^n − 1) lies between two
/// integers: the nearest of them, one that is at most 0.6 away, or either.
enum class DepthStore { nearest, nearly_nearest, either };
/// The largest distance between a depth and what it is stored as, in units of the format.
constexpr double reach_of(DepthStore store) {
  return store == DepthStore::nearest ? 0.5 : store == DepthStore::nearly_nearest ? 0.6 : 1;
}

/// The largest factor by which 1/w may fall from one pixel to the next while differences still mean
/// something.
inline constexpr float kMostQuadHorizon = 0x1p16F;

struct Contract {
  Coverage coverage;
  Basis basis = Basis::ideal;
  TieRule tie_rule = TieRule::top_left;
  /// If set, pixels are covered, not samples. If `coverage` is snapped too, every position that the
  /// snapping allows counts: a pixel is required if all of them require it, and forbidden if all of
  /// them forbid it.
  std::optional<Conservative> conservative;
  /// A vertex outside the viewport may be clipped if its window position is farther than this from
  /// the window origin in x or y, in pixels. Only if `coverage` is snapped. D3D: 2^15. If the
  /// backend clips at the viewport: 0.
  float guard_band = 32768;
  /// If set, it takes the place of `guard_band`: a vertex may be clipped if its window position is
  /// farther than this outside the viewport in x or y, in pixels. 0: all triangles are clipped at
  /// the viewport's sides. Only if `coverage` is snapped.
  std::optional<float> guard_beyond_viewport = {};
  /// True if nothing is ever clipped but by user clip distances: a triangle is left out if one of
  /// its vertices has w <= 0, lies beyond a depth plane, or lies beyond the guard band. Where
  /// clip_tolerance or the position error leave open whether a vertex does, both are permitted.
  bool culls_instead_of_clipping = false;
  /// The triangles that are never drawn, whatever the case culls.
  Winding culls = Winding::none;
  /// Triangles whose window area is below this, in square pixels, may be left out, as may those
  /// that clipping makes smaller.
  float least_area = 0;
  /// If set, the place of the only sample of a pixel, whatever the case asks for; values at centres
  /// and centroids are at this place, too. Only of cases with one sample.
  std::optional<PixelFraction> sample_position = {};
  /// True if vertices are placed on points of `coverage`'s grid. If false, they may be placed
  /// anywhere between the allowed grid points, as by a backend that rounds nothing to a grid and is
  /// merely slightly off.
  bool is_on_grid = true;
  /// How far an edge cut by a clip plane, and the clip edge itself, may be off in addition to the
  /// position error, in grid units per axis. Only if `coverage` is snapped.
  double clip_tolerance = 1;
  /// How far the distance of a point from a plane that cuts the triangle may be off, in addition to
  /// clip_tolerance. This is a share of max|z| + max|w| of the triangle's vertices or, for a clip
  /// distance, of its greatest magnitude at the vertices. Such errors arise because the new
  /// vertices made by one plane are cut by the next. Only if `coverage` is snapped.
  double clip_error = 0;
  /// How far the viewport's sides may be off, along either axis, in pixels. All of the case is
  /// drawn with one viewport within this error, the same for every identical request, and positions
  /// are rounded afterwards. Nothing is promised about viewports no larger than twice this error.
  /// Only if `coverage` is snapped.
  double viewport_error = 0;
  /// The format in which depth tests compare depths, of a case that asks for float32; a case that
  /// asks for a unorm format gets that. Rounding keeps the order of depths, but may
  /// make depths equal if they are no farther apart than a step. Depths that are equal in float32
  /// may differ in float64.
  DepthFormat depth_format = DepthFormat::float32;
  DepthStore depth_store = DepthStore::nearest;  ///< only of cases that ask for a unorm format
  BiasPromise depth_bias;
  /// What takes the place of the depth test `less` in cases that have one. If depth is reversed,
  /// the depth buffer begins with 0 where the case does not say what it begins with.
  KeptDepth depth_function = KeptDepth::less;
  /// The side on which depths are promised to lie. Their bound (ValueBounds::depth) holds on the
  /// other side.
  DepthError depth_error = DepthError::either_side;
  Claim claims = Claim::perspective;
  ValueBounds bounds;
  /// True if all triangles whose vertices have the same z/w (a plane of constant depth) get the
  /// same depth (RULES §6). The bound alone would allow two depths if the exact depth lies near the
  /// middle between two floats.
  bool keeps_equal_depth = false;
  /// True if an attribute that has the same bits at all vertices has these bits everywhere,
  /// whatever its bound; only a zero's sign may differ (keeps_sign_of_zero).
  bool keeps_constants = false;
  /// True if a sample exactly at a vertex with w > 0 (where the basis places the vertex) has the
  /// vertex's value, bit for bit; zeros of either sign count as equal.
  bool keeps_vertex_values = false;
  /// True if an interpolated attribute with the same zero at all vertices keeps the zero's sign;
  /// flat attributes always do.
  bool keeps_sign_of_zero = true;
  /// True if a fragment keeps its bits when other faces are culled, when a depth test is added or
  /// removed, and when clip coordinates or attributes are multiplied by a power of two. If false,
  /// it keeps its bits only when the same commands are repeated or the scissor changes, as the APIs
  /// guarantee.
  bool is_invariant = true;
  /// The largest error of screen derivatives of attributes, in ulp(max(|d|, M)) of float32: d is
  /// the exact ∂r/∂u (∂r/∂v likewise). d is a difference of terms, and M is the size of these
  /// terms:
  ///
  ///   smooth         M = max|r_i| Σ|∂E_i/∂u| / Σ E_i
  ///   noperspective  M = Σ|r_i w_i ∂E_i/∂u| / Σ w_i E_i
  ///
  /// Empty: no promise.
  std::optional<float> derivative_bound;
  /// The largest error of the clip positions f of the vertex stage, apart from half an ulp: for
  /// each coordinate k of a case with a camera
  ///
  ///   |f − clip_k| <= transform_bound · 2^-53 · (|P| |V| |M| |p|)_k + ulp(f) / 2
  ///
  /// with P, V, M the camera's matrices, p the position and |·| applied to each number of them.
  /// Empty: no vertex stage, or no promise.
  std::optional<float> transform_bound;
  /// The largest error of the unit normals of the vertex stage. The image of a normal n is m = C n,
  /// with C the cofactors of the model's upper left 3×3 part, times the sign of its determinant (+
  /// if 0); for each component i
  ///
  ///   |f_i − m_i / ‖m‖| <= normal_bound · 2^-53 · ‖|C| |n|‖ / ‖m‖ + 4 · 2^-53 + ulp(f_i) / 2
  ///
  /// and f = 0 if m = 0. Empty: no promise.
  std::optional<float> normal_bound;
  /// The largest error of differences across quads (cases::Shading). Let r be the value at the
  /// fragment and r' the value at its neighbour, both from the triangle's own map, whether the
  /// neighbour is drawn or not. Then
  ///
  ///   |f − (r_odd − r_even)| <= quad_share (M + g M') + ulp(f) / 2
  ///
  /// where M = max(max|r_i|, |r|), M' likewise for r', and g = max(1, 1/w at the fragment / 1/w at
  /// its neighbour), or 1 for noperspective values. The factor g allows for the digits that r/w
  /// loses towards the horizon. Nothing is promised about neighbours with 1/w <= 0 or g >
  /// kMostQuadHorizon, or about centroids if pixels have several samples, because the rules define
  /// no centroid in a neighbour outside the triangle. Empty: no promise at all.
  std::optional<float> quad_share;
  /// The error of filtered textures. Empty: no textures, or no promise.
  std::optional<TextureBounds> texture_bounds;
  /// If set, pictures may differ from those of the rules. Empty: they are those of the rules to the
  /// bit, and texels are those of the exact coordinates.
  std::optional<PictureBounds> picture_bounds;
  /// The range of numbers that promises cover. Nothing is promised about a triangle that has a clip
  /// position or clip distance outside the range; about an attribute, unless flat, that has a value
  /// outside the range at one of the triangle's vertices; or about a case whose depth range has an
  /// end outside the range.
  MagnitudeRange numbers;
  /// Overrides the members above per triangle, for a backend that promises more about some
  /// triangles than about others; the members above must then be no less than any triangle's.
  /// Empty: all triangles have the same promise.
  std::vector<TrianglePromise> triangles;
  bool operator==(const Contract&) const = default;

  /// True if attributes with this declared interpolation are claimed to be linear in window space.
  bool is_affine(Interpolation declared) const;
  /// True if the contract allows more than one answer, so that values are ranges.
  bool is_unspecified() const {
    return basis == Basis::unspecified || has_open_viewport() ||
           (coverage && (coverage->is_unspecified() || coverage->position_error > 0));
  }
  bool is_depth_reversed() const {
    return depth_function == KeptDepth::greater || depth_function == KeptDepth::greater_or_equal;
  }
  /// True if, of fragments of equal depth, the last one drawn stays.
  bool keeps_last_of_equals() const {
    return depth_function == KeptDepth::less_or_equal ||
           depth_function == KeptDepth::greater_or_equal;
  }
  /// The depth buffer's initial value, given the one that the case names, if any.
  float depth_beginning(std::optional<float> named) const {
    return named.value_or(is_depth_reversed() ? 0.0F : 1.0F);
  }
  /// True if no promise of its own leaves out a triangle that the case draws.
  bool draws_every_triangle() const {
    return culls == Winding::none && !culls_instead_of_clipping && least_area == 0;
  }
  /// True if each sample on an edge that two triangles share belongs to exactly one of them.
  bool has_one_owner_of_ties() const {
    return tie_rule != TieRule::unspecified && tie_rule != TieRule::all &&
           tie_rule != TieRule::none;
  }
  /// True if the contract allows several viewports.
  bool has_open_viewport() const { return coverage && viewport_error > 0; }
};

/// The largest distance between two depths that rounding to a format may make equal, rounded
/// upwards; 0 for floats.
double depth_step(DepthFormat format);

/// Returns how many times wider or higher the given viewport may be than the one used instead, if
/// its sides may be off by `error` pixels; infinite if the viewport used may have no area.
double most_growth(const Viewport& viewport, double error);

/// Returns a contract's promise about a triangle (an index into the case's triangles). Ignores the
/// numbers of a case with a camera, whose clip positions depend on the backend.
TrianglePromise promise_of(const Contract& contract, const Case& c, std::size_t triangle);

/// True if a contract promises anything about an attribute's values on a triangle. Assumes that the
/// contract promises something about the triangle.
bool promises_values_of(const Contract& contract, const Case& c, std::size_t triangle,
                        std::size_t attribute);

/// True if a contract's promises cover the depth range of a case without a camera. Assumes that the
/// promises cover the numbers of the case's triangles.
bool promises_depth_range_of(const Contract& contract, const Case& c);

/// True if a contract promises something about every triangle and every value of a case without a
/// camera.
bool promises_all_of(const Contract& contract, const Case& c);

/// The contract that a Case itself asks for: `oracle` prints it and `cpu` draws it.
Contract contract_of(const Case& c);

}  // namespace rastercheck::cases
