#include "properties/campaign/internal/put_right.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "cases/sample_place.h"
#include "oracle/judge.h"
#include "oracle/stored_values.h"
#include "oracle/triangle_truth.h"
#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

using cases::Fragments;
using cases::SamplePlace;
using records::DrawnPart;
using records::FragmentClass;

/// Returns a permitted number, or 0 if the rules do not define the value.
float permitted(const std::optional<oracle::ValueRange>& range) {
  if (!range) return 0;
  const float lo = range->lo.nearest_float();
  return range->is_open ? lo + (range->hi.nearest_float() - lo) / 2 : lo;
}

/// The corrections that a drawing needs.
struct Repairs {
  std::map<SamplePlace, std::size_t> too_many;  ///< number of fragments to remove from a place
  std::map<SamplePlace, std::vector<float>> missing;  ///< depth, then attributes
  /// The value to write, by place and attribute. An empty attribute stands for the depth.
  std::map<SamplePlace, std::map<std::optional<std::uint32_t>, float>> wrong;

  bool is_none() const { return too_many.empty() && missing.empty() && wrong.empty(); }
};

float permitted_value(const cases::Case& c, const oracle::TriangleTruth& truth,
                      std::optional<std::uint32_t> attribute, const SamplePlace& place) {
  const auto x = static_cast<int>(place.x);
  const auto y = static_cast<int>(place.y);
  const auto sample = static_cast<int>(place.sample);
  if (attribute) return permitted(truth.attribute(*attribute, x, y, sample));
  const std::optional<oracle::ValueRange> depth = truth.depth(x, y, sample);
  const bool is_unorm = c.depth_format != cases::DepthFormat::float32;
  return depth && is_unorm ? oracle::stored_depth(depth->lo, c.depth_format) : permitted(depth);
}

std::vector<float> permitted_values(const cases::Case& c, const oracle::TriangleTruth& truth,
                                    const SamplePlace& place) {
  std::vector<float> values{permitted_value(c, truth, std::nullopt, place)};
  for (std::uint32_t a = 0; a < c.attributes.size(); ++a) {
    values.push_back(permitted_value(c, truth, a, place));
  }
  return values;
}

records::Violation coverage_violation(const cases::Case& c, const oracle::JudgedSample& sample,
                                      const oracle::TriangleTruth* truth) {
  records::Violation violation;
  violation.fragment_class = sample.fragment_class;
  violation.place = sample.place;
  if (truth == nullptr || !is_sample_of(c, sample.place)) return violation;
  violation.distance =
      truth->distance(static_cast<int>(sample.place.x), static_cast<int>(sample.place.y),
                      static_cast<int>(sample.place.sample));
  return violation;
}

records::Violation value_violation(const oracle::JudgedSample& sample,
                                   const oracle::JudgedValue& value) {
  records::Violation violation;
  violation.fragment_class = value.fragment_class;
  violation.kind = value.kind;
  violation.place = sample.place;
  violation.attribute = value.attribute;
  violation.error = value.excess;
  return violation;
}

Repairs repairs_of(const cases::Case& c, const cases::Contract& contract, const IsMeant& is_meant,
                   bool judges_values, const Fragments& drawn) {
  Repairs repairs;
  const oracle::SceneTruth scene(c, contract);
  oracle::JudgeOptions options;
  options.judges_values = judges_values;
  options.self_check_one_in = 0;
  options.shows_ordinary = false;
  const auto take = [&](const oracle::JudgedSample& sample, const oracle::TriangleTruth* truth) {
    const bool is_wrong = sample.fragment_class != FragmentClass::correct;
    const bool is_missing = sample.fragment_class == FragmentClass::missing;
    const bool is_to_change = is_wrong && is_meant(coverage_violation(c, sample, truth));
    if (is_to_change && !is_missing) ++repairs.too_many[sample.place];
    if (truth == nullptr) return;
    if (is_to_change && is_missing) {
      repairs.missing[sample.place] = permitted_values(c, *truth, sample.place);
    }
    for (const oracle::JudgedValue& value : sample.values) {
      if (value.fragment_class == FragmentClass::correct) continue;
      if (!is_meant(value_violation(sample, value))) continue;
      repairs.wrong[sample.place][value.attribute] =
          permitted_value(c, *truth, value.attribute, sample.place);
    }
  };
  oracle::judge(scene, drawn, options, take);
  return repairs;
}

/// Adds a fragment without derivatives.
void append_fragment(Fragments& to, const SamplePlace& place,
                     std::vector<float>::const_iterator values) {
  to.triangle.push_back(place.triangle);
  to.x.push_back(static_cast<std::uint16_t>(place.x));
  to.y.push_back(static_cast<std::uint16_t>(place.y));
  to.sample.push_back(static_cast<std::uint8_t>(place.sample));
  to.depth.push_back(*values);
  const auto count = static_cast<std::ptrdiff_t>(to.attribute_count);
  to.attributes.insert(to.attributes.end(), values + 1, values + 1 + count);
}

/// Sorts fragments by place, the order in which backends should return them.
void sort_by_place(Fragments& drawn) {
  std::vector<std::size_t> order(drawn.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto is_before = [&drawn](std::size_t a, std::size_t b) {
    return drawn.place_of(a) < drawn.place_of(b);
  };
  if (std::is_sorted(order.begin(), order.end(), is_before)) return;
  std::stable_sort(order.begin(), order.end(), is_before);
  Fragments sorted;
  sorted.attribute_count = drawn.attribute_count;
  for (const std::size_t i : order) {
    std::vector<float> values{drawn.depth[i]};
    const auto attributes = drawn.attributes_of(i);
    values.insert(values.end(), attributes.begin(), attributes.end());
    append_fragment(sorted, drawn.place_of(i), values.cbegin());
    if (drawn.derivatives.empty()) continue;
    const auto derivatives = drawn.derivatives_of(i);
    sorted.derivatives.insert(sorted.derivatives.end(), derivatives.begin(), derivatives.end());
  }
  drawn = std::move(sorted);
}

void repair(Repairs repairs, Fragments& drawn) {
  // Fragments are ordered by place, and stay so. If a place is drawn twice, any of its fragments
  // may be removed.
  Fragments right;
  right.attribute_count = drawn.attribute_count;
  const std::size_t derivatives = drawn.derivatives.empty() ? 0 : 2 * drawn.attribute_count;
  auto missing = repairs.missing.cbegin();
  const auto add_missing_before = [&](const std::optional<SamplePlace>& place) {
    for (; missing != repairs.missing.cend() && (!place || missing->first < *place); ++missing) {
      append_fragment(right, missing->first, missing->second.cbegin());
      right.derivatives.insert(right.derivatives.end(), derivatives, 0.0F);
    }
  };
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const SamplePlace place = drawn.place_of(i);
    add_missing_before(place);
    const auto gone = repairs.too_many.find(place);
    if (gone != repairs.too_many.end() && gone->second > 0) {
      --gone->second;
      continue;
    }
    std::vector<float> values{drawn.depth[i]};
    const auto attributes = drawn.attributes_of(i);
    values.insert(values.end(), attributes.begin(), attributes.end());
    if (const auto wrong = repairs.wrong.find(place); wrong != repairs.wrong.end()) {
      for (const auto& [attribute, value] : wrong->second) {
        values[attribute ? 1 + *attribute : 0] = value;
      }
    }
    append_fragment(right, place, values.cbegin());
    if (derivatives == 0) continue;
    const auto of_fragment = drawn.derivatives_of(i);
    right.derivatives.insert(right.derivatives.end(), of_fragment.begin(), of_fragment.end());
  }
  add_missing_before(std::nullopt);
  drawn = std::move(right);
}

/// Returns the place with triangle 0, so that the same sample of different triangles compares
/// equal.
SamplePlace sample_of(SamplePlace place) {
  place.triangle = 0;
  return place;
}

void put_right(const cases::Case& c, const cases::Contract& contract, const IsMeant& is_meant,
               bool judges_values, Fragments& drawn) {
  Fragments sorted = drawn;
  sort_by_place(sorted);
  const Repairs repairs = repairs_of(c, contract, is_meant, judges_values, sorted);
  if (repairs.is_none()) return;
  std::set<SamplePlace> freed;
  for (const auto& [place, times] : repairs.too_many) freed.insert(sample_of(place));
  repair(repairs, sorted);
  drawn = std::move(sorted);
  if (c.depth_test == cases::DepthTest::none || freed.empty()) return;
  // A removed fragment may have hidden another that must be drawn.
  const auto is_hidden = [&freed](const records::Violation& violation) {
    return violation.fragment_class == FragmentClass::missing &&
           freed.contains(sample_of(violation.place));
  };
  repair(repairs_of(c, contract, is_hidden, false, drawn), drawn);
}

}  // namespace

DrawnPart part_of(records::AttributeKind kind) {
  switch (kind) {
    case records::AttributeKind::coverage:
      return DrawnPart::coverage;
    case records::AttributeKind::depth:
      return DrawnPart::depth;
    case records::AttributeKind::smooth:
    case records::AttributeKind::noperspective:
    case records::AttributeKind::flat:
      break;
  }
  return DrawnPart::values;
}

void put_right(const cases::Case& c, const cases::Contract& contract, const IsMeant& is_meant,
               Fragments& drawn) {
  put_right(c, contract, is_meant, true, drawn);
}

void put_right(const cases::Case& c, const cases::Contract& contract, const DrawnParts& parts,
               Fragments& drawn) {
  if (parts.empty()) return;
  const bool judges_values = parts.contains(DrawnPart::depth) || parts.contains(DrawnPart::values);
  const auto is_meant = [&parts](const records::Violation& violation) {
    return parts.contains(part_of(violation.kind));
  };
  put_right(c, contract, is_meant, judges_values, drawn);
}

}  // namespace rastercheck::properties
