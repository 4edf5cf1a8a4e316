#pragma once

// Defects applied to a correct drawing on purpose, to measure how many the judge notices under a
// contract.

#include <functional>
#include <optional>
#include <span>

#include "cases/case.h"
#include "cases/clip_case.h"
#include "cases/contract.h"
#include "cases/fragments.h"
#include "properties/judged_law.h"
#include "records/defect.h"

namespace rastercheck::properties {

/// A correct drawing, and a function that draws other cases in the same way.
struct Drawing {
  const cases::ClipCase* source = nullptr;
  const cases::Fragments* fragments = nullptr;
  /// Draws another case in the same way; empty if that fails.
  std::function<std::optional<cases::Fragments>(const cases::Case&)> draw;
};

/// Requests to judge coverage only, and values only.
inline constexpr JudgeRequest kCoverageAlone{.judges_values = false};
inline constexpr JudgeRequest kValuesAlone{.counts_coverage = false};

/// A defect of a backend.
struct Sabotage {
  records::Defect defect = records::Defect::values_nan;
  /// Returns the drawing of a backend with the defect. Empty if the defect changes nothing or its
  /// effect is unknown.
  std::optional<cases::Fragments> (*apply)(const Drawing& drawing) = nullptr;
  /// The parts of a drawing that the defect may change.
  JudgeRequest changes = {};
};

/// All defects, in their order.
std::span<const Sabotage> sabotages();

/// True if the judge finds anything wrong with a drawing, within the request.
bool has_wrong(const cases::ClipCase& source, const cases::Contract& contract,
               const cases::Fragments& drawn, const JudgeRequest& request = {});

}  // namespace rastercheck::properties
