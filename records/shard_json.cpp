#include "records/shard_json.h"

#include <nlohmann/json.hpp>

#include "cases/case_reader.h"
#include "cases/case_writer.h"

namespace rastercheck::records {

template <typename Archive, cases::Either<BackendPromises> T>
void members(Archive& archive, T& promises) {
  archive.required("backend", promises.backend);
  archive.required("has_limits", promises.has_limits);
  archive.optional("promise", promises.promise);
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
  archive.check([&](const cases::JsonNode& node) {
    for (std::size_t i = 0; i < shard.saved.size(); ++i) {
      if (!shard.saved[i].found) node["saved"].elements()[i].refuse("has no 'found'");
    }
  });
}

void write_value(nlohmann::json& to, const Shard& shard) { cases::write_members(to, shard); }
void read_value(const cases::JsonNode& node, Shard& shard) { cases::read_members(node, shard); }

}  // namespace rastercheck::records
