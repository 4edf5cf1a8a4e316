#include "reports/annotations.h"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>

#include "reports/commands.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

/// A text as workflow commands take it; in a property commas and colons end it as well.
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

std::string error_of(const records::Run& run, const records::Counterexample& counterexample,
                     const std::string& directory) {
  const cases::Found found = counterexample.source.found.value_or(cases::Found());
  const std::string file =
      (std::filesystem::path(directory) / records::file_of(counterexample)).string();
  std::string message;
  if (!counterexample.violations.empty()) {
    message = violation_text(counterexample.violations.front(), counterexample.source) + "\n";
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
    text += command(pass.is_same_version ? "error" : "warning", "unexpected pass",
                    records::unexpected_sentence(pass));
  }
  return text;
}

}  // namespace rastercheck::reports
