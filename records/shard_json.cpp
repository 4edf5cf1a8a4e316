#include "records/shard_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/json_members.h"
#include "records/internal/shard_members.h"

namespace rastercheck::records {

template <typename Archive, cases::Either<BackendPromises> T>
void members(Archive& archive, T& promises) {
  archive.required("backend", promises.backend);
  archive.required("has_limits", promises.has_limits);
  archive.required("draws_what_is_asked_for", promises.draws_what_is_asked_for);
  archive.required("unpromised", promises.unpromised);
}

template <typename Archive, cases::Either<Shard> T>
void members(Archive& archive, T& shard) {
  archive.required("is_whole", shard.is_whole);
  archive.required("corpus_digest", shard.corpus_digest);
  archive.required("promises", shard.promises);
  archive.optional("known_digest", shard.known_digest);
  archive.optional("scene_digest", shard.scene_digest);
  archive.optional("saved", shard.saved);
}

void check_shard_number(const ShardNumber& number, const cases::JsonNode& node) {
  if (node.failed()) return;
  if (number.count > kMostShards) {
    node["count"].refuse(fmt::format("must be at most {}", kMostShards));
  } else if (number.index == 0 || number.index > number.count) {
    node["index"].refuse(fmt::format("must be from 1 to {}", number.count));
  }
}

nlohmann::json shard_to_json(const Shard& shard) {
  nlohmann::json object;
  cases::write_members(object, shard);
  return object;
}

Shard shard_from_json(const cases::JsonNode& node) {
  auto shard = cases::read_members<Shard>(node);
  if (node.failed()) return shard;
  for (std::size_t i = 0; i < shard.saved.size(); ++i) {
    if (!shard.saved[i].found) node["saved"].elements()[i].refuse("has no 'found'");
  }
  return shard;
}

}  // namespace rastercheck::records
