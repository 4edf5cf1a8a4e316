#include "reports/bisect_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cases/float_text.h"
#include "cases/json.h"
#include "records/enclosure_json.h"
#include "reports/compare_format.h"
#include "reports/compare_text.h"
#include "reports/internal/compare_wording.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

constexpr std::size_t kShownHash = 10;
/// Maximum number of worse figures shown; the JSON has all of them.
constexpr std::size_t kMostLines = 5;
constexpr std::size_t kMostStagesOfCommit = 1;

std::string title_text(const records::CommitTitle& commit) {
  return fmt::format("{} {} {} ({})", commit.hash.substr(0, kShownHash), commit.date,
                     cases::one_line(commit.subject), cases::one_line(commit.author));
}

std::string growth_text(const records::Comparison& comparison, const std::string& folder) {
  const records::CaseGrowth& growth = comparison.growths.front();
  std::string text = fmt::format("  most in: {}, {}\n", growth.law, case_text(growth));
  for (const std::string& line : growth_lines(growth)) text += fmt::format("    {}\n", line);
  Gate gate;
  gate.folder = folder;
  for (const std::string& command : growth_commands(gate, comparison, growth)) {
    text += fmt::format("    {}\n", command);
  }
  return text;
}

/// The worse entries, the stages that made them worse, and the case that grew most.
std::string comparison_lines(const records::Comparison& comparison, const std::string& folder) {
  const std::uint64_t worse = refused(comparison);
  if (worse == 0) return "";
  std::string text = fmt::format("  {}: {}\n", comparison.backend, worse_text(worse));
  std::vector<records::EntryChange> entries;
  for (const records::EntryChange& entry : comparison.entries) {
    if (entry.change == records::Change::worse) entries.push_back(entry);
  }
  const std::vector<std::string> lines = change_lines(entries);
  for (std::size_t i = 0; i < std::min(lines.size(), kMostLines); ++i) {
    text += fmt::format("    {}\n", lines[i]);
  }
  if (lines.size() > kMostLines)
    text += fmt::format("    … and {} more\n", lines.size() - kMostLines);
  for (const std::string& line : stage_lines(comparison, kMostStagesOfCommit)) {
    text += fmt::format("  stage: {}\n", line);
  }
  if (!comparison.growths.empty()) text += growth_text(comparison, folder);
  return text;
}

std::string first_lines(const records::BisectOutcome& outcome) {
  std::string text;
  for (const records::Comparison& comparison : outcome.of_first) {
    text += comparison_lines(comparison, outcome.comparison);
  }
  return text;
}

nlohmann::ordered_json to_json(const records::CommitTitle& commit) {
  return {{"commit", commit.hash},
          {"date", commit.date},
          {"author", commit.author},
          {"subject", commit.subject}};
}

nlohmann::ordered_json to_json(const std::optional<records::WorstError>& worst) {
  if (!worst) return nullptr;
  return {{"error", cases::json_of(worst->error)},
          {"exact", worst->exact},
          {"actual", cases::to_hex(worst->actual)},
          {"triangle", worst->place.triangle},
          {"x", worst->place.x},
          {"y", worst->place.y},
          {"sample", worst->place.sample}};
}

nlohmann::ordered_json to_json(const records::Comparison& comparison) {
  nlohmann::ordered_json entries = nlohmann::ordered_json::array();
  for (const records::EntryChange& entry : comparison.entries) {
    if (entry.change == records::Change::worse) entries.push_back(to_string(entry.key));
  }
  nlohmann::ordered_json json{
      {"backend", comparison.backend}, {"worse", entries}, {"case", nullptr}};
  if (comparison.growths.empty()) return json;
  const records::CaseGrowth& growth = comparison.growths.front();
  json["case"] = {{"property", growth.law},
                  {"origin", records::to_string(growth.origin)},
                  {"index", growth.index},
                  {"name", growth.name},
                  {"mismatches_before", growth.mismatches_before},
                  {"mismatches_after", growth.mismatches_after},
                  {"before", to_json(growth.before)},
                  {"after", to_json(growth.after)}};
  return json;
}

template <typename Element>
nlohmann::ordered_json to_json(const std::vector<Element>& all) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (const Element& one : all) array.push_back(to_json(one));
  return array;
}

/// "Judged 5 of 10 commits, skipped 1."
std::string count_text(const records::BisectOutcome& outcome) {
  return fmt::format("Judged {} of {}{}.\n", outcome.tried,
                     counted(outcome.commits + 1, "commit", "commits"),
                     outcome.skipped == 0 ? "" : fmt::format(", skipped {}", outcome.skipped));
}

}  // namespace

std::string worse_text(std::uint64_t entries) {
  return counted(entries, "entry is", "entries are") + " worse";
}

std::string bisect_text(const records::BisectOutcome& outcome) {
  if (outcome.first.empty()) {
    return fmt::format("Not worse: {}\n     than: {}\n", title_text(outcome.bad),
                       title_text(outcome.good));
  }
  if (outcome.first.size() > 1) {
    std::string text = "First worse is one of these; those between could not be judged:\n";
    for (const records::CommitTitle& commit : outcome.first)
      text += "  " + title_text(commit) + "\n";
    return text + count_text(outcome);
  }
  const records::CommitTitle& first = outcome.first.front();
  std::string text = "First worse: " + title_text(first) + "\n" + first_lines(outcome);
  const std::uint64_t here = refused(outcome.of_first);
  const std::uint64_t later = refused(outcome.of_bad);
  if (here < later) {
    text +=
        fmt::format("  Of the {} entries that are worse in the end, these are {}.\n", later, here);
  }
  return text + count_text(outcome) +
         (outcome.comparison.empty() ? "" : fmt::format("Comparison: {}\n", outcome.comparison)) +
         fmt::format("See: git show {}\n", first.hash.substr(0, kShownHash));
}

std::string bisect_json(const records::BisectOutcome& outcome) {
  const nlohmann::ordered_json json{{"good", to_json(outcome.good)},
                                    {"bad", to_json(outcome.bad)},
                                    {"first", to_json(outcome.first)},
                                    {"worse", to_json(outcome.of_first)},
                                    {"worse_in_the_end", to_json(outcome.of_bad)},
                                    {"commits", outcome.commits + 1},
                                    {"judged", outcome.tried},
                                    {"skipped", outcome.skipped}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace rastercheck::reports
