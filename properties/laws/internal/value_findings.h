#pragma once

// What laws have in common that say something of values without knowing the exact ones: how far a
// contract lets floats be off, and, of values that seem to be farther, what the oracle says. Asking
// it is a thousand times as slow as comparing floats, so a law compares first and asks of offenders
// alone.

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

/// The part of a bound, in ULP, that is not the rounding to float32 at the end. A bound below 1 is
/// that of a closer result rounded once, which takes half an ulp: with two roundings in float32 it
/// could not be kept. Of a greater one nobody knows when what was rounded.
constexpr double before_rounding(double bound) { return bound < 1 ? bound - 0.5 : bound; }

/// The ends of what a float may be that is within `bound` units of numbers from lo to hi: rounding
/// is monotone, so that it is no farther than the ends, moved by what is not rounding, rounded. The
/// sums may be off by a double, and are taken one farther out.
float least_float(double lo, double bound, double unit);
float greatest_float(double hi, double bound, double unit);

/// What the oracle says of a value that was drawn where something is required: the numbers that the
/// contract leaves open, and how far beyond them a float may be. In doubles, none too narrow.
struct ValuePromise {
  double lo = 0;
  double hi = 0;
  double bound = 0;  ///< scale ULP
  double unit = 0;   ///< the scale's ulp
};

/// Of a drawing: counts what a law has looked at, and asks the oracle.
class ValueFindings {
 public:
  ValueFindings(const cases::Case& c, const cases::Contract& contract);

  const cases::Case& source() const { return *case_; }
  const cases::Contract& contract() const { return *contract_; }

  /// The bound without its share for the horizon: of an attribute, or of the depth.
  const cases::ValueBound& bound_of(std::optional<std::uint32_t> attribute) const;

  /// Whether all of a triangle is one plane wherever the contract lets its vertices be: snapped
  /// ones that are clipped as well are several.
  bool is_one_plane(std::uint32_t triangle);
  /// Whether a sample has to be drawn: what is not is a matter of coverage.
  bool is_required(const cases::SamplePlace& place);
  /// Nothing where the sample is not required, or the value undefined or not bounded.
  std::optional<ValuePromise> promise_of(const cases::SamplePlace& place,
                                         std::optional<std::uint32_t> attribute);

  void label(const std::string& text) { tally_.label(text); }
  /// Values that the law has looked at, right or wrong.
  void see(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute);
  /// A wrong one among them. `exact` is what the law expects.
  void report(const cases::SamplePlace& place, std::optional<std::uint32_t> attribute, float actual,
              const std::string& exact, const std::string& note);

  /// Says nothing of the case where nothing was seen.
  Check finish();

 private:
  const cases::Case* case_;
  const cases::Contract* contract_;
  Verdicts verdicts_;
  std::optional<cases::SamplePlace> last_;
  Tally tally_;
};

}  // namespace rastercheck::properties
