#pragma once

// Features that a case may have, and how to remove each: the experiments that explain a
// counterexample. Each removal leaves as much unchanged as possible, above all the vertices' window
// positions.

#include <span>
#include <string_view>

#include "cases/case.h"
#include "cases/sample_place.h"

namespace rastercheck::properties {

struct Variation {
  std::string_view id;       ///< "near plane"
  std::string_view with;     ///< a clause: "the near plane cuts the triangle"
  std::string_view without;  ///< a clause: "no vertex is before the near plane"
  /// Removes the feature; false if the case lacks it or it cannot be removed alone. `at` is where
  /// the case fails; its triangle may not exist. Call take_away() instead.
  bool (*change)(cases::Case& c, const cases::SamplePlace& at) = nullptr;
};

/// Removes the feature. Returns false and leaves the case unchanged if the case lacks the feature,
/// nothing would change, or numbers would exceed float32.
bool take_away(const Variation& variation, cases::Case& c, const cases::SamplePlace& at);

/// All variations, in the order of explanations.
std::span<const Variation> variations();
/// Returns the variation with this id; nullptr if none.
const Variation* find_variation(std::string_view id);

}  // namespace rastercheck::properties
