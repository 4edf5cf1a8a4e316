#pragma once

// What a case may have that matters, and the same case without it: what is tried to find out why a
// counterexample fails. Each leaves as much as it can as it was; above all, where vertices appear.

#include <span>
#include <string_view>

#include "cases/case.h"
#include "cases/sample_place.h"

namespace rastercheck::properties {

struct Variation {
  std::string_view id;       ///< "near plane"
  std::string_view with;     ///< a clause: "the near plane cuts the triangle"
  std::string_view without;  ///< a clause: "no vertex is before the near plane"
  /// Takes it away; false where the case has nothing of it, or it cannot be taken away alone. `at`
  /// is where the case fails, of which a triangle may name none. For take_away().
  bool (*change)(cases::Case& c, const cases::SamplePlace& at) = nullptr;
};

/// Takes it away; false, and the case as it was, where there is nothing of it, nothing would
/// change, or numbers would go beyond float32.
bool take_away(const Variation& variation, cases::Case& c, const cases::SamplePlace& at);

/// All, in the order in which readers are told.
std::span<const Variation> variations();
/// The one of an id; nullptr where there is none.
const Variation* find_variation(std::string_view id);

}  // namespace rastercheck::properties
