// bug: a report in Markdown, ready to be pasted into the tracker of whoever wrote the rasterizer:
// the symptom, the numbers that are drawn, what is right and by which rule, and how to see it
// again.

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "cases/case_writer.h"
#include "cases/json.h"
#include "reports/counterexample_text.h"
#include "reports/exporter.h"
#include "reports/finding_text.h"
#include "reports/inspection_text.h"
#include "reports/internal/sample_tests.h"

namespace rastercheck::reports::bug_exporter {
namespace {

/// A text in a fenced block, with more backticks than the text has in a row.
std::string block(std::string_view text, std::string_view language = "") {
  std::string fence = "```";
  while (text.find(fence) != std::string_view::npos) fence += '`';
  return fmt::format("{0}{1}\n{2}{3}{0}\n", fence, language, text,
                     text.ends_with('\n') ? "" : "\n");
}

/// A text within a paragraph: one line, without anything that Markdown takes for markup.
std::string inline_text(std::string_view text) {
  std::string escaped;
  for (const char c : cases::one_line(text)) {
    if (std::string_view("\\`*_[]<>#|").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// The case in words: state, vertices and triangles, where everybody can retype them.
std::string case_section(const records::Exhibit& exhibit) {
  return "## The case\n\n" + block(case_text(exhibit.source)) +
         "\nNumbers are float32, as C writes them in hexadecimal where decimals are not exact; "
         "positions are clip positions.\n";
}

std::string numbers_section(const records::Exhibit& exhibit) {
  std::string text = "## What is drawn\n\n";
  if (!exhibit.pixels.empty()) {
    text += block(fmt::format("{}", fmt::join(exhibit.pixels, "\n"))) + "\n";
  }
  text += block(violations_text(exhibit.violations, exhibit.violation_count, std::nullopt));
  text +=
      "\n`exact` is a fraction without rounding; a range holds whatever the rules leave open. "
      "Errors and bounds are in units in the last place of the largest of the triangle's three "
      "values.\n";
  if (!exhibit.inspection) return text;
  return text + "\n<details><summary>One sample in full</summary>\n\n" +
         block(inspection_text(*exhibit.inspection)) + "\n" + block(inspection_legend()) +
         "\n</details>\n";
}

std::string rules_section(const records::Exhibit& exhibit) {
  std::string text =
      fmt::format("## Why it is wrong\n\nWhat must hold: {}.\n", inline_text(exhibit.sentence));
  text += fmt::format("\nRule: {}\n",
                      inline_text(fmt::format("{}", fmt::join(rules_of(exhibit), "; "))));
  for (const std::string& known : exhibit.known) {
    text += fmt::format("\nKnown: {}\n", inline_text(known));
  }
  return text;
}

std::string again_section(const records::Exhibit& exhibit) {
  return "## To see it again\n\nWithout RasterCheck: draw the case above, and read back the pixel. "
         "With RasterCheck, save this as `case.json`:\n\n" +
         block(cases::to_json(exhibit.source), "json") + "\nand run\n\n" +
         block(cases::one_line(exhibit.replay));
}

Result<std::string> write(const records::Exhibit& exhibit) {
  if (exhibit.violations.empty()) {
    return tl::unexpected(Error{exhibit.file, "",
                                fmt::format("nothing is wrong with it: “{}” holds on {}",
                                            exhibit.sentence, exhibit.backend)});
  }
  const records::Violation& first = exhibit.violations.front();
  std::string symptom = finding_text(first, exhibit.source);
  if (symptom.starts_with("pixel")) symptom.front() = 'P';
  return fmt::format("# {}: {}\n\n{}.\n\nDrawn by {}{}{}\nFound with {}.\n\n{}\n{}\n{}\n{}",
                     inline_text(exhibit.backend),
                     inline_text(finding_fault(first, exhibit.source)), inline_text(symptom),
                     inline_text(exhibit.backend), exhibit.description.empty() ? "." : ": ",
                     inline_text(exhibit.description), exhibit.found_with, case_section(exhibit),
                     numbers_section(exhibit), rules_section(exhibit), again_section(exhibit));
}

const ExporterRegistration kRegistration({"bug", "a report in Markdown, to be pasted", &write});

}  // namespace
}  // namespace rastercheck::reports::bug_exporter
