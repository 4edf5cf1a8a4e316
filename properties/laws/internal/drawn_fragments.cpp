#include "properties/laws/internal/drawn_fragments.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "properties/draw.h"
#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::Violation;

}  // namespace

cases::SamplePlace place_at(const cases::Picture& picture, std::size_t at) {
  const auto samples = static_cast<std::size_t>(picture.size.samples);
  const auto width = static_cast<std::size_t>(picture.size.width);
  cases::SamplePlace place;
  place.x = static_cast<std::uint32_t>(at / samples % width);
  place.y = static_cast<std::uint32_t>(at / samples / width);
  place.sample = static_cast<std::uint32_t>(at % samples);
  return place;
}

std::size_t index_at(const cases::Picture& picture, const cases::SamplePlace& place) {
  const auto samples = static_cast<std::size_t>(picture.size.samples);
  const auto width = static_cast<std::size_t>(picture.size.width);
  return (place.y * width + place.x) * samples + (samples > 1 ? place.sample : 0);
}

bool is_of_case(const cases::Case& c, const cases::SamplePlace& place) {
  return place.triangle < c.triangles.size() && std::cmp_less(place.x, c.framebuffer.width) &&
         std::cmp_less(place.y, c.framebuffer.height) &&
         std::cmp_less(place.sample, c.framebuffer.samples);
}

FragmentMap fragments_by_place(const cases::Fragments& drawn) {
  FragmentMap by_place;
  for (std::size_t i = 0; i < drawn.size(); ++i) by_place.try_emplace(drawn.place_of(i), i);
  return by_place;
}

bool is_same(float a, float b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

FragmentClass class_of_wrong(float actual, FragmentClass of_number) {
  if (std::isnan(actual)) return FragmentClass::not_a_number;
  return std::isinf(actual) ? FragmentClass::infinite : of_number;
}

FragmentClass class_of(float actual, float expected) {
  if (is_same(actual, expected)) return FragmentClass::correct;
  return class_of_wrong(
      actual, actual == expected ? FragmentClass::wrong_sign_of_zero : FragmentClass::beyond_bound);
}

Violation violation_at(const cases::SamplePlace& place, FragmentClass fragment_class,
                       const std::string& exact, const std::string& note) {
  Violation violation;
  violation.fragment_class = fragment_class;
  violation.kind = AttributeKind::coverage;
  violation.place.triangle = place.triangle;
  violation.place.x = place.x;
  violation.place.y = place.y;
  violation.place.sample = place.sample;
  violation.exact = exact;
  violation.actual = fragment_class == FragmentClass::missing ? "not drawn" : "drawn";
  violation.note = note;
  return violation;
}

Violation violation_at(const cases::SamplePlace& place, FragmentClass fragment_class,
                       const std::string& exact, const std::string& note, const WrongValue& value) {
  Violation violation = violation_at(place, fragment_class, exact, note);
  violation.kind = value.kind;
  violation.attribute = value.attribute;
  violation.actual = value_text(value.actual);
  return violation;
}

AttributeKind kind_of(const cases::Case& c, std::optional<std::uint32_t> attribute) {
  return attribute ? records::kind_of(c.attributes[*attribute].interpolation)
                   : AttributeKind::depth;
}

std::optional<Violation> find_difference(const cases::Case& c, const cases::Fragments& expected,
                                         std::size_t expected_fragment,
                                         const cases::Fragments& drawn, std::size_t fragment,
                                         const std::string& note) {
  const auto differs = [&](std::optional<std::uint32_t> attribute, float before, float now,
                           const std::string& why) {
    return violation_at(drawn.place_of(fragment), class_of(now, before), value_text(before), why,
                        {kind_of(c, attribute), attribute, now});
  };
  const float depth = expected.depth[expected_fragment];
  if (!is_same(depth, drawn.depth[fragment])) {
    return differs(std::nullopt, depth, drawn.depth[fragment], note);
  }
  const auto before = expected.attributes_of(expected_fragment);
  const auto now = drawn.attributes_of(fragment);
  const bool has_derivatives = !expected.derivatives.empty() && !drawn.derivatives.empty();
  for (std::uint32_t a = 0; a < c.attributes.size(); ++a) {
    if (!is_same(before[a], now[a])) return differs(a, before[a], now[a], note);
    for (std::size_t axis = 0; has_derivatives && axis < 2; ++axis) {
      const float one = expected.derivatives_of(expected_fragment)[std::size_t{2} * a + axis];
      const float other = drawn.derivatives_of(fragment)[std::size_t{2} * a + axis];
      if (is_same(one, other)) continue;
      return differs(
          a, one, other,
          fmt::format("the derivative along window {}; {}", axis == 0 ? 'x' : 'y', note));
    }
  }
  return std::nullopt;
}

}  // namespace rastercheck::properties
