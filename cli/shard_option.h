#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "cases/error.h"
#include "properties/checkpoint.h"
#include "records/shard.h"

namespace rastercheck::cli {

/// The option `--shard i/n` of `rastercheck run`; empty without it.
CLI::Option* add_shard(CLI::App& app, std::string& shard);

/// "2/7" as a number; nothing of "". Fails where there is no such shard.
Result<std::optional<records::ShardNumber>> parse_shard(const std::string& text);

/// Whether the run that goes on is of that shard; any is where `text` is "".
Result<void> check_shard(const properties::RunPlan& plan, const std::string& text);

/// What a run's shard says of it beside what it found. `scene` is the one that it drew, if any.
std::optional<records::Shard> shard_of(const properties::Checkpoint& start,
                                       const std::vector<records::BackendPromises>& promises,
                                       const std::optional<cases::Case>& scene);

}  // namespace rastercheck::cli
