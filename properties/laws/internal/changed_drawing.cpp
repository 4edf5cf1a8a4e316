#include "properties/laws/internal/changed_drawing.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

#include "cases/some_fragments.h"
#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::FragmentClass;

/// The number of fragments to judge is limited: judging values takes far longer than comparing
/// them.
constexpr std::size_t kMostJudged = 16;

bool has_same_values(const cases::Fragments& a, std::size_t i, const cases::Fragments& b,
                     std::size_t j) {
  const auto of_a = a.attributes_of(i);
  const auto of_b = b.attributes_of(j);
  return is_same(a.depth[i], b.depth[j]) &&
         std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), &is_same);
}

/// How one drawing differs from the other.
struct Difference {
  bool is_in_places = false;
  std::vector<std::size_t> others;  ///< fragments without a match in place and values
  std::set<std::uint32_t> triangles;
};

Difference difference_of(const cases::Case& c, const cases::Fragments& before,
                         const cases::Fragments& drawn) {
  Difference difference;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (is_of_case(c, drawn.place_of(i))) difference.triangles.insert(drawn.triangle[i]);
  }
  difference.is_in_places = before.size() != drawn.size();
  visit_places(
      before, drawn,
      [&](const cases::SamplePlace& /*place*/, std::size_t was, std::size_t now) {
        if (!has_same_values(before, was, drawn, now)) difference.others.push_back(now);
      },
      [&](const cases::SamplePlace& /*place*/, std::size_t now, const char* /*expected*/) {
        difference.is_in_places = true;
        difference.others.push_back(now);
      },
      [&](const cases::SamplePlace& /*place*/) { difference.is_in_places = true; });
  return difference;
}

/// Merges the findings on values only.
void merge_values(Check& into, Check&& values) {
  values.judgement.counts = {};
  values.judgement.errors.erase(AttributeKind::coverage);
  merge(into, values);
}

}  // namespace

Check judge_changed(const cases::Case& c, const cases::Contract& contract,
                    const cases::Fragments& before, const cases::Fragments& drawn,
                    std::uint64_t index) {
  const Difference difference = difference_of(c, before, drawn);
  Check check;
  if (difference.is_in_places) {
    check = judge_drawn(c, contract, drawn, {.judges_values = false}, index);
  } else {
    check.judgement.counts.required = drawn.size();
    check.judgement.errors[AttributeKind::coverage].classes[FragmentClass::correct] = drawn.size();
  }
  std::set<std::string> labels(check.labels.begin(), check.labels.end());
  if (!difference.triangles.empty()) {
    labels.emplace("drawn");
    if (c.coverage) labels.emplace("snapped");
  }
  add_state_labels(c, difference.triangles, labels);
  check.labels.assign(labels.begin(), labels.end());
  if (!difference.others.empty()) {
    const cases::Fragments part =
        cases::some_fragments(drawn, some_of(difference.others, kMostJudged));
    merge_values(check, judge_drawn(c, contract, part, {.counts_coverage = false}, index));
  }
  return check;
}

}  // namespace rastercheck::properties
