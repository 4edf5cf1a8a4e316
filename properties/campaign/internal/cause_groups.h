#pragma once

// Sorts counterexamples by cause; campaign/causes.h explains the rules and words the causes.

#include <compare>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "records/cause.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// Ids of variations.
using VariationIds = std::set<std::string_view>;

/// A counterexample and the sets of features in its explanation.
struct CauseMember {
  std::size_t place = 0;
  const records::Counterexample* one = nullptr;
  VariationIds needs;
  VariationIds unforced_needs;  ///< `needs` that Found::condition does not imply
  VariationIds indifferent;
  VariationIds needs_or_inherent;  ///< `needs` and Explanation::inherent

  const std::string& law() const { return one->source.found->law; }
  const std::string& verdict() const { return one->source.found->verdict; }
};

/// The facts that counterexamples of one cause must share.
struct CauseKind {
  std::string_view backend;
  bool is_of_zeros = false;
  std::string_view verdict;  ///< only if nothing was drawn or explained
  std::string note;          ///< the message without its numbers; only if nothing was drawn
  std::optional<records::DrawnPart> part = std::nullopt;
  /// Only if no part is wrong: the alphabetically first of the laws that are violated together.
  std::string_view stage;
  bool is_unsteady = false;  ///< did not fail again
  auto operator<=>(const CauseKind&) const = default;
};

/// Counterexamples that share a cause.
struct CauseGroup {
  CauseKind kind;
  std::vector<CauseMember> members;
};

/// Groups the counterexamples, in no meaningful order. Groups refer to `all`.
std::vector<CauseGroup> cause_groups_of(const std::vector<records::Counterexample>& all);

/// Returns the features that may characterize a fault and that at least half of the members need,
/// or without which their laws do not apply (Explanation::inherent). Leaves out a feature if the
/// number of members that do without it is more than 2/3 of the number that need it.
VariationIds common_needs(const std::vector<CauseMember>& members);

/// Returns the changes that make at least half of the members' wrong drawings right, in the order
/// in which members first list them.
std::vector<records::Hint> hints_of(const std::vector<CauseMember>& members);

}  // namespace rastercheck::properties
