#include "cli/merged_inspections.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

#include "backends/held_backend.h"
#include "cli/corpus_folder.h"
#include "cli/isolation.h"
#include "cli/scene.h"
#include "properties/campaign/campaign.h"
#include "properties/campaign/checkpoint.h"
#include "properties/campaign/corpus.h"
#include "properties/inspect/run_inspections.h"
#include "properties/inspect/specimens.h"

namespace rastercheck::cli {
namespace {

using properties::MergedRun;
using records::Run;

/// A number among the run's options, which wrote it.
template <typename Number>
Number number_of(const Run& run, std::string_view option, Number usual) {
  const std::string text = records::option_of(run.options, option).value_or("");
  std::from_chars(text.data(), text.data() + text.size(), usual);
  return usual;
}

std::string known_folder_of(const Run& run) {
  const bool is_none =
      std::find(run.options.begin(), run.options.end(), "--no-known") != run.options.end();
  return is_none ? "" : records::option_of(run.options, "--known").value_or(known_folder());
}

tl::unexpected<Error> is_other(const std::string& what) {
  return tl::unexpected(Error{what, "", "is not what the shards had"});
}

Result<std::optional<cases::Case>> scene_of(const MergedRun& merged) {
  if (merged.run.scene.empty()) return std::nullopt;
  Result<cases::Case> scene =
      read_scene(merged.run.scene, number_of(merged.run, "--scene-size", 512));
  if (!scene) return tl::unexpected(scene.error());
  if (properties::digest_of({*scene}) != merged.common.scene_digest) {
    return is_other(merged.run.scene);
  }
  return *std::move(scene);
}

}  // namespace

Result<void> inspect_merged(MergedRun& merged) {
  Run& run = merged.run;
  isolate_foreign_backends(number_of(run, "--timeout", kDefaultTimeout));
  if (merged.common.contract) backends::hold_backends_to(merged.common.contract);
  const std::string folder = records::option_of(run.options, "--corpus").value_or(corpus_folder());
  Result<std::vector<cases::Case>> corpus = properties::read_corpus(folder);
  if (!corpus) return tl::unexpected(corpus.error());
  if (properties::digest_of(*corpus) != merged.common.corpus_digest) return is_other(folder);

  properties::TaskRunner runner(run.seed, {}, {}, known_folder_of(run));
  const Result<properties::KnownByBackend> known = runner.known_of(run.backends);
  if (!known) return tl::unexpected(known.error());
  if (properties::digest_of_known(*known) != merged.common.known_digest) {
    return is_other("what is known of drivers");
  }
  properties::CampaignOptions campaign;
  campaign.backends = run.backends;
  campaign.laws = run.laws;
  if (runner.promises(campaign) != merged.common.promises) return is_other("what backends promise");

  const Result<std::optional<cases::Case>> scene = scene_of(merged);
  if (!scene) return tl::unexpected(scene.error());
  const properties::CaseSources sources{*corpus, merged.common.saved, *known,
                                        *scene ? &**scene : nullptr};
  run.inspections = properties::inspect_run(run, sources);
  run.specimens = properties::make_specimens(run, sources);
  return {};
}

}  // namespace rastercheck::cli
