#pragma once

// The contents of a contract file: promises that replace the backend's own. A missing term keeps
// the backend's own promise.

#include <optional>
#include <string>
#include <variant>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/driver_promise.h"

namespace rastercheck::cases {

/// The promise is whatever the case asks for.
struct AsAsked {
  bool operator==(const AsAsked&) const = default;
};

template <typename Promise>
using Term = std::optional<std::variant<AsAsked, Promise>>;

/// The grid that the case names, but with this rounding and this error whatever the case says;
/// exact coverage if the case asks for no grid.
struct AskedGrid {
  Rounding rounding = Rounding::nearest_even;
  float position_error = 0;
  std::optional<Rounding> rounding_of_y = {};
  bool operator==(const AskedGrid&) const = default;
};
using CoverageTerm = std::optional<std::variant<AsAsked, AskedGrid, Coverage>>;

struct ContractTerms {
  std::string name;  ///< a name for people
  /// Chooses among the promises of an API; applies to drivers only.
  std::optional<DriverPromise> promise;
  CoverageTerm coverage;
  std::optional<bool> is_on_grid;
  Term<Basis> basis;  ///< ideal if coverage is exact
  Term<TieRule> tie_rule;
  /// If only the inner value is empty, samples are covered, not pixels.
  std::optional<std::optional<Conservative>> conservative;
  std::optional<float> guard_band;
  std::optional<float> guard_beyond_viewport;
  std::optional<bool> culls_instead_of_clipping;
  std::optional<Winding> culls;
  std::optional<float> least_area;
  std::optional<PixelFraction> sample_position;
  std::optional<float> clip_tolerance;
  std::optional<float> clip_error;
  std::optional<float> viewport_error;
  std::optional<DepthFormat> depth_format;
  std::optional<DepthStore> depth_store;
  std::optional<BiasPromise> depth_bias;
  std::optional<KeptDepth> depth_function;
  std::optional<DepthError> depth_error;
  std::optional<Claim> claims;
  std::optional<ValueBound> smooth;
  std::optional<ValueBound> noperspective;
  std::optional<ValueBound> depth;
  std::optional<bool> keeps_equal_depth;
  std::optional<bool> keeps_constants;
  std::optional<bool> keeps_vertex_values;
  std::optional<bool> keeps_sign_of_zero;
  std::optional<bool> is_invariant;
  /// If only the inner value is empty, nothing is promised.
  std::optional<std::optional<float>> derivative_bound;
  std::optional<std::optional<float>> quad_share;
  std::optional<MagnitudeRange> numbers;
  bool operator==(const ContractTerms&) const = default;
};

/// Returns the contract of a case for a backend whose own promises are `own`.
Contract with_terms(Contract own, const ContractTerms& terms, const Case& c);

}  // namespace rastercheck::cases
