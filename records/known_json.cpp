#include "records/known_json.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

namespace rastercheck::records {
namespace {

using cases::JsonNode;

constexpr std::size_t kMostInList = 64;  ///< far more than any list of an entry needs
constexpr std::int64_t kMostSamples = 16;

void check_line(const JsonNode& node) {
  const std::string text = node.text();
  if (text.empty()) node.refuse("must not be empty");
  if (text.find('\n') != std::string::npos) node.refuse("must be one line");
}

/// A text of one line that is not empty.
template <typename T>
struct Line {
  T& text;

  friend void write_value(nlohmann::json& to, const Line& line) { to = line.text; }
  friend void read_value(const JsonNode& node, Line& line) {
    line.text = node.text();
    check_line(node);
  }
};
template <typename T>
Line(T&) -> Line<T>;

/// The elements of a list, of which there has to be one.
std::vector<JsonNode> some_of(const JsonNode& node, std::string_view what) {
  return node.elements(1, kMostInList, what);
}

void check_conditions(const JsonNode& node, const KnownConditions& when) {
  const std::pair<std::string_view, std::string_view> lists[] = {{"rules", "rules"},
                                                                 {"samples", "numbers of samples"},
                                                                 {"attribute_kind", "kinds"},
                                                                 {"interpolation", "qualifiers"},
                                                                 {"location", "locations"}};
  for (const auto& [key, what] : lists) {
    if (node.has(key)) some_of(node[key], what);
  }
  if (node.has("samples")) {
    for (const JsonNode& one : node["samples"].elements()) one.integer(1, kMostSamples);
  }
  if (node.has("note")) check_line(node["note"]);
  if (when == KnownConditions()) {
    node.refuse("must have a condition: without one, nothing new of these laws would stand out");
  }
}

void check_entry(const JsonNode& node, const KnownEntry& entry) {
  for (const JsonNode& law : some_of(node["laws"], "laws")) check_line(law);
  some_of(node["verdicts"], "verdicts");
  if (std::ranges::find(entry.verdicts, FragmentClass::correct) != entry.verdicts.end()) {
    node["verdicts"].refuse("no violation is correct");
  }
  const std::filesystem::path path(entry.case_file);
  if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end()) {
    node["case"].refuse("must be a file in the folder of the list");
  }
}

void check_ids(const JsonNode& node, const KnownList& list) {
  std::set<std::string> ids;
  for (std::size_t i = 0; i < list.entries.size(); ++i) {
    if (!ids.insert(list.entries[i].id).second) {
      node["entries"].elements()[i]["id"].refuse("is another entry's, too");
    }
  }
}

}  // namespace

template <typename Archive, cases::Either<KnownConditions> T>
void members(Archive& archive, T& when) {
  archive.optional("rules", when.rules);
  archive.optional("samples", when.samples);
  archive.optional("attribute_kind", when.attribute_kinds);
  archive.optional("interpolation", when.interpolations);
  archive.optional("location", when.locations);
  archive.optional("note", when.note);
  archive.entries(when.facts);
  archive.entries(when.limits);
  archive.check([&](const JsonNode& node) { check_conditions(node, when); });
}

template <typename Archive, cases::Either<KnownEntry> T>
void members(Archive& archive, T& entry) {
  archive.required("id", Line{entry.id});
  archive.required("reason", Line{entry.reason});
  archive.required("rule", Line{entry.rule});
  archive.required("finding", Line{entry.finding});
  archive.required("laws", entry.laws);
  archive.required("verdicts", entry.verdicts);
  archive.required("when", entry.when);
  archive.required("case", Line{entry.case_file});
  archive.check([&](const JsonNode& node) { check_entry(node, entry); });
}

template <typename Archive, cases::Either<KnownList> T>
void members(Archive& archive, T& list) {
  archive.format("rastercheck-known", 1);
  archive.object("driver", [&](auto& driver) {
    driver.required("name", Line{list.driver});
    driver.required("version", Line{list.version});
  });
  archive.required("entries", list.entries);
  archive.check([&](const JsonNode& node) { check_ids(node, list); });
}

template <typename Archive, cases::Either<KnownOfBackend> T>
void members(Archive& archive, T& known) {
  archive.required("backend", known.backend);
  archive.required("driver_version", known.version);
  archive.required("list", known.list);
}

template <typename Archive, cases::Either<UnexpectedPass> T>
void members(Archive& archive, T& pass) {
  archive.required("backend", pass.backend);
  archive.required("id", pass.id);
  archive.required("law", pass.law);
  archive.required("is_same_version", pass.is_same_version);
}

Result<KnownList> parse_known(std::string_view text, const std::string& file) {
  return cases::read_json(text, file, &cases::read_as<KnownList>);
}

void write_value(nlohmann::json& to, const KnownList& list) { cases::write_members(to, list); }
void read_value(const JsonNode& node, KnownList& list) { cases::read_members(node, list); }
void write_value(nlohmann::json& to, const KnownOfBackend& known) {
  cases::write_members(to, known);
}
void read_value(const JsonNode& node, KnownOfBackend& known) { cases::read_members(node, known); }
void write_value(nlohmann::json& to, const UnexpectedPass& pass) { cases::write_members(to, pass); }
void read_value(const JsonNode& node, UnexpectedPass& pass) { cases::read_members(node, pass); }

}  // namespace rastercheck::records
