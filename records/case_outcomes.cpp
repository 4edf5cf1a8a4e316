#include "records/case_outcomes.h"

#include <fmt/format.h>

#include "records/run.h"

namespace rastercheck::records {

IndexSet judged_of(const CaseOutcomes& outcomes) {
  IndexSet judged = outcomes.right;
  judged.merge(outcomes.wrong);
  judged.merge(outcomes.known);
  return judged;
}

void merge(CaseOutcomeSet& into, const CaseOutcomeSet& from) {
  for (const auto& [key, outcomes] : from) {
    CaseOutcomes& all = into[key];
    all.right.merge(outcomes.right);
    all.wrong.merge(outcomes.wrong);
    all.known.merge(outcomes.known);
    for (const auto& [backend, cases] : outcomes.unlike) all.unlike[backend].merge(cases);
  }
}

std::string file_of(const Difference& difference) {
  const cases::Found found = difference.source.found.value_or(cases::Found());
  return fmt::format("differences/{}-{}-wrong-{}-right.json", file_word(found.law),
                     file_word(found.backend), file_word(difference.right));
}

}  // namespace rastercheck::records
