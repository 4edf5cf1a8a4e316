// compare.md: the findings of a comparison on one page, for a pull request or a CI job's summary.

#include <fmt/format.h>

#include "reports/compare_format.h"
#include "reports/internal/compare_wording.h"
#include "reports/internal/markdown.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports::compare_md_format {
namespace {

constexpr std::size_t kMostEntries = 50;
constexpr std::size_t kMostStages = 5;

/// All changed figures, better or worse, of the first kMostEntries entries that changed in this
/// way.
std::string table_of(const records::Comparison& comparison, records::Change change) {
  if (count_of(comparison, change) == 0) return "";
  std::string text = fmt::format(
      "\n## {}\n\n| property | kind | stratum | figure | baseline | now | allowed |\n"
      "|---|---|---|---|--:|--:|---|\n",
      change == records::Change::worse ? "Worse" : "Better");
  std::size_t entries = 0;
  for (const records::EntryChange& entry : comparison.entries) {
    if (entry.change != change) continue;
    if (++entries > kMostEntries) continue;
    for (const records::FigureChange& figure : entry.figures) {
      const OldAndNew texts = figure_texts(figure);
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", markdown(entry.key.law),
                          to_string(entry.key.kind),
                          entry.key.stratum ? to_string(*entry.key.stratum) : "all",
                          figure_name(figure), markdown(texts.before), markdown(texts.after),
                          markdown(entry.allowed_because.value_or("")));
    }
  }
  if (entries > kMostEntries) text += fmt::format("\n… and {} more.\n", entries - kMostEntries);
  return text;
}

std::string growths_of(const Gate& gate, const records::Comparison& comparison) {
  if (comparison.growths.empty()) return "";
  std::string text = fmt::format("\n## Cases whose errors grew most\n\n{} of {}.\n",
                                 comparison.growths.size(), comparison.grown_cases);
  for (const records::CaseGrowth& growth : comparison.growths) {
    text += fmt::format("\n- {}: {}\n", markdown(growth.law), markdown(case_text(growth)));
    for (const std::string& line : growth_lines(growth)) {
      text += fmt::format("  - {}\n", markdown(line));
    }
    const std::vector<std::string> commands = growth_commands(gate, comparison, growth);
    if (!commands.empty()) text += "\n";
    for (const std::string& command : commands) text += "    " + command_block(command);
  }
  return text;
}

std::string stages_of(const records::Comparison& comparison) {
  const std::vector<std::string> lines = stage_lines(comparison, kMostStages);
  if (lines.empty()) return "";
  std::string text = "\n## Stages whose part of the errors grew most\n\n";
  for (const std::string& line : lines) text += fmt::format("- {}\n", markdown(line));
  return text;
}

std::string laws_of(const records::Comparison& comparison) {
  std::string text;
  for (const std::string& law : comparison.new_laws) {
    text += fmt::format("- new, so not compared: {}\n", markdown(law));
  }
  for (const std::string& law : comparison.gone_laws) {
    text += fmt::format("- gone: {}\n", markdown(law));
  }
  return text.empty() ? "" : "\n## Properties\n\n" + text;
}

std::string policy_of(const records::PolicyReview& review) {
  std::string text;
  for (const std::string& line : review.expired) {
    text += fmt::format("- expired: {}\n", markdown(line));
  }
  for (const std::string& line : review.unused) {
    text += fmt::format("- unused, so it can be removed: {}\n", markdown(line));
  }
  return text.empty() ? "" : "\n## Policy\n\n" + text;
}

std::string taken_text(const records::Taken& taken) {
  return fmt::format("{} {}, {}, {}{}", taken.backend, taken.version, taken.compiler,
                     taken.instruction_set, taken.commit.empty() ? "" : ", commit " + taken.commit);
}

std::string write(const Gate& gate) {
  std::string text = "# RasterCheck: comparison with the baseline\n";
  for (const records::Comparison& comparison : gate.comparisons) {
    text += fmt::format("\n**{}**\n\n{}\n\n", markdown(verdict_sentence(comparison)),
                        markdown(bits_sentence(comparison)));
    text += fmt::format("- baseline: {}\n- now: {}\n", markdown(taken_text(comparison.before)),
                        markdown(taken_text(comparison.after)));
    text += table_of(comparison, records::Change::worse) + growths_of(gate, comparison) +
            stages_of(comparison) + table_of(comparison, records::Change::better) +
            laws_of(comparison);
  }
  text += policy_of(gate.policy);
  return text + "\n## To accept the new numbers\n\n" + command_block(approve_command(gate));
}

const CompareFormatRegistration kRegistration({"markdown", "compare.md", &write});

}  // namespace
}  // namespace rastercheck::reports::compare_md_format
