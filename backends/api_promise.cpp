// The bounds of api_promise(), triangle by triangle. Throughout, δ is the relative error of one
// operation. Error counts are of first order in δ. The factor kRest covers the higher orders
// (except in the quotients of section 3) and the rounding errors of computing the bounds in double.
//
// Assumptions about an implementation: it clips only by planes that some given vertex is beyond; it
// computes positions and weights by the formulas below or better ones; and the intermediate
// products fit into its numbers. Pieces of clipped triangles are assumed to be set up with the
// planes of the whole triangle. If an implementation sets up each piece separately, these bounds
// may be too strict.
//
// 1. Window positions. X = x · (1/w) · W/2 + (x0 + W/2) takes five operations: three for the
//    product, one for the centre, and one for the sum, which is off by δ|X|. So
//    |ΔX| <= 4δ |x/w W/2| + 2δ |x0 + W/2|, and likewise for Y. Then the position is rounded to a
//    neighbouring grid point.
//
// 2. New vertices. Both APIs clip to the view volume (|x| <= w, |y| <= w, z in the range that the
//    rules give) and by clip distances. If a plane separates the vertices a and b, three steps make
//    the new vertex. The distances d_a and d_b are off by δ each; they have opposite signs, so
//    their difference loses nothing. With the difference and the quotient, t = d_a/(d_a − d_b) is
//    off by 4δ. In a + t (b − a), the difference, the product and the sum add 3δ. These errors are
//    relative to numbers of at most twice the larger magnitude at a and b. Together, the new vertex
//    is off by kClipping δ m, where m is the largest magnitude at the triangle's vertices. The new
//    vertices of each plane are means of earlier vertices, so the errors of several planes add up.
//    Dividing by w_c >= w_least, the least w of the clipped polygon, gives the error of a new
//    vertex in the view volume, where |x_c/w_c| <= 1:
//
//      planes · kClipping δ (max|x| + max|w|)/w_least · W/2 pixels.
//
//    The distance of a new vertex from another plane is off by
//    planes · kClipping δ (max|z| + max|w|), or, if the plane is a clip distance, planes ·
//    kClipping δ times the largest magnitude of this distance at the vertices. The new vertex's w
//    has the relative error ω = planes · kClipping δ max|w|/w_least; z and attributes likewise.
//
// 3. Values. If w > 0 at all vertices, the values are those of planes over the triangle in the
//    window, with the errors derived in internal/plane_error.cpp. Errors of positions move
//    vertices. The contract's rules for where vertices may lie (Contract::coverage and ::basis)
//    already allow for this, so values need no further bound for it.
//
//    If some w <= 0, no triangle in the window exists. The planes are then evaluated in clip space,
//    about the window's origin, where the weight of vertex i is a sum of terms. Each term is off by
//    15δ: at most 2 · 5 operations for two positions, the product, the difference, the product with
//    the sample's u and two sums. Multiplying by r_i and adding takes 4δ more in the numerator, 3δ
//    more in the denominator, and the quotient 2δ. The errors of both sums come from terms whose
//    magnitudes add up to K times the denominator (cases::ValueBound), so
//
//      |Δr| <= (19 + 18) δ K / (1 − 18 δ K) max|r| + 2δ |r|,
//
//    and 37 / (1 − 18 δ K) <= 55 as long as 55 δ K <= 1. Beyond that, nothing is promised.
//
//    An ulp(max|r|) is at least 2^-24 max|r|. Depth has the same bound, with the K of affine
//    weights and three operations for the depth range. If the w of a vertex is off by ω, so is its
//    weight. So r, which is a mean of the vertices' values, is off by 2ω of their range, plus
//    ω max|r| for the errors of the values.
//
// 4. Viewports. A driver reads viewport numbers in units of 2^-f pixels, where f is the number of
//    viewport subpixel bits, and no specification says how it rounds. A side that is no multiple of
//    the unit may move by up to one unit, and the far side by up to two if origin and size are
//    rounded separately. Everything above holds for the viewport that the driver uses. That
//    viewport is at most 1 + 2e/W times as large, and shrinks triangles to no less than 1 − 2e/W of
//    their size, where e is cases::Contract::viewport_error. Errors of planes do not depend on the
//    scale of an axis; only distances in pixels grow. In the K of section 3, each |X|
//    (the size in cases::ValueBound, not section 1's X) is at most 1 + 4e/W times as large, because
//    |X| >= |w| W/2 and so |w| e <= 2e/W |X|.
//
// 5. `conformance`. Khronos' verifier (VK-GL-CTS, framework/common/tcuRasterizationVerifier.cpp,
//    TriangleInterpolator) accepts every colour that the weights anywhere in a square give, with
//    each weight ranging separately from its least to its greatest value there. The square is two
//    subpixels wide around the centre, or the whole pixel if it has several samples. The accepted
//    range is rounded outwards to 8 bits, and the colour under test was rounded to 8 bits. So
//    values may be off by 1.5/255 of the largest, plus the change of the weights over such a
//    square. The verifier checks neither depth nor triangles with w <= 0, so `spec` applies
//    to both.
//
// 6. `ieee`. δ is 2^-24, half a unit of a float32 rounded to nearest. Planes may be evaluated about
//    a point as far away as the window's origin, as in Mesa's drivers. For triangles with some
//    w <= 0, `spec` applies: drivers differ too much in how they cut and set these up.
//
// 7. Depth bias. The offset is o = m · slope + r · constant (cases::DepthBias), where m is off by
//    internal/plane_error.cpp's slope_error(). The depths at the vertices, from which m comes, are
//    off by e = (2 + 3) δ Z for the quotient and the depth range, where Z is the largest of them.
//    Both products and their sum take one operation each, so
//
//      |Δo| <= |slope| |Δm| + 2δ (|slope| m + |constant| r) + |constant| Δr.
//
//    In a unorm format Δr = 0, as the contract says what r may be. In float32, r is the power of
//    two below a depth; where an error of e changes that power, Δr is half of the greater r.
//    Clamping adds no error. An implementation may add o to the vertices, so that depths up to
//    Z + |o| are interpolated: Z + |o| takes the place of Z in the bound of depth, and the sum and
//    its rounding take 2δ of that. Both APIs let r be less than any given number, so the unit is
//    open; Mesa's drivers and others have 2^-b or 2^(1−b), which is what `ieee` asks for. A
//    triangle that a plane cuts may be set up in pieces as thin as a rounding to the grid, whose m
//    may be anything: with a slope, nothing is promised about its depths, nor if some w <= 0.

#include "backends/api_promise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "backends/internal/affine_condition.h"
#include "backends/internal/picture_promise.h"
#include "backends/internal/plane_error.h"
#include "backends/internal/primitive_promise.h"
#include "backends/internal/rounded_up.h"
#include "backends/internal/view_clipping.h"

namespace rastercheck::backends {
namespace {

// Numbers of operations, except where noted.
constexpr double kPosition = 4;
constexpr double kCentre = 2;
/// 4δ for t and 3δ for the sum, all of numbers up to twice the greatest magnitude.
constexpr double kClipping = 14;
constexpr double kPerCondition = 55;
constexpr double kQuotient = 2;
constexpr double kDepthRange = 3;
/// 2ω of a range that is at most twice the largest magnitude, plus ω.
constexpr double kNewWeights = 5;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// An error, in units of the last digit, that leaves no digit of a number correct.
constexpr float kAllDigits = 0x1p24F;

/// Number of steps of the 8-bit colours that Khronos' verifier checks.
constexpr double kSteps = 255;
/// How many steps a colour may be off: the verifier rounds its accepted range outwards, by less
/// than one step, and the colour under test was rounded to the nearest.
constexpr double kRounded = 1.5;

/// The assumed precision of single operations, and the range of numbers for which it holds.
struct Arithmetic {
  double operation = 0;  ///< δ
  cases::MagnitudeRange numbers;
};

/// "About one part in 10^5", in magnitudes up to 2^32. Products and quotients of two numbers in
/// this range lie between 2^-32 and 2^32. Products for window positions, whose formula the
/// specifications leave open, are assumed to fit as well.
constexpr Arithmetic kSpecified{1e-5, {0x1p-16F, 0x1p16F}};
/// Products of three numbers in this range, and of such a number with a window position, are normal
/// float32 numbers. Above this range, neighbouring numbers are farther apart than pixels.
constexpr Arithmetic kFloat32{0x1p-24, {0x1p-30F, 0x1p24F}};

const Arithmetic& arithmetic_of(cases::DriverPromise promise) {
  return promise == cases::DriverPromise::ieee ? kFloat32 : kSpecified;
}

/// The greatest magnitude of one quantity over a triangle's vertices.
template <typename Of>
double greatest(const std::array<Vertex, 3>& triangle, const Of& of) {
  return std::max(
      {std::fabs(of(triangle[0])), std::fabs(of(triangle[1])), std::fabs(of(triangle[2]))});
}

/// Bounds the offset that a bias adds to a triangle's depths, in units of depth.
struct Offset {
  double most = 0;  ///< upper bound on the magnitude
  double error = 0;
};

/// Derives the promise for one triangle of a case.
class OneTriangle {
 public:
  OneTriangle(const cases::Case& c, const ApiLimits& limits, cases::DriverPromise promised,
              const cases::Triangle& indices);

  cases::TrianglePromise promise();

 private:
  cases::TrianglePromise promise_without_area(const Clipped& clipped);
  /// True if no vertex is behind the eye.
  bool is_before_the_eye() const {
    return std::all_of(vertices_.begin(), vertices_.end(), [](const Vertex& v) { return v.w > 0; });
  }
  /// True if the promise covers the magnitudes of the triangle's positions and distances.
  bool has_numbers() const {
    return std::all_of(vertices_.begin(), vertices_.end(), [this](const Vertex& v) {
      const auto has = [this](double number) {
        return arithmetic_.numbers.has(static_cast<float>(number));
      };
      return has(v.x) && has(v.y) && has(v.z) && has(v.w) &&
             std::all_of(v.distances.begin(), v.distances.end(), has);
    });
  }
  /// True if `spec` covers the magnitudes of the triangle's attribute values.
  bool has_values_of_spec() const;
  void add_positions(std::span<const Vertex> vertices);
  void add_new_vertices(const Clipped& clipped, double least_w);
  double window_depth(const Vertex& v) const;
  double depth_scale() const;
  Offset offset(const WindowTriangle* window, const Evaluation& evaluation) const;
  double biased(double share, const Offset& offset) const;
  double larger_condition() const;
  void set_values(double of_weights);
  void set_values_by_planes(bool is_cut);
  bool extrapolates(cases::Interpolation interpolation) const;

  const cases::Case* case_;
  ApiLimits limits_;
  cases::DriverPromise promised_;
  Arithmetic arithmetic_;
  cases::Triangle indices_;
  std::array<Vertex, 3> vertices_;
  double viewport_error_ = 0;  ///< e, pixels
  double grown_ = 1;           ///< largest ratio of the viewport's size to the driver's
  double position_ = 0;        ///< error of given vertices, in pixels
  double new_position_ = 0;    ///< error of new vertices, in pixels
  double cut_at_sides_ = 0;    ///< error of new vertices that the viewport's sides make, in pixels
  double new_weight_ = 0;      ///< ω, relative
  std::vector<Vertex> drawn_;  ///< the vertices of the part in the view volume
  cases::TrianglePromise promise_;
};

/// How far the sides of the driver's viewport may lie from the requested sides, in pixels.
double viewport_error(const cases::Viewport& viewport, int subpixel_bits) {
  const double unit = std::ldexp(1.0, -subpixel_bits);
  const auto rounded = [subpixel_bits, unit](double number) {
    const double units = std::ldexp(number, subpixel_bits);
    return units == std::floor(units) ? 0 : unit;
  };
  const auto error = [&rounded](double origin, double size) {
    // The driver may get an upright viewport in place of one with negative size
    // (upright_viewport.h). The upright viewport's origin is origin + size.
    const double from_there = size < 0 ? rounded(origin + size) : 0;
    return std::max(rounded(origin), from_there) + rounded(size);
  };
  return std::max(error(viewport.x, viewport.width), error(viewport.y, viewport.height));
}

/// The greatest relative error of the viewport's width or height.
double share_of_extent(const cases::Viewport& viewport, double error) {
  return 2 * error / double{std::min(std::fabs(viewport.width), std::fabs(viewport.height))};
}

OneTriangle::OneTriangle(const cases::Case& c, const ApiLimits& limits,
                         cases::DriverPromise promised, const cases::Triangle& indices)
    : case_(&c),
      limits_(limits),
      promised_(promised),
      arithmetic_(arithmetic_of(promised)),
      indices_(indices) {
  for (std::size_t i = 0; i < 3; ++i) {
    const cases::ClipVertex& p = c.positions[indices[i]];
    vertices_[i] = {double{p.x}, double{p.y}, double{p.z}, double{p.w}, {}};
    const auto distances = c.clip_distances_of(indices[i]);
    std::copy(distances.begin(), distances.end(), vertices_[i].distances.begin());
  }
  if (!is_before_the_eye()) arithmetic_ = kSpecified;
  viewport_error_ = viewport_error(c.viewport, limits.viewport_subpixel_bits);
  if (viewport_error_ > 0) grown_ = cases::most_growth(c.viewport, viewport_error_);
}

/// Converts an error, given as a share of the largest value, to ulps of that value.
float in_ulps(double share, double more = 0.5) {
  const double ulps = share * kRest * 0x1p24 + more;
  return ulps < double{kAllDigits} ? no_less(ulps) : kAllDigits;
}

cases::TrianglePromise OneTriangle::promise() {
  if (!has_numbers()) {
    promise_.is_made = false;
    return promise_;
  }
  const Clipped clipped = clipped_to_view(*case_, vertices_);
  if (case_->primitive != cases::Primitive::triangles) return promise_without_area(clipped);
  const double of_weights = condition_of(case_->viewport, vertices_) * larger_condition();
  // If rounding can lose the triangle's area, one of its edges may pass through the eye, where
  // clipping divides 0 by 0.
  const bool has_area = kPerCondition * arithmetic_.operation * of_weights < 1;
  const bool is_hidden = clipped.polygon.empty() && has_area;
  if (!is_hidden) {
    add_positions(vertices_);
    add_positions(clipped.polygon);
    double least_w = kInfinity;
    for (const Vertex& v : clipped.polygon) least_w = std::min(least_w, v.w);
    if (!has_area && clipped.planes > 0 && !is_before_the_eye()) least_w = 0;
    if (!(least_w > 0)) {
      // "Division by zero produces an unspecified result": the driver may draw anything anywhere.
      promise_.is_made = false;
      return promise_;
    }
    if (clipped.planes > 0) add_new_vertices(clipped, least_w);
    drawn_ = clipped.polygon;
  }
  const double units = std::ldexp(kRest, limits_.subpixel_bits);
  // Rounding a new vertex to the grid moves the edges that end there by up to a unit. If such an
  // edge is part of an edge between two given vertices, the rounding of the given vertices does not
  // cover this. So a unit is added for triangles that the viewport's sides cut.
  const double rounded = clipped.is_cut_at_the_sides ? 1 : 0;
  const double position = (position_ + cut_at_sides_) * units + rounded;
  const double new_position = (position_ + new_position_) * units + 1;
  if (!(std::max(position, new_position) < double{cases::kMaxPositionError})) {
    promise_.is_made = false;  // may be drawn anywhere
    return promise_;
  }
  promise_.position_error = no_less(position);
  const double of_new = double{no_less(new_position)};
  promise_.clip_tolerance = std::max(of_new - double{promise_.position_error}, 0.0);
  // New vertices may be as far off a viewport side as off an edge.
  if (clipped.is_cut_at_the_sides) promise_.side_tolerance = of_new;
  // The first plane only sees given vertices, whose distances have no error of clipping.
  if (clipped.planes > 1) {
    promise_.clip_error = kRest * clipped.planes * kClipping * arithmetic_.operation;
  }
  if (is_before_the_eye()) {
    set_values_by_planes(clipped.planes > 0);
  } else {
    set_values(has_area && has_values_of_spec() ? of_weights : kInfinity);
  }
  return promise_;
}

/// The promise for a line or a point.
cases::TrianglePromise OneTriangle::promise_without_area(const Clipped& clipped) {
  add_positions(vertices_);
  const double position = position_ * std::ldexp(kRest, limits_.subpixel_bits);
  promise_.is_made = position < double{cases::kMaxPositionError};
  if (!promise_.is_made) return promise_;
  promise_.position_error = no_less(position);
  const bool is_clipped = clipped.planes > 0 || !is_before_the_eye();
  promise_primitive(*case_, promised_, {arithmetic_.operation, depth_scale(), is_clipped},
                    promise_);
  return promise_;
}

bool OneTriangle::has_values_of_spec() const {
  return std::all_of(indices_.begin(), indices_.end(), [this](std::uint32_t vertex) {
    const auto values = case_->attributes_of(vertex);
    return std::all_of(values.begin(), values.end(),
                       [](float value) { return kSpecified.numbers.has(value); });
  });
}

void OneTriangle::add_positions(std::span<const Vertex> vertices) {
  const cases::Viewport& viewport = case_->viewport;
  const auto error = [this](double number, double w, double origin, double extent) {
    const double half = std::fabs(extent) / 2 + viewport_error_;
    const double centre = std::fabs(origin + extent / 2) + viewport_error_;
    return arithmetic_.operation * (kPosition * std::fabs(number / w) * half + kCentre * centre);
  };
  for (const Vertex& v : vertices) {
    if (v.w <= 0) continue;  // clipped away
    position_ = std::max({position_, error(v.x, v.w, double{viewport.x}, double{viewport.width}),
                          error(v.y, v.w, double{viewport.y}, double{viewport.height})});
  }
}

void OneTriangle::add_new_vertices(const Clipped& clipped, double least_w) {
  const cases::Viewport& viewport = case_->viewport;
  const double greatest_w = greatest(vertices_, [](const Vertex& v) { return v.w; });
  const double x = greatest(vertices_, [](const Vertex& v) { return v.x; });
  const double y = greatest(vertices_, [](const Vertex& v) { return v.y; });
  const double share = clipped.planes * kClipping * arithmetic_.operation / least_w;
  new_position_ =
      share * std::max((x + greatest_w) * (std::fabs(viewport.width) / 2.0 + viewport_error_),
                       (y + greatest_w) * (std::fabs(viewport.height) / 2.0 + viewport_error_));
  if (clipped.is_cut_at_the_sides) cut_at_sides_ = new_position_;
  const double z = greatest(vertices_, [](const Vertex& v) { return v.z; });
  new_weight_ = share * std::max(greatest_w, z);
}

/// The depth z/w in the depth range, if w is not 0.
double OneTriangle::window_depth(const Vertex& v) const {
  const double n = double{case_->viewport.min_depth};
  const double f = double{case_->viewport.max_depth};
  const double z = v.z / v.w;
  const double share = case_->rules == cases::Rules::opengl ? (z + 1) / 2 : z;
  return n + (f - n) * share;
}

/// How many times the depths at the vertices exceed the larger end of the depth range, the scale of
/// depth errors; at least 1.
double OneTriangle::depth_scale() const {
  const double range = double{std::max(case_->viewport.min_depth, case_->viewport.max_depth)};
  double most = range;
  for (const Vertex& v : vertices_) {
    if (v.w != 0) most = std::max(most, std::fabs(window_depth(v)));
  }
  return range > 0 ? most / range : 1;
}

/// The unit of a float32 depth, 2^(e−23) where 2^e is the power of two below it.
double unit_of_float(double depth) {
  return depth > 0 ? std::ldexp(1.0, std::max(std::ilogb(depth), -126) - 23) : 0;
}

/// `window` is nullptr if the triangle's slope is not known.
Offset OneTriangle::offset(const WindowTriangle* window, const Evaluation& evaluation) const {
  const cases::DepthBias& bias = case_->depth_bias;
  if (bias.is_none()) return {};
  const double operation = arithmetic_.operation;
  const double range = double{std::max(case_->viewport.min_depth, case_->viewport.max_depth)};
  const double of_depth = (kQuotient + kDepthRange) * operation * depth_scale() * range;  // e
  Offset all;
  if (bias.slope != 0) {
    if (window == nullptr) return {kInfinity, kInfinity};
    const std::array<double, 3> depths{window_depth(vertices_[0]), window_depth(vertices_[1]),
                                       window_depth(vertices_[2])};
    const SlopeError slope = slope_error(*window, depths, of_depth, evaluation);
    all.most = std::fabs(double{bias.slope}) * (slope.most + slope.error);
    all.error = std::fabs(double{bias.slope}) * slope.error;
  }
  const double constant = std::fabs(double{bias.constant});
  const int bits = cases::unorm_bits(case_->depth_format);
  const double unit =
      bits > 0 ? std::ldexp(1.0, 1 - bits) : unit_of_float(depth_scale() * range + of_depth);
  all.most += constant * unit;
  all.error += 2 * operation * all.most;
  if (bits > 0) return all;
  double unit_error = 0;  // Δr
  const auto add_unit_error = [&](double depth) {
    unit_error = std::max(unit_error, unit_of_float(depth + of_depth) -
                                          unit_of_float(std::max(depth - of_depth, 0.0)));
  };
  // Whether the depth that r belongs to is clamped is open.
  const auto add_vertex = [&](const Vertex& v) {
    if (!(v.w > 0)) return;
    const double depth = std::fabs(window_depth(v));
    add_unit_error(depth);
    add_unit_error(std::min(depth, range));
  };
  std::for_each(vertices_.begin(), vertices_.end(), add_vertex);
  std::for_each(drawn_.begin(), drawn_.end(), add_vertex);
  all.error += constant * unit_error;
  return all;
}

/// The error of depth, as a share of the depth range's larger end, if `share` is the error as a
/// share of the largest depth without the offset.
double OneTriangle::biased(double share, const Offset& offset) const {
  if (case_->depth_bias.is_none()) return depth_scale() * share;
  const double range = double{std::max(case_->viewport.min_depth, case_->viewport.max_depth)};
  if (!(range > 0)) return kInfinity;
  return (depth_scale() + offset.most / range) * (share + 2 * arithmetic_.operation) +
         offset.error / range;
}

/// The factor by which K may grow because the driver's viewport differs slightly.
double OneTriangle::larger_condition() const {
  if (viewport_error_ == 0) return 1;
  const double along_one = grown_ * (1 + 2 * share_of_extent(case_->viewport, viewport_error_));
  return along_one * along_one;
}

/// `of_weights` is the K that applies to depth.
void OneTriangle::set_values(double of_weights) {
  const double new_weights = kNewWeights * new_weight_;
  cases::ValueBound value;
  // For a triangle without area, only the constant counts.
  value.constant = of_weights < kInfinity ? in_ulps(kQuotient * arithmetic_.operation + new_weights)
                                          : kAllDigits;
  value.per_condition = in_ulps(kPerCondition * arithmetic_.operation * larger_condition(), 0);
  promise_.bounds = {value, value, {}};
  const double of_depth =
      (kPerCondition * of_weights + kQuotient + kDepthRange) * arithmetic_.operation + new_weights;
  promise_.bounds.depth.constant = in_ulps(biased(of_depth, offset(nullptr, {})));
}

/// True if an attribute with this interpolation may be evaluated outside the triangle.
bool OneTriangle::extrapolates(cases::Interpolation interpolation) const {
  return case_->framebuffer.samples > 1 &&
         std::any_of(case_->attributes.begin(), case_->attributes.end(),
                     [interpolation](const cases::Attribute& attribute) {
                       return attribute.interpolation == interpolation &&
                              attribute.location == cases::Location::center;
                     });
}

/// The greatest distance, along each axis, from any corner of the framebuffer to any place in the
/// triangle's bounding box. Every corner counts, because any of them may be the window's origin.
std::array<double, 2> from_origin(const WindowTriangle& triangle,
                                  const cases::FramebufferSize& size) {
  const auto farthest = [](const std::array<double, 3>& at, int extent) {
    double most = 0;
    for (const double place : at) {
      most = std::max({most, std::fabs(place), std::fabs(extent - place)});
    }
    return most;
  };
  return {farthest(triangle.x, size.width), farthest(triangle.y, size.height)};
}

void OneTriangle::set_values_by_planes(bool is_cut) {
  const cases::Viewport& viewport = case_->viewport;
  WindowTriangle window;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vertex& v = vertices_[i];
    window.x[i] = (v.x / v.w + 1) * double{viewport.width} / 2 + double{viewport.x};
    window.y[i] = (v.y / v.w + 1) * double{viewport.height} / 2 + double{viewport.y};
    window.w[i] = v.w;
  }
  // A given vertex is rounded to a grid point next to its computed position. A new vertex is off by
  // up to the clip tolerance.
  const double unit = std::ldexp(1.0, -limits_.subpixel_bits);
  const double reach =
      (std::max(1.0, promise_.clip_tolerance) + double{promise_.position_error}) * unit * grown_;
  Evaluation evaluation{arithmetic_.operation, {}, reach, 0};
  if (promised_ == cases::DriverPromise::ieee) {
    evaluation.away = from_origin(window, case_->framebuffer);
    for (double& distance : evaluation.away) distance = (distance + viewport_error_) * grown_;
  }
  // Pieces of a cut triangle may cover samples outside the triangle of the rounded given vertices,
  // because given and new vertices may move in opposite directions.
  const double outside = is_cut ? reach : 0;
  WindowTriangle flat = window;
  flat.w = {1, 1, 1};
  const double open = kNewWeights * new_weight_ + weight_change(window, reach, outside);
  const double open_affine = kNewWeights * new_weight_ + weight_change(flat, reach, outside);
  const auto error_of = [&](bool extrapolates) {
    // A sample is at most half a pixel from the centre.
    evaluation.beyond = std::max(2 * outside, extrapolates ? 0.5 * grown_ : 0);
    return plane_error(window, evaluation);
  };
  const PlaneError smooth = error_of(extrapolates(cases::Interpolation::smooth));
  const PlaneError noperspective = error_of(extrapolates(cases::Interpolation::noperspective));
  const PlaneError depth = error_of(false);
  promise_.bounds.smooth = {in_ulps(smooth.constant + open), in_ulps(smooth.per_horizon, 0)};
  promise_.bounds.noperspective = {in_ulps(noperspective.affine + open_affine)};
  const double of_depth =
      depth.affine + (kQuotient + kDepthRange) * arithmetic_.operation + open_affine;
  promise_.bounds.depth = {
      in_ulps(biased(of_depth, offset(is_cut ? nullptr : &window, evaluation)))};
  if (promised_ != cases::DriverPromise::conformance) return;
  const double around = (case_->framebuffer.samples > 1 ? 1 : unit) * grown_;
  promise_.bounds.smooth = {
      in_ulps(kRounded / kSteps + open + weight_change(window, reach, around))};
  promise_.bounds.noperspective = {
      in_ulps(kRounded / kSteps + open_affine + weight_change(flat, reach, around))};
}

/// Replaces `all` by the weaker of two promises.
void weaken(cases::ValueBound& all, const cases::ValueBound& one) {
  all.constant = std::max(all.constant, one.constant);
  all.per_horizon = std::max(all.per_horizon, one.per_horizon);
  all.per_condition = std::max(all.per_condition, one.per_condition);
}

}  // namespace

cases::Contract api_promise(const cases::Case& c, const ApiLimits& limits,
                            cases::DriverPromise promised) {
  const Arithmetic& arithmetic = arithmetic_of(promised);
  cases::Contract contract = cases::contract_of(c);
  contract.numbers = arithmetic.numbers;
  contract.basis = cases::Basis::unspecified;
  contract.tie_rule = cases::TieRule::unspecified;
  contract.is_on_grid = false;
  contract.depth_store = cases::DepthStore::either;
  contract.depth_bias = {cases::BiasSlope::between,
                         promised == cases::DriverPromise::ieee ? cases::BiasUnit::either_power
                                                                : cases::BiasUnit::open,
                         cases::BiasExponent::open};
  contract.keeps_sign_of_zero = false;
  contract.is_invariant = false;
  contract.viewport_error = viewport_error(c.viewport, limits.viewport_subpixel_bits);
  contract.coverage = cases::Snapping{limits.subpixel_bits, cases::Rounding::unspecified, 0};
  promise_pictures(c, limits, promised, arithmetic.operation, contract);
  // For a case without triangles, the contract is the strictest that any triangle can have.
  contract.bounds = {{in_ulps(kQuotient * arithmetic.operation), in_ulps(arithmetic.operation, 0)},
                     {in_ulps(arithmetic.operation)},
                     {in_ulps(kDepthRange * arithmetic.operation)}};
  std::vector<cases::TrianglePromise> triangles;
  triangles.reserve(c.triangles.size());
  for (std::size_t t = 0; t < c.triangles.size(); ++t) {
    cases::TrianglePromise promise;
    if (cases::promise_of(contract, c, t).is_made) {
      promise = OneTriangle(c, limits, promised, c.triangles[t]).promise();
    } else {
      promise.is_made = false;
    }
    triangles.push_back(promise);
    if (!promise.is_made) continue;
    contract.coverage->position_error =
        std::max(contract.coverage->position_error, promise.position_error);
    contract.clip_tolerance = std::max(contract.clip_tolerance, promise.clip_tolerance);
    contract.clip_error = std::max(contract.clip_error, promise.clip_error);
    weaken(contract.bounds.smooth, promise.bounds.smooth);
    weaken(contract.bounds.noperspective, promise.bounds.noperspective);
    weaken(contract.bounds.depth, promise.bounds.depth);
  }
  contract.triangles = std::move(triangles);
  return contract;
}

}  // namespace rastercheck::backends
