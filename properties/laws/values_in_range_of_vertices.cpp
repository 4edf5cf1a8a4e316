// Values stay in the range of their vertices: inside a triangle a smooth value is between the least
// and the greatest of the three vertex values, and so are noperspective values and depths.
//
// At a covered sample all E_i >= 0, so r = Σ r_i E_i / Σ E_i is a mean of the r_i and stays in
// their range. So do noperspective values and depths if all w_i > 0: the weights w_i e_i are not
// negative either, and sum to 1. Clipped depths are also within the depth range. Rounding to
// float32 is monotone, so one rounding does not leave a range whose ends are floats. A value may
// leave the range only by what the contract's bound allows besides this rounding (before_rounding),
// in ulps of the greatest r_i: an attribute from −1000 to 0 must stay below half an ulp of 1000.
//
// The ends of a range of depths, n + (f − n) z_i/w_i, are not floats. In double they are off by
// five roundings, one per operation, of numbers of at most m = max(n, f), so by less than 2^-50 m.
//
// Attributes: those located at samples and at centroids, which are also points of the triangle;
// those at centres only if pixels have one sample, since other centres may lie outside. Samples:
// required ones. If coverage is snapped and values come from other positions than coverage, the
// sample need not lie in the triangle that its values come from. So for a value beyond the range,
// the oracle tells what the contract leaves open there, and the range is widened by that.
//
// Generated attributes have two values, so that a whole edge is at an end of the range.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "properties/float_numbers.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_values.h"
#include "properties/laws/internal/value_findings.h"
#include "properties/random_state.h"

namespace rastercheck::properties::values_in_range_of_vertices_law {
namespace {

using cases::Interpolation;
using cases::Location;

// --- The law -------------------------------------------------------------------------------------

/// The numbers from lo to hi, and the unit of their scale.
struct VertexRange {
  double lo = 0;
  double hi = 0;
  double unit = 0;  ///< ulp of the greatest magnitude
};

VertexRange range_of_attribute(const cases::Case& c, const cases::Triangle& triangle,
                               std::uint32_t attribute) {
  const auto value = [&](std::size_t i) { return double{c.attributes_of(triangle[i])[attribute]}; };
  const auto [lo, hi] = std::minmax({value(0), value(1), value(2)});
  return {lo, hi, ulp_of(std::max(std::abs(lo), std::abs(hi)))};
}

/// The range of the vertices' depths, clamped to the depth range.
VertexRange range_of_depth(const cases::Case& c, const cases::Triangle& triangle) {
  const double n{c.viewport.min_depth};
  const double f{c.viewport.max_depth};
  const bool is_opengl = c.rules == cases::Rules::opengl;
  const auto depth = [&](std::size_t i) {
    const cases::ClipVertex& p = c.positions[triangle[i]];
    const double share = std::clamp(double{p.z} / double{p.w}, is_opengl ? -1.0 : 0.0, 1.0);
    return n + (f - n) * (is_opengl ? (share + 1) / 2 : share);
  };
  const auto [lo, hi] = std::minmax({depth(0), depth(1), depth(2)});
  const double greatest = std::max(n, f);
  const double off = greatest * 0x1p-50;
  return {std::max(lo - off, std::min(n, f)), std::min(hi + off, greatest), ulp_of(greatest)};
}

/// The ranges that the law checks for one triangle.
struct TriangleRanges {
  bool has_depth = false;
  VertexRange depth;
  std::vector<std::pair<std::uint32_t, VertexRange>> attributes;
};

TriangleRanges subject_of(const cases::Case& c, const cases::Triangle& triangle) {
  TriangleRanges subject;
  subject.has_depth = all_in_front(c, triangle);
  if (subject.has_depth) subject.depth = range_of_depth(c, triangle);
  for (std::uint32_t a = 0; a < c.attributes.size(); ++a) {
    const cases::Attribute& attribute = c.attributes[a];
    if (attribute.interpolation == Interpolation::flat) continue;
    if (attribute.interpolation == Interpolation::noperspective && !subject.has_depth) continue;
    if (attribute.location == Location::center && c.framebuffer.samples > 1) continue;
    subject.attributes.emplace_back(a, range_of_attribute(c, triangle, a));
  }
  return subject;
}

class RangeCheck {
 public:
  RangeCheck(const cases::Case& c, const cases::Contract& contract, const cases::Fragments& drawn)
      : case_(&c), drawn_(&drawn), findings_(c, contract) {}

  Check run() {
    TriangleRanges subject;
    std::optional<std::uint32_t> triangle;
    for (std::size_t i = 0; i < drawn_->size(); ++i) {
      const cases::SamplePlace place = drawn_->place_of(i);
      if (!is_of_case(*case_, place)) continue;
      if (triangle != place.triangle) {
        triangle = place.triangle;
        subject = subject_of(*case_, case_->triangles[*triangle]);
      }
      if (subject.has_depth) {
        check_value(place, std::nullopt, subject.depth, drawn_->depth[i]);
      }
      for (const auto& [attribute, range] : subject.attributes) {
        check_value(place, attribute, range, drawn_->attributes_of(i)[attribute]);
      }
    }
    return findings_.finish();
  }

 private:
  void check_value(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute,
                   const VertexRange& range, float actual) {
    findings_.see(place, attribute);
    if (attribute) add_labels(*attribute, range, actual);
    if (actual >= range.lo && actual <= range.hi) return;
    // The promise includes the part of the bound that depends on the horizon, and the range that
    // the contract leaves open.
    const std::optional<ValuePromise> promise = findings_.promise_of(place, attribute);
    if (!promise) return;
    const double unit = std::max(range.unit, promise->unit);
    const float least = least_float(std::min(range.lo, promise->lo), promise->bound, unit);
    const float greatest = greatest_float(std::max(range.hi, promise->hi), promise->bound, unit);
    if (actual >= least && actual <= greatest) return;
    findings_.report(place, attribute, actual,
                     "[" + value_text(least) + ", " + value_text(greatest) + "]",
                     attribute ? "beyond the values of all three vertices"
                               : "beyond the depths of all three vertices");
  }

  void add_labels(std::uint32_t attribute, const VertexRange& range, float actual) {
    if (range.lo == range.hi) return;
    if (actual == range.lo || actual == range.hi) findings_.label("at an end");
    if (case_->attributes[attribute].interpolation == Interpolation::noperspective) {
      findings_.label("noperspective");
    }
    if (case_->attributes[attribute].location == Location::centroid) findings_.label("centroid");
  }

  const cases::Case* case_;
  const cases::Fragments* drawn_;
  ValueFindings findings_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  return check_drawn(c, backend, [](const cases::Case& clip, const backends::Drawn& drawn) {
    return RangeCheck(clip, drawn.contract, drawn.fragments).run();
  });
}

// --- Its cases -----------------------------------------------------------------------------------

/// Chooses the two values of an attribute.
std::array<float, 2> random_ends(Draw& draw) {
  switch (draw.between(0, 4)) {
    case 0:
      return {0, 1};
    case 1: {  // an end that is far less than an ulp of the other
      const float far = draw.spread(8, 40);
      return {0, far};
    }
    case 2: {
      const float far = draw.spread(20, 40);
      const float near = draw.spread(-20, 0);
      return {near, far};
    }
    case 3: {  // neighbouring floats
      const float value = draw.spread(-8, 8);
      return {value, stepped(value, 1)};
    }
    default: {
      const float first = draw.spread(-8, 8);
      const float second = draw.spread(-8, 8);
      return {first, second};
    }
  }
}

Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  ensure_attribute(c);
  const std::size_t count = c.attributes.size();
  for (std::size_t a = 0; a < count; ++a) {
    c.attributes[a].interpolation =
        draw.one_in(3) ? Interpolation::noperspective : Interpolation::smooth;
    c.attributes[a].location = draw.one_in(3) ? Location::centroid : Location::sample;
    const std::array<float, 2> ends = random_ends(draw);
    for (std::size_t v = 0; v < c.positions.size(); ++v) {
      c.attribute_values[v * count + a] = ends[draw.one_in(2) ? 1 : 0];
    }
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "values-stay-in-the-range-of-their-vertices",
     .sentence = "values stay in the range of their vertices",
     .reason = "Inside a triangle all e_i >= 0, so that values are means of the vertices', and "
               "rounding is monotone.",
     .exceptions = "noperspective values and depths where some w <= 0; centres of several samples, "
                   "which may lie outside; flat attributes",
     .generate = &generate,
     .check = &check,
     .excludes_outer = true,
     .covers = {cover(20, "at an end"), cover(20, "noperspective"), cover(21, "centroid"),
                cover(19, "several samples"), cover(16, "snapped"), cover(14, "clipped"),
                cover(7, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::values_in_range_of_vertices_law
