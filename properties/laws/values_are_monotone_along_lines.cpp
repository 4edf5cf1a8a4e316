// Values are monotone along a line: from sample to sample along a row, a column or a diagonal
// inside one triangle, a smooth value only grows or only falls, and so do noperspective values and
// depths.
//
// Along a line r(t) = (a + b t)/(c + d t). The denominator is 1/w. It is positive at both ends of
// the triangle's part of the line, and so in between; the derivative (b c − a d)/(c + d t)²
// therefore keeps its sign. Affine values and clamped depths are monotone anyway. It does not
// matter whether samples in between were drawn.
//
// Drawn values. A float f computed for r is round(r + δ) with |δ| <= e units of the scale, where e
// is the bound without one rounding (before_rounding). So f is off by at most e units and half an
// ulp of f itself. If r grows from sample k to sample l,
//
//   f_k − f_l <= 2 e unit + (ulp(f_k) + ulp(f_l))/2.
//
// If the rounding is not known, e is the whole bound, and the ulps of f are dropped. If the floats
// at the two ends of the line differ by more than that, they tell whether r grows or falls. If not,
// r may do either, and all floats must be that close to the floats at the ends.
//
// If an inequality fails with the contract's bound alone, the oracle computes the part of the bound
// that grows towards the horizon (ValueBound::per_horizon) and the range that the contract leaves
// open (as for snapped vertices). The floats may then be that much farther apart, and the ends must
// differ by that much more.
//
// Rounding in this check: differences of two floats in double are off by 2^-53 of the greater
// float, which is less than 2^-29 units. The allowed errors have a margin of 2^-23.
//
// Samples: required ones. Attributes: those located at samples, since centres may lie outside the
// triangle and centroids may lie anywhere; noperspective attributes only if all w > 0.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_values.h"
#include "properties/laws/internal/fragment_lines.h"
#include "properties/laws/internal/value_findings.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::values_are_monotone_along_lines_law {
namespace {

using cases::Interpolation;
using cases::Location;

/// True if an attribute is monotone along lines of a triangle.
bool is_monotone(const cases::Case& c, const cases::Triangle& triangle, std::uint32_t attribute) {
  const cases::Attribute& declared = c.attributes[attribute];
  if (!is_at_sample(c, attribute) || declared.interpolation == Interpolation::flat) return false;
  return declared.interpolation == Interpolation::smooth || all_in_front(c, triangle);
}

/// How far a float may be from its exact value.
struct EndError {
  double bound = 0;  ///< scale ULP
  double unit = 0;
  double width = 0;  ///< width of the range that the contract leaves open

  double of(double value) const {
    const double rounding = bound < 1 ? ulp_of(value) / 2 : 0;
    return before_rounding(bound) * unit + rounding + width;
  }
};

/// Whether values grow or fall along a line.
enum class Way { up, down, either };

class MonotoneCheck {
 public:
  MonotoneCheck(const cases::Case& c, const cases::Contract& contract,
                const cases::Fragments& drawn, LineDirection direction)
      : case_(&c),
        drawn_(&drawn),
        values_(c, drawn),
        direction_(direction),
        findings_(c, contract) {}

  Check run() {
    for_each_line(*case_, *drawn_, direction_, [this](std::span<const LinePoint> line) {
      if (line.size() < 3) return;
      check_line(line, std::nullopt);
      const cases::Triangle& triangle = values_.corners(line.front().fragment);
      for (std::uint32_t a = 0; a < case_->attributes.size(); ++a) {
        if (is_monotone(*case_, triangle, a)) check_line(line, a);
      }
    });
    return findings_.finish();
  }

 private:
  /// The error that the contract alone allows.
  EndError error_of(std::size_t fragment, const MaybeAttribute& attribute) const {
    return {double{findings_.bound_of(attribute).constant},
            values_.vertex_ulp(fragment, attribute)};
  }

  /// The error including the part of the bound that grows towards the horizon and the open range,
  /// which the oracle computes; empty if nothing is promised.
  std::optional<EndError> asked_error_of(std::size_t fragment, const MaybeAttribute& attribute) {
    const auto promise = findings_.promise_of(values_.place(fragment), attribute);
    if (!promise) return std::nullopt;
    return EndError{promise->bound, promise->unit, promise->hi - promise->lo};
  }

  /// True if value k exceeds value l by more than errors explain, or if a value is NaN.
  static bool is_above(double k, double l, const EndError& of_k, const EndError& of_l) {
    return !(k - l <= (of_k.of(k) + of_l.of(l)) * (1 + kRounding));
  }

  static Way way_of(double first, double last, const EndError& of_first, const EndError& of_last) {
    if (first - last > (of_first.of(first) + of_last.of(last)) * (1 + kRounding)) return Way::down;
    if (last - first > (of_first.of(first) + of_last.of(last)) * (1 + kRounding)) return Way::up;
    return Way::either;
  }

  void check_line(std::span<const LinePoint> line, const MaybeAttribute& attribute) {
    const auto number = [&](std::size_t i) {
      return number_of(values_.value(line[i].fragment, attribute));
    };
    const EndError error = error_of(line.front().fragment, attribute);
    const std::size_t end = line.size() - 1;
    const Way way = way_of(number(0), number(end), error, error);
    findings_.label(attribute ? "attribute" : "depth");
    if (attribute && way != Way::either) findings_.label("certain way");
    if (line.size() >= 16) findings_.label("long line");
    // The index of the value to compare with: if values are certain to grow (fall), the greatest
    // (least) value so far.
    std::size_t extreme = 0;
    for (std::size_t i = 0; i <= end; ++i) {
      findings_.see(values_.place(line[i].fragment), attribute);
      const double f = number(i);
      if (way == Way::up) {
        if (is_above(number(extreme), f, error, error)) ask(line, attribute, extreme, i, Way::up);
        if (f > number(extreme)) extreme = i;
      } else if (way == Way::down) {
        if (is_above(f, number(extreme), error, error)) ask(line, attribute, extreme, i, Way::down);
        if (f < number(extreme)) extreme = i;
      } else {
        const double lo = std::min(number(0), number(end));
        const double hi = std::max(number(0), number(end));
        if (is_above(f, hi, error, error) || is_above(lo, f, error, error)) {
          ask(line, attribute, 0, i, Way::either);
        }
      }
    }
  }

  /// Reports a violation at l, unless the oracle explains what the contract alone does not.
  void ask(std::span<const LinePoint> line, const MaybeAttribute& attribute, std::size_t k,
           std::size_t l, Way way) {
    const std::size_t a = line.front().fragment;
    const std::size_t b = line.back().fragment;
    const auto of_a = asked_error_of(a, attribute);
    const auto of_b = asked_error_of(b, attribute);
    const auto of_k = asked_error_of(line[k].fragment, attribute);
    const auto of_l = asked_error_of(line[l].fragment, attribute);
    if (!of_a || !of_b || !of_k || !of_l) return;
    const double at_a = number_of(values_.value(a, attribute));
    const double at_b = number_of(values_.value(b, attribute));
    const double at_k = number_of(values_.value(line[k].fragment, attribute));
    const float actual = values_.value(line[l].fragment, attribute);
    const double at_l = number_of(actual);
    bool is_wrong = false;
    if (way != Way::either && way_of(at_a, at_b, *of_a, *of_b) == way) {
      is_wrong =
          way == Way::up ? is_above(at_k, at_l, *of_k, *of_l) : is_above(at_l, at_k, *of_l, *of_k);
    } else {  // must lie between the ends
      const bool is_above_both =
          is_above(at_l, at_a, *of_l, *of_a) && is_above(at_l, at_b, *of_l, *of_b);
      const bool is_below_both =
          is_above(at_a, at_l, *of_a, *of_l) && is_above(at_b, at_l, *of_b, *of_l);
      is_wrong = is_above_both || is_below_both;
    }
    if (!is_wrong) return;
    const float expected = values_.value(line[k].fragment, attribute);
    findings_.report(values_.place(line[l].fragment), attribute, actual,
                     way == Way::up ? "at least about " + value_text(expected)
                                    : (way == Way::down ? "at most about " + value_text(expected)
                                                        : "about " + value_text(expected)),
                     "changes direction along the " + std::string(to_string(direction_)) +
                         " from " + std::to_string(line.front().at) + " to " +
                         std::to_string(line.back().at));
  }

  /// A bound for rounding errors of this check, relative to the allowed errors.
  static constexpr double kRounding = 0x1p-23;

  const cases::Case* case_;
  const cases::Fragments* drawn_;
  DrawnValues values_;
  LineDirection direction_;
  ValueFindings findings_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  return check_drawn(c, backend, [](const cases::Case& clip, const backends::Drawn& drawn) {
    return MonotoneCheck(clip, drawn.contract, drawn.fragments, some_direction(clip)).run();
  });
}

/// Adds a triangle around the middle of the window, so that lines are long enough; the w differ by
/// a factor of up to 64.
void add_large_triangle(Draw& draw, cases::Case& c) {
  const WindowPoint middle = visible_middle(c);
  constexpr std::array<WindowPoint, 3> kDirections{{{1, 0.25}, {-0.75, 1}, {-0.25, -1}}};
  for (const WindowPoint& direction : kDirections) {
    const float reach = draw.uniform(4, 24);
    const float w = draw.one_in(2) ? draw.uniform(0.125F, 1) : draw.uniform(1, 8);
    const float depth = random_depth(draw, c);
    const WindowPoint p{middle.u + direction.u * double{reach},
                        middle.v + direction.v * double{reach}};
    add_vertex(c, at_window(c, p, depth, w));
  }
  const auto first = static_cast<std::uint32_t>(c.positions.size() - 3);
  c.triangles.push_back({first, first + 1, first + 2});
}

/// Puts all attributes at samples, so that the law applies to each.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  add_large_triangle(draw, c);
  ensure_attribute(c);
  for (cases::Attribute& attribute : c.attributes) {
    attribute.location = Location::sample;
    if (attribute.interpolation == Interpolation::flat) {
      attribute.interpolation = Interpolation::smooth;
    }
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return made;
}

const LawRegistration kRegistration(
    {.id = "values-are-monotone-along-a-line",
     .sentence = "values are monotone along a line",
     .reason = "r(t) = (a + b t)/(c + d t) with a positive denominator has no extreme.",
     .exceptions = "values that are not at samples, flat ones, and noperspective ones where some "
                   "w <= 0",
     .generate = &generate,
     .check = &check,
     .excludes_outer = true,
     .covers = {cover(46, "certain way"), cover(13, "long line"), cover(18, "several samples"),
                cover(16, "snapped"), cover(11, "clipped"), cover(6, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::values_are_monotone_along_lines_law
