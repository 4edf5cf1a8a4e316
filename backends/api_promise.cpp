// The bounds of api_promise(). Throughout, δ is the error of one operation, relative to its result.
// What is counted is of first order in δ; kRest makes up for the rest, but for the quotient of
// section 3, and for computing the bounds themselves in double.
//
// What is taken for granted of an implementation: it clips only by planes that a given vertex is
// beyond, computes positions and weights by the formulas below or better ones, and the products on
// the way to them have room in its numbers. Of clipped triangles K is that of the whole, as if
// their pieces were set up by its planes.
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
// 3. Attributes. With window positions X/w, the weight of vertex i is an area, a sum of products of
//    coordinates. Evaluated as A u + B v + C with coefficients that are differences of products,
//    each of its terms has seen at most 2 · 5 operations on the way to two positions, the product,
//    the difference, the product with u and two sums: 15δ. Divided by w_i and multiplied by r_i,
//    and summed: 4δ more in the numerator, 3δ in the denominator; the quotient 2δ. All errors of
//    both sums are of terms whose magnitudes sum to K times the denominator (cases::ValueBound), so
//
//      |Δr| <= (19 + 18) δ K / (1 − 18 δ K) max|r| + 2δ |r|,
//
//    and 37 / (1 − 18 δ K) <= 55 as long as 55 δ K <= 1; beyond that nothing is promised.
//    An ulp(max|r|) is at least 2^-24 max|r|. Of depth the same, with the K of affine weights, and
//    three operations for the depth range. Weights of vertices whose w is off by ω are off by ω:
//    r, a mean of the values there, by 2ω of their range, and by ω max|r| for these.

#include "backends/api_promise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace rastercheck::backends {
namespace {

/// What the specifications call about one part in 10^5.
constexpr double kOperation = 1e-5;
constexpr double kRest = 1.01;
/// The same in units of the last place, of which 2^24 make up a number.
constexpr double kOperationInUlps = kRest * kOperation * 0x1p24;

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

/// Products and quotients of two such numbers lie within 2^-32 and 2^32; those of window positions,
/// which the specifications do not write down, are taken to have room as well.
constexpr cases::MagnitudeRange kNumbers{0x1p-16F, 0x1p16F};

/// No number but 0.
constexpr cases::MagnitudeRange kNone{std::numeric_limits<float>::max(), 0};

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

/// How far off the numbers of a case's triangles may be, the most of all.
struct Errors {
  double position = 0;      ///< of given vertices, pixels
  double new_position = 0;  ///< of new ones, pixels
  double cut_at_sides = 0;  ///< of those of triangles that the viewport's sides cut
  double new_weight = 0;    ///< ω, of itself
  double condition = 0;     ///< K of depth
  int planes = 0;           ///< that cut a triangle
  bool divides_by_zero = false;

  void add(const cases::Case& c, const std::array<Vertex, 3>& triangle);

 private:
  void add_positions(const cases::Viewport& viewport, std::span<const Vertex> vertices);
};

void Errors::add(const cases::Case& c, const std::array<Vertex, 3>& triangle) {
  const Clipped clipped = clipped_to_view(c, triangle);
  const cases::Viewport& viewport = c.viewport;
  const double of_weights = condition_of(viewport, triangle);
  // Of no more area than numbers tell: values have no digits left, and an edge may pass through the
  // eye, where cutting it divides 0 by 0.
  const bool has_area = kPerCondition * kOperation * of_weights < 1;
  if (clipped.polygon.empty() && has_area) return;
  add_positions(viewport, triangle);
  add_positions(viewport, clipped.polygon);
  condition = has_area ? std::max(condition, of_weights) : kInfinity;
  double least_w = kInfinity;
  for (const Vertex& v : clipped.polygon) least_w = std::min(least_w, v.w);
  if (!has_area && clipped.planes > 0) least_w = 0;
  planes = std::max(planes, clipped.planes);
  if (!(least_w > 0)) {
    divides_by_zero = true;
    return;
  }
  if (clipped.planes == 0) return;
  const double greatest_w = greatest(triangle, [](const Vertex& v) { return v.w; });
  const double x = greatest(triangle, [](const Vertex& v) { return v.x; });
  const double y = greatest(triangle, [](const Vertex& v) { return v.y; });
  const double share = clipped.planes * kClipping * kOperation / least_w;
  const double pixels = share *
                        std::max((x + greatest_w) * std::fabs(double{viewport.width}),
                                 (y + greatest_w) * std::fabs(double{viewport.height})) /
                        2;
  new_position = std::max(new_position, pixels);
  if (clipped.is_cut_at_the_sides) cut_at_sides = std::max(cut_at_sides, pixels);
  const double z = greatest(triangle, [](const Vertex& v) { return v.z; });
  new_weight = std::max(new_weight, share * std::max(greatest_w, z));
}

void Errors::add_positions(const cases::Viewport& viewport, std::span<const Vertex> vertices) {
  const auto error = [](double number, double w, double origin, double extent) {
    const double ndc = number / w * extent / 2;
    return kOperation * (kPosition * std::fabs(ndc) + kCentre * std::fabs(origin + extent / 2));
  };
  for (const Vertex& v : vertices) {
    if (v.w <= 0) continue;  // it is cut off
    position = std::max({position, error(v.x, v.w, double{viewport.x}, double{viewport.width}),
                         error(v.y, v.w, double{viewport.y}, double{viewport.height})});
  }
}

Errors errors_of(const cases::Case& c) {
  Errors errors;
  for (const cases::Triangle& indices : c.triangles) {
    std::array<Vertex, 3> triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      const cases::ClipVertex& p = c.positions[indices[i]];
      triangle[i] = {double{p.x}, double{p.y}, double{p.z}, double{p.w}, {}};
      const auto distances = c.clip_distances_of(indices[i]);
      std::copy(distances.begin(), distances.end(), triangle[i].distances.begin());
    }
    errors.add(c, triangle);
  }
  return errors;
}

/// A bound that is no less in float32; of what has none, the greatest that a contract has.
float no_less(double bound, float greatest) {
  if (!(bound < double{greatest})) return greatest;
  return std::nextafter(static_cast<float>(bound), greatest);
}

}  // namespace

cases::Contract api_promise(const cases::Case& c, const ApiLimits& limits) {
  cases::Contract contract = cases::contract_of(c);
  contract.numbers = kNumbers;
  contract.basis = cases::Basis::unspecified;
  contract.tie_rule = cases::TieRule::unspecified;
  contract.is_on_grid = false;
  contract.keeps_sign_of_zero = false;
  contract.is_invariant = false;
  if (!cases::makes_promises_of(contract, c)) return contract;

  const Errors errors = errors_of(c);
  if (errors.divides_by_zero) {
    // "Division by zero produces an unspecified result": anything may be drawn, and anywhere.
    contract.numbers = kNone;
    return contract;
  }
  const double units = std::ldexp(kRest, limits.subpixel_bits);
  contract.coverage = cases::Snapping{
      limits.subpixel_bits, cases::Rounding::unspecified,
      no_less((errors.position + errors.cut_at_sides) * units, cases::kMaxPositionError)};
  contract.clip_tolerance = double{
      no_less((errors.position + errors.new_position) * units + 1, cases::kMaxPositionError)};
  // What the first plane cuts has exact distances.
  if (errors.planes > 1) contract.clip_error = kRest * errors.planes * kClipping * kOperation;

  const double new_weights = kNewWeights * errors.new_weight / kOperation;
  cases::ValueBound value;
  // Of a triangle without area the constant is all that counts.
  const double of_values = errors.condition < kInfinity ? kQuotient + new_weights : kInfinity;
  value.constant = no_less(of_values * kOperationInUlps + 0.5, kAllDigits);
  value.per_condition = static_cast<float>(kPerCondition * kOperationInUlps);
  contract.bounds = {value, value, {}};
  contract.bounds.depth.constant =
      no_less((kPerCondition * errors.condition + kQuotient + kDepthRange + new_weights) *
                      kOperationInUlps +
                  0.5,
              kAllDigits);
  return contract;
}

}  // namespace rastercheck::backends
