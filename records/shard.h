#pragma once

// Which part of a campaign a run did (`rastercheck run --shard 2/7`), and what of it the parts have
// to agree on before they are put together.

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

/// In so many parts a campaign may be cut.
inline constexpr std::uint64_t kMostShards = 4096;

/// "2 of 7".
std::string to_string(const ShardNumber& number);

/// What a backend lets be asked of it: what can be said of a campaign where the backend is not.
struct BackendPromises {
  std::string backend;      ///< as given on the command line
  bool has_limits = false;  ///< it does not draw every case
  /// The promise that a driver is held to; empty for what is no driver.
  std::optional<cases::DriverPromise> promise = std::nullopt;
  /// It promises the coverage, basis and tie rule that a case names, and values in perspective.
  bool draws_what_is_asked_for = false;
  std::vector<std::string> unpromised;  ///< laws about what it does not promise, in their order
  bool operator==(const BackendPromises&) const = default;
};

/// Describes one part of a campaign, so that merging can check that all parts belong together.
/// Plan::shard says which part it is.
struct Shard {
  bool is_whole = true;       ///< else it was interrupted, be it while shrinking
  std::string corpus_digest;  ///< of the corpus' cases
  std::string known_digest;   ///< of what is known of the backends; empty: nothing
  std::string scene_digest;   ///< of the scene as it was drawn; empty: of another shard, or none
  std::vector<BackendPromises> promises;  ///< of the run's backends, in their order
  /// Counterexamples of earlier runs that were checked again.
  std::vector<cases::Case> saved;
  bool operator==(const Shard&) const = default;
};

}  // namespace rastercheck::records
