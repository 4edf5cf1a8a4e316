#include "properties/inspect/run_inspections.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include "properties/inspect/inspect.h"
#include "properties/inspect/largest_errors.h"
#include "records/record.h"

namespace rastercheck::properties {
namespace {

using records::Inspection;

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

std::optional<Inspection> inspect_error(const RunError& error, const records::Plan& plan,
                                        const CaseSources& sources, CaseDrawer& drawer) {
  const std::optional<cases::Case> c = case_of(error, plan, sources);
  if (!c) return std::nullopt;
  const records::WorstError& worst = *error.worst;
  const Focus focus{worst.place, worst.attribute};
  std::optional<Inspection> inspection =
      inspect_part(*c, error.key->backend, focus, drawer, kOfRuns);
  if (!inspection || !shows(*inspection, worst.attribute, worst.actual)) return std::nullopt;
  inspection->occasion = records::Occasion::worst;
  inspection->law = error.key->law;
  inspection->kind = error.key->attribute_kind;
  return inspection;
}

void inspect_worst(const records::Run& run, const CaseSources& sources, CaseDrawer& drawer,
                   std::vector<Inspection>& inspections) {
  const LargestErrors all = largest_errors(run);
  std::vector<LargestErrors::const_iterator> largest_first;
  for (auto group = all.begin(); group != all.end(); ++group) {
    largest_first.push_back(group);
  }
  std::stable_sort(largest_first.begin(), largest_first.end(), [](const auto& a, const auto& b) {
    return a->second.front().size() > b->second.front().size();
  });
  const std::size_t room = records::kMostInspections - inspections.size();
  std::vector<Inspection> worst;
  for (const auto& group : largest_first) {
    if (worst.size() == room) break;
    const std::vector<RunError>& errors = group->second;
    for (std::size_t i = 0; i < std::min(errors.size(), kMostTries); ++i) {
      std::optional<Inspection> inspection = inspect_error(errors[i], run.plan, sources, drawer);
      if (!inspection) continue;
      inspection->stratum = std::get<records::Stratum>(group->first);
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
