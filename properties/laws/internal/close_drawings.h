#pragma once

// For laws that compare two drawings with the same exact truth, which the contract promises to
// match only to within a bound.
//
// Let r be the exact value, and let f and g be the values in the two drawings, off by at most a and
// b. Then |f − g| <= |f − r| + |g − r| <= a + b, so no truth has to be computed.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "cases/case.h"
#include "cases/fragments.h"
#include "properties/law.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {

/// How far a value may be off where the contract gives a bound: by `units` scale ULP (RULES §5) for
/// vertex values up to `magnitude`.
struct ValueAllowance {
  double units = 0;
  double magnitude = 0;
};

ValueAllowance depth_allowance(const cases::Case& c, const cases::Contract& contract);

/// The allowance for an attribute located at the sample. Empty if the APIs leave the value open (an
/// attribute that is linear in window space, and some w <= 0), or if its bound depends on more than
/// the vertices' values and w (cases::ValueBound). Also empty if the bound grows towards a horizon
/// that may be anywhere, because some w <= 0 or because the sample need not be covered. If all w >
/// 0 and the sample is covered, 1/w is a mean of the vertices' 1/w, and the horizon ratio is at
/// most max w / min w.
std::optional<ValueAllowance> value_allowance(const cases::Case& c, const cases::Contract& contract,
                                              const cases::Triangle& triangle,
                                              std::size_t attribute);

/// The greatest possible difference of two numbers whose errors against the same r are together at
/// most `both`. |r| may exceed the magnitude M, since snapping covers samples beyond the exact
/// triangle. But for u units and the greater magnitude h of the two numbers, |r| <= h + u ulp(r) <=
/// h + u 2^-23 |r|, and so
///
///   |f − g| <= u ulp(max(M, h / (1 − u 2^-23)))       u < 2^22, else unlimited
double greatest_difference(const ValueAllowance& both, double f, double g);

/// The permitted differences between two drawings of the same triangles.
struct Closeness {
  /// The allowances of both drawings together, for an attribute's values or (without an attribute)
  /// for depths. If empty, the values are not compared.
  std::function<std::optional<ValueAllowance>(std::uint32_t triangle,
                                              std::optional<std::uint32_t> attribute)>
      allowed;
  /// True if the depth or attribute is undefined at the place. Called only for values that differ
  /// too much.
  std::function<bool(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute)>
      is_undefined;
  /// True if the contract leaves open how often a sample is drawn. Called only for samples that one
  /// drawing has less often than the other, or that the second drawing has twice.
  std::function<bool(const cases::SamplePlace& place)> is_open;
  /// Tells readers how the second drawing was made.
  std::string note;
};

/// Checks that `drawn` has the fragments of `expected`, each once, with values as close as
/// `closeness` demands. `c` is the case of `expected`; its state gives the labels.
Check compare_close(const cases::Case& c, const cases::Fragments& expected,
                    const cases::Fragments& drawn, const Closeness& closeness);

}  // namespace rastercheck::properties
