#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "cases/error.h"
#include "properties/campaign/checkpoint.h"
#include "records/plan.h"
#include "records/shard.h"

namespace rastercheck::cli {

using ShardOption = std::optional<std::string>;

/// Adds the option `--shard i/n` of `rastercheck run`.
CLI::Option* add_shard(CLI::App& app, ShardOption& shard);

/// Reads a shard's number such as "2/7"; empty if the option was not given. Fails if no such shard
/// exists.
Result<std::optional<records::ShardNumber>> parse_shard(const ShardOption& option);

/// Fails if a shard is asked for and the resumed run is not that shard.
Result<void> check_shard(const records::Plan& plan, const ShardOption& option);

/// Returns the data that a shard stores besides its findings. `scene` is the scene that it drew, if
/// any.
std::optional<records::Shard> shard_of(const properties::Checkpoint& start,
                                       const std::vector<records::BackendPromises>& promises,
                                       const std::optional<cases::Case>& scene);

}  // namespace rastercheck::cli
