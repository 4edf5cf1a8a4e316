#pragma once

// Common mistakes of rasterizers, such as y upside down, half a pixel off, one attribute for
// another. Each mistake is a changed case whose correct drawing may be exactly what was drawn.

#include <cstddef>
#include <functional>
#include <set>
#include <string>

#include "cases/case.h"
#include "cases/sample_place.h"

namespace rastercheck::properties {

/// The parts of a drawing that are wrong, which decide the changes worth trying.
struct WrongParts {
  bool coverage = false;
  bool depth = false;
  std::set<std::size_t> attributes;  ///< indices into the case's attributes

  bool is_none() const { return !coverage && !depth && attributes.empty(); }
};

struct SimpleChange {
  std::string change;  ///< a clause: "y points in the other direction"
  cases::Case source;  ///< the changed case
  /// Maps the place of a drawn sample to its place in the changed case; nullptr: the same place.
  cases::SamplePlace (*place_of)(const cases::FramebufferSize&, cases::SamplePlace) = nullptr;
  /// True if the changed case's grid replaces the contract's. Its basis (cases::Basis) then
  /// replaces the contract's too, unless the contract leaves the basis open.
  bool names_grid = false;
  bool swaps_ties = false;  ///< judges ties by the opposite of the contract's rule
};

/// Visits all changes of a case without a camera that may explain what is wrong, the commonest
/// first. Several may have the same clause.
void visit_simple_changes(const cases::Case& c, const WrongParts& wrong,
                          const std::function<void(const SimpleChange&)>& visit);

}  // namespace rastercheck::properties
