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

/// The option `--shard i/n` of `rastercheck run`.
CLI::Option* add_shard(CLI::App& app, ShardOption& shard);

/// "2/7" as a number; nothing where the option was not given. Fails where there is no such shard.
Result<std::optional<records::ShardNumber>> parse_shard(const ShardOption& option);

/// Whether the run that goes on is of that shard, where one is asked for.
Result<void> check_shard(const records::Plan& plan, const ShardOption& option);

/// What a run's shard says of it beside what it found. `scene` is the one that it drew, if any.
std::optional<records::Shard> shard_of(const properties::Checkpoint& start,
                                       const std::vector<records::BackendPromises>& promises,
                                       const std::optional<cases::Case>& scene);

}  // namespace rastercheck::cli
