// Integers survive rounding: an attribute that is the same integer at all three vertices is that
// integer again once it has been rounded to the nearest integer, wherever the contract implies it.
//
// Why. Programs pass indices and flags as floats and turn them back into integers. If all r_i = c,
// the exact value Σ c e_i / Σ e_i is c at every sample. The contract lets a float be off by `bound`
// units from what it leaves open, which is c alone. If this is less than 1/2, c is the only nearest
// integer. If it is more, as towards the horizon, nothing is judged. A bound is at most a few ULP
// of c, so it is below 1/2 for all integers but the largest, whether or not it is small enough for
// constants to stay constant.
//
// Truncation, which casts to integers use, is not promised to give the integer back: 0.9999 is
// within the bound of 1, and truncates to 0. Such a value is right, and is labelled: "truncates to
// the integer below" of a positive integer, "truncates to the integer above" of a negative one.
// Records count the cases with each label. Notes of violations name what truncation gives.
//
// Attributes: smooth and noperspective ones, at every location; flat attributes are copies anyway.
// Samples: required ones. All values that round to another integer are judged, and some of the
// others, which the oracle is asked about because the law must not pass for want of a promise.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/value_findings.h"
#include "properties/random_state.h"

namespace rastercheck::properties::integers_survive_rounding_law {
namespace {

/// The greatest number of values of a case that round to their integer and are judged.
constexpr std::size_t kMostValues = 64;

/// Floats from here on are integers, and no two of them round to the same one.
constexpr double kAllWhole = 0x1p23;

/// True if the attribute is interpolated and the same integer at all three vertices.
bool is_integer(const cases::Case& c, const cases::Triangle& triangle, std::size_t attribute) {
  if (c.attributes[attribute].interpolation == cases::Interpolation::flat) return false;
  const auto value = [&](std::size_t i) { return c.attributes_of(triangle[i])[attribute]; };
  return std::trunc(value(0)) == value(0) && value(0) == value(1) && value(1) == value(2);
}

class IntegersCheck {
 public:
  IntegersCheck(const cases::Case& c, const backends::Drawn& drawn)
      : case_(&c), drawn_(&drawn.fragments), findings_(c, drawn.contract) {}

  Check run() {
    std::vector<Value> kept;
    std::vector<Value> changed;
    for (std::size_t i = 0; i < drawn_->size(); ++i) {
      const cases::SamplePlace place = drawn_->place_of(i);
      if (!is_of_case(*case_, place)) continue;
      for (std::uint32_t a = 0; a < case_->attributes.size(); ++a) {
        if (!is_integer(*case_, case_->triangles[place.triangle], a)) continue;
        const Value value{i, a};
        (std::round(actual(value)) == integer(value) ? kept : changed).push_back(value);
      }
    }
    for (const Value& value : changed) check_value(value);
    for (const Value& value : some_of(kept, kMostValues)) check_value(value);
    Check check = findings_.finish();
    if (!check.is_applicable) {
      check.why_not = "no triangle has an integer that is promised to survive rounding";
    }
    return check;
  }

 private:
  struct Value {
    std::size_t fragment = 0;
    std::uint32_t attribute = 0;
  };

  float actual(const Value& value) const {
    return drawn_->attributes_of(value.fragment)[value.attribute];
  }
  float integer(const Value& value) const {
    const cases::Triangle& triangle = case_->triangles[drawn_->triangle[value.fragment]];
    return case_->attributes_of(triangle[0])[value.attribute];
  }

  void check_value(const Value& value) {
    const cases::SamplePlace place = drawn_->place_of(value.fragment);
    const auto promise = findings_.promise_of(place, value.attribute);
    const double c = double{integer(value)};
    // Both sums are rounded, by far less than the 2^-20 that is left.
    constexpr double kHalf = 0.5 - 0x1p-20;
    const bool is_promised =
        promise && std::abs(c) < kAllWhole &&
        std::max(c - promise->lo, promise->hi - c) + promise->bound * promise->unit < kHalf;
    if (!is_promised) return findings_.label("bound too wide");
    findings_.see(place, value.attribute);
    findings_.label(c == 0 ? "zero" : c > 0 ? "positive integer" : "negative integer");
    const float drawn = actual(value);
    const double truncated = std::trunc(double{drawn});
    if (truncated < c) findings_.label("truncates to the integer below");
    if (truncated > c) findings_.label("truncates to the integer above");
    if (std::round(double{drawn}) == c) return;
    findings_.report(
        place, value.attribute, drawn, fmt::format("{}", c),
        fmt::format("all three vertices have {}; the nearest integer is {}, truncation gives {}", c,
                    std::round(double{drawn}), truncated));
  }

  const cases::Case* case_;
  const cases::Fragments* drawn_;
  ValueFindings findings_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  return check_drawn(c, backend, [](const cases::Case& clip, const backends::Drawn& drawn) {
    return IntegersCheck(clip, drawn).run();
  });
}

/// Integers as programs pass them: flags, bytes, indices, and some that leave few digits.
float random_integer(Draw& draw) {
  switch (draw.between(0, 5)) {
    case 0:
      return draw.pick(std::array{0.0F, 1.0F, -1.0F, 2.0F});
    case 1:
      return static_cast<float>(-draw.between(1, 1000));
    case 2: {  // beside a power of two, below which floats are twice as close
      const int power = 1 << draw.between(1, 20);
      const int step = draw.between(-1, 1);
      return static_cast<float>(power + step);
    }
    case 3:
      return static_cast<float>(draw.between(0, 1 << 22));
    default:
      return static_cast<float>(draw.between(0, 255));
  }
}

/// Makes most attributes the same integer over all vertices. A third of the cases have snapped
/// vertices.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  ensure_attribute(c);
  const std::size_t count = c.attributes.size();
  for (std::size_t a = 0; a < count; ++a) {
    if (a > 0 && draw.one_in(4)) continue;
    const float integer = random_integer(draw);
    for (std::size_t v = 0; v < c.positions.size(); ++v) {
      c.attribute_values[v * count + a] = integer;
    }
  }
  if (draw.one_in(3)) set_snapped_coverage(draw, c);
  return made;
}

const LawRegistration kRegistration(
    {.id = "integers-survive-rounding",
     .sentence = "integers survive rounding",
     .reason = "Σ c e_i / Σ e_i is c, and a bound below 1/2 leaves no other nearest integer.",
     .exceptions = "values whose bound is wider than that; flat attributes, which are copies; "
                   "truncation, which may give the integer before",
     .generate = &generate,
     .check = &check,
     .covers = {cover(13, "clipped"), cover(13, "negative integer"), cover(41, "positive integer"),
                cover(19, "several samples"), cover(27, "snapped"), cover(7, "w <= 0"),
                cover(3, "zero")}});

}  // namespace
}  // namespace rastercheck::properties::integers_survive_rounding_law
