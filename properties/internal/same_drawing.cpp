#include "properties/internal/same_drawing.h"

#include <set>

#include "properties/internal/drawn_fragments.h"
#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::FragmentClass;

/// A violation, counted in its class as well.
void report(Check& check, const records::Violation& violation) {
  ++check.judgement.errors[violation.kind].classes[violation.fragment_class];
  note(check, violation);
}

}  // namespace

Check compare_drawings(const cases::Case& c, const cases::Framebuffer& expected,
                       const cases::Framebuffer& drawn, const std::string& note) {
  Check check;
  check.judgement.errors[AttributeKind::coverage];
  const FragmentMap places = fragments_by_place(expected);
  std::set<FragmentPlace> seen;
  std::set<std::uint32_t> triangles;
  std::uint64_t correct = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const FragmentPlace place = place_of(drawn, i);
    const auto before = places.find(place);
    if (before == places.end()) {
      report(check, violation_at(place, FragmentClass::extra, "forbidden: it was not drawn", note));
      continue;
    }
    if (!seen.insert(place).second) {
      report(check, violation_at(place, FragmentClass::extra, "forbidden: more than once", note));
      continue;
    }
    if (is_of_case(c, place)) triangles.insert(place.triangle);
    const auto difference = find_difference(c, expected, before->second, drawn, i, note);
    if (difference) {
      report(check, *difference);
    } else {
      ++correct;
    }
  }
  for (const auto& [place, index] : places) {
    if (seen.contains(place)) continue;
    report(check, violation_at(place, FragmentClass::missing, "required: it was drawn", note));
  }
  check.judgement.counts.required = places.size();
  check.judgement.errors[AttributeKind::coverage].classes[FragmentClass::correct] += correct;
  std::set<std::string> labels;
  if (!triangles.empty()) labels.emplace("drawn");
  add_state_labels(c, triangles, labels);
  check.labels.assign(labels.begin(), labels.end());
  return check;
}

}  // namespace rastercheck::properties
