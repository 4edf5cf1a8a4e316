#pragma once

// What laws have in common that hold one drawing against another: where fragments are, whether two
// have the same values, and a number that depends on a case's contents alone.

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

/// Pixel and sample of an index into a picture; triangle 0.
cases::SamplePlace place_at(const cases::Picture& picture, std::size_t at);
/// The index of a place: of its pixel where the samples have been resolved.
std::size_t index_at(const cases::Picture& picture, const cases::SamplePlace& place);

/// Whether the case has such a triangle, pixel and sample.
bool is_of_case(const cases::Case& c, const cases::SamplePlace& place);

/// Where each fragment is found; of those in one place, the first.
using FragmentMap = std::map<cases::SamplePlace, std::size_t>;
FragmentMap fragments_by_place(const cases::Fragments& drawn);

/// A violation of coverage at a place: `exact` is what the law expects, `actual` is by the class.
records::Violation violation_at(const cases::SamplePlace& place,
                                records::FragmentClass fragment_class, const std::string& exact,
                                const std::string& note);

/// Say in a violation what was expected where only one of two drawings has a fragment.
inline constexpr const char* kNotDrawnBefore = "forbidden: it was not drawn";
inline constexpr const char* kDrawnTwice = "forbidden: more than once";
inline constexpr const char* kDrawnBefore = "required: it was drawn";

/// Goes through the fragments of two drawings by their places, in any order of fragments. Calls
///
///   both(place, i, j)          where both have one: `before` its i-th, `now` its j-th
///   extra(place, j, expected)  for one of `now` in a place that `before` has none in, or that
///   `now`
///                              has had before; `expected` is which of these
///   missing(place)             for a place that `before` alone has one in, after all others
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

/// A value that was drawn and should not have been.
struct WrongValue {
  records::AttributeKind kind = records::AttributeKind::depth;
  std::optional<std::uint32_t> attribute;  ///< nothing: the depth, or no attribute's
  float actual = 0;
};

/// A violation of a value at a place.
records::Violation violation_at(const cases::SamplePlace& place,
                                records::FragmentClass fragment_class, const std::string& exact,
                                const std::string& note, const WrongValue& value);

/// What an attribute is, or, of none, the depth.
records::AttributeKind kind_of(const cases::Case& c, std::optional<std::uint32_t> attribute);

/// Whether two values are the same bits; NaNs are alike.
bool is_same(float a, float b);

/// What a wrong value is: no number, infinite, or else a number that is wrong in this way.
records::FragmentClass class_of_wrong(float actual, records::FragmentClass of_number);

/// What a value is that should be `expected`.
records::FragmentClass class_of(float actual, float expected);

/// The first value, depth or attribute, of a fragment that differs from the one expected in any
/// bit, as a violation at the fragment's place; nothing where none does. Derivatives are values
/// too, where both drawings have them. NaNs are alike.
std::optional<records::Violation> find_difference(const cases::Case& c,
                                                  const cases::Fragments& expected,
                                                  std::size_t expected_fragment,
                                                  const cases::Fragments& drawn,
                                                  std::size_t fragment, const std::string& note);

/// A hash of the numbers that a case draws with: the same of a case that was written to a file and
/// read back, whatever its name.
std::uint64_t fingerprint(const cases::Case& c);

}  // namespace rastercheck::properties
