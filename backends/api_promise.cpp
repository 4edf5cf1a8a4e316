// The bounds of api_promise(), triangle by triangle. Throughout, δ is the error of one operation,
// relative to its result. What is counted is of first order in δ; kRest makes up for the rest, but
// for quotients of section 3, and for computing the bounds themselves in double.
//
// What is taken for granted of an implementation: it clips only by planes that a given vertex is
// beyond, computes positions and weights by the formulas below or better ones, and the products on
// the way to them have room in its numbers. Pieces of clipped triangles are set up as if by the
// planes of the whole: where an implementation sets up each piece by itself, this may be too
// strict.
//
// 1. Window positions. X = x · (1/w) · W/2 + (x0 + W/2) is five operations: three for the product,
//    one for the centre, one for the sum, which is off by δ|X|. So |ΔX| <= 4δ |x/w W/2| +
//    2δ |x0 + W/2|, and alike Y. Then the position is rounded to one of its neighbours on the grid.
//
// 2. New vertices. Both APIs clip to the view volume, |x| <= w, |y| <= w, z as the rules have it,
//    and by clip distances. Where a plane parts a from b: the distances of both (δ each; they have
//    opposite signs, so that their difference loses nothing), t = d_a/(d_a − d_b) (4δ with the
//    difference and the quotient) and a + t (b − a) (the difference, the product and the sum: 3δ
//    more, of numbers of at most 2 max|·|): off by kClipping δ m with m the greatest |·| of the
//    triangle's vertices. What comes of a plane is a mean of what came before, so errors of the
//    planes add up. Divided by w_c >= w_least of what is left, within the view volume, where
//    |x_c/w_c| <= 1, a new vertex is off by
//
//      planes · kClipping δ (max|x| + max|w|)/w_least · W/2 pixels,
//
//    the distance from a plane that cuts it as well by planes · kClipping δ (max|z| + max|w|), or
//    as much of its clip distances, and its w by ω = planes · kClipping δ max|w|/w_least of itself,
//    alike z and attributes.
//
// 3. Values. Where w > 0 at all vertices they are those of planes over the window's triangle, with
//    the errors that internal/plane_error.cpp derives. Position errors, which move vertices, are
//    made up for by coverage and basis, which leave values open between placements.
//
//    Where some w <= 0 there is no such triangle; evaluated by planes about the window's origin, in
//    clip space, the weight of vertex i is a sum of terms each of which has seen at most 2 · 5
//    operations on the way to two positions, the product, the difference, the product with u and
//    two sums: 15δ. Multiplied by r_i and summed: 4δ more in the numerator, 3δ in the denominator;
//    the quotient 2δ. All errors of both sums are of terms whose magnitudes sum to K times the
//    denominator (cases::ValueBound), so
//
//      |Δr| <= (19 + 18) δ K / (1 − 18 δ K) max|r| + 2δ |r|,
//
//    and 37 / (1 − 18 δ K) <= 55 as long as 55 δ K <= 1; beyond that nothing is promised.
//
//    An ulp(max|r|) is at least 2^-24 max|r|. Of depth the same, with the K of affine weights, and
//    three operations for the depth range. Weights of vertices whose w is off by ω are off by ω:
//    r, a mean of the values there, by 2ω of their range, and by ω max|r| for these.
//
// 4. Viewports. A driver reads their numbers in parts of 2^-f pixel, f its viewports' subpixel
//    bits, and no text says how it rounds: a side that is no such part may lie up to one away, the
//    far one up to two where origin and size are rounded each for itself. Everything above is of
//    the viewport that is drawn by, which is at most 1 + 2e/W times as large and shrinks triangles
//    to 1 − 2e/W at most (cases::Contract::viewport_error, e). What planes are off by does not
//    depend on the scale of an axis, only distances in pixels count for more. In K of section 3
//    each |X| is at most 1 + 4e/W times as large, as |w| e <= 2e/W |X|.
//
// 5. `conformance`. Khronos' verifier (VK-GL-CTS, framework/common/tcuRasterizationVerifier.cpp,
//    TriangleInterpolator) takes a colour for right that the weights anywhere in a square give,
//    each weight for itself from its least to its greatest there: two subpixels wide around the
//    centre, or with several samples the pixel. What it allows is rounded outwards to 8 bits, and
//    the colour that it looks at was rounded to 8. So values may be off by 1.5/255 of the largest
//    and by as much as weights differ over such a square. It looks at no depth, nor at triangles
//    with w <= 0: these are held to what `spec` says.
//
// 6. `ieee`. δ is 2^-24, the half unit of a float32 that is rounded to nearest. Planes may be
//    evaluated about a point as far away as the window's origin, as Mesa's drivers do it. Triangles
//    with some w <= 0 are held to what `spec` says: how these are cut and set up differs too much.

#include "backends/api_promise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "backends/internal/plane_error.h"

namespace rastercheck::backends {
namespace {

constexpr double kRest = 1.01;

// Numbers of operations.
constexpr double kPosition = 4;
constexpr double kCentre = 2;
/// 4δ of t and 3δ of the sum, each of twice the greatest number.
constexpr double kClipping = 14;
constexpr double kPerCondition = 55;
constexpr double kQuotient = 2;
constexpr double kDepthRange = 3;
/// 2ω of a range that is at most twice the magnitude, and ω.
constexpr double kNewWeights = 5;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// All digits of a number, in units of the last.
constexpr float kAllDigits = 0x1p24F;

/// Steps of the colours that Khronos' verifier looks at.
constexpr double kSteps = 255;
/// By how many of them a colour may be off: the verifier rounds what it allows outwards, by less
/// than one, and what it is held against has been rounded to the nearest.
constexpr double kRounded = 1.5;

/// Says how precise single operations are assumed to be, and of which numbers.
struct Arithmetic {
  double operation = 0;  ///< δ
  cases::MagnitudeRange numbers;
};

/// "About one part in 10^5", in numbers up to 2^32: products and quotients of two of these lie
/// within 2^-32 and 2^32; those of window positions, which the specifications do not write down,
/// are taken to have room as well.
constexpr Arithmetic kSpecified{1e-5, {0x1p-16F, 0x1p16F}};
/// Products of three of these, and of a window position, are normal float32 numbers. Larger ones
/// are farther apart than pixels.
constexpr Arithmetic kFloat32{0x1p-24, {0x1p-30F, 0x1p24F}};

const Arithmetic& arithmetic_of(cases::DriverPromise promise) {
  return promise == cases::DriverPromise::ieee ? kFloat32 : kSpecified;
}

/// A vertex in clip space with its clip distances.
struct Vertex {
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 0;
  std::array<double, cases::kMaxClipDistances> distances{};
};

/// A function of a vertex that is not negative on the near side of a clip plane.
using Plane = double (*)(const Vertex& v, std::size_t index);

Vertex mean(const Vertex& a, const Vertex& b, double t) {
  const auto between = [t](double from, double to) { return from + t * (to - from); };
  Vertex c{between(a.x, b.x), between(a.y, b.y), between(a.z, b.z), between(a.w, b.w), {}};
  for (std::size_t i = 0; i < c.distances.size(); ++i) {
    c.distances[i] = between(a.distances[i], b.distances[i]);
  }
  return c;
}

/// What is left of a triangle in the view volume, or was before the plane that left nothing, and
/// how many planes have cut it.
struct Clipped {
  std::vector<Vertex> polygon;
  int planes = 0;
  bool is_cut_at_the_sides = false;
  bool is_empty = false;
};

void clip_by(Clipped& clipped, Plane plane, std::size_t index, bool is_side) {
  if (clipped.is_empty) return;
  std::vector<Vertex> left;
  bool cuts = false;
  const std::vector<Vertex>& all = clipped.polygon;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vertex& a = all[i];
    const Vertex& b = all[(i + 1) % all.size()];
    const double at_a = plane(a, index);
    const double at_b = plane(b, index);
    if (at_a >= 0) left.push_back(a);
    if ((at_a < 0) != (at_b < 0)) left.push_back(mean(a, b, at_a / (at_a - at_b)));
    cuts = cuts || at_a < 0;
  }
  clipped.planes += cuts ? 1 : 0;
  clipped.is_cut_at_the_sides = clipped.is_cut_at_the_sides || (cuts && is_side);
  clipped.is_empty = left.empty();
  // After another plane, whose new vertices are a little off, something may be left all the same.
  if (!clipped.is_empty || clipped.planes == 1) clipped.polygon = std::move(left);
}

Clipped clipped_to_view(const cases::Case& c, const std::array<Vertex, 3>& triangle) {
  Clipped clipped{{triangle.begin(), triangle.end()}};
  constexpr std::array<Plane, 4> kSides{[](const Vertex& v, std::size_t) { return v.w + v.x; },
                                        [](const Vertex& v, std::size_t) { return v.w - v.x; },
                                        [](const Vertex& v, std::size_t) { return v.w + v.y; },
                                        [](const Vertex& v, std::size_t) { return v.w - v.y; }};
  if (!c.depth_clamp) {
    const bool from_minus_one = c.rules == cases::Rules::opengl;
    const Plane near = [](const Vertex& v, std::size_t) { return v.z; };
    const Plane near_of_opengl = [](const Vertex& v, std::size_t) { return v.w + v.z; };
    clip_by(clipped, from_minus_one ? near_of_opengl : near, 0, false);
    clip_by(
        clipped, [](const Vertex& v, std::size_t) { return v.w - v.z; }, 0, false);
  }
  for (std::size_t i = 0; i < c.clip_distance_count; ++i) {
    clip_by(
        clipped, [](const Vertex& v, std::size_t index) { return v.distances[index]; }, i, false);
  }
  for (const Plane side : kSides) clip_by(clipped, side, 0, true);
  return clipped;
}

/// The greatest magnitude of a number of a triangle's vertices.
template <typename Of>
double greatest(const std::array<Vertex, 3>& triangle, const Of& of) {
  return std::max(
      {std::fabs(of(triangle[0])), std::fabs(of(triangle[1])), std::fabs(of(triangle[2]))});
}

/// K of the affine weights (cases::ValueBound) at the corner of the viewport farthest from the
/// window's origin, where it is greatest.
double condition_of(const cases::Viewport& viewport, const std::array<Vertex, 3>& triangle) {
  const auto farthest = [](float from, float extent) {
    return std::max(std::fabs(double{from}), std::fabs(double{from} + double{extent}));
  };
  const double u = farthest(viewport.x, viewport.width);
  const double v = farthest(viewport.y, viewport.height);
  std::array<std::array<double, 3>, 3> size{};
  std::array<std::array<double, 3>, 3> column{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vertex& p = triangle[i];
    const double half_w = double{viewport.width} / 2;
    const double half_h = double{viewport.height} / 2;
    column[i] = {p.x * half_w + p.w * (double{viewport.x} + half_w),
                 p.y * half_h + p.w * (double{viewport.y} + half_h), p.w};
    size[i] = {std::fabs(p.x * half_w) +
                   std::fabs(p.w) * (std::fabs(double{viewport.x}) + std::fabs(half_w)),
               std::fabs(p.y * half_h) +
                   std::fabs(p.w) * (std::fabs(double{viewport.y}) + std::fabs(half_h)),
               std::fabs(p.w)};
  }
  double determinant = 0;
  double sizes = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& a = column[(i + 1) % 3];
    const auto& b = column[(i + 2) % 3];
    determinant += column[i][2] * (a[0] * b[1] - a[1] * b[0]);
    const auto& [x_j, y_j, w_j] = size[(i + 1) % 3];
    const auto& [x_k, y_k, w_k] = size[(i + 2) % 3];
    sizes += size[i][2] *
             ((y_j * w_k + y_k * w_j) * u + (x_j * w_k + x_k * w_j) * v + x_j * y_k + x_k * y_j);
  }
  return sizes / std::fabs(determinant);
}

/// A triangle of a case, and what is promised of it.
class OneTriangle {
 public:
  OneTriangle(const cases::Case& c, const ApiLimits& limits, cases::DriverPromise promised,
              const cases::Triangle& indices);

  cases::TrianglePromise promise();

 private:
  /// Whether no vertex is behind the eye.
  bool is_before_the_eye() const {
    return std::all_of(vertices_.begin(), vertices_.end(), [](const Vertex& v) { return v.w > 0; });
  }
  /// Whether its positions and distances are numbers that something is promised of.
  bool has_numbers() const {
    return std::all_of(vertices_.begin(), vertices_.end(), [this](const Vertex& v) {
      const auto has = [this](double number) {
        return arithmetic_.numbers.has(static_cast<float>(number));
      };
      return has(v.x) && has(v.y) && has(v.z) && has(v.w) &&
             std::all_of(v.distances.begin(), v.distances.end(), has);
    });
  }
  /// Whether its attributes' values are numbers that `spec` promises something of.
  bool has_values_of_spec() const;
  void add_positions(std::span<const Vertex> vertices);
  void add_new_vertices(const Clipped& clipped, double least_w);
  double depth_scale() const;
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
  double grown_ = 1;           ///< how much more a pixel is where the viewport is the smallest
  double position_ = 0;        ///< error of given vertices, pixels
  double new_position_ = 0;    ///< of new ones, pixels
  double cut_at_sides_ = 0;    ///< of those of a triangle that the viewport's sides cut
  double new_weight_ = 0;      ///< ω, of itself
  cases::TrianglePromise promise_;
};

/// How far the sides of a viewport may lie from where they were asked for, in pixels.
double viewport_error(const cases::Viewport& viewport, int subpixel_bits) {
  const double unit = std::ldexp(1.0, -subpixel_bits);
  const auto rounded = [subpixel_bits, unit](double number) {
    const double units = std::ldexp(number, subpixel_bits);
    return units == std::floor(units) ? 0 : unit;
  };
  const auto error = [&rounded](double origin, double size) {
    // One of negative size may be drawn turned round (upright_viewport.h), from its other side.
    const double from_there = size < 0 ? rounded(origin + size) : 0;
    return std::max(rounded(origin), from_there) + rounded(size);
  };
  return std::max(error(viewport.x, viewport.width), error(viewport.y, viewport.height));
}

/// How much of its size an extent of the viewport is off at most.
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

/// A float32 that is no less.
float no_less(double bound) {
  return std::nextafter(static_cast<float>(bound), std::numeric_limits<float>::max());
}

/// An error that is a share of the largest value, in ulp of that.
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
  const double of_weights = condition_of(case_->viewport, vertices_) * larger_condition();
  // An edge of a triangle whose area is lost in rounding may pass through the eye, where cutting it
  // divides 0 by 0.
  const bool has_area = kPerCondition * arithmetic_.operation * of_weights < 1;
  const bool is_hidden = clipped.polygon.empty() && has_area;
  if (!is_hidden) {
    add_positions(vertices_);
    add_positions(clipped.polygon);
    double least_w = kInfinity;
    for (const Vertex& v : clipped.polygon) least_w = std::min(least_w, v.w);
    if (!has_area && clipped.planes > 0 && !is_before_the_eye()) least_w = 0;
    if (!(least_w > 0)) {
      // "Division by zero produces an unspecified result": anything may be drawn, and anywhere.
      promise_.is_made = false;
      return promise_;
    }
    if (clipped.planes > 0) add_new_vertices(clipped, least_w);
  }
  const double units = std::ldexp(kRest, limits_.subpixel_bits);
  // A new vertex is rounded to the grid as well, and takes the edges along that it lies on, those
  // of given vertices among them, by a unit whichever way these are rounded.
  const double rounded = clipped.is_cut_at_the_sides ? 1 : 0;
  const double position = (position_ + cut_at_sides_) * units + rounded;
  const double new_position = (position_ + new_position_) * units + 1;
  if (!(std::max(position, new_position) < double{cases::kMaxPositionError})) {
    promise_.is_made = false;  // it may be drawn anywhere
    return promise_;
  }
  promise_.position_error = no_less(position);
  const double of_new = double{no_less(new_position)};
  promise_.clip_tolerance = std::max(of_new - double{promise_.position_error}, 0.0);
  // New vertices lie beside the side as far as they do beside an edge.
  if (clipped.is_cut_at_the_sides) promise_.side_tolerance = of_new;
  // The first plane cuts by exact distances.
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
    if (v.w <= 0) continue;  // it is cut off
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

/// How much larger the vertices' depths are than the range that errors of depth are measured by.
double OneTriangle::depth_scale() const {
  const double n = double{case_->viewport.min_depth};
  const double f = double{case_->viewport.max_depth};
  const double range = std::max(n, f);
  double most = range;
  for (const Vertex& v : vertices_) {
    if (v.w == 0) continue;
    const double z = v.z / v.w;
    const double share = case_->rules == cases::Rules::opengl ? (z + 1) / 2 : z;
    most = std::max(most, std::fabs(n + (f - n) * share));
  }
  return range > 0 ? most / range : 1;
}

/// How many times larger K may be in another viewport that may be drawn by.
double OneTriangle::larger_condition() const {
  if (viewport_error_ == 0) return 1;
  const double along_one = grown_ * (1 + 2 * share_of_extent(case_->viewport, viewport_error_));
  return along_one * along_one;
}

/// `of_weights`: K of depth.
void OneTriangle::set_values(double of_weights) {
  const double new_weights = kNewWeights * new_weight_;
  cases::ValueBound value;
  // Only the constant counts for a triangle without area.
  value.constant = of_weights < kInfinity ? in_ulps(kQuotient * arithmetic_.operation + new_weights)
                                          : kAllDigits;
  value.per_condition = in_ulps(kPerCondition * arithmetic_.operation * larger_condition(), 0);
  promise_.bounds = {value, value, {}};
  promise_.bounds.depth.constant =
      in_ulps(depth_scale() *
              ((kPerCondition * of_weights + kQuotient + kDepthRange) * arithmetic_.operation +
               new_weights));
}

/// Whether values of an attribute that varies so may be asked for outside the triangle.
bool OneTriangle::extrapolates(cases::Interpolation interpolation) const {
  return case_->framebuffer.samples > 1 &&
         std::any_of(case_->attributes.begin(), case_->attributes.end(),
                     [interpolation](const cases::Attribute& attribute) {
                       return attribute.interpolation == interpolation &&
                              attribute.location == cases::Location::center;
                     });
}

/// The farthest that a corner of the framebuffer, whichever is taken for the window's origin, may
/// be from a place of the triangle's box, along each axis.
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
  // A vertex is rounded to a neighbour on the grid from where it is computed; a new one is as far
  // off as the tolerance.
  const double unit = std::ldexp(1.0, -limits_.subpixel_bits);
  const double reach =
      (std::max(1.0, promise_.clip_tolerance) + double{promise_.position_error}) * unit * grown_;
  Evaluation evaluation{arithmetic_.operation, {}, reach, 0};
  if (promised_ == cases::DriverPromise::ieee) {
    evaluation.away = from_origin(window, case_->framebuffer);
    for (double& distance : evaluation.away) distance = (distance + viewport_error_) * grown_;
  }
  // Pieces of a cut triangle hold samples that lie outside the triangle as its vertices are placed:
  // by as much as these are moved one way and new ones the other.
  const double outside = is_cut ? reach : 0;
  WindowTriangle flat = window;
  flat.w = {1, 1, 1};
  const double open = kNewWeights * new_weight_ + weight_change(window, reach, outside);
  const double open_affine = kNewWeights * new_weight_ + weight_change(flat, reach, outside);
  const auto error_of = [&](bool extrapolates) {
    // A sample's place is at most half a pixel from the centre.
    evaluation.beyond = std::max(2 * outside, extrapolates ? 0.5 * grown_ : 0);
    return plane_error(window, evaluation);
  };
  const PlaneError smooth = error_of(extrapolates(cases::Interpolation::smooth));
  const PlaneError noperspective = error_of(extrapolates(cases::Interpolation::noperspective));
  const PlaneError depth = error_of(false);
  promise_.bounds.smooth = {in_ulps(smooth.constant + open), in_ulps(smooth.per_horizon, 0)};
  promise_.bounds.noperspective = {in_ulps(noperspective.affine + open_affine)};
  promise_.bounds.depth = {
      in_ulps(depth_scale() *
              (depth.affine + (kQuotient + kDepthRange) * arithmetic_.operation + open_affine))};
  if (promised_ != cases::DriverPromise::conformance) return;
  const double around = (case_->framebuffer.samples > 1 ? 1 : unit) * grown_;
  promise_.bounds.smooth = {
      in_ulps(kRounded / kSteps + open + weight_change(window, reach, around))};
  promise_.bounds.noperspective = {
      in_ulps(kRounded / kSteps + open_affine + weight_change(flat, reach, around))};
}

/// The weakest of two promises.
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
  contract.keeps_sign_of_zero = false;
  contract.is_invariant = false;
  contract.viewport_error = viewport_error(c.viewport, limits.viewport_subpixel_bits);
  contract.coverage = cases::Snapping{limits.subpixel_bits, cases::Rounding::unspecified, 0};
  // A case without triangles leaves open what any triangle leaves open at least.
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
