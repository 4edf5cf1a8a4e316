#include "records/known_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "cases/names.h"

namespace rastercheck::records {
namespace {

using cases::JsonNode;
using nlohmann::json;

constexpr std::size_t kMostInList = 64;  ///< far more than any list of an entry needs
constexpr std::int64_t kMostSamples = 16;

std::string read_line(const JsonNode& node) {
  std::string text = node.text();
  if (text.empty()) node.refuse("must not be empty");
  if (text.find('\n') != std::string::npos) node.refuse("must be one line");
  return text;
}

std::vector<std::string> read_lines(const JsonNode& node, std::string_view what) {
  std::vector<std::string> lines;
  for (const JsonNode& one : node.elements(1, kMostInList, what)) lines.push_back(read_line(one));
  return lines;
}

template <typename Enum>
std::vector<Enum> read_enumerators(const JsonNode& node, std::string_view what) {
  std::vector<Enum> all;
  for (const JsonNode& one : node.elements(1, kMostInList, what)) {
    all.push_back(one.enumerator<Enum>());
  }
  return all;
}

template <typename Enum>
json names_of_all(const std::vector<Enum>& all) {
  json names = json::array();
  for (const Enum one : all) names.push_back(cases::name_of(one));
  return names;
}

constexpr auto kListNames = std::to_array<std::string_view>(
    {"rules", "samples", "attribute_kind", "interpolation", "location", "note"});

/// The keys that conditions may have.
std::vector<std::string_view> condition_names() {
  std::vector<std::string_view> names(kListNames.begin(), kListNames.end());
  constexpr auto kFacts = names_of(KnownFact{});
  constexpr auto kLimits = names_of(KnownLimit{});
  names.insert(names.end(), kFacts.begin(), kFacts.end());
  names.insert(names.end(), kLimits.begin(), kLimits.end());
  return names;
}

std::vector<int> read_samples(const JsonNode& node) {
  std::vector<int> all;
  for (const JsonNode& one : node.elements(1, kMostInList, "numbers of samples")) {
    all.push_back(static_cast<int>(one.integer(1, kMostSamples)));
  }
  return all;
}

KnownConditions read_conditions(const JsonNode& node) {
  node.expect_object({}, condition_names());
  KnownConditions when;
  if (node.failed()) return when;
  if (node.has("rules")) when.rules = read_enumerators<cases::Rules>(node["rules"], "rules");
  if (node.has("samples")) when.samples = read_samples(node["samples"]);
  if (node.has("attribute_kind")) {
    when.attribute_kinds = read_enumerators<AttributeKind>(node["attribute_kind"], "kinds");
  }
  if (node.has("interpolation")) {
    when.interpolations =
        read_enumerators<cases::Interpolation>(node["interpolation"], "qualifiers");
  }
  if (node.has("location")) {
    when.locations = read_enumerators<cases::Location>(node["location"], "locations");
  }
  if (node.has("note")) when.note = read_line(node["note"]);
  for (std::size_t i = 0; i < names_of(KnownFact{}).size(); ++i) {
    const auto fact = static_cast<KnownFact>(i);
    if (node.has(cases::name_of(fact))) when.facts[fact] = node[cases::name_of(fact)].boolean();
  }
  for (std::size_t i = 0; i < names_of(KnownLimit{}).size(); ++i) {
    const auto limit = static_cast<KnownLimit>(i);
    if (node.has(cases::name_of(limit))) when.limits[limit] = node[cases::name_of(limit)].float64();
  }
  if (when == KnownConditions()) {
    node.refuse("must have a condition: without one, nothing new of these laws would stand out");
  }
  return when;
}

json conditions_to_json(const KnownConditions& when) {
  json object = json::object();
  if (!when.rules.empty()) object["rules"] = names_of_all(when.rules);
  if (!when.samples.empty()) object["samples"] = when.samples;
  if (!when.attribute_kinds.empty()) object["attribute_kind"] = names_of_all(when.attribute_kinds);
  if (!when.interpolations.empty()) object["interpolation"] = names_of_all(when.interpolations);
  if (!when.locations.empty()) object["location"] = names_of_all(when.locations);
  if (!when.note.empty()) object["note"] = when.note;
  for (const auto& [fact, is_so] : when.facts) object[std::string(cases::name_of(fact))] = is_so;
  for (const auto& [limit, number] : when.limits) {
    object[std::string(cases::name_of(limit))] = cases::float64_to_json(number);
  }
  return object;
}

/// A file within the folder that the list is in.
std::string read_case_file(const JsonNode& node) {
  std::string text = read_line(node);
  const std::filesystem::path path(text);
  if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end()) {
    node.refuse("must be a file in the folder of the list");
  }
  return text;
}

KnownEntry read_entry(const JsonNode& node) {
  node.expect_object({"id", "reason", "rule", "finding", "laws", "verdicts", "when", "case"});
  KnownEntry entry;
  if (node.failed()) return entry;
  entry.id = read_line(node["id"]);
  entry.reason = read_line(node["reason"]);
  entry.rule = read_line(node["rule"]);
  entry.finding = read_line(node["finding"]);
  entry.laws = read_lines(node["laws"], "laws");
  entry.verdicts = read_enumerators<FragmentClass>(node["verdicts"], "verdicts");
  const auto& verdicts = entry.verdicts;
  if (std::find(verdicts.begin(), verdicts.end(), FragmentClass::correct) != verdicts.end()) {
    node["verdicts"].refuse("no violation is correct");
  }
  entry.when = read_conditions(node["when"]);
  entry.case_file = read_case_file(node["case"]);
  return entry;
}

json entry_to_json(const KnownEntry& entry) {
  return {{"id", entry.id},
          {"reason", entry.reason},
          {"rule", entry.rule},
          {"finding", entry.finding},
          {"laws", entry.laws},
          {"verdicts", names_of_all(entry.verdicts)},
          {"when", conditions_to_json(entry.when)},
          {"case", entry.case_file}};
}

}  // namespace

KnownList known_from_json(const JsonNode& root) {
  // These first: of a later version, its unknown keys are not what is wrong.
  root.expect_format("rastercheck-known");
  if (root.has("version") && root["version"].count() != 1) {
    root["version"].refuse("version must be 1");
  }
  root.expect_object({"format", "version", "driver", "entries"});
  KnownList list;
  if (root.failed()) return list;
  root["driver"].expect_object({"name", "version"});
  list.driver = read_line(root["driver"]["name"]);
  list.version = read_line(root["driver"]["version"]);
  std::set<std::string> ids;
  for (const JsonNode& node : root["entries"].elements()) {
    list.entries.push_back(read_entry(node));
    if (root.failed()) break;
    if (!ids.insert(list.entries.back().id).second) node["id"].refuse("is another entry's, too");
  }
  return list;
}

Result<KnownList> parse_known(std::string_view text, const std::string& file) {
  return cases::read_json(text, file, &known_from_json);
}

json known_to_json(const KnownList& list) {
  json entries = json::array();
  for (const KnownEntry& entry : list.entries) entries.push_back(entry_to_json(entry));
  return {{"format", "rastercheck-known"},
          {"version", 1},
          {"driver", {{"name", list.driver}, {"version", list.version}}},
          {"entries", std::move(entries)}};
}

json known_of_backend_to_json(const KnownOfBackend& known) {
  return {{"backend", known.backend},
          {"driver_version", known.version},
          {"list", known_to_json(known.list)}};
}

KnownOfBackend known_of_backend_from_json(const JsonNode& node) {
  node.expect_object({"backend", "driver_version", "list"});
  return {node["backend"].text(), node["driver_version"].text(), known_from_json(node["list"])};
}

json unexpected_pass_to_json(const UnexpectedPass& pass) {
  return {{"backend", pass.backend},
          {"id", pass.id},
          {"law", pass.law},
          {"is_same_version", pass.is_same_version}};
}

UnexpectedPass unexpected_pass_from_json(const JsonNode& node) {
  node.expect_object({"backend", "id", "law", "is_same_version"});
  return {node["backend"].text(), node["id"].text(), node["law"].text(),
          node["is_same_version"].boolean()};
}

}  // namespace rastercheck::records
