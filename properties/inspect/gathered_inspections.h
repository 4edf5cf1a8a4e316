#pragma once

// Combines the shards' inspections into those of the whole run, on a machine without their
// backends.

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "records/inspection.h"
#include "records/run.h"

namespace rastercheck::properties {

/// Keeps of each shard only what the whole run may show, so that shards need not be in memory
/// together.
class GatheredInspections {
 public:
  /// `run`: the merged run, which must outlive this object.
  explicit GatheredInspections(const records::Run& run);

  /// Adds a shard's inspections. Of equal errors, that of the shard added first is kept.
  void add(const records::Run& shard);

  /// Returns inspections in the order and with the limit of inspect_run(). Takes each
  /// counterexample's inspection from the shard that found it. For each backend, kind and stratum,
  /// takes the largest error that any shard showed, which may differ from the largest error that
  /// can be shown for the whole run.
  std::vector<records::Inspection> finish() &&;

 private:
  struct Worst {
    double size = 0;
    records::Inspection inspection;
  };
  using Key = std::tuple<std::string, records::AttributeKind, records::Stratum>;

  static bool is_preferred(const Worst& a, const Worst& b);
  void add_counterexample(const records::Run& shard, const records::Inspection& inspection);
  void add_worst(const records::Inspection& inspection);

  const records::Run* run_;
  std::vector<std::optional<records::Inspection>> of_counterexamples_;  ///< [counterexample]
  std::map<Key, Worst> largest_;
};

}  // namespace rastercheck::properties
