#pragma once

// One computed value against the truth: its class, and its place in the statistics.

#include <optional>

#include "cases/contract.h"
#include "oracle/judge.h"
#include "oracle/triangle_truth.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// What is judged: one value of one drawn sample.
struct ComputedValue {
  std::uint32_t triangle = 0;
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t sample = 0;
  std::optional<std::uint32_t> attribute;  ///< nothing for the depth
  float actual = 0;
};

/// Judges the value and adds it to the statistics of its kind. Nothing where the rules leave it
/// free or undefined; then nothing is added.
std::optional<JudgedValue> judge_value(const SceneTruth& scene, const TriangleTruth& truth,
                                       const ComputedValue& value, std::uint64_t case_index,
                                       records::Judgement& judgement);

}  // namespace rastercheck::oracle
