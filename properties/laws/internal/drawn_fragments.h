#pragma once

// For laws that compare two drawings: finds fragments by place and compares their values.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "cases/case.h"
#include "cases/fragments.h"
#include "cases/picture.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// The pixel and sample at index `at` of a picture; the triangle is 0.
cases::SamplePlace place_at(const cases::Picture& picture, std::size_t at);
/// The index of a place in a picture; the index of its pixel if the samples have been resolved.
std::size_t index_at(const cases::Picture& picture, const cases::SamplePlace& place);

/// True if the case has the triangle, pixel and sample of `place`.
bool is_of_case(const cases::Case& c, const cases::SamplePlace& place);

/// The index of the fragment at each place; the first one if a place has several.
using FragmentMap = std::map<cases::SamplePlace, std::size_t>;
FragmentMap fragments_by_place(const cases::Fragments& drawn);

/// A coverage violation at a place. `exact` is what the law expects; `actual` follows from the
/// class.
records::Violation violation_at(const cases::SamplePlace& place,
                                records::FragmentClass fragment_class, const std::string& exact,
                                const std::string& note);

/// Texts for Violation::exact if only one of two drawings has the fragment.
inline constexpr const char* kNotDrawnBefore = "forbidden: the other drawing does not have it";
inline constexpr const char* kDrawnTwice = "forbidden: drawn more than once";
inline constexpr const char* kDrawnBefore = "required: the other drawing has it";

/// Matches the fragments of two drawings by place, whatever their order. Calls
///
///   both(place, i, j)          if both have one there: number i of `before`, number j of `now`
///   extra(place, j, expected)  if `before` has none there, or if number j is the second one of
///                              `now` there; `expected` is the text for that reason
///   missing(place)             if only `before` has one there; called after the other two
template <typename Both, typename Extra, typename Missing>
void visit_places(const cases::Fragments& before, const cases::Fragments& now, const Both& both,
                  const Extra& extra, const Missing& missing) {
  const FragmentMap places = fragments_by_place(before);
  std::set<cases::SamplePlace> seen;
  for (std::size_t j = 0; j < now.size(); ++j) {
    const cases::SamplePlace place = now.place_of(j);
    const auto found = places.find(place);
    if (found == places.end()) {
      extra(place, j, kNotDrawnBefore);
    } else if (!seen.insert(place).second) {
      extra(place, j, kDrawnTwice);
    } else {
      both(place, found->second, j);
    }
  }
  for (const auto& [place, index] : places) {
    if (!seen.contains(place)) missing(place);
  }
}

/// A wrong value in a drawing.
struct WrongValue {
  records::AttributeKind kind = records::AttributeKind::depth;
  std::optional<std::uint32_t> attribute;  ///< empty for depths and other values
  float actual = 0;
};

/// A violation caused by a wrong value at a place.
records::Violation violation_at(const cases::SamplePlace& place,
                                records::FragmentClass fragment_class, const std::string& exact,
                                const std::string& note, const WrongValue& value);

/// The kind of an attribute, or of the depth if `attribute` is empty.
records::AttributeKind kind_of(const cases::Case& c, std::optional<std::uint32_t> attribute);

/// True if two values have the same bits or are both NaN.
bool is_same(float a, float b);

/// The class of a wrong value: not a number, infinite, or else `of_number`.
records::FragmentClass class_of_wrong(float actual, records::FragmentClass of_number);

/// The class of a value that should be `expected`.
records::FragmentClass class_of(float actual, float expected);

/// Compares two fragments bit by bit: returns the first depth or attribute that differs as a
/// violation at the fragment's place, or nothing. Derivatives count as values if both drawings have
/// them. Any two NaNs are the same.
std::optional<records::Violation> find_difference(const cases::Case& c,
                                                  const cases::Fragments& expected,
                                                  std::size_t expected_fragment,
                                                  const cases::Fragments& drawn,
                                                  std::size_t fragment, const std::string& note);

}  // namespace rastercheck::properties
