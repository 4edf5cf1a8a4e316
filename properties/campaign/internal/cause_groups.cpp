#include "properties/campaign/internal/cause_groups.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "properties/campaign/internal/failure.h"
#include "properties/campaign/internal/variations.h"

namespace rastercheck::properties {
namespace {

using records::Counterexample;
using records::DrawnPart;
using records::FragmentClass;

using Members = std::vector<CauseMember>;

/// Returns the features that a case with this condition must have, because shrinking keeps the
/// condition.
VariationIds needs_of_condition(std::string_view condition) {
  if (condition == "tie")
    return {"tie", "near plane", "far plane", "sides", "w <= 0", "clip distances"};
  if (condition == "clamped") return {"depth clamp", "near plane", "far plane"};
  if (condition == "clipped") {
    return {"near plane", "far plane", "sides", "w <= 0", "clip distances"};
  }
  if (condition == "several samples") return {"samples"};
  return {};
}

CauseMember member_of(const std::vector<Counterexample>& all, std::size_t place) {
  CauseMember member{place, &all[place], {}, {}, {}, {}};
  if (!member.one->explanation) return member;
  const records::Explanation& explanation = *member.one->explanation;
  member.needs.insert(explanation.needs.begin(), explanation.needs.end());
  member.indifferent.insert(explanation.indifferent.begin(), explanation.indifferent.end());
  member.needs_or_inherent = member.needs;
  member.needs_or_inherent.insert(explanation.inherent.begin(), explanation.inherent.end());
  const VariationIds forced = needs_of_condition(member.one->source.found->condition);
  std::set_difference(member.needs.begin(), member.needs.end(), forced.begin(), forced.end(),
                      std::inserter(member.unforced_needs, member.unforced_needs.end()));
  return member;
}

std::size_t laws_in(const Members& members) {
  VariationIds laws;
  for (const CauseMember& member : members) laws.insert(member.law());
  return laws.size();
}

/// True if removing the feature leaves all triangles in place. If the law then holds, this is not
/// mere chance.
bool leaves_geometry(std::string_view id) {
  constexpr std::array<std::string_view, 11> kIds{
      "camera",      "clip distances", "noperspective", "flat",    "large values", "small values",
      "depth clamp", "depth test",     "depth clear",   "scissor", "culling"};
  return std::find(kIds.begin(), kIds.end(), id) != kIds.end();
}

/// True if a need for the feature may characterize a fault. False for the viewport's place and the
/// rules, which mostly decide where samples fall.
bool tells_faults_apart(std::string_view id) {
  constexpr std::array<std::string_view, 12> kIds{
      "near plane", "far plane", "tie",  "samples",     "w <= 0",   "small",
      "large",      "sides",     "thin", "perspective", "snapping", "far pixels"};
  return leaves_geometry(id) || std::find(kIds.begin(), kIds.end(), id) != kIds.end();
}

/// Minimum number of laws that must agree: two are unlikely to need the same feature by accident.
constexpr std::size_t kFewestLaws = 2;

/// A split into two sets, each of which needs a feature that the other does without.
struct Parting {
  std::string_view first;
  std::string_view second;
  std::ptrdiff_t clearness = 0;  ///< size of the smaller set, minus members needing both or none
};

Members needing_only(const Members& members, std::string_view need, std::string_view other) {
  Members some;
  std::copy_if(members.begin(), members.end(), std::back_inserter(some),
               [&](const CauseMember& member) {
                 return member.unforced_needs.contains(need) && !member.needs.contains(other);
               });
  return some;
}

/// True if the member fails without this feature: its case still failed after the removal, or
/// certainly lacks the feature. Some features can always be removed if they are present; a case
/// from which such a feature was not removed certainly lacks it.
bool does_without(const CauseMember& member, std::string_view id) {
  if (member.indifferent.contains(id)) return true;
  const bool is_told = leaves_geometry(id) || id == "snapping" || id == "samples";
  return is_told && !member.needs_or_inherent.contains(id);
}

std::size_t doing_without(const Members& members, std::string_view id) {
  return static_cast<std::size_t>(
      std::count_if(members.begin(), members.end(),
                    [id](const CauseMember& member) { return does_without(member, id); }));
}

Parting parting_of(const Members& members, std::string_view first, std::string_view second) {
  const Members of_first = needing_only(members, first, second);
  const Members of_second = needing_only(members, second, first);
  const bool is_sure = laws_in(of_first) >= kFewestLaws && laws_in(of_second) >= kFewestLaws &&
                       doing_without(of_first, second) >= kFewestLaws &&
                       doing_without(of_second, first) >= kFewestLaws;
  if (!is_sure) return {};
  const auto against =
      std::count_if(members.begin(), members.end(), [&](const CauseMember& member) {
        return member.needs.contains(first) == member.needs.contains(second);
      });
  const std::size_t fewer = std::min(of_first.size(), of_second.size());
  return {first, second, static_cast<std::ptrdiff_t>(fewer) - against};
}

Parting clearest_parting(const Members& members) {
  VariationIds ids;
  for (const CauseMember& member : members) {
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

/// Splits members into those of a first set and the rest.
template <typename IsOfFirst>
std::pair<Members, Members> parted(const Members& members, const IsOfFirst& is_of_first) {
  std::pair<Members, Members> both;
  std::partition_copy(members.begin(), members.end(), std::back_inserter(both.first),
                      std::back_inserter(both.second), is_of_first);
  return both;
}

/// Splits members that have the same wrong part into sets by the features they need.
std::vector<Members> parted_by_needs(const Members& members) {
  const auto both_parted = [](const std::pair<Members, Members>& both) {
    std::vector<Members> all = parted_by_needs(both.first);
    for (Members& one : parted_by_needs(both.second)) all.push_back(std::move(one));
    return all;
  };
  if (const Parting parting = clearest_parting(members); parting.clearness > 0) {
    const auto both = parted(members, [&parting](const CauseMember& member) {
      const bool needs_first = member.needs.contains(parting.first);
      if (needs_first != member.needs.contains(parting.second)) return needs_first;
      return !does_without(member, parting.first) && does_without(member, parting.second);
    });
    if (!both.first.empty() && !both.second.empty()) return both_parted(both);
  }
  for (const Variation& variation : variations()) {
    if (!leaves_geometry(variation.id)) continue;
    const auto both = parted(members, [&](const CauseMember& member) {
      return member.needs_or_inherent.contains(variation.id);
    });
    Members unforced;
    std::copy_if(
        both.first.begin(), both.first.end(), std::back_inserter(unforced),
        [&](const CauseMember& member) { return member.unforced_needs.contains(variation.id); });
    if (laws_in(unforced) >= kFewestLaws && !both.second.empty()) return both_parted(both);
  }
  return {members};
}

bool is_of_zeros(const CauseMember& member) {
  return member.verdict() == to_string(FragmentClass::wrong_sign_of_zero);
}

/// Returns the wrong part of drawings: the part to correct, else the part that is wrong whenever
/// the law fails.
std::optional<DrawnPart> wrong_part_of(const records::Explanation& explanation) {
  const auto& parts = explanation.parts.empty() ? explanation.wrong : explanation.parts;
  return parts.empty() ? std::nullopt : std::optional(parts.front());
}

/// Groups the laws that cases violate together although all fragments are right. Maps each law to
/// the alphabetically first law of its group.
std::map<std::string_view, std::string_view> stages_of(const Members& members) {
  std::map<std::string_view, VariationIds> violated_with;
  for (const CauseMember& member : members) {
    if (!member.one->explanation || wrong_part_of(*member.one->explanation)) continue;
    if (!member.one->explanation->fails_again) continue;
    const auto& also = member.one->explanation->also_violates;
    violated_with[member.law()].insert(also.begin(), also.end());
  }
  std::map<std::string_view, std::string_view> stages;
  for (const auto& [law, with] : violated_with) stages[law] = law;
  // The map is small, so the loop simply repeats until nothing changes.
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

CauseKind kind_of(const CauseMember& member,
                  const std::map<std::string_view, std::string_view>& stages) {
  CauseKind kind{
      member.one->source.found->backend, is_of_zeros(member), {}, {}, std::nullopt, {}, false};
  const auto& violations = member.one->violations;
  if (!violations.empty() && !violations.front().has_place()) {
    kind.verdict = member.verdict();
    kind.note = without_numbers(violations.front().note);
  } else if (!member.one->explanation) {
    kind.verdict = member.verdict();
  } else if (!member.one->explanation->fails_again) {
    kind.is_unsteady = !kind.is_of_zeros;
  } else if (!kind.is_of_zeros && wrong_part_of(*member.one->explanation)) {
    kind.part = wrong_part_of(*member.one->explanation);
  } else if (!kind.is_of_zeros) {
    kind.stage = stages.at(member.law());
  }
  return kind;
}

/// Returns the needs that are unlikely to be accidental. Leaves out sizes, as a change of size may
/// make a law hold by chance. Leaves out ties unless coverage is wrong, as the least change of
/// anything removes a tie.
VariationIds sure_needs(const VariationIds& needs, const CauseKind& kind) {
  constexpr std::array<std::string_view, 5> kOfSize{"small", "large", "thin", "sides",
                                                    "far pixels"};
  VariationIds sure;
  for (const std::string_view id : needs) {
    const bool is_of_size = std::find(kOfSize.begin(), kOfSize.end(), id) != kOfSize.end();
    if (!is_of_size && (id != "tie" || kind.part == DrawnPart::coverage)) sure.insert(id);
  }
  return sure;
}

bool includes(const VariationIds& all, const VariationIds& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

/// True if one simple change makes at least half of the wrong drawings of both groups right. In a
/// group of several members, the change must make several drawings right, because a single drawing
/// may become right by chance.
bool is_of_one_change(const Members& group, const Members& larger) {
  const std::vector<records::Hint> of_group = hints_of(group);
  const std::vector<records::Hint> of_larger = hints_of(larger);
  const auto is_sure = [](const records::Hint& hint, const Members& members) {
    return hint.right >= kFewestLaws || members.size() == 1;
  };
  return std::any_of(of_group.begin(), of_group.end(), [&](const records::Hint& hint) {
    const auto is_same = [&](const records::Hint& one) {
      return one.change == hint.change && is_sure(one, larger);
    };
    return is_sure(hint, group) && std::any_of(of_larger.begin(), of_larger.end(), is_same);
  });
}

/// True if a group shares a larger group's cause. It does if one change makes both right, or if
/// both violate only the same law. It also does if it needs what most of the larger group needs,
/// provided that the group has few laws or that removing one of these needs leaves triangles in
/// place.
bool is_part_of(const CauseGroup& group, const CauseGroup& larger) {
  if (group.kind.backend != larger.kind.backend || !group.kind.verdict.empty() ||
      !larger.kind.verdict.empty() || group.kind.is_of_zeros != larger.kind.is_of_zeros ||
      group.kind.is_unsteady || larger.kind.is_unsteady) {
    return false;
  }
  if (is_of_one_change(group.members, larger.members)) return true;
  const bool is_of_one_law = laws_in(group.members) == 1 && laws_in(larger.members) == 1;
  if (is_of_one_law && group.members[0].law() == larger.members[0].law()) return true;
  // Wrong fragments may also violate laws about what happens before or after them
  // (CauseKind::stage), but a fault before or after them leaves the fragments right.
  if (group.kind.part && !larger.kind.part) return false;
  VariationIds needs = sure_needs(common_needs(larger.members), larger.kind);
  if (!larger.kind.part) {
    // If the laws of a stage merely do not apply without a feature, the feature says nothing about
    // the stage's faults.
    std::erase_if(needs, [&larger](std::string_view id) {
      return std::none_of(larger.members.begin(), larger.members.end(),
                          [id](const CauseMember& member) { return member.needs.contains(id); });
    });
  }
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

/// Merges each group into the larger group whose cause it shares; if several match, into the one
/// with the most needs.
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

/// Returns each group's common needs, but only those whose removal leaves triangles in place.
std::vector<VariationIds> telling_needs(const std::vector<CauseGroup>& groups) {
  std::vector<VariationIds> all;
  all.reserve(groups.size());
  for (const CauseGroup& group : groups) {
    VariationIds needs = common_needs(group.members);
    std::erase_if(needs, [](std::string_view id) { return !leaves_geometry(id); });
    all.push_back(std::move(needs));
  }
  return all;
}

bool needs_some(const CauseMember& member, const VariationIds& ids) {
  return std::any_of(ids.begin(), ids.end(),
                     [&member](std::string_view id) { return member.unforced_needs.contains(id); });
}

/// Moves a member to another group if it needs what that group needs, and nothing that its own
/// group needs.
std::vector<CauseGroup> moved_by_needs(const std::vector<CauseGroup>& groups) {
  const std::vector<VariationIds> needs = telling_needs(groups);
  std::vector<CauseGroup> moved;
  moved.reserve(groups.size());
  for (const CauseGroup& group : groups) moved.push_back({group.kind, {}});
  const auto is_of = [&](const CauseMember& member, std::size_t own, std::size_t other) {
    const CauseKind& kind = groups[other].kind;
    return kind.part && kind.backend == groups[own].kind.backend &&
           kind.is_of_zeros == groups[own].kind.is_of_zeros &&
           laws_in(groups[other].members) >= kFewestLaws && needs_some(member, needs[other]);
  };
  for (std::size_t own = 0; own < groups.size(); ++own) {
    for (const CauseMember& member : groups[own].members) {
      std::size_t to = own;
      const bool may_move = groups[own].kind.part && !needs_some(member, needs[own]);
      for (std::size_t other = 0; may_move && other < groups.size(); ++other) {
        const bool is_larger =
            to == own || groups[other].members.size() > groups[to].members.size();
        if (other != own && is_larger && is_of(member, own, other)) to = other;
      }
      moved[to].members.push_back(member);
    }
  }
  std::erase_if(moved, [](const CauseGroup& group) { return group.members.empty(); });
  return moved;
}

}  // namespace

std::vector<CauseGroup> cause_groups_of(const std::vector<Counterexample>& all) {
  std::map<std::string_view, Members> by_backend;
  for (std::size_t i = 0; i < all.size(); ++i) {
    by_backend[all[i].source.found->backend].push_back(member_of(all, i));
  }
  std::map<CauseKind, Members> by_kind;
  for (const auto& [backend, some] : by_backend) {
    const auto stages = stages_of(some);
    for (const CauseMember& member : some) by_kind[kind_of(member, stages)].push_back(member);
  }
  std::vector<CauseGroup> groups;
  for (const auto& [kind, some] : by_kind) {
    for (Members& one : parted_by_needs(some)) groups.push_back({kind, std::move(one)});
  }
  return joined(moved_by_needs(groups));
}

VariationIds common_needs(const Members& members) {
  std::map<std::string_view, std::size_t> counts;
  for (const CauseMember& member : members) {
    for (const std::string_view id : member.needs_or_inherent) ++counts[id];
  }
  VariationIds common;
  for (const auto& [id, count] : counts) {
    const std::size_t against = doing_without(members, id);
    const bool is_common = count * 2 >= members.size() && count * 2 >= 3 * against;
    if (is_common && tells_faults_apart(id)) common.insert(id);
  }
  return common;
}

std::vector<records::Hint> hints_of(const Members& members) {
  std::vector<records::Hint> hints;
  std::uint64_t wrong = 0;
  for (const CauseMember& member : members) {
    if (!member.one->explanation || !member.one->explanation->hints) continue;
    ++wrong;
    for (const std::string& change : *member.one->explanation->hints) {
      auto hint = std::find_if(hints.begin(), hints.end(), [&change](const records::Hint& one) {
        return one.change == change;
      });
      if (hint == hints.end()) hint = hints.insert(hint, {change});
      ++hint->right;
    }
  }
  std::erase_if(hints, [wrong](const records::Hint& one) { return one.right * 2 < wrong; });
  for (records::Hint& hint : hints) hint.wrong = wrong;
  return hints;
}

}  // namespace rastercheck::properties
