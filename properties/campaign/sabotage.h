#pragma once

// Defects given to a right drawing on purpose, so that it can be measured how much of them the
// judge notices under a contract.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "cases/case.h"
#include "cases/clip_case.h"
#include "cases/contract.h"
#include "cases/fragments.h"

namespace rastercheck::properties {

/// Holds a right drawing, and what draws more in the same way.
struct Drawing {
  const cases::ClipCase* source = nullptr;
  const cases::Fragments* fragments = nullptr;
  /// Draws another case in the same way; nothing where that cannot be drawn.
  std::function<std::optional<cases::Fragments>(const cases::Case&)> draw;
};

/// A defect of a backend.
struct Sabotage {
  std::string_view name;
  /// Gives what a backend with the defect would have drawn; nothing where it would be the same.
  std::optional<cases::Fragments> (*apply)(const Drawing& drawing);
};

std::span<const Sabotage> sabotages();

/// Whether the judge finds anything wrong with a drawing, in its coverage or its values.
bool is_noticed(const cases::ClipCase& source, const cases::Contract& contract,
                const cases::Fragments& drawn);

}  // namespace rastercheck::properties
