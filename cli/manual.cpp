#include "cli/manual.h"

#include <fmt/format.h>

#include <string_view>

#include "cli/command_tree.h"

namespace rastercheck::cli {
namespace {

/// Returns plain text as roff: escapes every character that begins a request or an escape.
std::string escaped(std::string_view text) {
  std::string roff;
  if (text.starts_with('.') || text.starts_with('\'')) roff = "\\&";
  for (const char c : text) {
    if (c == '\\') {
      roff += "\\e";
    } else if (c == '-') {
      roff += "\\-";  // not a hyphen, so that options can be copied
    } else {
      roff += c;
    }
  }
  return roff;
}

std::string entry(const OptionText& text) {
  std::string head = "\\fB" + escaped(text.names) + "\\fR";
  if (!text.value.empty()) head += " \\fI" + escaped(text.value) + "\\fR";
  return ".TP\n" + head + "\n" + escaped(text.description) + "\n";
}

/// Returns a footer as paragraphs; lines that begin with a space stay as they are.
std::string paragraphs(const std::string& footer) {
  std::string roff;
  bool is_example = false;
  const auto set_example = [&](bool on) {
    if (on != is_example) roff += on ? ".PP\n.nf\n" : ".fi\n";
    is_example = on;
  };
  for (const std::string& line : CLI::detail::split(footer, '\n')) {
    if (line.empty()) continue;
    set_example(line.starts_with(' '));
    roff += (is_example ? "" : ".PP\n") + escaped(line) + "\n";
  }
  set_example(false);
  return roff;
}

std::string section(const CLI::App& command) {
  std::string roff = ".SS \"" + escaped(full_name(command)) + "\"\n";
  roff +=
      escaped(command.get_description()) + ".\n.PP\n\\fB" + escaped(usage_of(command)) + "\\fR\n";
  for (const CLI::Option* argument : arguments_of(command)) roff += entry(text_of(*argument));
  for (const CLI::Option* option : options_of(command)) roff += entry(text_of(*option));
  roff += paragraphs(command.get_footer());
  for (const CLI::App* inner : shown_commands(command)) roff += section(*inner);
  return roff;
}

constexpr std::string_view kManualEnd = R"(.SH "EXIT STATUS"
.TP
0
All properties held, or were violated only in known ways.
.TP
1
A property was violated.
.TP
2
Wrong usage or unreadable input; one line names the file, the place and the reason.
.TP
3
Worse than the baseline.
.TP
4
A requested backend cannot run here.
.TP
5
Nothing was checked, or too little of what a property claims to test.
.TP
70
Internal error, for example if the oracle contradicts itself.
.TP
130
Interrupted before anything was violated.
.SH FILES
.TP
rastercheck\-out
Results of a run: report.html, run.json, summary.md, junit.xml, and a case file for each counterexample.
.SH ENVIRONMENT
.TP
CI
If set, no progress bar is shown.
.TP
GITHUB_ACTIONS, GITHUB_STEP_SUMMARY
In a job of GitHub Actions, a run appends its summary to the job's summary and annotates what failed.
.TP
VK_DRIVER_FILES, __EGL_VENDOR_LIBRARY_FILENAMES
Drivers for the Vulkan loader and EGL to load.
)";

}  // namespace

std::string manual_page(const CLI::App& program) {
  std::string roff =
      ".TH RASTERCHECK 1 \"\" \"rastercheck " RASTERCHECK_VERSION "\" \"User Commands\"\n";
  roff += ".SH NAME\nrastercheck \\- check rasterizers against exact rational arithmetic\n";
  roff += ".SH SYNOPSIS\n\\fBrastercheck\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n";
  roff += ".SH DESCRIPTION\n" + escaped(program.get_description()) + ".\n" +
          paragraphs(program.get_footer());
  roff += ".SH OPTIONS\n";
  for (const CLI::Option* option : options_of(program)) roff += entry(text_of(*option));
  roff += ".SH COMMANDS\n";
  for (const CLI::App* command : shown_commands(program)) roff += section(*command);
  return roff + std::string(kManualEnd);
}

}  // namespace rastercheck::cli
