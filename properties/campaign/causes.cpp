#include "properties/campaign/causes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "properties/campaign/findings.h"
#include "properties/campaign/internal/failure.h"
#include "properties/campaign/internal/variations.h"
#include "properties/law.h"

namespace rastercheck::properties {
namespace {

using records::Counterexample;
using records::DrawnPart;
using records::FragmentClass;

using Ids = std::set<std::string_view>;

/// A counterexample and what was tried of it.
struct Member {
  std::size_t place = 0;
  const Counterexample* one = nullptr;
  Ids needs;
  Ids unforced_needs;  ///< without those that it was kept for
  Ids indifferent;
  Ids needs_or_inherent;  ///< what it cannot be told to do without

  const std::string& law() const { return one->source.found->law; }
  const std::string& verdict() const { return one->source.found->verdict; }
};

using Members = std::vector<Member>;

/// Variations that a case of some condition cannot do without: shrinking keeps the condition.
Ids needs_of_condition(std::string_view condition) {
  if (condition == "tie")
    return {"tie", "near plane", "far plane", "sides", "w <= 0", "clip distances"};
  if (condition == "clamped") return {"depth clamp", "near plane", "far plane"};
  if (condition == "clipped") {
    return {"near plane", "far plane", "sides", "w <= 0", "clip distances"};
  }
  if (condition == "several samples") return {"samples"};
  return {};
}

Member member_of(const std::vector<Counterexample>& all, std::size_t place) {
  Member member{place, &all[place], {}, {}, {}, {}};
  if (!member.one->explanation) return member;
  const records::Explanation& explanation = *member.one->explanation;
  member.needs.insert(explanation.needs.begin(), explanation.needs.end());
  member.indifferent.insert(explanation.indifferent.begin(), explanation.indifferent.end());
  member.needs_or_inherent = member.needs;
  member.needs_or_inherent.insert(explanation.inherent.begin(), explanation.inherent.end());
  const Ids forced = needs_of_condition(member.one->source.found->condition);
  std::set_difference(member.needs.begin(), member.needs.end(), forced.begin(), forced.end(),
                      std::inserter(member.unforced_needs, member.unforced_needs.end()));
  return member;
}

std::size_t laws_in(const Members& members) {
  Ids laws;
  for (const Member& member : members) laws.insert(member.law());
  return laws.size();
}

/// Whether taking it away leaves all triangles where they are, so that the law does not hold by
/// chance.
bool leaves_geometry(std::string_view id) {
  constexpr std::array<std::string_view, 11> kIds{
      "camera",      "clip distances", "noperspective", "flat",    "large values", "small values",
      "depth clamp", "depth test",     "depth clear",   "scissor", "culling"};
  return std::find(kIds.begin(), kIds.end(), id) != kIds.end();
}

/// Whether a fault may be told by it: not how the viewport lies, nor which rules there are, which
/// mostly decide where samples fall.
bool tells_faults_apart(std::string_view id) {
  constexpr std::array<std::string_view, 12> kIds{
      "near plane", "far plane", "tie",  "samples",     "w <= 0",   "small",
      "large",      "sides",     "thin", "perspective", "snapping", "far pixels"};
  return leaves_geometry(id) || std::find(kIds.begin(), kIds.end(), id) != kIds.end();
}

/// The chance that as many laws need the same by accident is small from here on.
constexpr std::size_t kFewestLaws = 2;

/// Two sets that each need something of their own, to which the other is indifferent.
struct Parting {
  std::string_view first;
  std::string_view second;
  std::ptrdiff_t clearness = 0;  ///< members that speak for it beyond those that speak against it
};

Members needing_only(const Members& members, std::string_view need, std::string_view other) {
  Members some;
  std::copy_if(members.begin(), members.end(), std::back_inserter(some), [&](const Member& member) {
    return member.unforced_needs.contains(need) && !member.needs.contains(other);
  });
  return some;
}

/// Whether a member fails without this: as it was taken away, or, of what a case certainly has not
/// where it cannot be taken away, as it is not there.
bool does_without(const Member& member, std::string_view id) {
  if (member.indifferent.contains(id)) return true;
  const bool is_told = leaves_geometry(id) || id == "snapping" || id == "samples";
  return is_told && !member.needs_or_inherent.contains(id);
}

std::size_t doing_without(const Members& members, std::string_view id) {
  return static_cast<std::size_t>(
      std::count_if(members.begin(), members.end(),
                    [id](const Member& member) { return does_without(member, id); }));
}

Parting parting_of(const Members& members, std::string_view first, std::string_view second) {
  const Members of_first = needing_only(members, first, second);
  const Members of_second = needing_only(members, second, first);
  const bool is_sure = laws_in(of_first) >= kFewestLaws && laws_in(of_second) >= kFewestLaws &&
                       doing_without(of_first, second) >= kFewestLaws &&
                       doing_without(of_second, first) >= kFewestLaws;
  if (!is_sure) return {};
  const auto against = std::count_if(members.begin(), members.end(), [&](const Member& member) {
    return member.needs.contains(first) == member.needs.contains(second);
  });
  const std::size_t fewer = std::min(of_first.size(), of_second.size());
  return {first, second, static_cast<std::ptrdiff_t>(fewer) - against};
}

Parting clearest_parting(const Members& members) {
  Ids ids;
  for (const Member& member : members) {
    std::copy_if(member.needs.begin(), member.needs.end(), std::inserter(ids, ids.end()),
                 &tells_faults_apart);
  }
  Parting clearest;
  for (auto first = ids.begin(); first != ids.end(); ++first) {
    for (auto second = std::next(first); second != ids.end(); ++second) {
      const Parting parting = parting_of(members, *first, *second);
      if (parting.clearness > clearest.clearness) clearest = parting;
    }
  }
  return clearest;
}

/// Splits members into those of a first set and the others.
template <typename IsOfFirst>
std::pair<Members, Members> parted(const Members& members, const IsOfFirst& is_of_first) {
  std::pair<Members, Members> both;
  std::partition_copy(members.begin(), members.end(), std::back_inserter(both.first),
                      std::back_inserter(both.second), is_of_first);
  return both;
}

/// Parts members that have the same part of drawings wrong by what they need.
std::vector<Members> parted_by_needs(const Members& members) {
  const auto both_parted = [](const std::pair<Members, Members>& both) {
    std::vector<Members> all = parted_by_needs(both.first);
    for (Members& one : parted_by_needs(both.second)) all.push_back(std::move(one));
    return all;
  };
  if (const Parting parting = clearest_parting(members); parting.clearness > 0) {
    const auto both = parted(members, [&parting](const Member& member) {
      const bool needs_first = member.needs.contains(parting.first);
      if (needs_first != member.needs.contains(parting.second)) return needs_first;
      return !does_without(member, parting.first) && does_without(member, parting.second);
    });
    if (!both.first.empty() && !both.second.empty()) return both_parted(both);
  }
  for (const Variation& variation : variations()) {
    if (!leaves_geometry(variation.id)) continue;
    const auto both = parted(members, [&](const Member& member) {
      return member.needs_or_inherent.contains(variation.id);
    });
    Members unforced;
    std::copy_if(
        both.first.begin(), both.first.end(), std::back_inserter(unforced),
        [&](const Member& member) { return member.unforced_needs.contains(variation.id); });
    if (laws_in(unforced) >= kFewestLaws && !both.second.empty()) return both_parted(both);
  }
  return {members};
}

bool is_of_zeros(const Member& member) {
  return member.verdict() == to_string(FragmentClass::wrong_sign_of_zero);
}

/// Says what has to be the same of counterexamples of one cause.
struct Kind {
  std::string_view backend;
  bool is_of_zeros = false;
  std::string_view verdict;  ///< where nothing was drawn
  std::string note;          ///< then, without its numbers
  std::optional<DrawnPart> part = std::nullopt;
  std::string_view stage;  ///< where none has to: a law that stands for all such
  auto operator<=>(const Kind&) const = default;
};

/// The part of drawings that is wrong: has to be put right, or is wrong wherever what the law is
/// about is.
std::optional<DrawnPart> part_of(const records::Explanation& explanation) {
  const auto& parts = explanation.parts.empty() ? explanation.wrong : explanation.parts;
  return parts.empty() ? std::nullopt : std::optional(parts.front());
}

/// Laws that cases violate together though all fragments are right: each law's first in the
/// alphabet.
std::map<std::string_view, std::string_view> stages_of(const Members& members) {
  std::map<std::string_view, Ids> violated_with;
  for (const Member& member : members) {
    if (!member.one->explanation || part_of(*member.one->explanation)) continue;
    const auto& also = member.one->explanation->also_violates;
    violated_with[member.law()].insert(also.begin(), also.end());
  }
  std::map<std::string_view, std::string_view> stages;
  for (const auto& [law, with] : violated_with) stages[law] = law;
  // Small enough to be walked until nothing changes.
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (const auto& [law, with] : violated_with) {
      for (const auto& [other, with_other] : violated_with) {
        if (!with.contains(other) || !with_other.contains(law)) continue;
        const std::string_view least = std::min(stages[law], stages[other]);
        has_changed = has_changed || stages[law] != least || stages[other] != least;
        stages[law] = least;
        stages[other] = least;
      }
    }
  }
  return stages;
}

Kind kind_of(const Member& member, const std::map<std::string_view, std::string_view>& stages) {
  Kind kind{member.one->source.found->backend, is_of_zeros(member), {}, {}, std::nullopt, {}};
  const auto& violations = member.one->violations;
  if (!violations.empty() && !violations.front().has_place()) {
    kind.verdict = member.verdict();
    kind.note = without_numbers(violations.front().note);
  } else if (!member.one->explanation) {
    kind.verdict = member.verdict();
  } else if (!kind.is_of_zeros && part_of(*member.one->explanation)) {
    kind.part = part_of(*member.one->explanation);
  } else if (!kind.is_of_zeros) {
    kind.stage = stages.at(member.law());
  }
  return kind;
}

/// Counterexamples that are taken to be of one cause.
struct CauseGroup {
  Kind kind;
  Members members;
};

/// Gives what at least half of the members need, inherent needs included, if at most two thirds as
/// many do without it.
Ids common_needs(const Members& members) {
  std::map<std::string_view, std::size_t> counts;
  for (const Member& member : members) {
    for (const std::string_view id : member.needs_or_inherent) ++counts[id];
  }
  Ids common;
  for (const auto& [id, count] : counts) {
    const std::size_t against = doing_without(members, id);
    const bool is_common = count * 2 >= members.size() && count * 2 >= 3 * against;
    if (is_common && tells_faults_apart(id)) common.insert(id);
  }
  return common;
}

/// Those of some needs that a change of sizes does not meet by chance; a tie by the least change of
/// anything, and so of coverage only.
Ids sure_needs(const Ids& needs, const Kind& kind) {
  constexpr std::array<std::string_view, 5> kOfSize{"small", "large", "thin", "sides",
                                                    "far pixels"};
  Ids sure;
  for (const std::string_view id : needs) {
    const bool is_of_size = std::find(kOfSize.begin(), kOfSize.end(), id) != kOfSize.end();
    if (!is_of_size && (id != "tie" || kind.part == DrawnPart::coverage)) sure.insert(id);
  }
  return sure;
}

bool includes(const Ids& all, const Ids& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

/// Whether a group is of a larger one's cause: it needs what most of that do, which says much of
/// few laws, or of needs that geometry has no say in; or both are of the same one law.
bool is_part_of(const CauseGroup& group, const CauseGroup& larger) {
  if (group.kind.backend != larger.kind.backend || !group.kind.verdict.empty() ||
      !larger.kind.verdict.empty() || group.kind.is_of_zeros != larger.kind.is_of_zeros) {
    return false;
  }
  const bool is_of_one_law = laws_in(group.members) == 1 && laws_in(larger.members) == 1;
  if (is_of_one_law && group.members[0].law() == larger.members[0].law()) return true;
  const Ids needs = sure_needs(common_needs(larger.members), larger.kind);
  if (larger.members.size() < kFewestLaws || needs.empty()) return false;
  const bool is_sure = laws_in(group.members) <= kFewestLaws ||
                       std::any_of(needs.begin(), needs.end(), &leaves_geometry);
  return is_sure && includes(group.members.size() == 1 ? group.members.front().needs_or_inherent
                                                       : common_needs(group.members),
                             needs);
}

bool is_larger(const CauseGroup& a, const CauseGroup& b) {
  return a.members.size() > b.members.size();
}

/// Adds groups to the larger ones that they are of; of several to that with most needs.
std::vector<CauseGroup> joined(std::vector<CauseGroup> groups) {
  std::stable_sort(groups.begin(), groups.end(), &is_larger);
  std::vector<CauseGroup> kept;
  for (CauseGroup& group : groups) {
    CauseGroup* of = nullptr;
    for (CauseGroup& larger : kept) {
      if (!is_part_of(group, larger)) continue;
      const bool is_clearer =
          of == nullptr || common_needs(larger.members).size() > common_needs(of->members).size();
      if (is_clearer) of = &larger;
    }
    if (of == nullptr) {
      kept.push_back(std::move(group));
    } else {
      std::move(group.members.begin(), group.members.end(), std::back_inserter(of->members));
    }
  }
  return kept;
}

std::vector<CauseGroup> cause_groups_of(const Members& members) {
  std::map<std::string_view, Members> by_backend;
  for (const Member& member : members) {
    by_backend[member.one->source.found->backend].push_back(member);
  }
  std::map<Kind, Members> by_kind;
  for (const auto& [backend, some] : by_backend) {
    const auto stages = stages_of(some);
    for (const Member& member : some) by_kind[kind_of(member, stages)].push_back(member);
  }
  std::vector<CauseGroup> groups;
  for (const auto& [kind, some] : by_kind) {
    for (Members& one : parted_by_needs(some)) groups.push_back({kind, std::move(one)});
  }
  return joined(std::move(groups));
}

// --- In words ------------------------------------------------------------------------------------

/// Says what is wrong, in a clause.
std::string what_is_wrong(const CauseGroup& group) {
  if (group.kind.is_of_zeros) return "zeros have the wrong sign";
  std::set<std::string> verdicts;
  for (const Member& member : group.members) {
    const auto& parts =
        member.one->explanation ? member.one->explanation->parts : std::vector<DrawnPart>{};
    const bool is_of_part = parts.empty() || !group.kind.part ||
                            (parts.size() == 1 && parts.front() == *group.kind.part);
    if (is_of_part) verdicts.insert(member.verdict());
  }
  const auto has = [&verdicts](FragmentClass one) {
    return verdicts.contains(std::string(to_string(one)));
  };
  if (group.kind.verdict == to_string(FragmentClass::crash)) return "it crashes";
  if (group.kind.verdict == to_string(FragmentClass::hang)) return "it does not answer in time";
  if (!group.kind.note.empty()) return "it does not draw: " + group.kind.note;
  if (!group.kind.verdict.empty()) return fmt::format("{}", group.kind.verdict);
  if (!group.kind.part) {
    const Law* law = find_law(group.members.front().law());
    return fmt::format("“{}” does not hold",
                       law == nullptr ? group.members.front().law() : std::string(law->sentence));
  }
  if (*group.kind.part == DrawnPart::coverage) {
    // Where a triangle covers too much, it may be seen in front of the nearest, too.
    if (!has(FragmentClass::extra)) {
      return has(FragmentClass::wrong_triangle) ? "another triangle than the nearest is seen"
                                                : "samples are missing";
    }
    return has(FragmentClass::missing) ? "samples are missing, and others drawn that must not be"
                                       : "samples are drawn that must not be";
  }
  const char* const what = *group.kind.part == DrawnPart::depth ? "depth is" : "values are";
  if (has(FragmentClass::not_a_number)) return fmt::format("{} no number", what);
  if (has(FragmentClass::infinite)) return fmt::format("{} infinite", what);
  return fmt::format("{} wrong", what);
}

/// "where A and B"; empty of no needs.
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
      // A file may be of another version, which tried other things.
      const Variation* const tried = find_variation(id);
      clauses.emplace_back(tried == nullptr ? std::string_view(id) : tried->without);
    }
    return fmt::format("{}", fmt::join(clauses, "; "));
  };
  std::vector<std::string> tried;
  const records::Explanation& explanation = *one.explanation;
  std::vector<std::string_view> parts;
  parts.reserve(explanation.parts.size());
  for (const DrawnPart part : explanation.parts) parts.push_back(cases::name_of(part));
  if (!parts.empty()) {
    tried.push_back(fmt::format("holds once {} {} put right", fmt::join(parts, " and "),
                                parts.size() == 1 && parts.front() != "values" ? "is" : "are"));
  }
  if (!explanation.needs.empty()) {
    tried.push_back("holds as soon as: " + listed(explanation.needs));
  }
  if (!explanation.indifferent.empty()) {
    tried.push_back("fails all the same if: " + listed(explanation.indifferent));
  }
  return tried;
}

/// In the order of variations().
std::vector<std::string> in_order(const Ids& ids) {
  std::vector<std::string> ordered;
  for (const Variation& variation : variations()) {
    if (ids.contains(variation.id)) ordered.emplace_back(variation.id);
  }
  return ordered;
}

records::Cause cause_of(const CauseGroup& group) {
  records::Cause cause;
  cause.backend = group.kind.backend;
  cause.needs = in_order(common_needs(group.members));
  cause.sentence = what_is_wrong(group) + where(cause.needs);
  std::vector<Counterexample> members;
  members.reserve(group.members.size());
  for (const Member& member : group.members) {
    members.push_back(*member.one);
    cause.counterexamples.push_back(member.place);
  }
  const auto first = static_cast<std::ptrdiff_t>(first_to_read(members));
  cause.tried = tried_of(members[static_cast<std::size_t>(first)]);
  const auto begin = cause.counterexamples.begin();
  std::rotate(begin, begin + first, begin + first + 1);
  std::sort(begin + 1, cause.counterexamples.end());
  return cause;
}

}  // namespace

std::vector<records::Cause> causes_of(const std::vector<Counterexample>& all) {
  Members members;
  members.reserve(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) members.push_back(member_of(all, i));
  std::vector<CauseGroup> groups = cause_groups_of(members);
  std::stable_sort(groups.begin(), groups.end(), [](const CauseGroup& a, const CauseGroup& b) {
    if (a.kind.is_of_zeros != b.kind.is_of_zeros) return b.kind.is_of_zeros;
    return is_larger(a, b);
  });
  std::vector<records::Cause> causes;
  causes.reserve(groups.size());
  for (const CauseGroup& group : groups) causes.push_back(cause_of(group));
  return causes;
}

}  // namespace rastercheck::properties
