#include "records/case_record_json.h"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "records/record_json.h"

namespace rastercheck::records {
namespace {

using cases::JsonNode;
using nlohmann::json;

constexpr int kDigestBase = 16;
constexpr std::size_t kDigestDigits = 16;

CaseKey read_case_key(const JsonNode& node) {
  return {node["law"].text(), node["backend"].text(), node["origin"].enumerator<Origin>(),
          node["index"].count()};
}

std::map<Stratum, WorstError> read_worst_of_strata(const JsonNode& node, std::uint64_t index,
                                                   const std::string& name) {
  constexpr auto kNames = names_of(Stratum{});
  node.expect_object({}, kNames);
  std::map<Stratum, WorstError> strata;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (!node.has(kNames[i])) continue;
    WorstError worst = error_without_case_from_json(node[kNames[i]]);
    worst.case_index = index;
    worst.case_name = name;
    strata[static_cast<Stratum>(i)] = std::move(worst);
  }
  return strata;
}

CaseRecord read_case_record(const JsonNode& node, const CaseKey& key) {
  CaseRecord record;
  if (node.has("name")) record.name = node["name"].text();
  record.stratum = node["stratum"].text();
  record.outcome = node["outcome"].enumerator<CaseOutcome>();
  record.source_digest = digest_from_json(node["source"]);
  record.found_digest = digest_from_json(node["found"]);
  if (node.has("mismatches")) record.mismatches = node["mismatches"].count();
  if (node.has("worst")) {
    record.worst = worst_of_case_from_json(node["worst"], key.index, record.name);
  }
  return record;
}

}  // namespace

std::string digest_text(std::uint64_t digest) { return fmt::format("{:016x}", digest); }

std::uint64_t digest_from_json(const JsonNode& node) {
  const std::string text = node.text();
  std::uint64_t digest = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, digest, kDigestBase);
  if (text.size() != kDigestDigits || error != std::errc() || stop != end ||
      digest_text(digest) != text) {
    node.refuse("must be 16 hexadecimal digits");
  }
  return digest;
}

json worst_of_case_to_json(const WorstOfCase& worst) {
  json object = json::object();
  for (const auto& [kind, strata] : worst) {
    json& of_kind = object[std::string(to_string(kind))] = json::object();
    for (const auto& [stratum, error] : strata) {
      of_kind[std::string(to_string(stratum))] = error_without_case_to_json(error);
    }
  }
  return object;
}

WorstOfCase worst_of_case_from_json(const JsonNode& node, std::uint64_t index,
                                    const std::string& name) {
  constexpr auto kKinds = names_of(AttributeKind{});
  node.expect_object({}, kKinds);
  WorstOfCase worst;
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (!node.has(kKinds[i])) continue;
    worst[static_cast<AttributeKind>(i)] = read_worst_of_strata(node[kKinds[i]], index, name);
  }
  return worst;
}

json case_record_to_json(const CaseKey& key, const CaseRecord& record) {
  json object{{"law", key.law},
              {"backend", key.backend},
              {"origin", to_string(key.origin)},
              {"index", key.index},
              {"stratum", record.stratum},
              {"outcome", to_string(record.outcome)},
              {"source", digest_text(record.source_digest)},
              {"found", digest_text(record.found_digest)}};
  if (!record.name.empty()) object["name"] = record.name;
  if (record.mismatches > 0) object["mismatches"] = record.mismatches;
  if (!record.worst.empty()) object["worst"] = worst_of_case_to_json(record.worst);
  return object;
}

json case_records_to_json(const CaseRecordSet& records) {
  json array = json::array();
  for (const auto& [key, record] : records) array.push_back(case_record_to_json(key, record));
  return array;
}

CaseRecordSet case_records_from_json(const JsonNode& array) {
  CaseRecordSet records;
  for (const JsonNode& node : array.elements()) {
    node.expect_object(
        {"law", "backend", "origin", "index", "stratum", "outcome", "source", "found"},
        {"name", "mismatches", "worst"});
    if (node.failed()) break;
    CaseKey key = read_case_key(node);
    CaseRecord record = read_case_record(node, key);
    const bool is_new = records.emplace(std::move(key), std::move(record)).second;
    if (!is_new) node.refuse("a second record of the same law, backend, origin and index");
  }
  return records;
}

}  // namespace rastercheck::records
