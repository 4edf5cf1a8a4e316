#include "records/case_record_json.h"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>

#include "records/internal/shared_members.h"
#include "records/record_json.h"

namespace rastercheck::records {

std::string digest_text(std::uint64_t digest) { return fmt::format("{:016x}", digest); }

std::uint64_t digest_from_json(const cases::JsonNode& node) {
  constexpr int kBase = 16;
  constexpr std::size_t kDigits = 16;
  const std::string text = node.text();
  std::uint64_t digest = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, digest, kBase);
  if (text.size() != kDigits || error != std::errc() || stop != end ||
      digest_text(digest) != text) {
    node.refuse("must be 16 hexadecimal digits");
  }
  return digest;
}

void name_case(WorstOfCase& worst, std::uint64_t index, const std::string& name) {
  for (auto& [kind, strata] : worst) {
    for (auto& [stratum, error] : strata) {
      error.case_index = index;
      error.case_name = name;
    }
  }
}

template <typename Archive, cases::Either<CaseKey> Key, cases::Either<CaseRecord> T>
void members(Archive& archive, Key& key, T& record) {
  members(archive, key);
  archive.optional("name", record.name);
  archive.required("stratum", record.stratum);
  archive.required("outcome", record.outcome);
  archive.required("source", DigestText{record.source_digest});
  archive.required("found", DigestText{record.found_digest});
  archive.optional("mismatches", record.mismatches);
  archive.optional("worst", record.worst);
}

void write_value(nlohmann::json& to, const CaseRecordSet::value_type& one) {
  cases::write_object(to, [&](auto& archive) { members(archive, one.first, one.second); });
}
void write_value(nlohmann::json& to, const CaseRecordSet& records) {
  cases::write_entries(to, records);
}
void read_value(const cases::JsonNode& node, CaseRecordSet& records) {
  cases::read_entries(node, records, "record with the same property, backend, origin and index");
  for (auto& [key, record] : records) name_case(record.worst, key.index, record.name);
}

}  // namespace rastercheck::records
