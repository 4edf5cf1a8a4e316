#include "properties/laws/internal/same_drawing.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {
namespace {

using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

bool are_same(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), &is_same);
}

/// Whether the two are fragment by fragment the same, and each is in a place after the one before:
/// what most drawings are, told without looking anything up.
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

/// The labels of what was drawn of these triangles.
std::vector<std::string> labels_of(const cases::Case& c, const std::set<std::uint32_t>& triangles) {
  std::set<std::string> labels;
  if (!triangles.empty()) labels.emplace("drawn");
  add_state_labels(c, triangles, labels);
  return {labels.begin(), labels.end()};
}

/// What compare_drawings() says of two that are alike.
Check alike(const cases::Case& c, const Fragments& drawn) {
  Check check;
  check.judgement.counts.required = drawn.size();
  check.judgement.errors[AttributeKind::coverage].classes[FragmentClass::correct] = drawn.size();
  std::set<std::uint32_t> triangles;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const bool is_next = i == 0 || drawn.triangle[i] != drawn.triangle[i - 1];
    if (is_next && is_of_case(c, drawn.place_of(i))) triangles.insert(drawn.triangle[i]);
  }
  check.labels = labels_of(c, triangles);
  return check;
}

}  // namespace

Check compare_drawings(const cases::Case& c, const cases::Fragments& expected,
                       const cases::Fragments& drawn, const std::string& note) {
  if (are_alike(expected, drawn)) return alike(c, drawn);
  Check check;
  check.judgement.errors[AttributeKind::coverage];
  const FragmentMap places = fragments_by_place(expected);
  std::set<cases::SamplePlace> seen;
  std::set<std::uint32_t> triangles;
  std::uint64_t correct = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const cases::SamplePlace place = drawn.place_of(i);
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
  check.labels = labels_of(c, triangles);
  return check;
}

}  // namespace rastercheck::properties
