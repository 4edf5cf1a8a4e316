// summary.md: a run on one page, for a terminal, a pull request or a CI job's summary.

#include <fmt/format.h>

#include <vector>

#include "records/share.h"
#include "records/side_by_side.h"
#include "records/summary.h"
#include "reports/cause_text.h"
#include "reports/commands.h"
#include "reports/finding_text.h"
#include "reports/format.h"
#include "reports/internal/markdown.h"
#include "reports/internal/side_by_side_wording.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports::summary_md_format {
namespace {

using records::Counterexample;
using records::LawSummary;
using records::Run;

std::string verdict_of(const LawSummary& row) {
  if (row.verdict == records::LawVerdict::violated) {
    return fmt::format("**violated** in {}", grouped(row.cases.violations));
  }
  const std::string why = records::why_not_checked(row);
  return markdown(verdict_text(row)) + (why.empty() ? "" : ": " + markdown(why));
}

std::string table_of(const std::vector<LawSummary>& rows) {
  std::string text =
      "| property | backend | cases | fragments | not judged | worst ULP | p99 ULP | after "
      "allowances | "
      "verdict |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|---|\n";
  for (const LawSummary& row : rows) {
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", markdown(row.law),
                        markdown(row.backend), grouped(row.cases.checked),
                        grouped(row.judged.fragments), not_judged_share(row.judged),
                        markdown(number_text(row.ideal.worst)), at_most_text(row.ideal.p99),
                        markdown(number_text(row.excess.worst)), verdict_of(row));
  }
  return text;
}

std::string counts_of(const LawSummary& total) {
  const records::Counts& counts = total.counts;
  return fmt::format(
      "Samples by what is right: required {}, forbidden {}, permitted {}, undecided {}.\n",
      grouped(counts.required), grouped(counts.forbidden), grouped(counts.permitted),
      grouped(counts.undecided));
}

/// The share that each level of the oracle decided, as a paragraph; empty if unknown.
std::string levels_of(const LawSummary& total) {
  const std::string decided = records::decided_sentence(total.levels, total.counts.undecided);
  return decided.empty() ? "" : "\n" + decided + "\n";
}

/// A table for each law and backend that has values.
std::string precision_of(const std::vector<LawSummary>& rows) {
  if (!has_precision(rows)) return "";
  std::string text = fmt::format("\n## Precision by stratum\n\n{}\n", kPrecisionSentence);
  for (const LawSummary& row : rows) {
    if (row.precision.empty()) continue;
    text += fmt::format("\n### {} on {}\n\n| kind | stratum |", markdown(row.law),
                        markdown(row.backend));
    for (const std::string_view column : kPrecisionColumns) text += fmt::format(" {} |", column);
    text += "\n|---|---|";
    for (std::size_t i = 0; i < kPrecisionColumns.size(); ++i) text += "--:|";
    text += "\n";
    for (const records::Precision& precision : row.precision) {
      text += fmt::format("| {} | {} |", to_string(precision.kind), stratum_text(precision));
      for (const std::string& cell : precision_cells(precision)) {
        text += fmt::format(" {} |", markdown(cell));
      }
      text += "\n";
    }
  }
  return text;
}

/// Lists the drivers' known defects, and how often each was seen.
std::string known_of(const Run& run) {
  if (run.known.empty()) return "";
  std::string text =
      "\n## Known defects\n\n| defect | backend | cases | reason | rule |\n|---|---|--:|---|---|\n";
  for (const records::KnownSummary& known : records::known_defects(run)) {
    text += fmt::format("| {} | {} | {} | {} | {} |\n", markdown(known.entry.id),
                        markdown(known.backend),
                        known.is_passed ? "**unexpected pass**" : grouped(known.cases),
                        markdown(known.entry.reason), markdown(known.entry.rule));
  }
  return text;
}

/// The properties on which two backends differ, and how to look at the first case of each.
std::string differences_of(const Run& run, const records::SideBySide& pair) {
  const std::vector<records::SideBySideLaw> laws = differing_laws(pair);
  if (laws.empty()) return pair.counts.cases() == 0 ? "" : "They agree on every property.\n";
  std::string text = "They differ on " + counted(laws.size(), "property", "properties") + ":\n\n";
  for (const records::SideBySideLaw& law : laws) {
    for (const Disagreement& one : disagreements_of(pair, law)) {
      text +=
          fmt::format("- {}: only {} right in {} ({})\n", markdown(one.law), markdown(one.right),
                      counted(one.cases, "case", "cases"), markdown(places_text(run, one)));
      const records::Difference* difference = difference_of(run, one);
      if (difference == nullptr) continue;
      text += "\n";
      for (const std::string& command : look_commands(run, records::file_of(*difference), one)) {
        text += "  " + command_block(command);
      }
      text += "\n";
    }
  }
  return text;
}

/// Shows backends side by side; empty for a run of one backend or a shard.
std::string side_by_side_of(const Run& run) {
  const std::vector<records::SideBySide> pairs = records::side_by_side(run);
  if (pairs.empty()) return "";
  std::string text = fmt::format("\n## Side by side\n\n{}\n", kSideBySideSentence);
  for (const records::SideBySide& pair : pairs) {
    text += fmt::format("\n### {} and {}\n\n{}\n", markdown(pair.first), markdown(pair.second),
                        markdown(compared_sentence(pair)));
    if (pair.counts.cases() > 0) {
      text += "\n| on both | cases |\n|---|--:|\n";
      for (const auto& [term, number] : side_counts(pair)) {
        text += fmt::format("| {} | {} |\n", markdown(term), grouped(number));
      }
    }
    const std::string known = known_sentence(pair);
    if (!known.empty()) text += "\n" + markdown(known) + "\n";
    const std::string differences = differences_of(run, pair);
    if (!differences.empty()) text += "\n" + differences;
    if (pair.errors.empty()) continue;
    text += fmt::format(
        "\nLargest errors after allowances, of all cases of each, in scale ULP:\n\n"
        "| kind of value | {} | {} |\n|---|--:|--:|\n",
        markdown(pair.first), markdown(pair.second));
    for (const records::SideErrors& errors : pair.errors) {
      text +=
          fmt::format("| {} | {} | {} |\n", to_string(errors.kind),
                      markdown(number_text(errors.first)), markdown(number_text(errors.second)));
    }
  }
  return text;
}

std::string counterexample_text(const Run& run, const Counterexample& counterexample) {
  const cases::Found found = counterexample.source.found.value_or(cases::Found());
  std::string text = fmt::format("\n#### {} on {}, case {}\n\n", markdown(found.law),
                                 markdown(found.backend), found.index);
  if (!counterexample.source.name.empty()) {
    text += fmt::format("“{}”. ", markdown(counterexample.source.name));
  }
  text += counted(counterexample.violation_count, "violation", "violations") + "; replay with\n\n" +
          command_block(replay_command(run, records::file_of(counterexample)));
  if (!counterexample.violations.empty()) text += "\n";
  for (const records::Violation& violation : counterexample.violations) {
    text += fmt::format("- {}\n", markdown(finding_text(violation, counterexample.source)));
  }
  if (!counterexample.close_up.empty()) text += "\n";
  for (const std::string& line : counterexample.close_up) text += command_block(line);
  return text;
}

std::string write(const Run& run) {
  const std::vector<LawSummary> rows = records::summarize(run);
  std::string text = fmt::format("# RasterCheck\n\n**{}**\n\n", headline(run, rows));
  for (const std::string& caveat : records::caveats(run)) text += markdown(caveat) + "\n\n";
  text += table_of(rows);
  if (!run.unreached.empty() || !run.unexpected.empty() || !run.scenes.empty()) text += "\n";
  for (const records::UnreachedLabel& label : run.unreached) {
    text += fmt::format("- {}\n", markdown(records::unreached_sentence(label)));
  }
  if (const std::string thin = records::thin_sentence(rows); !thin.empty()) {
    text += fmt::format("\n{}.\n", thin);
  }
  for (const records::UnexpectedPass& pass : run.unexpected) {
    text += fmt::format("- {}\n", markdown(records::unexpected_sentence(pass)));
  }
  for (const records::SceneResult& scene : run.scenes) {
    text += fmt::format("- {}\n", markdown(records::scene_sentence(scene)));
  }
  text += fmt::format("\n{}\n\n{}\n\n", kUnitSentence, kExcessSentence);
  text += counts_of(totals(rows)) + levels_of(totals(rows));
  text += side_by_side_of(run);
  text += "\n## Do it again\n\n" + command_block(run_command(run));
  if (!run.counterexamples.empty())
    text += "\n## Counterexamples\n\nCommands are for the folder that this file is in.\n";
  for (std::size_t i = 0; i < run.causes.size(); ++i) {
    const records::Cause& cause = run.causes[i];
    text += fmt::format("\n### Cause {}: {}\n\n", i + 1, markdown(cause_line(run, cause)));
    if (cause.hint) text += fmt::format("Hint: {}.\n\n", markdown(hint_text(cause)));
    for (const std::string& tried : cause.tried) text += fmt::format("- It {}.\n", markdown(tried));
    for (const std::uint64_t place : cause.counterexamples) {
      text += counterexample_text(run, run.counterexamples[static_cast<std::size_t>(place)]);
    }
  }
  for (const std::size_t i : without_cause(run)) {
    text += counterexample_text(run, run.counterexamples[i]);
  }
  text += known_of(run) + precision_of(rows) + "\n## Environment\n\n";
  for (const auto& [name, value] : run.environment) {
    text += fmt::format("- {}: {}\n", markdown(name), markdown(value));
  }
  return text;
}

const FormatRegistration kRegistration({"markdown", "summary.md", &write});

}  // namespace
}  // namespace rastercheck::reports::summary_md_format
