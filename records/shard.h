#pragma once

// The part of a campaign that a run did (`rastercheck run --shard 2/7`), and the data on which all
// parts must agree before they are merged.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/driver_promise.h"

namespace rastercheck::records {

/// One of `count` parts, from 1.
struct ShardNumber {
  std::uint64_t index = 1;
  std::uint64_t count = 1;
  bool operator==(const ShardNumber&) const = default;
};

/// Maximum number of parts of a campaign.
inline constexpr std::uint64_t kMostShards = 4096;

/// "2 of 7".
std::string to_string(const ShardNumber& number);

/// A backend's promises, in enough detail to describe a campaign on a machine without the backend.
struct BackendPromises {
  std::string backend;      ///< as given on the command line
  bool has_limits = false;  ///< true if it does not draw every case
  /// The promise that a driver is held to; empty if the backend is not a driver.
  std::optional<cases::DriverPromise> promise = std::nullopt;
  /// True if it promises the coverage, basis and tie rule that a case names, and
  /// perspective-correct values.
  bool draws_what_is_asked_for = false;
  /// Laws about properties that the backend does not promise, in order
  std::vector<std::string> unpromised;
  bool operator==(const BackendPromises&) const = default;
};

/// Describes one part of a campaign, so that merging can check that all parts belong together.
/// Plan::shard gives the part's number.
struct Shard {
  bool is_whole = true;       ///< false if interrupted, even during shrinking
  std::string corpus_digest;  ///< digest of the corpus' cases
  std::string known_digest;   ///< digest of the backends' known defects; empty: none
  /// Digest of the scene as drawn; empty: no scene, or drawn by another shard.
  std::string scene_digest;
  std::vector<BackendPromises> promises;  ///< one for each of the run's backends, in their order
  /// Counterexamples of earlier runs that were checked again.
  std::vector<cases::Case> saved;
  bool operator==(const Shard&) const = default;
};

}  // namespace rastercheck::records
