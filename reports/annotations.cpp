#include "reports/annotations.h"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>

#include "reports/commands.h"
#include "reports/finding_text.h"
#include "reports/internal/compare_wording.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

/// Escapes a text for a workflow command. In a property of the command, commas and colons are
/// escaped as well.
std::string escaped(std::string_view text, bool is_property) {
  std::string result;
  for (const char c : text) {
    const bool is_special = c == '%' || c == '\r' || c == '\n';
    if (is_special || (is_property && (c == ',' || c == ':'))) {
      result += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result;
}

std::string command(std::string_view level, std::string_view title, std::string_view message) {
  return fmt::format("::{} title={}::{}\n", level, escaped(title, true), escaped(message, false));
}

/// GitHub shows ten annotations per step and drops the rest.
constexpr std::size_t kMostAnnotations = 10;

std::string error_of(const Gate& gate, const records::Comparison& comparison,
                     const records::EntryChange& entry) {
  std::string message;
  for (const records::FigureChange& change : entry.figures)
    message += figure_sentence(change) + "\n";
  for (const records::CaseGrowth& growth : comparison.growths) {
    if (growth.law != entry.key.law) continue;
    message += fmt::format("most in {}", case_text(growth));
    for (const std::string& line : growth_lines(growth)) message += "; " + line;
    for (const std::string& line : growth_commands(gate, comparison, growth))
      message += "\n" + line;
    break;
  }
  return fmt::format("::error file={},line=1,title={}::{}\n", escaped(gate.baseline_file, true),
                     escaped("worse than the baseline of " + to_string(comparison.key), true),
                     escaped(to_string(entry.key) + "\n" + message, false));
}

std::string error_of(const records::Run& run, const records::Counterexample& counterexample,
                     const std::string& directory) {
  const cases::Found found = counterexample.source.found.value_or(cases::Found());
  const std::string file =
      (std::filesystem::path(directory) / records::file_of(counterexample)).string();
  std::string message;
  if (!counterexample.violations.empty()) {
    message = finding_text(counterexample.violations.front(), counterexample.source) + "\n";
  }
  return fmt::format("::error file={},line=1,title={}::{}\n", escaped(file, true),
                     escaped(found.law + " on " + found.backend, true),
                     escaped(message + replay_command(run, file), false));
}

}  // namespace

std::string github_annotations(const records::Run& run, const std::string& directory) {
  std::string text;
  for (const records::Counterexample& counterexample : run.counterexamples) {
    text += error_of(run, counterexample, directory);
  }
  for (const records::UnreachedLabel& label : run.unreached) {
    text += command("error", "label not reached", records::unreached_sentence(label));
  }
  for (const records::UnexpectedPass& pass : run.unexpected) {
    text += command(pass.staleness == records::Staleness::wrong_list ? "error" : "warning",
                    "unexpected pass", records::unexpected_sentence(pass));
  }
  return text;
}

std::string github_annotations(const Gate& gate) {
  std::string text;
  std::size_t shown = 0;
  for (const records::Comparison& comparison : gate.comparisons) {
    for (const records::EntryChange& entry : comparison.entries) {
      const bool is_refused = entry.change == records::Change::worse && !entry.allowed_because;
      if (is_refused && ++shown <= kMostAnnotations) text += error_of(gate, comparison, entry);
    }
  }
  for (const std::string& line : gate.policy.expired) text += command("warning", "expired", line);
  for (const std::string& line : gate.policy.unused) {
    text += command("warning", "allows nothing anymore", line);
  }
  return text;
}

}  // namespace rastercheck::reports
