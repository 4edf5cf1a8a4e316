#pragma once

// The shards of a campaign put together to the run that one program would have made of it.
//
// Nothing is drawn for it, and no backend has to be there: what was found merges exactly, the first
// counterexample of each kind over all shards is the first of its own shard, and what a law's cases
// had to reach follows from what each shard says its backends promise.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cases/error.h"
#include "properties/campaign/findings.h"
#include "records/inspection.h"
#include "records/run.h"
#include "records/shard.h"

namespace rastercheck::properties {

struct MergedRun {
  /// Whole but for the inspections. Its environment: what shards say alike, and where they do not,
  /// all that they say; `seconds` are all of them together, `date` is the last one's, and `shards`
  /// how many there were.
  records::Run run;
  /// What the shards agree on, and what the first of them says of scene and saved counterexamples.
  records::Shard common;
  /// [shard] what it looked at, each with its counterexamples.
  struct LookedAt {
    std::vector<records::Counterexample> counterexamples;
    std::vector<records::Inspection> inspections;
  };
  std::vector<LookedAt> looked_at;
};

class ShardMerge {
 public:
  /// Adds the run that a file holds, in any order. Refuses what is no shard, one that was
  /// interrupted, one of another campaign than those before, naming the first difference, and one
  /// that is there already.
  Result<void> add(records::Run run, const std::string& file);

  /// Fails where there is none, or some are missing, which it names.
  Result<MergedRun> finish() &&;

 private:
  struct Added {
    std::string file;
    std::map<std::string, std::string> environment;
    MergedRun::LookedAt looked_at;
  };

  Result<void> check(const records::Run& run, const std::string& file) const;

  records::Run first_;  ///< without what it found
  Findings all_;
  std::vector<records::SceneResult> scenes_;
  std::vector<records::Picture> pictures_;
  std::string scene_digest_;
  std::vector<cases::Case> saved_;
  std::map<std::uint64_t, Added> added_;  ///< by the shard's index
};

}  // namespace rastercheck::properties
