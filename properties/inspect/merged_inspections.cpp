#include "properties/inspect/merged_inspections.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "properties/campaign/campaign.h"
#include "properties/campaign/checkpoint.h"
#include "properties/campaign/corpus.h"
#include "properties/campaign/side_by_side.h"
#include "properties/inspect/looks.h"

namespace rastercheck::properties {
namespace {

tl::unexpected<Error> is_other(const std::string& what) {
  return tl::unexpected(Error{what, "", "differs from the shards'"});
}

}  // namespace

Result<void> inspect_merged(MergedRun& merged, const Conduct& conduct,
                            const SceneReader& read_scene) {
  const records::Plan& plan = merged.run.plan;
  merged.run.differences = differences_of(merged.run, {});  // needs no corpus
  const Result<std::vector<cases::Case>> corpus = corpus_of(plan, conduct.corpus);
  if (!corpus) return tl::unexpected(corpus.error());
  if (digest_of(*corpus) != merged.common.corpus_digest) return is_other(conduct.corpus);
  merged.run.differences = differences_of(merged.run, *corpus);

  TaskRunner runner(plan, {}, conduct.known, conduct.backends);
  const Result<KnownByBackend> known = runner.known();
  if (!known) return tl::unexpected(known.error());
  if (digest_of_known(*known) != merged.common.known_digest) {
    return is_other("list of known defects");
  }
  if (runner.promises() != merged.common.promises) return is_other("contract of a backend");

  std::optional<cases::Case> scene;
  if (!plan.scene.empty()) {
    Result<cases::Case> read = read_scene(plan);
    if (!read) return tl::unexpected(read.error());
    if (digest_of({*read}) != merged.common.scene_digest) return is_other(plan.scene);
    scene = *std::move(read);
  }
  look_closely(merged.run, {*corpus, merged.common.saved, *known, scene ? &*scene : nullptr},
               conduct.backends);
  return {};
}

}  // namespace rastercheck::properties
