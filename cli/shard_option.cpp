#include "cli/shard_option.h"

#include <fmt/format.h>

#include "cases/json.h"
#include "cli/whole_number.h"

namespace rastercheck::cli {
namespace {

Error refusal(const std::string& text, const std::string& reason) {
  return {"--shard", cases::printable(text), reason};
}

std::string name_of(const std::optional<records::ShardNumber>& shard) {
  return shard ? "shard " + to_string(*shard) : "not a shard";
}

}  // namespace

CLI::Option* add_shard(CLI::App& app, ShardOption& shard) {
  return app
      .add_option("--shard", shard,
                  "Do only part I of N of the work, such as 2/7 (needs --seed); `rastercheck "
                  "merge` combines the parts")
      ->type_name("I/N");
}

Result<std::optional<records::ShardNumber>> parse_shard(const ShardOption& option) {
  if (!option) return std::nullopt;
  const std::string& text = *option;
  const auto numbers = two_whole_numbers_in(text, '/');
  if (!numbers) return tl::unexpected(refusal(text, "must be two integers, such as 2/7"));
  const auto [index, count] = *numbers;
  if (count == 0 || count > records::kMostShards) {
    return tl::unexpected(refusal(
        text, fmt::format("the number of shards must be from 1 to {}", records::kMostShards)));
  }
  if (index == 0 || index > count) {
    return tl::unexpected(refusal(text, fmt::format("the shard must be from 1 to {}", count)));
  }
  return records::ShardNumber{index, count};
}

Result<void> check_shard(const records::Plan& plan, const ShardOption& option) {
  const auto asked_for = parse_shard(option);
  if (!asked_for) return tl::unexpected(asked_for.error());
  const auto& shard = plan.shard;
  if (!option || *asked_for == shard) return {};
  return tl::unexpected(refusal(*option, "the interrupted run is " + name_of(shard)));
}

std::optional<records::Shard> shard_of(const properties::Checkpoint& start,
                                       const std::vector<records::BackendPromises>& promises,
                                       const std::optional<cases::Case>& scene) {
  if (!start.plan.shard) return std::nullopt;
  records::Shard shard;
  shard.corpus_digest = start.corpus_digest;
  shard.known_digest = start.known_digest;
  if (scene) shard.scene_digest = properties::digest_of({*scene});
  shard.promises = promises;
  shard.saved = start.saved;
  return shard;
}

}  // namespace rastercheck::cli
