#include "reports/side_by_side_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "cases/json.h"
#include "records/side_by_side.h"
#include "reports/internal/side_by_side_wording.h"
#include "reports/internal/wording.h"
#include "reports/wrapped_text.h"

namespace rastercheck::reports {
namespace {

using records::SideBySide;
using records::SideBySideLaw;

/// The maximum number of properties that a terminal shows for a pair of backends. The report has
/// all.
constexpr std::size_t kMostPropertiesShown = 3;

/// The counts, one on each line.
std::string counts_text(const SideBySide& pair) {
  const auto counts = side_counts(pair);
  std::size_t widest = 0;
  std::size_t digits = 0;
  for (const auto& [term, number] : counts) {
    widest = std::max(widest, characters_in(cases::printable(term)));
    digits = std::max(digits, grouped(number).size());
  }
  std::string text;
  for (const auto& [term, number] : counts) {
    const std::string name = cases::printable(term);
    text += fmt::format("  {}{} {:>{}}\n", name, std::string(widest - characters_in(name), ' '),
                        grouped(number), digits);
  }
  return text;
}

/// The properties on which two backends differ, and the commands that check the first such case
/// again.
std::string differences_text(const records::Run& run, const std::string& folder,
                             const SideBySide& pair) {
  const std::vector<SideBySideLaw> laws = differing_laws(pair);
  if (laws.empty()) {
    return pair.counts.cases() == 0 ? "" : "  They agree on every property.\n";
  }
  std::string text =
      fmt::format("  They differ on {}:\n", counted(laws.size(), "property", "properties"));
  std::vector<std::string> commands;
  for (std::size_t i = 0; i < std::min(laws.size(), kMostPropertiesShown); ++i) {
    text += fmt::format("    {}\n", cases::printable(laws[i].law));
    for (const Disagreement& one : disagreements_of(pair, laws[i])) {
      text += wrapped("", 6,
                      cases::printable(fmt::format("only {} right in {}: {}", one.right,
                                                   counted(one.cases, "case", "cases"),
                                                   places_text(run, one))));
      const records::Difference* difference = difference_of(run, one);
      if (difference == nullptr || !commands.empty()) continue;
      const auto file = std::filesystem::path(folder) / records::file_of(*difference);
      commands = look_commands(run, file.string(), one);
    }
  }
  if (laws.size() > kMostPropertiesShown) {
    text += fmt::format("    and {} more, which summary.md and report.html list\n",
                        laws.size() - kMostPropertiesShown);
  }
  if (commands.empty()) return text;
  text += "  The first of these cases, wrong, then right:\n";
  for (const std::string& command : commands) text += "    " + command + "\n";
  return text;
}

}  // namespace

std::string side_by_side_text(const records::Run& run, const std::string& folder) {
  std::string text;
  for (const SideBySide& pair : records::side_by_side(run)) {
    text += fmt::format("\nSide by side: {} and {}\n", cases::printable(pair.first),
                        cases::printable(pair.second));
    text += wrapped("  ", 2, cases::printable(compared_sentence(pair)));
    if (pair.counts.cases() > 0) text += counts_text(pair);
    const std::string known = known_sentence(pair);
    if (!known.empty()) text += wrapped("  ", 2, cases::printable(known));
    text += differences_text(run, folder, pair);
  }
  return text.empty() ? text : text + wrapped("", 0, kSideBySideSentence);
}

}  // namespace rastercheck::reports
