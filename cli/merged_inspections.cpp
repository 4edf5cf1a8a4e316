#include "cli/merged_inspections.h"

#include <optional>
#include <string>

#include "backends/factory.h"
#include "cli/corpus_folder.h"
#include "cli/isolation.h"
#include "cli/scene.h"
#include "properties/campaign/campaign.h"
#include "properties/campaign/checkpoint.h"
#include "properties/campaign/corpus.h"
#include "properties/campaign/side_by_side.h"
#include "properties/inspect/looks.h"

namespace rastercheck::cli {
namespace {

using properties::MergedRun;
using records::Run;

tl::unexpected<Error> is_other(const std::string& what) {
  return tl::unexpected(Error{what, "", "differs from the shards'"});
}

Result<std::optional<cases::Case>> scene_of(const MergedRun& merged) {
  const records::Plan& plan = merged.run.plan;
  if (plan.scene.empty()) return std::nullopt;
  Result<cases::Case> scene = read_scene(plan);
  if (!scene) return tl::unexpected(scene.error());
  if (properties::digest_of({*scene}) != merged.common.scene_digest) {
    return is_other(plan.scene);
  }
  return *std::move(scene);
}

}  // namespace

Result<void> inspect_merged(MergedRun& merged) {
  Run& run = merged.run;
  const records::Plan& plan = run.plan;
  const backends::BackendFactory backends = properties::factory_for(plan, worker_program());
  run.differences = properties::differences_of(run, {});  // those of random cases need no corpus
  const std::string folder = corpus_folder_of(plan);
  Result<std::vector<cases::Case>> corpus = properties::read_corpus(folder);
  if (!corpus) return tl::unexpected(corpus.error());
  if (properties::digest_of(*corpus) != merged.common.corpus_digest) return is_other(folder);
  run.differences = properties::differences_of(run, *corpus);

  properties::TaskRunner runner(plan, {}, known_sources_of(plan), backends);
  const Result<properties::KnownByBackend> known = runner.known();
  if (!known) return tl::unexpected(known.error());
  if (properties::digest_of_known(*known) != merged.common.known_digest) {
    return is_other("list of known defects");
  }
  if (runner.promises() != merged.common.promises) return is_other("contract of a backend");

  const Result<std::optional<cases::Case>> scene = scene_of(merged);
  if (!scene) return tl::unexpected(scene.error());
  const properties::CaseSources sources{*corpus, merged.common.saved, *known,
                                        *scene ? &**scene : nullptr};
  properties::look_closely(run, sources, backends);
  return {};
}

}  // namespace rastercheck::cli
