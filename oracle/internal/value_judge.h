#pragma once

// One computed value against the truth, in exact numbers: its class, and its place in the
// statistics.

#include <optional>

#include "cases/contract.h"
#include "cases/fragments.h"
#include "cases/sample_place.h"
#include "oracle/internal/value_statistics.h"
#include "oracle/judge.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {

/// What is judged: one value of one drawn sample.
struct ComputedValue {
  cases::SamplePlace place;
  std::optional<std::uint32_t> attribute;  ///< nothing for the depth
  float actual = 0;
};
ComputedValue computed_value(const cases::Fragments& drawn, std::size_t fragment,
                             std::optional<std::uint32_t> attribute);

/// The kind of the attribute, or of the depth where there is none.
records::AttributeKind kind_of(const cases::Case& source, std::optional<std::uint32_t> attribute);

/// Judges the value, which is not free, and adds it to the statistics of its kind. Nothing where it
/// is not judged, being undefined or without a bound, which is counted as well. `is_single`: where
/// the value has both errors, they are the same.
std::optional<JudgedValue> judge_value(const SceneTruth& scene, const TriangleTruth& truth,
                                       const ComputedValue& value, std::uint64_t case_index,
                                       records::Stratum stratum, bool is_single,
                                       ValueStatistics& statistics);

/// Computes the candidates' errors exactly, and keeps those that are extremes.
void settle_extremes(const SceneTruth& scene, const cases::Fragments& drawn,
                     std::uint64_t case_index, EnclosedErrors& errors);

}  // namespace rastercheck::oracle
