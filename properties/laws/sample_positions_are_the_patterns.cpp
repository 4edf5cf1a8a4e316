// Sample positions are the pattern's: attributes equal to the window position have, at sample s of
// pixel (x, y), the value (x + p_s, y + q_s), whichever way the API's y points. (p_s, q_s) is the
// sample's place in the standard pattern (RULES §4).
//
// Let (u_i, v_i) be exactly the window positions of a triangle's vertices, and all w_i > 0.
// Noperspective values are affine in window coordinates and agree with u and v at three points that
// are not collinear, and so everywhere. Smooth values do so, too, if all w_i are the same. A
// pattern in another order, upside down (as in SwiftShader once) or off by half a pixel (as in
// PPSSPP) shows in every fragment; coverage alone shows such errors only at edges.
//
// Locations. At the sample: the sample's place. At the centre: (x + 1/2, y + 1/2), covered or not.
// At the centroid: any point of the pixel. The numbers are multiples of 2^-4 and exact floats, so
// one rounding leaves them unchanged, and a value may be off only by what the contract's bound
// allows besides this rounding (before_rounding), in ulps of the greatest vertex value or of the
// value itself.
//
// Samples: required ones. For values beyond the bound, the oracle tells whether the sample is
// required, how far snapping moves vertices, and which values the contract leaves open. Clipped
// triangles with snapped vertices are left out: their pieces lie in different planes.
//
// Generated cases: vertices at multiples of 1/16 pixel, w powers of two, so that clip positions are
// exact.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "cases/names.h"
#include "cases/sample_pattern.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/value_findings.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::sample_positions_are_the_patterns_law {
namespace {

using cases::Interpolation;
using cases::Location;

// --- The law -------------------------------------------------------------------------------------

enum class PatternAxis { x, y };

/// An attribute equal to the window position along an axis.
struct Coordinate {
  std::uint32_t attribute = 0;
  PatternAxis axis = PatternAxis::x;
  double greatest = 0;  ///< among the vertices' values
};

bool has_one_w(const cases::Case& c, const cases::Triangle& triangle) {
  return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t index) {
    return c.positions[index].w == c.positions[triangle[0]].w;
  });
}

/// Returns which of attributes 0 and 1 equal the window position throughout the triangle; none,
/// unless both equal it at every vertex.
std::vector<Coordinate> coordinates_of(const cases::Case& c, const cases::Triangle& triangle) {
  if (c.attributes.size() < 2) return {};
  for (const std::uint32_t index : triangle) {
    const auto values = c.attributes_of(index);
    const WindowPoint p{double{values[0]}, double{values[1]}};
    const bool is_short = std::abs(p.u) < 0x1p20 && std::abs(p.v) < 0x1p20 &&
                          p.u * 256 == std::floor(p.u * 256) && p.v * 256 == std::floor(p.v * 256);
    const bool is_in_front = c.positions[index].w > 0;
    if (!is_short || !is_in_front || !is_exactly_at(c, c.positions[index], p)) return {};
  }
  std::vector<Coordinate> coordinates;
  for (const PatternAxis axis : {PatternAxis::x, PatternAxis::y}) {
    const std::uint32_t a = axis == PatternAxis::x ? 0 : 1;
    const Interpolation interpolation = c.attributes[a].interpolation;
    if (interpolation == Interpolation::flat) continue;
    if (interpolation == Interpolation::smooth && !has_one_w(c, triangle)) continue;
    double greatest = 0;
    for (const std::uint32_t index : triangle) {
      greatest = std::max(greatest, std::abs(double{c.attributes_of(index)[a]}));
    }
    coordinates.push_back({a, axis, greatest});
  }
  return coordinates;
}

/// The numbers from lo to hi.
struct NumberRange {
  double lo = 0;
  double hi = 0;
};

class PatternCheck {
 public:
  PatternCheck(const cases::Case& c, const cases::Contract& contract, const cases::Fragments& drawn)
      : case_(&c),
        drawn_(&drawn),
        pattern_(cases::standard_pattern(c.framebuffer.samples)),
        findings_(c, contract) {
    if (c.framebuffer.samples == 1) own_ = contract.sample_position;
  }

  Check run() {
    std::vector<Coordinate> coordinates;
    std::optional<std::uint32_t> triangle;
    for (std::size_t i = 0; i < drawn_->size(); ++i) {
      const cases::SamplePlace place = drawn_->place_of(i);
      if (!is_of_case(*case_, place)) continue;
      if (triangle != place.triangle) {
        triangle = place.triangle;
        coordinates = coordinates_of(*case_, case_->triangles[*triangle]);
        if (!coordinates.empty() && !findings_.is_one_plane(*triangle)) coordinates.clear();
      }
      for (const Coordinate& coordinate : coordinates) check_value(i, place, coordinate);
    }
    return findings_.finish();
  }

 private:
  /// The place along an axis where an attribute is evaluated.
  NumberRange expected(const cases::SamplePlace& place, const Coordinate& coordinate) const {
    const bool is_x = coordinate.axis == PatternAxis::x;
    const double pixel = is_x ? place.x : place.y;
    if (own_) {
      // Two roundings, together less than one step of the result.
      const double at = pixel + static_cast<double>(is_x ? own_->x : own_->y) / own_->parts;
      constexpr double kFar = std::numeric_limits<double>::infinity();
      return {std::nextafter(at, -kFar), std::nextafter(at, kFar)};
    }
    const cases::SamplePosition& offset = pattern_[place.sample];
    const double sample = pixel + (is_x ? offset.x : offset.y) / 16.0;
    switch (case_->attributes[coordinate.attribute].location) {
      case Location::sample:
        return {sample, sample};
      case Location::center:
        return {pixel + 0.5, pixel + 0.5};
      case Location::centroid:
        break;
    }
    if (case_->framebuffer.samples == 1 && case_->rules == cases::Rules::d3d) {
      return {sample, sample};
    }
    return {pixel, pixel + 1};
  }

  void check_value(std::size_t i, const cases::SamplePlace& place, const Coordinate& coordinate) {
    findings_.see(place, coordinate.attribute);
    add_labels(coordinate.attribute);
    const float actual = drawn_->attributes_of(i)[coordinate.attribute];
    const NumberRange range = expected(place, coordinate);
    const double unit = ulp_of(std::max({coordinate.greatest, range.lo, range.hi}));
    const double bound{findings_.bound_of(coordinate.attribute).constant};
    if (is_within(actual, range, bound, unit)) return;
    const auto promise = findings_.promise_of(place, coordinate.attribute);
    if (!promise) return;
    const NumberRange open = opened(range, *promise);
    if (is_within(actual, open, promise->bound, std::max(unit, promise->unit))) return;
    const std::string at = range.lo == range.hi
                               ? value_text(static_cast<float>(range.lo))
                               : "[" + value_text(static_cast<float>(range.lo)) + ", " +
                                     value_text(static_cast<float>(range.hi)) + "]";
    findings_.report(place, coordinate.attribute, actual, at,
                     coordinate.axis == PatternAxis::x ? "not the window x of the sample position"
                                                       : "not the window y of the sample position");
  }

  /// Widens the range by what the contract leaves open; unchanged if the contract allows only a
  /// single number.
  static NumberRange opened(const NumberRange& range, const ValuePromise& promise) {
    if (promise.lo == promise.hi) return range;
    return {std::min(range.lo, promise.lo), std::max(range.hi, promise.hi)};
  }

  static bool is_within(float actual, const NumberRange& range, double bound, double unit) {
    return actual >= least_float(range.lo, bound, unit) &&
           actual <= greatest_float(range.hi, bound, unit);
  }

  void add_labels(std::uint32_t attribute) {
    switch (case_->attributes[attribute].location) {
      case Location::sample:
        findings_.label("sample");
        break;
      case Location::center:
        findings_.label("center");
        break;
      case Location::centroid:
        findings_.label("centroid");
    }
    const bool is_up = (case_->rules == cases::Rules::opengl) == (case_->viewport.height > 0);
    findings_.label(is_up ? "y up" : "y down");
  }

  const cases::Case* case_;
  const cases::Fragments* drawn_;
  std::span<const cases::SamplePosition> pattern_;
  /// The backend's own sample position, if the case has one sample.
  std::optional<cases::PixelFraction> own_;
  ValueFindings findings_;
};

/// True if vertices at multiples of 1/16 pixel stay where they are.
bool keeps_sixteenths(const cases::Contract& contract) {
  return !contract.coverage || contract.basis == cases::Basis::ideal ||
         contract.coverage->steps() % 16 == 0;
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!keeps_sixteenths(backend.contract(c))) {
    return not_applicable("vertices at sixteenths of a pixel are rounded to another grid");
  }
  return check_drawn(c, backend, [](const cases::Case& clip, const backends::Drawn& drawn) {
    return PatternCheck(clip, drawn.contract, drawn.fragments).run();
  });
}

// --- Its cases -----------------------------------------------------------------------------------

/// A point in or near the window whose coordinates have few bits.
WindowPoint short_point(Draw& draw, const cases::Case& c) {
  const WindowPoint p = point_about(draw, c);
  const auto sixteenths = [](double at) {
    return static_cast<double>(static_cast<int>(at * 16)) / 16;
  };
  return {sixteenths(p.u), sixteenths(p.v)};
}

/// Makes triangles at points of few bits; more than half of the cases have several samples per
/// pixel.
Generated generate(Draw& draw) {
  StateRequest request;
  request.is_on_grid = true;
  request.least_side = 8;
  request.most_side = 16;  // each pixel may have many samples
  Generated made{random_state(draw, request), ""};
  cases::Case& c = made.source;
  if (draw.one_in(2)) c.framebuffer.samples = draw.pick(std::array{2, 4, 8, 16});
  const auto location = draw.pick(
      std::array{Location::sample, Location::sample, Location::center, Location::centroid});
  made.stratum = "at the " + std::string(cases::name_of(location));
  const bool is_smooth = draw.one_in(4);
  const auto interpolation = is_smooth ? Interpolation::smooth : Interpolation::noperspective;
  c.attributes = {{"u", interpolation, location}, {"v", interpolation, location}};
  const int triangles = draw.between(1, 3);
  for (int i = 0; i < 3 * triangles; ++i) {
    const WindowPoint p = short_point(draw, c);
    const bool is_cut = draw.one_in(8);
    const float depth = is_cut ? 2.0F : random_depth(draw, c);
    const float w = is_smooth ? 1.0F : draw.pick(std::array{0.25F, 0.5F, 1.0F, 2.0F, 4.0F, 8.0F});
    add_vertex(c, at_window(c, p, depth, w));
    c.attribute_values.insert(c.attribute_values.end(),
                              {static_cast<float>(p.u), static_cast<float>(p.v)});
  }
  add_separate_triangles(c);
  add_clip_distances(draw, c);
  return made;
}

const LawRegistration kRegistration(
    {.id = "sample-positions-are-the-patterns",
     .sentence = "sample positions are the pattern's",
     .reason = "An affine value that is the window position at three vertices is so everywhere.",
     .exceptions = "triangles whose first two attributes are not exactly their window positions, "
                   "all w > 0; snapped ones that are clipped",
     .generate = &generate,
     .check = &check,
     .needs_samples = true,
     .covers = {cover(26, "sample"), cover(12, "center"), cover(11, "centroid"),
                cover(33, "several samples"), cover(10, "snapped"), cover_decided(16, "clipped"),
                cover(21, "y up"), cover(28, "y down")}});

}  // namespace
}  // namespace rastercheck::properties::sample_positions_are_the_patterns_law
