#pragma once

// What a contract file says: promises in place of those that a backend makes of itself. A term that
// the file does not have leaves the backend's own promise as it is.

#include <optional>
#include <string>
#include <variant>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/driver_promise.h"

namespace rastercheck::cases {

/// What the case names is what is promised.
struct AsAsked {
  bool operator==(const AsAsked&) const = default;
};

template <typename Promise>
using Term = std::optional<std::variant<AsAsked, Promise>>;

/// The grid that the case names, whatever rounding and error it names; exact where it asks for
/// none.
struct AskedGrid {
  Rounding rounding = Rounding::nearest_even;
  float position_error = 0;
  bool operator==(const AskedGrid&) const = default;
};
using CoverageTerm = std::optional<std::variant<AsAsked, AskedGrid, Coverage>>;

struct ContractTerms {
  std::string name;  ///< for people
  /// Chooses among the promises of an API; counts for drivers alone.
  std::optional<DriverPromise> promise;
  CoverageTerm coverage;
  std::optional<bool> is_on_grid;
  Term<Basis> basis;  ///< ideal wherever coverage is exact
  Term<TieRule> tie_rule;
  std::optional<float> guard_band;
  std::optional<float> clip_tolerance;
  std::optional<float> clip_error;
  std::optional<float> viewport_error;
  std::optional<DepthFormat> depth_format;
  std::optional<Claim> claims;
  std::optional<ValueBound> smooth;
  std::optional<ValueBound> noperspective;
  std::optional<ValueBound> depth;
  std::optional<bool> keeps_equal_depth;
  std::optional<bool> keeps_constants;
  std::optional<bool> keeps_vertex_values;
  std::optional<bool> keeps_sign_of_zero;
  std::optional<bool> is_invariant;
  /// Nothing within: none are promised.
  std::optional<std::optional<float>> derivative_bound;
  std::optional<std::optional<float>> quad_share;
  std::optional<MagnitudeRange> numbers;
  bool operator==(const ContractTerms&) const = default;
};

/// The contract of a case for a backend that promises `own` of it.
Contract with_terms(Contract own, const ContractTerms& terms, const Case& c);

}  // namespace rastercheck::cases
