#pragma once

// For laws that check values without knowing the exact values. Tells how far the contract lets
// floats be off, and asks the oracle about values that seem farther off. The oracle is a thousand
// times slower than a comparison of floats, so a law compares first and asks only about offenders.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "cases/case.h"
#include "properties/law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"

namespace rastercheck::properties {

/// The part of a bound, in ULP, without the final rounding to float32. A bound below 1 can only be
/// met by rounding a more precise result once, and this rounding takes half an ulp; two roundings
/// in float32 would break the bound. For a greater bound nothing is known about the roundings.
constexpr double before_rounding(double bound) { return bound < 1 ? bound - 0.5 : bound; }

/// The least and the greatest float within `bound` units of numbers from lo to hi. Rounding is
/// monotone, so the ends are moved by before_rounding(bound) and rounded. The sums may be off by
/// one double, so each is moved outwards by one double before it is rounded.
float least_float(double lo, double bound, double unit);
float greatest_float(double hi, double bound, double unit);

/// The contract's promise, found by the oracle, for a value at a required sample. The exact value
/// may be any number from `lo` to `hi`, and a float may be off by `bound`. The doubles are rounded
/// outwards.
struct ValuePromise {
  double lo = 0;
  double hi = 0;
  double bound = 0;  ///< scale ULP
  double unit = 0;   ///< the scale's ulp
};

/// Counts the values of a drawing that a law has checked, and asks the oracle about values.
class ValueFindings {
 public:
  ValueFindings(const cases::Case& c, const cases::Contract& contract);

  const cases::Case& source() const { return *case_; }
  const cases::Contract& contract() const { return *contract_; }

  /// The contract's bound for an attribute or, if `attribute` is empty, for the depth.
  const cases::ValueBound& bound_of(std::optional<std::uint32_t> attribute) const;

  /// True if a triangle is one plane for all vertex positions that the contract allows. A snapped
  /// triangle that is also clipped consists of several planes.
  bool is_one_plane(std::uint32_t triangle);
  /// True if a sample must be drawn; other samples are left to laws about coverage.
  bool is_required(const cases::SamplePlace& place);
  /// Returns the promise for a value; nothing if the sample is not required, or if the value is
  /// undefined or unbounded.
  std::optional<ValuePromise> promise_of(const cases::SamplePlace& place,
                                         std::optional<std::uint32_t> attribute);

  void label(const std::string& text) { tally_.label(text); }
  /// Counts a value that the law has checked, right or wrong.
  void see(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute);
  /// Reports a wrong value among those counted by see(). `exact` is what the law expects.
  void report(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute, float actual,
              const std::string& exact, const std::string& note);

  /// Returns the check; not applicable if no value was seen.
  Check finish();

 private:
  const cases::Case* case_;
  const cases::Contract* contract_;
  Verdicts verdicts_;
  std::optional<cases::SamplePlace> last_;
  Tally tally_;
};

}  // namespace rastercheck::properties
