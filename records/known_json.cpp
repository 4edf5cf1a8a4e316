#include "records/known_json.h"

#include <algorithm>
#include <charconv>
#include <chrono>
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

/// A text of one line, which must not be empty.
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

/// The elements of a list, which must not be empty.
std::vector<JsonNode> some_of(const JsonNode& node, std::string_view what) {
  return node.elements(1, kMostInList, what);
}

void check_conditions(const JsonNode& node, const KnownConditions& when) {
  const std::pair<std::string_view, std::string_view> lists[] = {{"rules", "rules"},
                                                                 {"primitive", "primitives"},
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
    node.refuse(
        "must have a condition: without one it would hide every new fault that these properties "
        "find");
  }
}

bool is_day(std::string_view text) {
  constexpr std::string_view kForm = "0000-00-00";
  if (text.size() != kForm.size() || text[4] != '-' || text[7] != '-') return false;
  const auto number = [text](std::size_t first, std::size_t count) -> std::optional<int> {
    int value = 0;
    const char* const end = text.data() + first + count;
    const auto read = std::from_chars(text.data() + first, end, value);
    const bool is_read = read.ptr == end && read.ec == std::errc() && value >= 0;
    return is_read ? std::optional(value) : std::nullopt;
  };
  const auto year = number(0, 4);
  const auto month = number(5, 2);
  const auto day = number(8, 2);
  if (!year || !month || !day) return false;
  return std::chrono::year_month_day(std::chrono::year(*year),
                                     std::chrono::month(static_cast<unsigned>(*month)),
                                     std::chrono::day(static_cast<unsigned>(*day)))
      .ok();
}

/// Checks an entry of an expectation list, as run.json contains it.
void check_expectation(const JsonNode& node, const KnownEntry& entry) {
  if (entry.laws.empty()) node.refuse("must name a property");
  const bool has_more =
      !entry.verdicts.empty() || !(entry.when == KnownConditions()) || !entry.case_file.empty();
  if (has_more)
    node.refuse(
        "is an expectation of whole properties, which must have no verdict, condition or case");
}

void check_entry(const JsonNode& node, const KnownEntry& entry) {
  for (const char* const key : {"properties", "backends"}) {
    if (!node.has(key)) continue;
    for (const JsonNode& one : some_of(node[key], key)) check_line(one);
  }
  if (node.has("until") && !is_day(entry.until)) {
    node["until"].refuse("must be a date such as \"2027-01-31\"");
  }
  for (const char* const key : {"rule", "finding", "case"}) {
    if (node.has(key)) check_line(node[key]);
  }
  if (entry.expected) return check_expectation(node, entry);
  for (const char* const key : {"verdicts", "when", "case"}) {
    if (!node.has(key)) node.refuse(std::string("lacks \"") + key + "\"");
  }
  some_of(node["verdicts"], "verdicts");
  if (std::ranges::find(entry.verdicts, FragmentClass::correct) != entry.verdicts.end()) {
    node["verdicts"].refuse("must not contain \"correct\"");
  }
  const std::filesystem::path path(entry.case_file);
  if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end()) {
    node["case"].refuse("must be a file in the folder of the list");
  }
}

void check_entries(const JsonNode& node, const KnownList& list) {
  std::set<std::string> ids;
  for (std::size_t i = 0; i < list.entries.size(); ++i) {
    const JsonNode entry = node["entries"].elements()[i];
    if (!ids.insert(list.entries[i].id).second)
      entry["id"].refuse("is also the id of another entry");
    if (!list.driver) continue;
    // A driver's list must say more, because people who have not seen its defects read it.
    for (const char* const key : {"rule", "finding", "properties"}) {
      if (!entry.has(key)) entry.refuse(std::string("lacks \"") + key + "\"");
    }
  }
}

}  // namespace

template <typename Archive, cases::Either<KnownConditions> T>
void members(Archive& archive, T& when) {
  archive.optional("rules", when.rules);
  archive.optional("primitive", when.primitives);
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
  archive.optional("rule", entry.rule);
  archive.optional("finding", entry.finding);
  archive.optional("backends", entry.backends);
  archive.optional("properties", entry.laws);
  archive.optional("verdicts", entry.verdicts);
  archive.optional("when", entry.when);
  archive.optional("case", entry.case_file);
  archive.optional("until", entry.until);
  archive.optional("expected", entry.expected);
  archive.check([&](const JsonNode& node) { check_entry(node, entry); });
}

template <typename Archive, cases::Either<KnownList> T>
void members(Archive& archive, T& list) {
  archive.format("rastercheck-known", 1);
  archive.optional_object("driver", list.driver, [](auto& inner, auto& driver) {
    inner.required("name", Line{driver.name});
    inner.required("version", Line{driver.version});
  });
  archive.required("entries", list.entries);
  archive.check([&](const JsonNode& node) { check_entries(node, list); });
}

template <typename Archive, cases::Either<KnownOfBackend> T>
void members(Archive& archive, T& known) {
  archive.required("backend", known.backend);
  archive.required("file", known.file);
  archive.optional("driver_version", known.version);
  archive.required("list", known.list);
  archive.optional("run_out", known.run_out);
}

template <typename Archive, cases::Either<UnexpectedPass> T>
void members(Archive& archive, T& pass) {
  archive.required("backend", pass.backend);
  archive.required("id", pass.id);
  archive.required("property", pass.law);
  archive.required("staleness", pass.staleness);
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
