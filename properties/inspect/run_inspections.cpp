#include "properties/inspect/run_inspections.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "properties/campaign/check_case.h"
#include "properties/inspect/inspect.h"
#include "records/histogram.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::Inspection;
using records::RecordKey;
using records::Stratum;
using records::WorstError;

/// Maximum number of values in an inspection: 16 × 16 pixels with a depth and an attribute. Forty
/// inspections make a page of some megabytes.
constexpr InspectOptions kOfRuns{512};
/// Number of errors tried for a backend, kind and stratum, the largest first. An error found in a
/// law's changed version of the case cannot be reproduced from the case itself.
constexpr std::size_t kMostTries = 4;

// --- Counterexamples -----------------------------------------------------------------------------

/// Returns where to inspect a counterexample: at its violation, if the case has this place, else at
/// the first violation or the largest error of the case's own drawing (find_focus). The violation
/// may belong to a drawing of another size.
std::optional<Focus> focus_of(const records::Counterexample& found,
                              const std::string& specification, CaseDrawer& drawer) {
  const cases::Case& c = found.source;
  if (found.violations.empty() || !found.violations.front().has_place()) return std::nullopt;
  const records::Violation& v = found.violations.front();
  const cases::FramebufferSize& size = c.framebuffer;
  const bool is_there =
      v.place.triangle < c.triangles.size() && std::cmp_less(v.place.x, size.width) &&
      std::cmp_less(v.place.y, size.height) && std::cmp_less(v.place.sample, size.samples) &&
      (!v.attribute || *v.attribute < c.attributes.size());
  if (is_there) return Focus{v.place, v.attribute};
  const Result<cases::ClipCase> clip = case_to_draw(c);
  const backends::Drawn* const drawn = clip ? drawer.draw(*clip, specification) : nullptr;
  if (drawn == nullptr) return std::nullopt;
  return find_focus(*clip, *drawn, {});
}

void inspect_counterexamples(const records::Run& run, CaseDrawer& drawer,
                             std::vector<Inspection>& inspections) {
  for (std::size_t i = 0; i < run.counterexamples.size(); ++i) {
    if (inspections.size() == records::kMostInspections) return;
    const records::Counterexample& one = run.counterexamples[i];
    const cases::Found found = one.source.found.value_or(cases::Found());
    const std::optional<Focus> focus = focus_of(one, found.backend, drawer);
    if (!focus) continue;
    std::optional<Inspection> inspection =
        inspect_part(one.source, found.backend, *focus, drawer, kOfRuns);
    if (!inspection) continue;
    inspection->occasion = records::Occasion::counterexample;
    inspection->law = found.law;
    inspection->counterexample = i;
    inspections.push_back(*std::move(inspection));
  }
}

// --- Worst cases ---------------------------------------------------------------------------------

/// An error, and the key of its record.
struct Candidate {
  const RecordKey* key = nullptr;
  const WorstError* worst = nullptr;

  double size() const { return records::magnitude_bound(worst->error); }
};

/// Orders errors by size, the largest first; of equal errors, those of the law on values come
/// first.
bool is_closer(const Candidate& a, const Candidate& b) {
  const auto is_of_values = [](const Candidate& one) { return one.key->law == kValuesLaw; };
  if (a.size() != b.size()) return a.size() > b.size();
  return is_of_values(a) && !is_of_values(b);
}

using CandidateKey = std::tuple<std::string, AttributeKind, Stratum>;  ///< backend, kind, stratum
using Candidates = std::map<CandidateKey, std::vector<Candidate>>;

/// Returns the errors of each backend, kind and stratum, the largest first.
Candidates candidates_of(const records::Run& run) {
  Candidates candidates;
  for (const auto& [key, record] : run.records) {
    if (key.attribute_kind == AttributeKind::flat) continue;  // flat values are copies
    for (const auto& [stratum, sizes] : record.errors.strata) {
      for (const auto& worst :
           {std::cref(sizes.extremes.most_negative), std::cref(sizes.extremes.most_positive)}) {
        if (!worst.get()) continue;
        candidates[{key.backend, key.attribute_kind, stratum}].push_back({&key, &*worst.get()});
      }
    }
  }
  for (auto& [key, errors] : candidates) {
    std::stable_sort(errors.begin(), errors.end(), &is_closer);
  }
  return candidates;
}

/// Returns the first saved case of this law and index; nullptr if there is none.
const cases::Case* find_saved(std::span<const cases::Case> saved, const std::string& law,
                              std::uint64_t index) {
  const auto found = std::find_if(saved.begin(), saved.end(), [&](const cases::Case& c) {
    return c.found && c.found->law == law && c.found->index == index;
  });
  return found == saved.end() ? nullptr : &*found;
}

/// Returns the case that has the error; empty if the case no longer exists.
std::optional<cases::Case> case_of(const Candidate& candidate, const records::Plan& plan,
                                   const CaseSources& sources) {
  const auto& [law_name, backend, kind, stratum] = *candidate.key;
  const std::uint64_t index = candidate.worst->case_index;
  const auto copy_of = [](const cases::Case* c) {
    return c == nullptr ? std::nullopt : std::optional(*c);
  };
  if (stratum.starts_with(records::kSceneStratum)) return copy_of(sources.scene);
  if (stratum == records::kSavedStratum) return copy_of(find_saved(sources.saved, law_name, index));
  if (stratum == records::kKnownStratum) {
    const auto known = sources.known.find(backend);
    if (known == sources.known.end()) return std::nullopt;
    return copy_of(find_saved(known->second.cases(), law_name, index));
  }
  const records::Origin origin =
      stratum == records::kCorpusStratum ? records::Origin::corpus : records::Origin::random;
  return frozen_case({law_name, backend, origin, index}, plan, sources.corpus);
}

std::optional<Inspection> inspect_candidate(const Candidate& candidate, const records::Plan& plan,
                                            const CaseSources& sources, CaseDrawer& drawer) {
  const std::optional<cases::Case> c = case_of(candidate, plan, sources);
  if (!c) return std::nullopt;
  const WorstError& worst = *candidate.worst;
  const Focus focus{worst.place, worst.attribute};
  std::optional<Inspection> inspection =
      inspect_part(*c, candidate.key->backend, focus, drawer, kOfRuns);
  if (!inspection || !shows(*inspection, worst.attribute, worst.actual)) return std::nullopt;
  inspection->occasion = records::Occasion::worst;
  inspection->law = candidate.key->law;
  inspection->kind = candidate.key->attribute_kind;
  return inspection;
}

void inspect_worst(const records::Run& run, const CaseSources& sources, CaseDrawer& drawer,
                   std::vector<Inspection>& inspections) {
  const Candidates candidates = candidates_of(run);
  std::vector<Candidates::const_iterator> largest_first;
  for (auto group = candidates.begin(); group != candidates.end(); ++group) {
    largest_first.push_back(group);
  }
  std::stable_sort(largest_first.begin(), largest_first.end(), [](const auto& a, const auto& b) {
    return a->second.front().size() > b->second.front().size();
  });
  const std::size_t room = records::kMostInspections - inspections.size();
  std::vector<Inspection> worst;
  for (const auto& group : largest_first) {
    if (worst.size() == room) break;
    const std::vector<Candidate>& errors = group->second;
    for (std::size_t i = 0; i < std::min(errors.size(), kMostTries); ++i) {
      std::optional<Inspection> inspection =
          inspect_candidate(errors[i], run.plan, sources, drawer);
      if (!inspection) continue;
      inspection->stratum = std::get<Stratum>(group->first);
      worst.push_back(*std::move(inspection));
      break;
    }
  }
  std::sort(worst.begin(), worst.end(), [](const Inspection& a, const Inspection& b) {
    return std::tie(a.law, a.backend, a.kind, a.stratum) <
           std::tie(b.law, b.backend, b.kind, b.stratum);
  });
  std::move(worst.begin(), worst.end(), std::back_inserter(inspections));
}

}  // namespace

std::vector<Inspection> inspect_run(const records::Run& run, const CaseSources& sources,
                                    CaseDrawer& drawer) {
  std::vector<Inspection> inspections;
  inspect_counterexamples(run, drawer, inspections);
  inspect_worst(run, sources, drawer, inspections);
  return inspections;
}

}  // namespace rastercheck::properties
