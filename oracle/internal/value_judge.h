#pragma once

// Judges one computed value against the truth, in exact numbers: its class, and its place in the
// statistics.

#include <optional>

#include "cases/contract.h"
#include "cases/fragments.h"
#include "cases/sample_place.h"
#include "oracle/internal/value_statistics.h"
#include "oracle/judge.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {

/// One value of one drawn sample, as judged.
struct ComputedValue {
  cases::SamplePlace place;
  std::optional<std::uint32_t> attribute;  ///< empty for the depth
  float actual = 0;
};
ComputedValue computed_value(const cases::Fragments& drawn, std::size_t fragment,
                             std::optional<std::uint32_t> attribute);

/// The kind of an attribute, or of the depth if `attribute` is empty.
records::AttributeKind kind_of(const cases::Case& source, std::optional<std::uint32_t> attribute);

/// Judges a value that is not free and adds it to the statistics of its kind. Returns nullopt if
/// the value is not judged because it is undefined or has no bound; such values are counted as
/// well. `is_single` promises that, if the value has both errors, they are equal.
std::optional<JudgedValue> judge_value(const SceneTruth& scene, const TriangleTruth& truth,
                                       const ComputedValue& value, std::uint64_t case_index,
                                       records::Stratum stratum, bool is_single,
                                       ValueStatistics& statistics);

/// Computes the candidates' errors exactly and keeps the extremes.
void settle_extremes(const SceneTruth& scene, const cases::Fragments& drawn,
                     std::uint64_t case_index, EnclosedErrors& errors);

}  // namespace rastercheck::oracle
