#include "properties/campaign/side_by_side.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "cases/case_writer.h"
#include "oracle/transform.h"
#include "properties/campaign/frozen_case.h"
#include "properties/choices.h"
#include "records/side_by_side.h"

namespace rastercheck::properties {
namespace {

using records::IndexSet;

/// Returns the numbers of the judged cases for which the backend `other` got a different case.
IndexSet unlike_cases(const records::Plan& plan, std::span<const cases::Case> corpus,
                      const records::OutcomeKey& key, const IndexSet& judged,
                      const std::string& other) {
  IndexSet unlike;
  for (const auto& [first, last] : judged.ranges()) {
    for (std::uint64_t number = first; number <= last; ++number) {
      const auto here = frozen_case({key.law, key.backend, key.origin, number}, plan, corpus);
      const auto there = frozen_case({key.law, other, key.origin, number}, plan, corpus);
      // Compares the cases as text, which distinguishes -0 from 0, as drawings do.
      if (!here || !there || cases::to_json(*here) != cases::to_json(*there)) unlike.add(number);
    }
  }
  return unlike;
}

/// Makes the first case of a law for which `right` is right and `wrong` is not.
std::optional<records::Difference> difference(const records::Run& run,
                                              std::span<const cases::Case> corpus,
                                              const std::string& law, const std::string& wrong,
                                              const std::string& right,
                                              const std::vector<records::CasePlace>& places) {
  if (places.empty()) return std::nullopt;
  const auto& [origin, index] = places.front();
  std::optional<cases::Case> source = frozen_case({law, wrong, origin, index}, run.plan, corpus);
  if (!source) return std::nullopt;
  // The law must make the same choices as in the run.
  const Result<cases::ClipCase> clip = oracle::to_clip_case(*source, "");
  source->choices = clip ? choices_of(*clip) : choices_of(*source);
  source->found = cases::Found{law, wrong, "", run.plan.seed, index};
  return records::Difference{*std::move(source), right, origin};
}

}  // namespace

void note_unlike_cases(const records::Plan& plan, std::span<const cases::Case> corpus,
                       Findings& findings) {
  if (!findings.outcomes) return;
  for (auto& [key, outcomes] : *findings.outcomes) {
    const IndexSet judged = judged_of(outcomes);
    for (const std::string& other : plan.backends) {
      if (other == key.backend) break;
      if (capabilities_of(plan, other) == capabilities_of(plan, key.backend)) continue;
      IndexSet unlike = unlike_cases(plan, corpus, key, judged, other);
      if (!unlike.empty()) outcomes.unlike[other] = std::move(unlike);
    }
  }
}

std::vector<records::Difference> differences_of(const records::Run& run,
                                                std::span<const cases::Case> corpus) {
  std::vector<records::Difference> all;
  const auto add = [&all](std::optional<records::Difference> one) {
    if (one) all.push_back(*std::move(one));
  };
  for (const records::SideBySide& pair : records::side_by_side(run)) {
    for (const records::SideBySideLaw& law : pair.laws) {
      add(difference(run, corpus, law.law, pair.second, pair.first, law.only_first_right));
      add(difference(run, corpus, law.law, pair.first, pair.second, law.only_second_right));
    }
  }
  return all;
}

}  // namespace rastercheck::properties
