#pragma once

// What laws have in common that hold one drawing against another that has the same exact truth,
// where the contract promises either only to within a bound.
//
// Let r be the exact value, and f and g two drawings' values of it that are off by at most a and b.
// Then |f − g| <= |f − r| + |g − r| <= a + b. So no truth has to be computed.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "cases/case.h"
#include "cases/fragments.h"
#include "properties/law.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {

/// How far a value may be off, beyond what its contract leaves open: `units` scale ULP (RULES §5)
/// of vertex values up to `magnitude`.
struct ValueAllowance {
  double units = 0;
  double magnitude = 0;
};

ValueAllowance depth_allowance(const cases::Case& c, const cases::Contract& contract);

/// Of an attribute located at the sample. Nothing where it is free, where the bound is not of the
/// vertices' values and w alone (cases::ValueBound), or where it grows towards a horizon that may
/// be anywhere, as some w <= 0 or the sample need not be covered; elsewhere 1/w is a mean of the
/// vertices' and the horizon ratio at most max w / min w.
std::optional<ValueAllowance> value_allowance(const cases::Case& c, const cases::Contract& contract,
                                              const cases::Triangle& triangle,
                                              std::size_t attribute);

/// How far two numbers may be apart that are as far as that from the same r. |r| may be beyond the
/// magnitude M, as snapping covers samples beyond the exact triangle; but with u units
/// |r| <= h + u ulp(r) <= h + u 2^-23 |r|, h the greater number, and so
///
///   |f − g| <= u ulp(max(M, h / (1 − u 2^-23)))       u < 2^22, else anything may be
double greatest_difference(const ValueAllowance& both, double f, double g);

/// Of two drawings of the same triangles.
struct Closeness {
  /// How far apart depths (nothing) or values of an attribute may be, units of both drawings;
  /// nothing: they are left alone.
  std::function<std::optional<ValueAllowance>(std::uint32_t triangle,
                                              std::optional<std::uint32_t> attribute)>
      allowed;
  /// Whether a value that should not be as it is, a depth or an attribute's, is undefined there.
  /// Asked of these alone.
  std::function<bool(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute)>
      is_undefined;
  /// Whether a sample that one of the two draws less often than the other, or the second draws
  /// twice, may be drawn so. Asked of these alone.
  std::function<bool(const cases::SamplePlace& place)> is_open;
  /// How the second drawing came about.
  std::string note;
};

/// Holds `drawn` to have the fragments of `expected`, each once, and values as close as that. The
/// case is that of `expected`, and its state gives the labels.
Check compare_close(const cases::Case& c, const cases::Fragments& expected,
                    const cases::Fragments& drawn, const Closeness& closeness);

}  // namespace rastercheck::properties
