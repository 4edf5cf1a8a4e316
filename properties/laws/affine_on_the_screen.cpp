// 1/w and r/w are affine on the screen: values that are not divided by w do not curve, and values
// that are divided by w are quotients of values that do not curve.
//
// Affine (RULES §1, §4). z/w = Σ z_i e_i is affine, since the e_i are affine in window coordinates,
// whatever the w_i. Noperspective values are affine if all w_i > 0. So along a line of pixels, the
// exact value f lies on the chord between any two other values: for n pixels from a to b,
//
//   n f(x) = (b − x) f(a) + (x − a) f(b).
//
// Each drawn value is off by at most α, and the right side is n times a mean, so for drawn values
// the two sides differ by at most 2nα. Each line's chord runs from its first fragment to its last,
// so that a curve shows most.
//
// Quotient. Take a smooth attribute r and noperspective attributes q and d. If q_i = r_i/w_i and
// d_i = 1/w_i exactly at all three vertices, then q is r/w and d is 1/w everywhere: q = r d. For
// drawn values
//
//   |q' − r'd'| <= |q' − q| + |d| |r' − r| + |r'| |d' − d| <= α_q + (|d'| + α_d) α_r + |r'| α_d.
//
// α is the contract's bound in scale ULP of the greatest vertex value, which no value exceeds
// inside a triangle. If an inequality fails with this α, the oracle computes the part of the bound
// that grows towards the horizon (ValueBound::per_horizon) and the range of values that the
// contract leaves open (as for snapped vertices). α then grows by both, since for any placement of
// the vertices the exact values are in these ranges.
//
// Rounding in this check: products of a float and a number below 2^15 are exact in double, and so
// are products of two floats. The sums are off by three roundings of numbers below 2^2 n m, where m
// is the greatest value. That is less than 2^-49 n m <= 2^-25 n ulp(m). The allowed errors are at
// least 2n halves of that ulp, so a margin of 2^-23 covers the rounding.
//
// Samples: required ones. Attributes: those located at samples, since centres may lie outside the
// triangle and centroids may lie anywhere. Clipped triangles with snapped vertices have no chords:
// their pieces lie in different planes. Depths are checked only if they are not clamped; D3D also
// clamps the depths of snapped triangles.
//
// The generated w_i are powers of two, so that r_i = q_i w_i and d_i are floats.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_values.h"
#include "properties/laws/internal/fragment_lines.h"
#include "properties/laws/internal/value_findings.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::affine_on_the_screen_law {
namespace {

using cases::Interpolation;
using cases::Location;

// --- The law -------------------------------------------------------------------------------------

/// True if attributes 0, 1 and 2 are r, q = r/w and d = 1/w at the triangle's vertices. The test is
/// exact, since doubles hold products of two floats.
bool has_quotient(const cases::Case& c, const cases::Triangle& triangle) {
  if (c.attributes.size() < 3 || !all_in_front(c, triangle)) return false;
  for (std::uint32_t a = 0; a < 3; ++a) {
    const auto expected = a == 0 ? Interpolation::smooth : Interpolation::noperspective;
    if (c.attributes[a].interpolation != expected || !is_at_sample(c, a)) return false;
  }
  return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t index) {
    const auto values = c.attributes_of(index);
    const double w{c.positions[index].w};
    return double{values[1]} * w == double{values[0]} && double{values[2]} * w == 1;
  });
}

class AffineCheck {
 public:
  AffineCheck(const cases::Case& c, const cases::Contract& contract, const cases::Fragments& drawn,
              LineDirection direction)
      : case_(&c),
        drawn_(&drawn),
        values_(c, drawn),
        direction_(direction),
        findings_(c, contract) {}

  Check run() {
    check_quotients();
    for_each_line(*case_, *drawn_, direction_, [this](std::span<const LinePoint> line) {
      if (line.back().at - line.front().at < 2) return;
      if (!is_one_plane(drawn_->triangle[line.front().fragment])) return;
      for (const MaybeAttribute& attribute : affine_of(line)) check_chord(line, attribute);
    });
    return findings_.finish();
  }

 private:
  bool is_one_plane(std::uint32_t triangle) {
    if (asked_triangle_ != triangle) {
      asked_triangle_ = triangle;
      is_one_plane_ = findings_.is_one_plane(triangle);
    }
    return is_one_plane_;
  }

  /// The values that are affine on a line's triangle.
  std::vector<MaybeAttribute> affine_of(std::span<const LinePoint> line) const {
    std::vector<MaybeAttribute> affine;
    const bool is_clamped = case_->depth_clamp || (case_->rules == cases::Rules::d3d &&
                                                   findings_.contract().coverage.has_value());
    if (!is_clamped) affine.emplace_back(std::nullopt);
    if (!all_in_front(*case_, values_.corners(line.front().fragment))) return affine;
    for (std::uint32_t a = 0; a < case_->attributes.size(); ++a) {
      const bool is_affine = findings_.contract().is_affine(case_->attributes[a].interpolation);
      if (is_affine && is_at_sample(*case_, a)) affine.emplace_back(a);
    }
    return affine;
  }

  /// How far a value may be off by the contract alone.
  double allowed(std::size_t fragment, const MaybeAttribute& attribute) const {
    return double{findings_.bound_of(attribute).constant} * values_.vertex_ulp(fragment, attribute);
  }

  /// How far a value may be off, including the part of the bound that grows towards the horizon and
  /// the open range, which the oracle computes; empty if nothing is promised.
  std::optional<double> allowed_at_most(std::size_t fragment, const MaybeAttribute& attribute) {
    const auto promise = findings_.promise_of(values_.place(fragment), attribute);
    if (!promise) return std::nullopt;
    return promise->bound * promise->unit + (promise->hi - promise->lo);
  }

  /// True if errors of this size do not explain a difference.
  static bool is_beyond(double difference, double errors) {
    return !(std::abs(difference) <= errors);  // NaN is beyond, too
  }

  void check_chord(std::span<const LinePoint> line, const MaybeAttribute& attribute) {
    const LinePoint& a = line.front();
    const LinePoint& b = line.back();
    const double at_a = number_of(values_.value(a.fragment, attribute));
    const double at_b = number_of(values_.value(b.fragment, attribute));
    const double n = b.at - a.at;
    const double most = allowed(a.fragment, attribute);
    findings_.label(attribute ? "noperspective" : "depth");
    if (n >= 8) findings_.label("long line");
    for (const LinePoint& p : line.subspan(1, line.size() - 2)) {
      findings_.see(values_.place(p.fragment), attribute);
      const float actual = values_.value(p.fragment, attribute);
      const double difference =
          n * number_of(actual) - ((b.at - p.at) * at_a + (p.at - a.at) * at_b);
      if (!is_beyond(difference, 2 * n * most)) continue;
      const auto of_a = allowed_at_most(a.fragment, attribute);
      const auto of_b = allowed_at_most(b.fragment, attribute);
      const auto of_p = allowed_at_most(p.fragment, attribute);
      if (!of_a || !of_b || !of_p) continue;
      const double errors = (b.at - p.at) * *of_a + (p.at - a.at) * *of_b + n * *of_p;
      if (!is_beyond(difference, errors * (1 + kRounding))) continue;
      const double chord = ((b.at - p.at) * at_a + (p.at - a.at) * at_b) / n;
      findings_.report(values_.place(p.fragment), attribute, actual,
                       "about " + value_text(static_cast<float>(chord)),
                       "not on the chord of its " + std::string(to_string(direction_)) + " from " +
                           std::to_string(a.at) + " to " + std::to_string(b.at));
    }
  }

  void check_quotients() {
    if (findings_.contract().claims != cases::Claim::perspective) return;
    std::optional<std::uint32_t> triangle;
    bool has_one = false;
    for (std::size_t i = 0; i < drawn_->size(); ++i) {
      if (!is_of_case(*case_, values_.place(i))) continue;
      if (triangle != drawn_->triangle[i]) {
        triangle = drawn_->triangle[i];
        has_one = has_quotient(*case_, values_.corners(i));
      }
      if (has_one) check_quotient(i);
    }
  }

  void check_quotient(std::size_t i) {
    findings_.see(values_.place(i), 0);
    findings_.label("quotient");
    const double r = number_of(values_.value(i, 0));
    const double q = number_of(values_.value(i, 1));
    const double d = number_of(values_.value(i, 2));
    const auto errors = [&](double of_r, double of_q, double of_d) {
      return of_q + (std::abs(d) + of_d) * of_r + std::abs(r) * of_d;
    };
    const double difference = q - r * d;
    if (!is_beyond(difference, errors(allowed(i, 0), allowed(i, 1), allowed(i, 2)))) return;
    const auto of_r = allowed_at_most(i, 0);
    const auto of_q = allowed_at_most(i, 1);
    const auto of_d = allowed_at_most(i, 2);
    if (!of_r || !of_q || !of_d) return;
    if (!is_beyond(difference, errors(*of_r, *of_q, *of_d) * (1 + kRounding))) return;
    findings_.report(values_.place(i), 0, values_.value(i, 0),
                     std::isfinite(q / d) ? "about " + value_text(static_cast<float>(q / d))
                                          : "r/w divided by 1/w",
                     "r/w is " + value_text(values_.value(i, 1)) + " and 1/w " +
                         value_text(values_.value(i, 2)));
  }

  /// A bound for rounding errors of this check, relative to the allowed errors.
  static constexpr double kRounding = 0x1p-23;

  const cases::Case* case_;
  const cases::Fragments* drawn_;
  DrawnValues values_;
  LineDirection direction_;
  ValueFindings findings_;
  std::optional<std::uint32_t> asked_triangle_;
  bool is_one_plane_ = false;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  return check_drawn(c, backend, [](const cases::Case& clip, const backends::Drawn& drawn) {
    return AffineCheck(clip, drawn.contract, drawn.fragments, some_direction(clip)).run();
  });
}

// --- Its cases -----------------------------------------------------------------------------------

float power_of_two_weight(Draw& draw, int most) {
  const int exponent = draw.between(-most, most);
  return exponent < 0 ? 1.0F / static_cast<float>(1 << -exponent)
                      : static_cast<float>(1 << exponent);
}

/// Makes triangles with powers of two as w, and with attributes r, r/w and 1/w. A depth plane cuts
/// some of the triangles.
Generated generate(Draw& draw) {
  StateRequest request;
  request.least_side = 16;
  Generated made{random_state(draw, request), ""};
  cases::Case& c = made.source;
  c.attributes = {{"r", Interpolation::smooth, Location::sample},
                  {"r/w", Interpolation::noperspective, Location::sample},
                  {"1/w", Interpolation::noperspective, Location::sample}};
  const int most = draw.pick(std::array{1, 3, 10});
  const bool is_huge = draw.one_in(8);
  made.stratum = is_huge ? "huge values" : "weights up to 2^" + std::to_string(most);
  const int triangles = draw.between(1, 2 + draw.size() / 50);
  for (int i = 0; i < 3 * triangles; ++i) {
    const WindowPoint p = point_about(draw, c);
    const bool is_cut = draw.one_in(6);
    const float depth = is_cut ? draw.uniform(1, 2) : random_depth(draw, c);
    const float w = power_of_two_weight(draw, most);
    add_vertex(c, at_window(c, p, depth, w));
    const float q = is_huge ? draw.spread(90, 110) : draw.spread(-4, 4);
    c.attribute_values.insert(c.attribute_values.end(), {q * w, q, 1 / w});
  }
  add_separate_triangles(c);
  add_clip_distances(draw, c);
  return made;
}

const LawRegistration kRegistration(
    {.id = "1-w-and-r-w-are-affine-on-the-screen",
     .sentence = "1/w and r/w are affine on the screen",
     .reason = "The e_i are affine in window coordinates, and r = (r/w) / (1/w).",
     .exceptions = "noperspective values where some w <= 0; clamped depths; values that are not "
                   "at samples; chords of snapped triangles that are clipped; quotients of "
                   "backends that claim smooth values to be affine themselves",
     .generate = &generate,
     .check = &check,
     .excludes_outer = true,
     .covers = {cover_decided(49, "quotient"), cover(39, "noperspective"), cover(31, "depth"),
                cover(21, "long line"), cover(19, "several samples"), cover(13, "snapped"),
                cover(26, "clipped")}});

}  // namespace
}  // namespace rastercheck::properties::affine_on_the_screen_law
