#include "reports/internal/compare_growths.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "cases/float_text.h"
#include "reports/internal/compare_pictures.h"
#include "reports/internal/compare_wording.h"
#include "reports/internal/exact_text.h"
#include "reports/internal/html.h"
#include "reports/internal/page.h"
#include "reports/internal/split_table.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::CloserLook;
using records::WorstError;

constexpr std::size_t kLongestExact = 80;  ///< characters
/// The number of sections that are expanded at first.
constexpr std::size_t kMostOpenGrowths = 2;

std::string actual_text(float actual) {
  return fmt::format("{:.9g}<br><code>{}</code>", actual, cases::to_hex(actual));
}

std::string place_of_error(const WorstError& at) {
  std::string text = fmt::format("triangle {}, pixel ({}, {}), sample {}", at.place.triangle,
                                 at.place.x, at.place.y, at.place.sample);
  return text +
         (at.attribute ? fmt::format(", attribute {}", *at.attribute) : std::string(", depth"));
}

std::string error_row(std::string_view whose, const WorstError& worst) {
  return "<tr>" + cell(std::string(whose)) + named_cell("where", place_of_error(worst)) +
         named_cell("exact", html(exact_text(worst.exact, kLongestExact))) +
         named_cell("drawn", actual_text(worst.actual)) +
         number_cell("error, ULP", number_text(worst.error)) + "</tr>\n";
}

/// "depth", "u", "attribute 3".
std::string grown_value_name(const records::Inspection& inspection) {
  if (!inspection.attribute) return "depth";
  const auto& attributes = inspection.source.attributes;
  const bool has_name =
      *inspection.attribute < attributes.size() && !attributes[*inspection.attribute].name.empty();
  return has_name ? html(attributes[*inspection.attribute].name)
                  : fmt::format("attribute {}", *inspection.attribute);
}

/// The case's largest error, before and now.
std::string errors_of(const records::CaseGrowth& growth) {
  std::string text =
      "<table class=\"worst-of\">\n"
      "<thead><tr><th>largest error</th><th>where</th><th>exact</th><th>drawn</th><th "
      "class=\"number\">error<br><small>scale ULP</small></th></tr></thead>\n"
      "<tbody>\n";
  if (growth.before) {
    text += error_row("baseline", *growth.before);
  } else {
    text +=
        "<tr><td>baseline</td><td colspan=\"4\">no value had an error, or none was "
        "judged</td></tr>\n";
  }
  if (growth.after) text += error_row("now", *growth.after);
  return text + "</tbody>\n</table>\n";
}

/// The inspected pixel and value, and the result there.
std::string subject_of(const CloserLook& look) {
  const records::Inspection& inspection = look.inspection;
  std::string text = fmt::format("<p>Pixel ({}, {}), sample {}, of triangle {}: {}",
                                 inspection.place.x, inspection.place.y, inspection.place.sample,
                                 look.triangle, grown_value_name(inspection));
  const records::InspectedSample* const sample = records::inspected_sample(inspection);
  if (sample != nullptr) {
    text += fmt::format("; the sample is {} ({}) and {} now", to_string(sample->verdict),
                        html(to_string(sample->reason)), sample->is_drawn ? "drawn" : "not drawn");
  }
  return text + ".</p>\n";
}

std::string split_of(const CloserLook& look) {
  for (const records::ErrorSplit& split : look.inspection.splits) {
    if (split.attribute != look.inspection.attribute) continue;
    return fmt::format("<h4>The new error by stage{}</h4>\n{}",
                       split.is_traced ? "" : " <small>as far as it is known</small>",
                       split_table(split));
  }
  return "";
}

std::string commands_of(const Gate& gate, const records::Comparison& comparison,
                        const records::CaseGrowth& growth) {
  std::string text;
  for (const std::string& command : growth_commands(gate, comparison, growth)) {
    text += "<p><code>" + html(command) + "</code></p>\n";
  }
  return text;
}

/// The case's largest error in the baseline, of the kind and stratum shown; empty if unknown, for
/// example because no error was judged.
std::optional<records::Enclosure> reach_of(const records::CaseGrowth& growth) {
  if (!growth.after || !growth.before) return std::nullopt;
  return growth.before->error;
}

std::string start_of(const std::string& id, const std::string& title, bool is_open) {
  return fmt::format("<details class=\"finding\" id=\"{}\"{}>\n<summary>{}</summary>\n", id,
                     is_open ? " open" : "", title);
}

/// A link to the section of the entry to which the growth belongs.
std::string entry_link(const records::Comparison& comparison, std::size_t number,
                       const records::CaseGrowth& growth) {
  const auto entry =
      std::find_if(comparison.entries.begin(), comparison.entries.end(),
                   [&growth](const records::EntryChange& one) {
                     return one.change == records::Change::worse && one.key.law == growth.law &&
                            one.key.kind == growth.kind && one.key.stratum == growth.stratum;
                   });
  if (entry == comparison.entries.end()) return "";
  return fmt::format("<p>Entry: <a href=\"#{}\">{}</a>.</p>\n",
                     fmt::format("entry-{}-{}", number, entry - comparison.entries.begin()),
                     html(to_string(entry->key)));
}

std::string growth_section(const Gate& gate, std::size_t number, std::size_t i) {
  const records::Comparison& comparison = gate.comparisons[number];
  const records::CaseGrowth& growth = comparison.growths[i];
  std::string title =
      fmt::format("<span class=\"title\">{}, {}</span>", html(growth.law), html(case_text(growth)));
  if (growth.after) {
    title += fmt::format(
        " <small>{} → {} scale ULP</small>",
        growth.before ? number_text(records::magnitude(growth.before->error)) : std::string("none"),
        number_text(records::magnitude(growth.after->error)));
  }
  std::string text = start_of(growth_id(number, i), title, i < kMostOpenGrowths);
  for (const std::string& line : growth_lines(growth)) {
    if (line.starts_with(kOutcomeLine) || line.starts_with(kMismatchesLine))
      text += "<p>" + html(line) + "</p>\n";
  }
  if (growth.kind && growth.stratum) {
    text += fmt::format("<p class=\"unit\">{}, {}</p>\n", to_string(*growth.kind),
                        to_string(*growth.stratum));
  }
  if (growth.after) text += errors_of(growth);
  if (const CloserLook* const look = find_look(gate, comparison, growth)) {
    text += subject_of(*look) + compare_pictures(*look, reach_of(growth)) + split_of(*look);
  } else {
    text +=
        "<p class=\"missing\">No picture: the case was not drawn again, or the property "
        "compares a changed copy of it, which is not kept.</p>\n";
  }
  return text + entry_link(comparison, number, growth) + commands_of(gate, comparison, growth) +
         "</details>\n";
}

/// The crops that the baseline kept and whose pixels have changed.
std::string kept_sections(const Gate& gate, std::size_t number) {
  const records::Comparison& comparison = gate.comparisons[number];
  std::string text;
  std::size_t shown = 0;
  for (const CloserLook& look : gate.looks) {
    if (look.key.backend != comparison.backend || look.kind) continue;
    const std::string where =
        look.key.origin == records::Origin::random
            ? fmt::format("random case {}", look.key.index)
            : fmt::format("case {} of the corpus, “{}”", look.key.index, look.case_name);
    text += start_of(fmt::format("kept-{}-{}", number, shown),
                     fmt::format("<span class=\"title\">{}, {}</span> <small>triangle {}</small>",
                                 html(look.key.law), html(where), look.triangle),
                     shown == 0) +
            subject_of(look) + compare_pictures(look, std::nullopt) + split_of(look) +
            "</details>\n";
    ++shown;
  }
  if (text.empty()) return "";
  return "<section>\n"
         "<h2>Changed pixels</h2>\n"
         "<p class=\"unit\">The parts of drawings kept in the baseline that changed most, for "
         "better or worse.</p>\n" +
         text + "</section>\n";
}

}  // namespace

std::string growth_id(std::size_t number, std::size_t growth) {
  return fmt::format("case-{}-{}", number, growth);
}

std::string growth_sections(const Gate& gate, std::size_t number) {
  const records::Comparison& comparison = gate.comparisons[number];
  std::string text;
  for (std::size_t i = 0; i < comparison.growths.size(); ++i)
    text += growth_section(gate, number, i);
  if (!text.empty()) {
    text = "<section>\n<h2>Cases that grew most</h2>\n" + picture_legend() + text;
    if (comparison.grown_cases > comparison.growths.size()) {
      text += fmt::format("<p class=\"unit\">… and {} more.</p>\n",
                          grouped(comparison.grown_cases - comparison.growths.size()));
    }
    text += "</section>\n";
  }
  return text + kept_sections(gate, number);
}

}  // namespace rastercheck::reports
