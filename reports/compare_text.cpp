#include "reports/compare_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "cases/json.h"
#include "reports/internal/compare_wording.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

constexpr std::size_t kMostEntries = 10;
constexpr std::size_t kMostGrowths = 5;
constexpr std::size_t kMostStages = 3;

/// "… and 12 more" if there are more than are shown; otherwise empty.
std::string more_text(std::uint64_t all, std::uint64_t shown, const Gate& gate) {
  if (all <= shown) return "";
  return fmt::format("  … and {} more{}\n", grouped(all - shown),
                     gate.folder.empty() ? "" : ", in " + gate.folder + "/compare.json");
}

std::vector<const records::EntryChange*> entries_with(const records::Comparison& comparison,
                                                      records::Change change, bool is_allowed) {
  std::vector<const records::EntryChange*> entries;
  for (const records::EntryChange& entry : comparison.entries) {
    if (entry.change == change && entry.allowed_because.has_value() == is_allowed) {
      entries.push_back(&entry);
    }
  }
  return entries;
}

std::string entries_text(const Gate& gate, const std::vector<const records::EntryChange*>& entries,
                         std::string_view title) {
  if (entries.empty()) return "";
  std::string text = fmt::format("\n{}\n", title);
  for (std::size_t i = 0; i < std::min(entries.size(), kMostEntries); ++i) {
    text += fmt::format("  {}\n", cases::one_line(to_string(entries[i]->key)));
    for (const records::FigureChange& change : entries[i]->figures) {
      text += fmt::format("    {}\n", figure_sentence(change));
    }
    if (entries[i]->allowed_because) {
      text += fmt::format("    allowed: {}\n", cases::printable(*entries[i]->allowed_because));
    }
  }
  return text + more_text(entries.size(), kMostEntries, gate);
}

std::string growths_text(const Gate& gate, const records::Comparison& comparison) {
  if (comparison.growths.empty()) return "";
  std::string text = "\nCases whose errors grew most:\n";
  const std::size_t shown = std::min(comparison.growths.size(), kMostGrowths);
  for (std::size_t i = 0; i < shown; ++i) {
    const records::CaseGrowth& growth = comparison.growths[i];
    text += fmt::format("  {}:\n    {}\n", cases::one_line(growth.law), case_text(growth));
    for (const std::string& line : growth_lines(growth)) text += fmt::format("    {}\n", line);
    if (const auto part = part_to_look_at(gate, comparison, growth)) {
      text += fmt::format("    stage to look at: {}, {} ULP of the error\n", to_string(part->stage),
                          mean_text(part->error));
    }
    for (const std::string& command : growth_commands(gate, comparison, growth)) {
      text += fmt::format("    {}\n", cases::one_line(command));
    }
  }
  text += more_text(comparison.grown_cases, shown, gate);
  if (gate.folder.empty()) text += "  --output DIR saves them as case files for replay.\n";
  return text;
}

std::string stages_text(const records::Comparison& comparison) {
  const std::vector<std::string> lines = stage_lines(comparison, kMostStages);
  if (lines.empty()) return "";
  std::string text = "\nStages whose part of the errors grew most:\n";
  for (const std::string& line : lines) text += fmt::format("  {}\n", line);
  return text;
}

std::string laws_text(const records::Comparison& comparison) {
  std::string text;
  for (const std::string& law : comparison.new_laws) {
    text += fmt::format("New, so not compared: {}\n", cases::one_line(law));
  }
  for (const std::string& law : comparison.gone_laws) {
    text += fmt::format("Gone: {}\n", cases::one_line(law));
  }
  return text.empty() ? "" : "\n" + text;
}

std::string policy_text(const records::PolicyReview& review) {
  std::string text;
  for (const std::string& line : review.expired) {
    text += fmt::format("Expired: {}\n", cases::one_line(line));
  }
  for (const std::string& line : review.unused) {
    text += fmt::format("Unused, so it can be removed: {}\n", cases::one_line(line));
  }
  return text.empty() ? "" : "\n" + text;
}

std::string text_of(const Gate& gate, const records::Comparison& comparison, bool quiet) {
  std::string text = cases::one_line(verdict_sentence(comparison)) + "\n";
  if (!quiet) text += bits_sentence(comparison) + "\n";
  text += entries_text(gate, entries_with(comparison, records::Change::worse, false), "Worse:");
  if (quiet) return text;
  text += entries_text(gate, entries_with(comparison, records::Change::worse, true),
                       "Worse, but allowed:");
  if (count_of(comparison, records::Change::worse) > 0) {
    text += growths_text(gate, comparison) + stages_text(comparison);
  }
  text += entries_text(gate, entries_with(comparison, records::Change::better, false), "Better:");
  return text + laws_text(comparison);
}

/// Advice on what to do about the changes.
std::string advice_text(const Gate& gate) {
  const auto some = [&gate](records::Change change) {
    return std::any_of(gate.comparisons.begin(), gate.comparisons.end(),
                       [change](const records::Comparison& comparison) {
                         return count_of(comparison, change) > 0;
                       });
  };
  const bool is_worse = some(records::Change::worse);
  if (!is_worse && !some(records::Change::better) && !some(records::Change::appeared) &&
      !some(records::Change::gone)) {
    return "";
  }
  return fmt::format("\n{}:\n  {}\n",
                     is_worse ? "If this change is intended, accept the new numbers"
                              : "To hold later runs to the new numbers, accept them",
                     cases::one_line(approve_command(gate)));
}

}  // namespace

std::string comparison_text(const Gate& gate, bool quiet) {
  std::string text;
  for (const records::Comparison& comparison : gate.comparisons) {
    text += (text.empty() ? "" : "\n") + text_of(gate, comparison, quiet);
  }
  text += policy_text(gate.policy);
  return quiet ? text : text + advice_text(gate);
}

std::vector<std::string> change_lines(const std::vector<records::EntryChange>& entries) {
  std::vector<std::string> lines;
  for (const records::EntryChange& entry : entries) {
    if (entry.change == records::Change::appeared || entry.change == records::Change::gone) {
      lines.push_back(fmt::format("{}: {}", to_string(entry.key), to_string(entry.change)));
    }
    for (const records::FigureChange& change : entry.figures) {
      lines.push_back(fmt::format("{}: {}", to_string(entry.key), figure_sentence(change)));
    }
  }
  return lines;
}

}  // namespace rastercheck::reports
