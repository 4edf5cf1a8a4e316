#include "reports/internal/report_side_by_side.h"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "records/side_by_side.h"
#include "reports/internal/html.h"
#include "reports/internal/page.h"
#include "reports/internal/side_by_side_wording.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::SideBySide;
using records::SideBySideLaw;

std::string header(std::string_view name, bool is_number) {
  return fmt::format("<th{}>{}</th>", is_number ? " class=\"number\"" : "", name);
}

/// How the cases divide, in large type.
std::string counts_of(const SideBySide& pair) {
  if (pair.counts.cases() == 0) return "";
  std::string text = "<dl class=\"figures\">\n";
  for (const auto& [term, number] : side_counts(pair)) {
    text += definition(html(term), fmt::format("<strong>{}</strong>", grouped(number)));
  }
  return text + "</dl>\n";
}

/// The first cases of a property's disagreements; a click shows the commands that check the first
/// one again.
std::string first_cases_of(const records::Run& run, const SideBySide& pair,
                           const SideBySideLaw& law) {
  std::string text;
  for (const Disagreement& one : disagreements_of(pair, law)) {
    const std::string places =
        fmt::format("only {} right: {}", html(one.right), html(places_text(run, one)));
    const records::Difference* difference = difference_of(run, one);
    if (difference == nullptr) {
      text += "<div>" + places + "</div>\n";
      continue;
    }
    text += fmt::format(
        "<details><summary>{}</summary>\n<p>The first case, wrong, then right:</p>\n", places);
    for (const std::string& command : look_commands(run, records::file_of(*difference), one)) {
      text += fmt::format("<p><code>{}</code></p>\n", html(command));
    }
    text += "</details>\n";
  }
  return text;
}

std::string differences_of_pair(const records::Run& run, const SideBySide& pair) {
  const std::vector<SideBySideLaw> laws = differing_laws(pair);
  if (laws.empty()) {
    return pair.counts.cases() == 0 ? "" : "<p class=\"held\">They agree on every property.</p>\n";
  }
  const std::string only_first = fmt::format("only {} right", html(pair.first));
  const std::string only_second = fmt::format("only {} right", html(pair.second));
  std::string text = fmt::format(
      "<p>They differ on {}:</p>\n<table "
      "class=\"sortable\">\n<thead><tr>{}{}{}{}{}{}</tr></thead>\n"
      "<tbody>\n",
      counted(laws.size(), "property", "properties"), header("property", false),
      header("both right", true), header(only_first, true), header(only_second, true),
      header("neither right", true), header("first cases", false));
  for (const SideBySideLaw& law : laws) {
    text += "<tr>" +
            cell(fmt::format("<a href=\"#{}\">{}</a>", html(law_link(law.law)), html(law.law))) +
            number_cell("both right", grouped(law.counts.both_right)) +
            number_cell(only_first, grouped(law.counts.only_first_right)) +
            number_cell(only_second, grouped(law.counts.only_second_right)) +
            number_cell("neither right", grouped(law.counts.neither_right)) +
            named_cell("first cases", first_cases_of(run, pair, law)) + "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

/// The largest errors of each kind of value.
std::string errors_of_pair(const SideBySide& pair) {
  if (pair.errors.empty()) return "";
  std::string text = fmt::format(
      "<details>\n<summary>Largest errors after allowances, of all cases of each</summary>\n"
      "<table>\n<thead><tr>{}{}{}</tr></thead>\n<tbody>\n",
      header("kind of value", false),
      header(html(pair.first) + "<br><small>scale ULP</small>", true),
      header(html(pair.second) + "<br><small>scale ULP</small>", true));
  for (const records::SideErrors& errors : pair.errors) {
    text += "<tr>" + cell(std::string(to_string(errors.kind))) +
            number_cell(html(pair.first), number_text(errors.first)) +
            number_cell(html(pair.second), number_text(errors.second)) + "</tr>\n";
  }
  return text + "</tbody>\n</table>\n</details>\n";
}

}  // namespace

std::string side_by_side_section(const records::Run& run) {
  const std::vector<SideBySide> pairs = records::side_by_side(run);
  if (pairs.empty()) return "";
  std::string text = "<section id=\"side-by-side\">\n<h2>Side by side</h2>\n";
  for (const SideBySide& pair : pairs) {
    text += fmt::format("<h3>{} and {}</h3>\n<p>{}</p>\n", html(pair.first), html(pair.second),
                        html(compared_sentence(pair))) +
            counts_of(pair);
    const std::string known = known_sentence(pair);
    if (!known.empty()) text += fmt::format("<p>{}</p>\n", html(known));
    text += differences_of_pair(run, pair) + errors_of_pair(pair);
  }
  return text + fmt::format("<p class=\"unit\">{}</p>\n</section>\n", html(kSideBySideSentence));
}

}  // namespace rastercheck::reports
