#include "properties/campaign/causes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "properties/campaign/findings.h"
#include "properties/campaign/internal/cause_groups.h"
#include "properties/campaign/internal/variations.h"
#include "properties/law.h"

namespace rastercheck::properties {
namespace {

using records::Counterexample;
using records::DrawnPart;
using records::FragmentClass;

/// False if the member's explanation names a wrong part other than kind.part.
bool is_only_of_the_part(const CauseMember& member, const CauseKind& kind) {
  if (!kind.part || !member.one->explanation) return true;
  const records::Explanation& explanation = *member.one->explanation;
  const auto& parts = explanation.parts.empty() ? explanation.wrong : explanation.parts;
  return parts.empty() || (parts.size() == 1 && parts.front() == *kind.part);
}

/// Returns the indices of the members that the cause's sentence describes: those with no other
/// wrong part than the cause's, or all members if there are none.
std::vector<std::size_t> telling_members(const CauseGroup& group) {
  std::vector<std::size_t> of_part;
  std::vector<std::size_t> all;
  all.reserve(group.members.size());
  of_part.reserve(group.members.size());
  for (std::size_t i = 0; i < group.members.size(); ++i) {
    all.push_back(i);
    if (is_only_of_the_part(group.members[i], group.kind)) of_part.push_back(i);
  }
  return of_part.empty() ? all : of_part;
}

/// Returns the members whose verdict is `one`, of those given.
std::vector<std::size_t> members_of_class(const CauseGroup& group,
                                          const std::vector<std::size_t>& members,
                                          FragmentClass one) {
  std::vector<std::size_t> of_class;
  std::copy_if(members.begin(), members.end(), std::back_inserter(of_class), [&](std::size_t i) {
    return group.members[i].verdict() == std::string(to_string(one));
  });
  return of_class;
}

/// Returns the members whose values are no numbers: the NaN, or else the infinite ones. Empty if
/// there are none.
std::vector<std::size_t> members_without_numbers(const CauseGroup& group,
                                                 const std::vector<std::size_t>& members) {
  std::vector<std::size_t> nan = members_of_class(group, members, FragmentClass::not_a_number);
  return nan.empty() ? members_of_class(group, members, FragmentClass::infinite) : nan;
}

/// Says what is wrong with values: "depth is NaN", "values are wrong, sometimes infinite".
std::string what_is_wrong_with_values(const CauseGroup& group,
                                      const std::vector<std::size_t>& telling) {
  const std::string what = *group.kind.part == DrawnPart::depth ? "depth is" : "values are";
  const std::vector<std::size_t> without = members_without_numbers(group, telling);
  if (without.empty()) return what + " wrong";
  const bool is_nan = group.members[without.front()].verdict() ==
                      std::string(to_string(FragmentClass::not_a_number));
  const char* const word = is_nan ? "NaN" : "infinite";
  return without.size() == telling.size() ? fmt::format("{} {}", what, word)
                                          : fmt::format("{} wrong, sometimes {}", what, word);
}

/// Returns a clause that says what is wrong.
std::string what_is_wrong(const CauseGroup& group) {
  if (group.kind.is_of_zeros) return "zeros have the wrong sign";
  const std::vector<std::size_t> telling = telling_members(group);
  std::set<std::string> verdicts;
  for (const std::size_t i : telling) verdicts.insert(group.members[i].verdict());
  const auto has = [&verdicts](FragmentClass one) {
    return verdicts.contains(std::string(to_string(one)));
  };
  if (group.kind.verdict == to_string(FragmentClass::crash)) {
    return "it crashes or answers with something other than a drawing";
  }
  if (group.kind.verdict == to_string(FragmentClass::hang)) return "it does not answer in time";
  if (!group.kind.note.empty()) return "it does not draw: " + group.kind.note;
  if (!group.kind.verdict.empty()) return fmt::format("{}", group.kind.verdict);
  if (group.kind.is_unsteady) return "the drawing differs from one time to the next";
  if (!group.kind.part) {
    const Law* law = find_law(group.members.front().law());
    return fmt::format("“{}” does not hold",
                       law == nullptr ? group.members.front().law() : std::string(law->sentence));
  }
  if (*group.kind.part == DrawnPart::coverage) {
    // A triangle that covers too much may also hide the nearest triangle, so `extra` comes first.
    if (!has(FragmentClass::extra)) {
      return has(FragmentClass::wrong_triangle) ? "a triangle other than the nearest is visible"
                                                : "samples are missing";
    }
    return has(FragmentClass::missing) ? "samples are missing and extra samples are drawn"
                                       : "extra samples are drawn";
  }
  return what_is_wrong_with_values(group, telling);
}

/// Returns " where A and B", or "" if there are no needs.
std::string where(const std::vector<std::string>& needs) {
  std::string text;
  for (const std::string& id : needs) {
    const Variation* const need = find_variation(id);
    if (need != nullptr) text += fmt::format("{} {}", text.empty() ? " where" : " and", need->with);
  }
  return text;
}

std::vector<std::string> tried_of(const Counterexample& one) {
  if (!one.explanation) return {};
  const auto listed = [](const std::vector<std::string>& ids) {
    std::vector<std::string> clauses;
    for (const std::string& id : ids) {
      // The file may come from a version that tried other variations.
      const Variation* const tried = find_variation(id);
      clauses.emplace_back(tried == nullptr ? std::string_view(id) : tried->without);
    }
    return fmt::format("{}", fmt::join(clauses, "; "));
  };
  std::vector<std::string> tried;
  const records::Explanation& explanation = *one.explanation;
  if (!explanation.fails_again) tried.emplace_back("held when drawn again");
  std::vector<std::string_view> parts;
  parts.reserve(explanation.parts.size());
  for (const DrawnPart part : explanation.parts) parts.push_back(cases::name_of(part));
  if (!parts.empty()) {
    tried.push_back(fmt::format("holds once {} {} corrected", fmt::join(parts, " and "),
                                parts.size() == 1 && parts.front() != "values" ? "is" : "are"));
  }
  if (!explanation.needs.empty()) {
    tried.push_back("holds if: " + listed(explanation.needs));
  }
  if (!explanation.indifferent.empty()) {
    tried.push_back("still fails if: " + listed(explanation.indifferent));
  }
  return tried;
}

/// Returns the ids in the order of variations().
std::vector<std::string> in_order(const VariationIds& ids) {
  std::vector<std::string> ordered;
  for (const Variation& variation : variations()) {
    if (ids.contains(variation.id)) ordered.emplace_back(variation.id);
  }
  return ordered;
}

/// Returns the index of the member that best illustrates the cause's sentence.
std::size_t shown_first(const CauseGroup& group) {
  std::vector<std::size_t> places = telling_members(group);
  // Infinite values have no such rank: a value that is a little too large is infinite where the
  // right one is the largest float.
  const std::vector<std::size_t> nan = members_of_class(group, places, FragmentClass::not_a_number);
  const bool is_of_values = group.kind.part && *group.kind.part != DrawnPart::coverage;
  if (is_of_values && !nan.empty()) places = nan;
  std::vector<Counterexample> told;
  told.reserve(places.size());
  for (const std::size_t place : places) told.push_back(*group.members[place].one);
  return places[first_to_read(told)];
}

records::Cause cause_of(const CauseGroup& group) {
  records::Cause cause;
  cause.backend = group.kind.backend;
  cause.needs = in_order(common_needs(group.members));
  cause.sentence = what_is_wrong(group) + where(cause.needs);
  const std::vector<records::Hint> hints = hints_of(group.members);
  const auto hint = std::max_element(
      hints.begin(), hints.end(),
      [](const records::Hint& a, const records::Hint& b) { return a.right < b.right; });
  if (hint != hints.end()) cause.hint = *hint;
  cause.counterexamples.reserve(group.members.size());
  for (const CauseMember& member : group.members) cause.counterexamples.push_back(member.place);
  const std::size_t first = shown_first(group);
  cause.tried = tried_of(*group.members[first].one);
  const auto begin = cause.counterexamples.begin();
  std::iter_swap(begin, begin + static_cast<std::ptrdiff_t>(first));
  std::sort(begin + 1, cause.counterexamples.end());
  return cause;
}

}  // namespace

std::vector<records::Cause> causes_of(const std::vector<Counterexample>& all) {
  std::vector<CauseGroup> groups = cause_groups_of(all);
  std::stable_sort(groups.begin(), groups.end(), [](const CauseGroup& a, const CauseGroup& b) {
    if (a.kind.is_of_zeros != b.kind.is_of_zeros) return b.kind.is_of_zeros;
    return a.members.size() > b.members.size();
  });
  std::vector<records::Cause> causes;
  causes.reserve(groups.size());
  for (const CauseGroup& group : groups) causes.push_back(cause_of(group));
  return causes;
}

}  // namespace rastercheck::properties
