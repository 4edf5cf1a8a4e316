#include "properties/campaign/waiver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "cases/json.h"
#include "oracle/transform.h"
#include "properties/campaign/causes.h"
#include "properties/campaign/check_case.h"
#include "properties/campaign/internal/amendment.h"
#include "properties/campaign/internal/explanation.h"
#include "properties/campaign/internal/failure.h"
#include "properties/campaign/internal/put_right.h"
#include "properties/campaign/known_defects.h"
#include "properties/drawing.h"
#include "properties/judged_law.h"
#include "records/counterexample.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::KnownFact;

/// The kind of entry that a failure needs.
enum class Scope {
  drawing,  ///< what is drawn is wrong
  laws,     ///< the drawing is right, and laws fail all the same
  none,     ///< nothing is drawn
};

/// A counterexample that was tried again.
struct Subject {
  const cases::Case* source;
  const Law* law;
  records::Counterexample one;  ///< with its explanation
  Scope scope = Scope::drawing;
};

/// Gathers the conditions for an entry that covers several failures.
struct Conditions {
  std::set<FragmentClass> verdicts;
  std::set<AttributeKind> kinds;
  std::set<std::string> laws;
  std::optional<std::set<std::string>> needs;  ///< needs of all failures
  std::set<std::string> notes;
  double reach = 0;            ///< how far off an edge may be, in pixels
  bool are_degenerate = true;  ///< whether no wrongly drawn triangle has an area
};

/// Maps needs to facts. Needs of sizes have no fact, because experiments cannot establish them:
/// after a change of sizes, a law may hold by chance.
constexpr std::array<std::pair<std::string_view, KnownFact>, 14> kFacts{
    {{"w <= 0", KnownFact::nonpositive_w},
     {"near plane", KnownFact::before_near},
     {"far plane", KnownFact::beyond_far},
     {"clip distances", KnownFact::clip_distances},
     {"perspective", KnownFact::perspective},
     {"snapping", KnownFact::snapped},
     {"tie", KnownFact::tie},
     {"depth clamp", KnownFact::depth_clamp},
     {"depth test", KnownFact::depth_test},
     {"depth clear", KnownFact::depth_clear},
     {"depth bias", KnownFact::depth_bias},
     {"unorm depth", KnownFact::unorm_depth},
     {"scissor", KnownFact::scissor},
     {"culling", KnownFact::culling}}};

Result<Subject> tried(const cases::Case& source, const std::string& name,
                      backends::Backend& backend, const KnownDefects& known) {
  const auto refuse = [&name](const std::string& place, const std::string& why) {
    return tl::unexpected(Error{name, place, why});
  };
  if (!source.found)
    return refuse("/found", "is missing; only a counterexample can be recorded as known");
  const Law* const law = find_law(source.found->law);
  if (law == nullptr) {
    return refuse("/found/property",
                  "no property is called '" + cases::printable(source.found->law) + "'");
  }
  const std::uint64_t index = source.found->index;
  Check check = check_or_note(*law, source, backend, index, &known);
  if (check.fault) return refuse("", *check.fault);
  if (check.violation_count == 0) {
    return refuse(
        "", "the property " + source.found->law + " holds here, so there is nothing to waive");
  }
  if (!check.known.empty()) return refuse("", "is already known: " + check.known.front());
  const bool is_alike = check.violations.empty() || put_alike_first(check, source, *source.found);
  if (!is_alike) return refuse("", "fails in another way than recorded in the file");
  Subject subject{&source, law, {source, check.violation_count, check.violations}, Scope::drawing};
  const bool is_drawn = check.violations.empty() || check.violations.front().has_place();
  if (!is_drawn) subject.scope = Scope::none;
  // A backend that hangs takes the whole time-out each time it draws the case.
  if (verdict_of(check) == to_string(FragmentClass::hang)) return subject;
  subject.one.explanation = explain(*law, backend, subject.one, source, &known, {});
  const bool fails_again = subject.one.explanation && subject.one.explanation->fails_again;
  if (!fails_again) return refuse("", "failed once, but not when it was drawn again");
  if (is_drawn && subject.one.explanation->parts.empty()) subject.scope = Scope::laws;
  return subject;
}

/// Returns how far a sample on a drawn edge may be from the exact edge, in pixels. Vertices move
/// along both axes by as far as rounding takes them, plus the error of positions.
double reach_of(const cases::Contract& contract) {
  if (!contract.coverage) return 0;
  const cases::Snapping& snapping = *contract.coverage;
  const double reach = snapping.rounding_reach() + double{snapping.position_error};
  // The factor rounds upwards by more than the quotient and the product can round down.
  return std::sqrt(2.0) * reach / snapping.steps() * (1 + 0x1p-50);
}

/// Adds what the judge finds wrong in the plain drawing of a case, in the parts to correct. A law
/// that draws other cases may find its faults only in those; then this adds nothing.
void add_drawn(const Subject& subject, backends::Backend& backend, const KnownDefects& known,
               Conditions& conditions) {
  const Result<cases::ClipCase> c = oracle::to_clip_case(*subject.source, "");
  if (!c) return;
  const MoreAmended amended(backend, known_amendment(known, backend));
  const Result<backends::Drawn> drawn = draw(*c, backend);
  if (!drawn) return;
  conditions.reach = std::max(conditions.reach, reach_of(drawn->contract));
  const auto& parts = subject.one.explanation->parts;
  const Check check =
      judge_drawn(*c, drawn->contract, drawn->fragments, {}, subject.source->found->index);
  const auto& wrong = check.violations.empty() ? subject.one.violations : check.violations;
  const auto add_class = [&](AttributeKind kind, FragmentClass fragment_class) {
    if (std::find(parts.begin(), parts.end(), part_of(kind)) == parts.end()) return;
    conditions.kinds.insert(kind);
    conditions.verdicts.insert(fragment_class);
    // With a depth test, an extra fragment may hide the nearest triangle.
    if (fragment_class == FragmentClass::extra) {
      conditions.verdicts.insert(FragmentClass::wrong_triangle);
    }
  };
  for (const records::Violation& violation : wrong) {
    add_class(violation.kind, violation.fragment_class);
    const bool is_degenerate = violation.kind == AttributeKind::coverage && !violation.distance;
    conditions.are_degenerate = conditions.are_degenerate && is_degenerate;
  }
  // The counts include violations that were not kept.
  for (const auto& [kind, errors] : check.judgement.errors) {
    const auto& counts = errors.classes.counts;
    for (std::size_t i = 1; i < counts.size(); ++i) {
      if (counts[i] > 0) add_class(kind, static_cast<FragmentClass>(i));
    }
  }
}

/// Returns the longest part of a message without numbers: numbers may differ in each case.
std::string steady_part(std::string_view note) {
  const std::string text = without_numbers(note);
  std::string longest;
  for (std::size_t first = 0; first < text.size();) {
    const std::size_t end = std::min(text.find('#', first), text.size());
    std::string_view part(text.data() + first, end - first);
    while (part.starts_with(' ')) part.remove_prefix(1);
    while (part.ends_with(' ')) part.remove_suffix(1);
    if (part.size() > longest.size()) longest = part;
    first = end + 1;
  }
  return longest;
}

void add(const Subject& subject, backends::Backend& backend, const KnownDefects& known,
         Conditions& conditions) {
  if (subject.scope == Scope::drawing) {
    add_drawn(subject, backend, known, conditions);
  } else {
    for (const records::Violation& violation : subject.one.violations) {
      conditions.verdicts.insert(violation.fragment_class);
      conditions.kinds.insert(violation.kind);
      if (violation.has_place()) continue;
      std::string_view note = violation.note;
      // The plugin's path is not part of the fault.
      const std::string name = subject.source->found->backend + ": ";
      if (note.starts_with(name)) note.remove_prefix(name.size());
      conditions.notes.insert(steady_part(note));
    }
    conditions.laws.insert(std::string(subject.law->id));
    if (subject.scope == Scope::laws) {
      const auto& also = subject.one.explanation->also_violates;
      conditions.laws.insert(also.begin(), also.end());
    }
  }
  std::set<std::string> needs;
  if (subject.one.explanation) {
    needs.insert(subject.one.explanation->needs.begin(), subject.one.explanation->needs.end());
  }
  if (!conditions.needs) {
    conditions.needs = std::move(needs);
  } else {
    std::erase_if(*conditions.needs,
                  [&needs](const std::string& need) { return !needs.contains(need); });
  }
}

records::KnownEntry entry_of(const Conditions& conditions, Scope scope) {
  records::KnownEntry entry;
  if (scope != Scope::drawing) entry.laws.assign(conditions.laws.begin(), conditions.laws.end());
  entry.verdicts.assign(conditions.verdicts.begin(), conditions.verdicts.end());
  entry.when.attribute_kinds.assign(conditions.kinds.begin(), conditions.kinds.end());
  if (conditions.notes.size() == 1) entry.when.note = *conditions.notes.begin();
  const bool are_degenerate = scope == Scope::drawing && conditions.are_degenerate;
  if (are_degenerate) entry.when.facts[KnownFact::degenerate] = true;
  for (const auto& [need, fact] : kFacts) {
    const bool is_needed = conditions.needs->contains(std::string(need));
    const bool is_of_coverage = conditions.kinds == std::set{AttributeKind::coverage};
    if (!is_needed || (fact == KnownFact::tie && !is_of_coverage)) continue;
    // Violations of degenerate triangles have no distance, so `tie` never holds for them.
    if (fact == KnownFact::tie && are_degenerate) continue;
    if (fact == KnownFact::tie && conditions.reach > 0) {
      entry.when.limits[records::KnownLimit::distance_at_most] = conditions.reach;
    } else {
      entry.when.facts[fact] = true;
    }
  }
  if (conditions.needs->contains("samples")) entry.when.samples = {2, 4, 8, 16};
  // If a case is not drawn, every law fails, so the entry is for all laws; but only if it also has
  // a fact, because a message alone may mean anything.
  if (scope == Scope::none && !entry.when.facts.empty()) entry.laws = {"*"};
  return entry;
}

/// True if the entry, together with those already known, explains everything in all subjects.
class Explains {
  static constexpr const char* kThis = "this one";

 public:
  Explains(const std::vector<Subject>& subjects, backends::Backend& backend,
           const KnownDefects& known)
      : subjects_(&subjects), backend_(&backend), known_(&known) {}

  bool operator()(const records::KnownEntry& entry) const {
    KnownDefects known = *known_;
    known.defects.push_back({entry, std::nullopt});
    known.defects.back().entry.id = kThis;
    return std::all_of(subjects_->begin(), subjects_->end(), [&](const Subject& subject) {
      const Check check = check_or_note(*subject.law, *subject.source, *backend_,
                                        subject.source->found->index, &known);
      const auto& by = check.known;
      return std::find(by.begin(), by.end(), kThis) != by.end();
    });
  }

 private:
  const std::vector<Subject>* subjects_;
  backends::Backend* backend_;
  const KnownDefects* known_;
};

/// Returns the entry with only the conditions that all subjects meet: a needed feature may be
/// absent from the very triangle or sample with the violation. Empty if the entry explains too
/// little even without conditions.
std::optional<records::KnownEntry> widened(const records::KnownEntry& entry,
                                           const Explains& explains) {
  records::KnownEntry least = entry;
  least.when.facts.clear();
  least.when.limits.clear();
  least.when.samples.clear();
  if (!explains(least)) return std::nullopt;
  const auto keep_if_explained = [&](const auto& add_condition) {
    records::KnownEntry narrower = least;
    add_condition(narrower.when);
    if (explains(narrower)) least = std::move(narrower);
  };
  for (const auto& fact : entry.when.facts) {
    keep_if_explained([&](records::KnownConditions& when) { when.facts.insert(fact); });
  }
  for (const auto& limit : entry.when.limits) {
    keep_if_explained([&](records::KnownConditions& when) { when.limits.insert(limit); });
  }
  keep_if_explained([&](records::KnownConditions& when) { when.samples = entry.when.samples; });
  return least;
}

/// Turns an entry into one for the failures' laws alone.
records::KnownEntry of_laws(records::KnownEntry entry, const std::vector<Subject>& subjects) {
  std::set<std::string> laws;
  std::set<FragmentClass> verdicts;
  std::set<AttributeKind> kinds;
  for (const Subject& subject : subjects) {
    laws.emplace(subject.law->id);
    for (const records::Violation& violation : subject.one.violations) {
      verdicts.insert(violation.fragment_class);
      kinds.insert(violation.kind);
    }
  }
  entry.laws.assign(laws.begin(), laws.end());
  entry.verdicts.assign(verdicts.begin(), verdicts.end());
  entry.when.attribute_kinds.assign(kinds.begin(), kinds.end());
  return entry;
}

/// Returns the narrowest entry that explains all subjects. An entry for drawings must have every
/// condition found, or it would match unrelated faults. If such an entry does not explain all
/// subjects, the entry is for their laws alone.
std::optional<records::KnownEntry> narrowest(const records::KnownEntry& entry,
                                             const std::vector<Subject>& subjects,
                                             const Explains& explains) {
  if (explains(entry)) return entry;
  return widened(entry.laws.empty() ? of_laws(entry, subjects) : entry, explains);
}

}  // namespace

Result<Waiver> make_waiver(std::span<const cases::Case> counterexamples,
                           std::span<const std::string> names, backends::Backend& backend,
                           const KnownDefects& known) {
  std::vector<Subject> subjects;
  std::vector<records::Counterexample> all;
  Conditions conditions;
  for (std::size_t i = 0; i < counterexamples.size(); ++i) {
    Result<Subject> subject = tried(counterexamples[i], names[i], backend, known);
    if (!subject) return tl::unexpected(subject.error());
    if (!subjects.empty() && subjects.front().scope != subject->scope) {
      return tl::unexpected(
          Error{names[i], "", "has another cause than " + names[0] + "; add them one by one"});
    }
    add(*subject, backend, known, conditions);
    all.push_back(subject->one);
    subjects.push_back(*std::move(subject));
  }
  const std::optional<records::KnownEntry> entry = narrowest(
      entry_of(conditions, subjects.front().scope), subjects, Explains(subjects, backend, known));
  if (!entry) {
    return tl::unexpected(
        Error{names[0], "",
              "no conditions were found that identify the defect; " +
                  std::string("docs/known-defects.md explains how to write an entry by hand")});
  }
  return Waiver{*entry, causes_of(all).front().sentence};
}

}  // namespace rastercheck::properties
