#include "records/shard_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/contract_json.h"
#include "cases/json.h"

namespace rastercheck::records {
namespace {

using cases::JsonNode;
using nlohmann::json;

/// What its own writer makes of it, so that the two cannot drift apart.
json document_of(const std::string& text) {
  return cases::parse_json(text, "shard").value_or(json());
}

ShardNumber read_number(const JsonNode& node) {
  ShardNumber number{node["index"].count(kMostShards), node["count"].count(kMostShards)};
  if (!node.failed() && (number.index == 0 || number.index > number.count)) {
    node["index"].refuse(fmt::format("must be from 1 to {}", number.count));
  }
  return number;
}

json promises_to_json(const BackendPromises& promises) {
  return {{"backend", promises.backend},
          {"has_limits", promises.has_limits},
          {"draws_what_is_asked_for", promises.draws_what_is_asked_for},
          {"unpromised", promises.unpromised}};
}

BackendPromises read_promises(const JsonNode& node) {
  node.expect_object({"backend", "has_limits", "draws_what_is_asked_for", "unpromised"});
  BackendPromises promises;
  promises.backend = node["backend"].text();
  promises.has_limits = node["has_limits"].boolean();
  promises.draws_what_is_asked_for = node["draws_what_is_asked_for"].boolean();
  for (const JsonNode& law : node["unpromised"].elements()) {
    promises.unpromised.push_back(law.text());
  }
  return promises;
}

}  // namespace

json shard_number_to_json(const ShardNumber& number) {
  return {{"index", number.index}, {"count", number.count}};
}

ShardNumber shard_number_from_json(const JsonNode& node) {
  node.expect_object({"index", "count"});
  return node.failed() ? ShardNumber() : read_number(node);
}

json shard_to_json(const Shard& shard) {
  json object = shard_number_to_json(shard.number);
  object["is_whole"] = shard.is_whole;
  object["corpus_digest"] = shard.corpus_digest;
  object["promises"] = json::array();
  for (const BackendPromises& promises : shard.promises) {
    object["promises"].push_back(promises_to_json(promises));
  }
  if (!shard.known_digest.empty()) object["known_digest"] = shard.known_digest;
  if (!shard.scene_digest.empty()) object["scene_digest"] = shard.scene_digest;
  if (shard.contract) object["contract"] = document_of(cases::to_json(*shard.contract));
  for (const cases::Case& c : shard.saved) {
    object["saved"].push_back(document_of(cases::to_json(c)));
  }
  return object;
}

Shard shard_from_json(const JsonNode& node) {
  node.expect_object({"index", "count", "is_whole", "corpus_digest", "promises"},
                     {"known_digest", "scene_digest", "contract", "saved"});
  Shard shard;
  if (node.failed()) return shard;
  shard.number = read_number(node);
  shard.is_whole = node["is_whole"].boolean();
  shard.corpus_digest = node["corpus_digest"].text();
  for (const JsonNode& promises : node["promises"].elements()) {
    shard.promises.push_back(read_promises(promises));
  }
  if (node.has("known_digest")) shard.known_digest = node["known_digest"].text();
  if (node.has("scene_digest")) shard.scene_digest = node["scene_digest"].text();
  if (node.has("contract")) shard.contract = cases::read_contract_terms(node["contract"]);
  if (!node.has("saved")) return shard;
  for (const JsonNode& saved : node["saved"].elements()) {
    if (node.failed()) return shard;
    shard.saved.push_back(cases::read_case(saved));
    if (!shard.saved.back().found) saved.refuse("has no 'found'");
  }
  return shard;
}

}  // namespace rastercheck::records
