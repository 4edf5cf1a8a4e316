#include "gate/hunted_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "cases/json.h"
#include "gate/sections.h"
#include "properties/campaign/campaign.h"
#include "properties/campaign/corpus.h"
#include "properties/campaign/workers.h"
#include "records/plan_json.h"
#include "records/run.h"

namespace rastercheck::gate {
namespace {

/// The tasks that check a plan's corpus from case `first` on.
std::vector<properties::Task> tasks_from(std::size_t first, const records::Plan& plan,
                                         std::size_t corpus_size,
                                         const properties::KnownByBackend& known) {
  std::vector<properties::Task> tasks = properties::tasks_of(plan, corpus_size, {}, known);
  std::erase_if(tasks, [first](const properties::Task& task) {
    return task.kind != properties::TaskKind::corpus || task.last <= first;
  });
  for (properties::Task& task : tasks) task.first = std::max<std::uint64_t>(task.first, first);
  return tasks;
}

/// Refuses a corpus whose cases are not those that the section has figures of.
Result<void> check_corpus(const records::BaselineSection& section,
                          const std::vector<cases::Case>& corpus, std::size_t count) {
  const auto is_of_section = [&](const auto& numbered) {
    const auto& [index, name] = numbered;
    return index < count && corpus[index].name == name;
  };
  if (section.corpus.size() == count &&
      std::all_of(section.corpus.begin(), section.corpus.end(), is_of_section)) {
    return {};
  }
  return tl::unexpected(
      Error{"the corpus", "",
            fmt::format("has other cases than the baseline's section {}", to_string(section.key))});
}

}  // namespace

Result<void> add_hunted(records::BaselineSection& section, const std::string& backend,
                        const std::vector<cases::Case>& worst, const properties::Conduct& conduct) {
  records::Plan plan = section.plan;
  plan.backends = {backend};
  plan.keeps_cases = true;
  for (const auto& [law, cases] : section.laws) plan.laws.push_back(law);
  plan.hunted.insert(plan.hunted.end(), worst.begin(), worst.end());
  if (cases::json_line(cases::json_of(plan)).size() > kMostPlanCharacters) {
    return tl::unexpected(
        Error{"the baseline", "",
              fmt::format("has no room for {} more worst cases beside the {} of {}", worst.size(),
                          section.plan.hunted.size(), to_string(section.key))});
  }
  Result<std::vector<cases::Case>> corpus = properties::corpus_of(plan, conduct.corpus);
  if (!corpus) return tl::unexpected(corpus.error());
  const std::size_t size = corpus->size();
  const std::size_t first = size - worst.size();
  if (auto same = check_corpus(section, *corpus, first); !same) return same;

  properties::TaskRunner runner(plan, *std::move(corpus), conduct.known, conduct.backends);
  const Result<properties::KnownByBackend> known = runner.known();
  if (!known) return tl::unexpected(known.error());
  runner.make_cases_for(runner.capabilities());
  properties::Findings findings;
  Result<void> checked =
      properties::run_tasks(runner, tasks_from(first, plan, size, *known),
                            [&findings](std::size_t /*task*/, properties::Findings found) {
                              merge(findings, std::move(found));
                              return !findings.fault;
                            });
  if (!checked) return checked;
  if (findings.fault) return tl::unexpected(Error{"the oracle", "", *findings.fault});
  records::Run run;
  run.plan = plan;
  run.records = std::move(findings.records);
  run.cases = std::move(findings.cases);
  if (auto added = add_cases(section, run, backend); !added) return added;
  section.plan.hunted = std::move(plan.hunted);
  return {};
}

}  // namespace rastercheck::gate
