#include "properties/laws/internal/same_drawing.h"

#include <algorithm>
#include <string>
#include <vector>

#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"

namespace rastercheck::properties {
namespace {

using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

bool are_same(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), &is_same);
}

/// True if the two drawings have the same fragments in the same, strictly ascending order. Most
/// drawings do, and the check is cheap.
bool are_alike(const Fragments& a, const Fragments& b) {
  if (a.triangle != b.triangle || a.x != b.x || a.y != b.y || a.sample != b.sample) return false;
  if (!are_same(a.depth, b.depth) || !are_same(a.attributes, b.attributes)) return false;
  const bool has_derivatives = !a.derivatives.empty() && !b.derivatives.empty();
  if (has_derivatives && !are_same(a.derivatives, b.derivatives)) return false;
  for (std::size_t i = 1; i < a.size(); ++i) {
    if (!(a.place_of(i - 1) < a.place_of(i))) return false;
  }
  return true;
}

/// The result of compare_drawings() for two drawings that are_alike().
Check alike(const cases::Case& c, const Fragments& drawn) {
  Tally tally(c);
  tally.pass(AttributeKind::coverage, drawn.size());
  tally.counts().required = drawn.size();
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const bool is_next = i == 0 || drawn.triangle[i] != drawn.triangle[i - 1];
    if (is_next && is_of_case(c, drawn.place_of(i))) tally.see(drawn.triangle[i]);
  }
  tally.label_drawn();
  return tally.finish();
}

}  // namespace

Check compare_drawings(const cases::Case& c, const cases::Fragments& expected,
                       const cases::Fragments& drawn, const std::string& note) {
  if (are_alike(expected, drawn)) return alike(c, drawn);
  Tally tally(c);
  visit_places(
      expected, drawn,
      [&](const cases::SamplePlace& place, std::size_t before, std::size_t now) {
        ++tally.counts().required;
        if (is_of_case(c, place)) tally.see(place.triangle);
        if (const auto difference = find_difference(c, expected, before, drawn, now, note)) {
          tally.report(*difference);
        } else {
          tally.pass(AttributeKind::coverage);
        }
      },
      [&](const cases::SamplePlace& place, std::size_t /*now*/, const char* exact) {
        tally.report(violation_at(place, FragmentClass::extra, exact, note));
      },
      [&](const cases::SamplePlace& place) {
        ++tally.counts().required;
        tally.report(violation_at(place, FragmentClass::missing, kDrawnBefore, note));
      });
  tally.label_drawn();
  return tally.finish();
}

}  // namespace rastercheck::properties
