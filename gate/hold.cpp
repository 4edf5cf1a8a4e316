#include "gate/hold.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <iterator>
#include <utility>
#include <vector>

#include "gate/closer_looks.h"
#include "gate/compare.h"
#include "gate/grown_cases.h"
#include "properties/campaign/campaign.h"
#include "properties/campaign/corpus.h"

namespace rastercheck::gate {
namespace {

Day today() { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))); }

/// Draws cases with changed bits again and inspects them.
std::vector<records::CloserLook> looks_of(const reports::Gate& gate, const Side& baseline,
                                          const Side& current, const HoldOptions& options) {
  std::vector<records::CloserLook> looks;
  for (const records::Comparison& comparison : gate.comparisons) {
    if (comparison.changed_cases == 0) continue;
    // Without the corpus, its cases get no pictures, which is no reason to fail.
    const std::vector<cases::Case> corpus =
        properties::corpus_of(comparison.plan, corpus_folder_of(comparison, options.corpus))
            .value_or(std::vector<cases::Case>());
    records::Plan plan = comparison.plan;
    plan.timeout = options.timeout;  // does not affect what is drawn
    std::vector<records::CloserLook> found =
        look_closer(comparison, baseline.sections, current.sections, corpus,
                    properties::factory_for(plan, options.worker));
    std::move(found.begin(), found.end(), std::back_inserter(looks));
  }
  return looks;
}

}  // namespace

Result<reports::Gate> hold(const Side& baseline, const Side& current, const HoldOptions& options) {
  Result<std::vector<records::Comparison>> comparisons =
      compare(baseline.sections, current.sections, {baseline.file, current.file});
  if (!comparisons) return tl::unexpected(comparisons.error());
  reports::Gate gate;
  gate.comparisons = *std::move(comparisons);
  gate.policy = apply(options.policy, today(), gate.comparisons);
  gate.baseline_file = baseline.file;
  gate.current_file = current.file;
  gate.folder = options.folder;
  gate.before_run = baseline.run ? &*baseline.run : nullptr;
  gate.after_run = current.run ? &*current.run : nullptr;
  gate.baseline = &baseline.sections;
  if (!options.folder.empty()) gate.looks = looks_of(gate, baseline, current, options);
  return gate;
}

Result<void> write_files(const reports::Gate& gate, const std::string& corpus) {
  return save_grown_cases(gate, corpus).and_then([&] {
    return reports::write_comparison(gate, gate.folder);
  });
}

}  // namespace rastercheck::gate
