#pragma once

// Merges the shards of a campaign into the run that a single process would have produced.
//
// Merging draws nothing and needs no backend: findings merge exactly, the first counterexample of
// each kind over all shards is also the first of its own shard, and the required labels follow from
// the promises recorded in each shard.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cases/error.h"
#include "properties/campaign/findings.h"
#include "records/run.h"
#include "records/shard.h"

namespace rastercheck::properties {

struct MergedRun {
  /// Complete except for inspections. Each environment entry holds the shards' common value, or all
  /// their values if they differ. `seconds` is the sum, `date` the latest, and `shards` the number
  /// of shards.
  records::Run run;
  /// The data on which shards agree, with the first shard's scene and saved counterexamples.
  records::Shard common;
  /// [shard] the file that it was read from.
  std::vector<std::string> files;
};

class ShardMerge {
 public:
  /// Adds the run from a file, in any order. Refuses a run that is not a shard, was interrupted,
  /// belongs to another campaign (naming the first difference), or was already added.
  Result<void> add(records::Run run, const std::string& file);

  /// Returns the merged run. Fails if no shard was added, or if shards are missing, naming these.
  Result<MergedRun> finish() &&;

 private:
  struct Added {
    std::string file;
    std::map<std::string, std::string> environment;
  };

  Result<void> check(const records::Run& run, const std::string& file) const;

  records::Run first_;  ///< without its findings
  Findings all_;
  std::vector<records::SceneResult> scenes_;
  std::vector<records::Picture> pictures_;
  std::string scene_digest_;
  std::vector<cases::Case> saved_;
  std::map<std::uint64_t, Added> added_;  ///< by the shard's index
};

}  // namespace rastercheck::properties
