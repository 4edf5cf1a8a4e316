#pragma once

// Defects given to a right drawing on purpose, so that it can be measured how much of them the
// judge notices under a contract.

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

/// Holds a right drawing, and what draws more in the same way.
struct Drawing {
  const cases::ClipCase* source = nullptr;
  const cases::Fragments* fragments = nullptr;
  /// Draws another case in the same way; nothing where that cannot be drawn.
  std::function<std::optional<cases::Fragments>(const cases::Case&)> draw;
};

/// Say that only which samples are drawn, or only values, are looked at or changed.
inline constexpr JudgeRequest kCoverageAlone{.judges_values = false};
inline constexpr JudgeRequest kValuesAlone{.counts_coverage = false};

/// A defect of a backend.
struct Sabotage {
  records::Defect defect = records::Defect::values_nan;
  /// Gives what a backend with the defect would have drawn; nothing where it would be the same, or
  /// cannot be told.
  std::optional<cases::Fragments> (*apply)(const Drawing& drawing) = nullptr;
  /// Says what it may change of a drawing.
  JudgeRequest changes = {};
};

/// All defects, in their order.
std::span<const Sabotage> sabotages();

/// Whether the judge finds anything wrong with a drawing, of what is asked for.
bool has_wrong(const cases::ClipCase& source, const cases::Contract& contract,
               const cases::Fragments& drawn, const JudgeRequest& request = {});

}  // namespace rastercheck::properties
