// Flat values are the provoking vertex's, to the bit: the last vertex's under OpenGL's rules, the
// first one's under others (RULES §4), however the triangle is clipped, wherever its vertices are
// snapped, whichever side is visible.
//
// A flat attribute is a copy. Nothing is interpolated, so huge values do not overflow, subnormal
// ones are not flushed, and −0 keeps its sign. Clipping does not change which vertex provokes, even
// if that vertex is cut off or lies behind the eye.
//
// Samples: all that are drawn, rightly or not, since their triangle is known.
//
// Generated values: bit patterns that a conversion to another type and back would change.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "properties/judged_law.h"
#include "properties/laws/internal/value_findings.h"

namespace rastercheck::properties::flat_values_are_copies_law {
namespace {

using cases::Interpolation;

bool is_copy(float actual, float of_vertex) {
  return std::bit_cast<std::uint32_t>(actual) == std::bit_cast<std::uint32_t>(of_vertex);
}

class FlatCheck {
 public:
  FlatCheck(const cases::Case& c, const cases::Contract& contract, const cases::Fragments& drawn)
      : case_(&c), drawn_(&drawn), findings_(c, contract) {
    for (std::size_t t = 0; t < c.triangles.size(); ++t) {
      is_promised_.push_back(cases::promise_of(contract, c, t).is_made);
    }
  }

  Check run() {
    for (std::size_t i = 0; i < drawn_->size(); ++i) {
      const cases::SamplePlace place = drawn_->place_of(i);
      if (!is_of_case(*case_, place) || !is_promised_[place.triangle]) continue;
      for (std::uint32_t a = 0; a < case_->attributes.size(); ++a) {
        if (case_->attributes[a].interpolation != Interpolation::flat) continue;
        check_value(place, a, drawn_->attributes_of(i)[a]);
      }
    }
    return findings_.finish();
  }

 private:
  void check_value(const cases::SamplePlace& place, std::uint32_t attribute, float actual) {
    const bool is_last = case_->rules == cases::Rules::opengl;
    const std::uint32_t vertex = case_->triangles[place.triangle][is_last ? 2 : 0];
    const float expected = case_->attributes_of(vertex)[attribute];
    findings_.see(place, attribute);
    add_labels(vertex, expected);
    if (is_copy(actual, expected)) return;
    findings_.report(place, attribute, actual, value_text(expected),
                     "the provoking vertex is " + std::to_string(vertex));
  }

  void add_labels(std::uint32_t vertex, float expected) {
    if (case_->positions[vertex].w <= 0) findings_.label("provoked from behind the eye");
    if (case_->cull != cases::Cull::none) findings_.label("culling");
    if (expected == 0 && std::signbit(expected)) findings_.label("negative zero");
    if (std::fpclassify(expected) == FP_SUBNORMAL) findings_.label("subnormal");
  }

  const cases::Case* case_;
  const cases::Fragments* drawn_;
  ValueFindings findings_;
  /// [triangle]: true if anything is promised; if not, any values may be drawn.
  std::vector<bool> is_promised_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  const Result<backends::Drawn> drawn = draw(c, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  return FlatCheck(c, drawn->contract, drawn->fragments).run();
}

float telling_value(Draw& draw) {
  switch (draw.between(0, 5)) {
    case 0:
      return -0.0F;
    case 1:
      return draw.spread(-149, -127);
    case 2:
      return draw.spread(120, 127);
    case 3: {  // an index up to 2^24 − 1, as its bits
      const auto bits = static_cast<std::uint32_t>(draw.bits(24));
      return std::bit_cast<float>(bits);
    }
    default:
      return draw.spread(-30, 30);
  }
}

/// Makes cases with at least one flat attribute. All vertices have different values, except by
/// chance.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  if (c.attributes.size() < 2) {
    c.attributes.resize(2);
    c.attributes[0].name = "a0";
    c.attributes[1].name = "a1";
    c.attribute_values.assign(c.positions.size() * 2, 0);
  }
  const std::size_t count = c.attributes.size();
  for (std::size_t a = 0; a < count; ++a) {
    const bool is_flat = a == 0 || draw.one_in(2);
    if (is_flat) c.attributes[a].interpolation = Interpolation::flat;
    for (std::size_t v = 0; v < c.positions.size(); ++v) {
      c.attribute_values[v * count + a] = telling_value(draw);
    }
  }
  if (draw.one_in(4)) c.cull = draw.pick(std::array{cases::Cull::back, cases::Cull::front});
  return made;
}

const LawRegistration kRegistration(
    {.id = "flat-values-are-the-provoking-vertex",
     .sentence = "flat values are the provoking vertex's",
     .reason = "A flat attribute is a copy: nothing is interpolated, whatever is cut away.",
     .exceptions = "cases without flat attributes; triangles that nothing is promised of",
     .generate = &generate,
     .check = &check,
     .takes_lines_and_points = true,
     .covers = {cover(24, "negative zero"), cover(29, "subnormal"), cover(15, "culling"),
                cover(7, "provoked from behind the eye"), cover(20, "several samples"),
                cover(16, "snapped"), cover(15, "clipped")}});

}  // namespace
}  // namespace rastercheck::properties::flat_values_are_copies_law
