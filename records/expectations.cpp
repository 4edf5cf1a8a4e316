#include "records/expectations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "records/summary.h"

namespace rastercheck::records {
namespace {

constexpr std::array<std::pair<Expected, std::string_view>, 3> kEndings{
    {{Expected::fail, "-fails.txt"},
     {Expected::flake, "-flakes.txt"},
     {Expected::skip, "-skips.txt"}}};

const char* reason_of(Expected expected) {
  switch (expected) {
    case Expected::fail:
      return "Expected to fail.";
    case Expected::flake:
      return "Expected to fail sometimes.";
    case Expected::skip:
      break;
  }
  return "Expected not to be checked.";
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const std::size_t first = std::min(text.find_first_not_of(kSpace), text.size());
  text.remove_prefix(first);
  return text.substr(0, text.find_last_not_of(kSpace) + 1);
}

/// The name in a line, without comment and status; empty if the line has no name. A backend's name
/// may contain commas and slashes; a law's name contains neither.
std::string_view name_in(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with('#')) return "";
  line = trimmed(line.substr(0, line.find(" #")));
  const std::size_t slash = line.rfind('/');
  return trimmed(line.substr(0, line.find(',', slash == std::string_view::npos ? 0 : slash)));
}

/// Turns a name into a pattern that matches only this name.
std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c == '*' || c == '?' || c == '[' || c == '\\') text += '\\';
    text += c;
  }
  return text;
}

KnownEntry entry_of(std::string_view name, Expected expected) {
  KnownEntry entry;
  entry.id = name;
  entry.reason = reason_of(expected);
  const std::size_t slash = name.rfind('/');
  if (slash != std::string_view::npos) {
    entry.backends = {std::string(name.substr(0, slash))};
    name.remove_prefix(slash + 1);
  }
  entry.laws = {std::string(name)};
  entry.expected = expected;
  return entry;
}

/// The results of a law on a backend in several runs.
struct Outcomes {
  std::size_t violated = 0;
  std::size_t checked = 0;
};

/// True if the law was violated, in known ways or others.
bool is_violated(const LawSummary& row) {
  return row.verdict == LawVerdict::violated || row.cases.known > 0;
}

}  // namespace

std::optional<Expected> expected_by(std::string_view file) {
  for (const auto& [expected, ending] : kEndings) {
    if (file.ends_with(ending)) return expected;
  }
  return std::nullopt;
}

Result<KnownList> parse_expectations(std::string_view text, Expected expected,
                                     const std::string& file) {
  KnownList list;
  std::set<std::string_view> names;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view name = name_in(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (name.empty()) continue;
    if (!names.insert(name).second) {
      return tl::unexpected(
          Error{file, fmt::format("line {}", number), "repeats the name of another line"});
    }
    list.entries.push_back(entry_of(name, expected));
  }
  return list;
}

ExpectationTexts expectations_of(const std::vector<Run>& runs) {
  std::map<std::pair<std::string, std::string>, Outcomes> outcomes;
  std::set<std::string> backends;
  for (const Run& run : runs) {
    for (const LawSummary& row : summarize(run)) {
      backends.insert(row.backend);
      Outcomes& outcome = outcomes[{row.backend, row.law}];
      if (row.cases.checked > 0) ++outcome.checked;
      if (is_violated(row)) ++outcome.violated;
    }
  }
  const auto line_of = [&backends](const std::string& backend, const std::string& law) {
    return backends.size() > 1 ? fmt::format("{}/{}\n", escaped(backend), law) : law + "\n";
  };
  ExpectationTexts texts;
  for (const auto& [key, outcome] : outcomes) {
    if (outcome.violated == 0) continue;
    std::string& text = outcome.violated == outcome.checked ? texts.fails : texts.flakes;
    text += line_of(key.first, key.second);
  }
  std::set<std::string> skips;
  for (const Run& run : runs) {
    for (const SkippedLaw& skipped : skipped_laws(run)) {
      skips.insert(line_of(skipped.backend, skipped.law));
    }
  }
  for (const std::string& line : skips) texts.skips += line;
  return texts;
}

}  // namespace rastercheck::records
