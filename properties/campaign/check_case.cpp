#include "properties/campaign/check_case.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "cases/case_writer.h"
#include "oracle/transform.h"
#include "properties/campaign/close_up.h"
#include "properties/campaign/internal/failure.h"
#include "properties/choices.h"
#include "properties/draw.h"
#include "properties/judged_law.h"
#include "records/record_json.h"
#include "records/run.h"

namespace rastercheck::properties {

namespace {

using records::CaseOutcome;
using records::Counterexample;

/// Returns true if the check fails as `found` says, and moves matching violations to the front. A
/// law may report only that it is violated, without violations.
bool fails_alike(Check& check, const cases::Case& c, const cases::Found& found,
                 const KnownDefects* known) {
  const bool fails =
      check.is_applicable && check.violation_count > 0 && check.known.empty() && !check.fault;
  if (!fails) return false;
  if (check.violations.empty()) return found.verdict == verdict_of(check);
  // Drops violations that are known defects of the driver, because the violation to reproduce is
  // not a known one.
  const Result<cases::ClipCase> clip = oracle::to_clip_case(c, "");
  if (known != nullptr && clip) {
    std::erase_if(check.violations, [&](const records::Violation& violation) {
      return !entries_of(*known, found.law, *clip, violation).empty();
    });
  }
  return put_alike_first(check, c, found);
}

/// Returns the fragment class that stands for a failed drawing.
records::FragmentClass class_of(Failure failure) {
  switch (failure) {
    case Failure::crash:
      return records::FragmentClass::crash;
    case Failure::hang:
      return records::FragmentClass::hang;
    case Failure::refused:
    case Failure::unavailable:
    case Failure::unsupported:
      break;
  }
  return records::FragmentClass::failed;
}

}  // namespace

Check failed_check(const Error& error) {
  Check failed;
  if (error.failure == Failure::unsupported) return not_applicable(error.reason);
  failed.violation_count = 1;
  records::Violation violation;
  violation.fragment_class = class_of(error.failure);
  violation.exact = "a drawing";
  violation.actual = "none";
  violation.note = to_string(error);
  failed.violations = {violation};
  return failed;
}

bool put_alike_first(Check& check, const cases::Case& c, const cases::Found& found) {
  const auto is_alike = [&](const records::Violation& violation) {
    cases::Found other = found;
    set_failure(other, c, violation);
    // Cases saved elsewhere may name only the verdict.
    if (found.kind.empty()) return other.verdict == found.verdict;
    return other == found;
  };
  const auto rest =
      std::stable_partition(check.violations.begin(), check.violations.end(), is_alike);
  return rest != check.violations.begin();
}

std::string verdict_of(const Check& check) {
  if (check.violation_count == 0) return "held";
  if (check.violations.empty()) return "violated";
  return std::string(to_string(check.violations.front().fragment_class));
}

std::string reason_of(const Law& law, backends::Backend& backend, const Check& check) {
  if (!is_promised(law, backend)) return std::string(why_unpromised(law, backend));
  if (check.why_not.empty()) return "the property does not apply to such cases";
  const std::size_t own = std::min(check.why_not.find(": "), check.why_not.size());
  const std::string_view why(check.why_not);
  return std::string(why.substr(0, own)) + without_numbers(why.substr(own));
}

Check check_or_note(const Law& law, const cases::Case& c, backends::Backend& backend,
                    std::uint64_t index, const KnownDefects* known) {
  Result<Check> checked = check_law(law, c, backend, index);
  // Positions beyond float32 cannot even be passed to a backend; no backend is to blame.
  if (!checked && !oracle::to_clip_case(c, "")) {
    return not_applicable("clip positions are beyond the range of float32");
  }
  Check check = checked ? *std::move(checked) : failed_check(checked.error());
  if (known != nullptr) tell_known(*known, law, c, backend, index, check);
  return check;
}

namespace {

/// Returns the ways in which a case fails, each once, in the order of violations. Leaves out known
/// ones if the case also fails in another way.
std::vector<cases::Found> failures_of(const cases::Found& place, const cases::Case& c,
                                      const Check& check, const KnownDefects* known) {
  std::vector<cases::Found> all;
  const Result<cases::ClipCase> clip = oracle::to_clip_case(c, "");
  for (const records::Violation& violation : check.violations) {
    const bool is_new =
        known == nullptr || !clip || entries_of(*known, place.law, *clip, violation).empty();
    if (!is_new && !all.empty()) continue;
    cases::Found failure = place;
    set_failure(failure, c, violation);
    if (std::find(all.begin(), all.end(), failure) == all.end()) all.push_back(std::move(failure));
  }
  if (all.empty()) all.push_back(place);
  return all;
}

}  // namespace

void keep_counterexample(const Law& law, const std::string& specification,
                         backends::Backend& backend, std::uint64_t seed,
                         const NumberedCase& numbered, const Check& check, Findings& findings,
                         const KnownDefects* known) {
  cases::Found place{std::string(law.id), specification, verdict_of(check), seed, numbered.index};
  // A saved counterexample keeps the place where it was first found.
  if (numbered.origin == records::Origin::saved && numbered.source.found) {
    place.seed = numbered.source.found->seed;
    place.index = numbered.source.found->index;
  }
  // The law must make the same choices for every changed version of the case.
  const Result<cases::ClipCase> clip = oracle::to_clip_case(numbered.source, "");
  const std::uint64_t choices = clip ? choices_of(*clip) : choices_of(numbered.source);
  for (const cases::Found& failure : failures_of(place, numbered.source, check, known)) {
    if (!is_kept(findings, failure, numbered.origin, numbered.source.name)) continue;
    Check whole = check;
    put_alike_first(whole, numbered.source, failure);
    Counterexample found{numbered.source, check.violation_count, whole.violations, numbered.origin};
    found.source.choices = choices;
    // If one triangle fails alone, keeps only this triangle, so that no large scene is passed
    // around until it is shrunk.
    if (numbered.source.triangles.size() > 1 && !whole.violations.empty()) {
      const std::size_t triangle = whole.violations.front().place.triangle;
      if (triangle < numbered.source.triangles.size()) {
        cases::Case one = with_triangles(found.source, {{triangle}});
        Check alone = check_or_note(law, one, backend, numbered.index, known);
        if (fails_alike(alone, one, failure, known)) {
          found = {std::move(one), alone.violation_count, alone.violations, numbered.origin};
        }
      }
    }
    found.source.found = failure;
    keep(findings, std::move(found));
  }
}

void shrink_counterexample(const Law& law, backends::Backend& backend, const Counterexample& found,
                           const ShrinkLimits& limits, Findings& findings,
                           const KnownDefects* known) {
  const cases::Found place = found.source.found.value_or(cases::Found());
  const auto still_fails = [&](const cases::Case& c) -> std::optional<Check> {
    if (findings.fault) return std::nullopt;  // More tries would tell nothing.
    Check check = check_or_note(law, c, backend, place.index, known);
    findings.fault = check.fault;
    return fails_alike(check, c, place, known) ? std::optional(std::move(check)) : std::nullopt;
  };
  if (place.verdict == to_string(records::FragmentClass::hang) &&
      found.source.triangles.size() > 1) {
    // A single triangle was tried when the case was found, and it did not hang. So the case is slow
    // because it is large, and each try would take the whole time-out.
    Counterexample as_found = found;
    as_found.shrinking = records::Shrinking{};
    keep(findings, std::move(as_found));
    return;
  }
  Check check;
  check.violation_count = found.violation_count;
  check.violations = found.violations;
  Shrunk shrunk = shrink(found.source, std::move(check), still_fails, limits);
  Counterexample least{std::move(shrunk.source), shrunk.check.violation_count,
                       std::move(shrunk.check.violations), found.origin,
                       records::Shrinking{shrunk.tries, shrunk.is_least}};
  if (!least.violations.empty()) {
    least.close_up = close_up(least.source, backend, least.violations.front());
  }
  keep(findings, std::move(least));
}

namespace {

/// Counts a case to which the law does not apply, and the reason.
void count_not_applicable(std::string why, records::Record& record) {
  ++record.cases.not_applicable;
  ++record.not_applicable_because[std::move(why)];
}

CaseOutcome outcome_of(const Check& check) {
  if (!check.is_applicable) return CaseOutcome::not_applicable;
  if (check.violation_count == 0) return CaseOutcome::held;
  return check.known.empty() ? CaseOutcome::violated : CaseOutcome::known;
}

/// Stores the case's result, if the run keeps case results.
void keep_case(const Law& law, const std::string& specification, const NumberedCase& numbered,
               const Check& check, Findings& findings) {
  if (!findings.cases) return;
  const std::string name(law.id);
  records::CaseRecord record;
  record.name = numbered.source.name;
  record.stratum = numbered.stratum;
  record.outcome = outcome_of(check);
  record.source_digest = fnv1a(cases::to_json(numbered.source));
  records::Judgement judged = check.judgement;
  judged.levels = {};  // not a result: says which level of the oracle decided
  for (const auto& [kind, errors] : judged.errors) {
    for (std::size_t i = 1; i < errors.classes.counts.size(); ++i) {
      record.mismatches += errors.classes.counts[i];
    }
    for (const auto& [stratum, sizes] : errors.strata) {
      if (const records::WorstError* worst = records::worst_of(sizes.extremes)) {
        record.worst[kind][stratum] = *worst;
      }
    }
  }
  records::RecordSet alone;
  // Excludes the backend's name, which changes with a plugin's path, and the law's name, which is
  // the same for all its cases.
  const records::RecordKey key{"", "", records::AttributeKind::coverage, numbered.stratum};
  records::add(alone, key, judged);
  for (const std::string& label : check.labels) ++alone[key].labels[label];
  alone[key].cases.violations = check.violation_count;
  record.found_digest =
      fnv1a(std::string(to_string(record.outcome)) + cases::json_of(alone).dump());
  findings.cases->insert_or_assign({name, specification, numbered.origin, numbered.index},
                                   std::move(record));
}

/// Notes whether the case was right, if the run keeps outcomes. Says nothing about cases that were
/// not drawn because the backend was given up.
void keep_outcome(const Law& law, const std::string& specification, const NumberedCase& numbered,
                  const Check& check, Findings& findings) {
  const bool is_given_up = std::find(check.labels.begin(), check.labels.end(),
                                     std::string(records::kGivenUp)) != check.labels.end();
  if (!findings.outcomes || !check.is_applicable || is_given_up) return;
  records::CaseOutcomes& outcomes =
      (*findings.outcomes)[{std::string(law.id), specification, numbered.origin}];
  const CaseOutcome outcome = outcome_of(check);
  if (outcome == CaseOutcome::held) {
    outcomes.right.add(numbered.index);
  } else if (outcome == CaseOutcome::known) {
    outcomes.known.add(numbered.index);
  } else {
    outcomes.wrong.add(numbered.index);
  }
}

}  // namespace

bool account(const Law& law, const std::string& specification, backends::Backend& backend,
             const NumberedCase& numbered, const Check& check, Findings& findings) {
  if (check.fault && !findings.fault) findings.fault = check.fault;
  const records::RecordKey key{std::string(law.id), specification, records::AttributeKind::coverage,
                               numbered.stratum};
  records::Record& record = findings.records[key];
  keep_case(law, specification, numbered, check, findings);
  keep_outcome(law, specification, numbered, check, findings);
  if (!check.is_applicable) {
    count_not_applicable(reason_of(law, backend, check), record);
    return false;
  }
  ++record.cases.checked;
  for (const std::string& label : check.labels) ++record.labels[label];
  records::add(findings.records, key, check.judgement);
  if (!check.known.empty()) ++record.cases.known;
  for (const std::string& id : check.known) ++record.known[id];
  const bool is_violated = check.violation_count > 0 && check.known.empty();
  if (is_violated) ++record.cases.violations;
  return is_violated;
}

namespace {

/// Counts a check's outcome and keeps its counterexamples. Returns true if the law applied to the
/// case and held.
bool take_check(const Law& law, const std::string& specification, backends::Backend& backend,
                std::uint64_t seed, const NumberedCase& numbered, const Check& check,
                Findings& findings, const KnownDefects* known) {
  if (account(law, specification, backend, numbered, check, findings)) {
    keep_counterexample(law, specification, backend, seed, numbered, check, findings, known);
  }
  return check.is_applicable && check.violation_count == 0;
}

/// Returns the check of a case that is not drawn because the backend is lost.
Check given_up() {
  Check lost;
  lost.violation_count = 1;
  lost.labels = {std::string(records::kGivenUp)};
  return lost;
}

}  // namespace

bool check_case(const Law& law, const std::string& specification, backends::Backend& backend,
                std::uint64_t seed, const NumberedCase& numbered, Findings& findings,
                const KnownDefects* known) {
  if (backend.is_lost()) {
    // Only the cases that caused the loss are counterexamples.
    const Check lost = is_promised(law, backend) ? given_up() : not_applicable();
    account(law, specification, backend, numbered, lost, findings);
    return false;
  }
  const Check check = check_or_note(law, numbered.source, backend, numbered.index, known);
  return take_check(law, specification, backend, seed, numbered, check, findings, known);
}

std::optional<NumberedCase> check_random_case(const Law& law, const std::string& specification,
                                              backends::Backend& backend, std::uint64_t seed,
                                              std::uint64_t index,
                                              const cases::Capabilities& capabilities,
                                              Findings& findings, const KnownDefects* known) {
  for (std::uint64_t attempt = 0;; ++attempt) {
    const std::uint64_t number = index + attempt * records::kRedrawn;
    Generated made = random_case(law, seed, number, capabilities);
    NumberedCase numbered{std::move(made.source), std::move(made.stratum), number,
                          records::Origin::random};
    // A backend that draws everything gets the same cases whatever their outcome.
    const bool is_last = attempt == kMostRedrawn || capabilities.is_everything() ||
                         backend.is_lost() || !is_promised(law, backend);
    bool is_held = false;
    if (is_last) {
      is_held = check_case(law, specification, backend, seed, numbered, findings, known);
    } else {
      const Check check = check_or_note(law, numbered.source, backend, number, known);
      if (!check.is_applicable && !check.fault && !backend.is_lost()) {
        const records::RecordKey key{std::string(law.id), specification,
                                     records::AttributeKind::coverage, numbered.stratum};
        ++findings.records[key].not_applicable_because[reason_of(law, backend, check)];
        keep_case(law, specification, numbered, check, findings);
        continue;
      }
      is_held = take_check(law, specification, backend, seed, numbered, check, findings, known);
    }
    return is_held ? std::optional(std::move(numbered)) : std::nullopt;
  }
}

void check_known_case(const Law& law, const std::string& specification, backends::Backend& backend,
                      std::uint64_t seed, const KnownDefects& known, std::size_t entry,
                      Findings& findings) {
  const KnownDefect& defect = known.defects[entry];
  const cases::Case& source = *defect.shown;
  const std::string& id = defect.entry.id;
  const NumberedCase numbered{source, std::string(records::kKnownStratum), source.found->index,
                              records::Origin::saved};
  if (backend.is_lost()) {
    check_case(law, specification, backend, seed, numbered, findings, &known);
    return;
  }
  Check check = check_or_note(law, source, backend, numbered.index, &known);
  if (account(law, specification, backend, numbered, check, findings)) {
    // The law is also violated in ways that the entry does not cover.
    keep_counterexample(law, specification, backend, seed, numbered, check, findings, &known);
    return;
  }
  if (!check.is_applicable || !check.known.empty()) return;
  if (backend.terms()) return;  // Entries describe the backend under its usual contract.
  keep(findings, records::UnexpectedPass{specification, id, std::string(law.id), defect.staleness});
  if (defect.staleness != records::Staleness::wrong_list) return;
  ++findings
        .records[{std::string(law.id), specification, records::AttributeKind::coverage,
                  numbered.stratum}]
        .cases.violations;
}

}  // namespace rastercheck::properties
