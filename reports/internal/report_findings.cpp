#include "reports/internal/report_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "cases/float_text.h"
#include "reports/cause_text.h"
#include "reports/commands.h"
#include "reports/counterexample_text.h"
#include "reports/internal/html.h"
#include "reports/internal/inspection_data.h"
#include "reports/internal/page.h"
#include "reports/internal/split_table.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::Counterexample;
using records::InspectedSample;
using records::InspectedValue;
using records::Inspection;
using records::Run;

constexpr std::size_t kLongestValue = 160;    ///< characters
constexpr std::size_t kMostData = 3'500'000;  ///< for the inspections in the page, in bytes

std::string shortened_value(std::string_view text) {
  return "<span class=\"value\">" + html(elided(text, kLongestValue)) + "</span>";
}

/// "u", "depth".
std::string name_of(const Inspection& inspection, const std::optional<std::uint32_t>& attribute) {
  if (!attribute) return "depth";
  const auto& attributes = inspection.source.attributes;
  return *attribute < attributes.size() && !attributes[*attribute].name.empty()
             ? html(attributes[*attribute].name)
             : fmt::format("attribute {}", *attribute);
}

/// Names the inspected place, for use in a sentence.
std::string place_of(const Inspection& inspection) {
  return fmt::format("Pixel ({}, {}){} of triangle {}", inspection.place.x, inspection.place.y,
                     inspection.pattern.size() > 1
                         ? fmt::format(", sample {},", inspection.place.sample)
                         : std::string(),
                     inspection.place.triangle);
}

std::string coverage_sentence(const Inspection& inspection, const InspectedSample& sample) {
  using records::Verdict;
  const std::string_view what =
      sample.is_drawn ? (sample.verdict == Verdict::forbidden ? "extra" : "drawn")
                      : (sample.verdict == Verdict::required ? "missing" : "not drawn");
  std::string text = fmt::format("<p class=\"finding\">{} is <strong>{}</strong>: it is {} ({})",
                                 place_of(inspection), what, to_string(sample.verdict),
                                 html(to_string(sample.reason)));
  if (sample.distance) {
    text += fmt::format(", {} pixels from the boundary", html(number_text(sample.distance)));
  }
  if (inspection.coverage_stage) {
    text += fmt::format("; the first stage to say otherwise is <strong>{}</strong>",
                        to_string(*inspection.coverage_stage));
  }
  return text + ".</p>\n";
}

/// The cause of the largest part of an error; empty if unknown.
std::string cause_of(const Inspection& inspection, const std::optional<std::uint32_t>& attribute) {
  for (const records::ErrorSplit& split : inspection.splits) {
    if (split.attribute != attribute) continue;
    const std::optional<records::Stage> largest = records::largest_part(split);
    if (!largest) return "";
    switch (*largest) {
      case records::Stage::left_open:
        return "; most of it is what the <strong>contract leaves open</strong>";
      case records::Stage::excess:
        return "; most of it is <strong>beyond what the contract leaves open</strong>";
      default:
        return fmt::format("; most of it is from <strong>{}</strong>", to_string(*largest));
    }
  }
  return "";
}

std::string value_sentence(const Inspection& inspection, const InspectedValue& value) {
  std::string text =
      fmt::format("<p class=\"finding\">{}: {} is exactly {}", place_of(inspection),
                  name_of(inspection, value.attribute),
                  value.exact.empty() ? "not defined" : shortened_value(value.exact));
  if (value.nearest && value.exact.find('/') != std::string::npos) {
    text += fmt::format(" ≈ {}", shortened_value(fmt::format("{}", *value.nearest)));
  }
  if (!value.actual) return text + ", and was not drawn.</p>\n";
  text +=
      fmt::format(", and was drawn as {} <small>{}</small>",
                  shortened_value(fmt::format("{}", *value.actual)), cases::to_hex(*value.actual));
  if (value.scale_error) {
    text +=
        fmt::format(": <strong>{} scale ULP</strong> off", html(number_text(value.scale_error)));
  }
  return text + cause_of(inspection, value.attribute) + ".</p>\n";
}

/// Describes the inspected sample in a sentence.
std::string sentence_of(const Inspection& inspection) {
  const InspectedSample* const sample = inspected_sample(inspection);
  if (sample == nullptr) return "";
  for (const InspectedValue& value : sample->values) {
    const bool is_of_coverage = !inspection.attribute && inspection.splits.empty();
    if (value.attribute == inspection.attribute && !is_of_coverage) {
      return value_sentence(inspection, value);
    }
  }
  return coverage_sentence(inspection, *sample);
}

/// The error of the inspected value, or of each value, by stage.
std::string splits_of(const Inspection& inspection) {
  std::string text;
  for (const records::ErrorSplit& split : inspection.splits) {
    if (inspection.attribute && split.attribute != inspection.attribute) continue;
    text += fmt::format(
        "<div>\n<h4>Error of {} by stage{}</h4>\n{}</div>\n", name_of(inspection, split.attribute),
        split.is_traced ? "" : " <small>as far as it can be told</small>", split_table(split));
  }
  return text.empty() ? "" : "<div class=\"splits\">\n" + text + "</div>\n";
}

/// An inspection of the run, with its data for the viewer.
struct Shown {
  const Inspection* inspection;
  std::size_t index;
  std::string data;
};

std::string inspection_of(const Shown& shown) {
  std::string text = sentence_of(*shown.inspection) + splits_of(*shown.inspection);
  // Without the inspected sample, the viewer has nothing to select at first.
  if (shown.data.empty() || inspected_sample(*shown.inspection) == nullptr) return text;
  return text +
         fmt::format(
             "<div class=\"viewer-place\"></div>\n<script type=\"application/json\">{}</script>\n",
             shown.data);
}

/// The start of a finding's section. `title` is HTML.
std::string section_start(const Shown* shown, std::string_view sign, const std::string& title,
                          bool is_open) {
  std::string attributes;
  if (shown != nullptr) {
    attributes = fmt::format(" id=\"{}\" data-inspection=\"{}\"", inspection_link(shown->index),
                             shown->index);
  }
  return fmt::format("<details class=\"finding\"{}{}>\n<summary>{} {}</summary>\n", attributes,
                     is_open ? " open" : "", sign, title);
}

std::string violation_row(const records::Violation& violation, const cases::Case& source) {
  const auto number = [](const std::optional<records::Enclosure>& value) {
    return html(number_text(value));
  };
  std::string what(to_string(violation.fragment_class));
  if (violation.has_place()) what += fmt::format(", {}", to_string(violation.kind));
  if (!violation.note.empty()) what += "<br><small>" + html(violation.note) + "</small>";
  return "<tr>" + cell(html(place_text(violation, source))) + cell(what) +
         named_cell("exact", violation.has_place() ? shortened_value(violation.exact) : "–") +
         named_cell("actual", violation.has_place() ? shortened_value(violation.actual) : "–") +
         number_cell("error, ULP", number(violation.error)) +
         number_cell("bound, ULP", number(violation.bound)) +
         number_cell("distance, pixels", number(violation.distance)) + "</tr>\n";
}

std::string violations_of(const Counterexample& counterexample) {
  std::string text = fmt::format(
      "<p>{}{}</p>\n", counted(counterexample.violation_count, "violation", "violations"),
      counterexample.violation_count > counterexample.violations.size()
          ? fmt::format(", the first {}:", counterexample.violations.size())
          : ":");
  text +=
      "<table class=\"sortable\">\n<thead><tr><th>where</th><th>what</th><th>exact</th>"
      "<th>actual</th><th class=\"number\">error<br><small>scale ULP</small></th>"
      "<th class=\"number\">bound<br><small>scale ULP</small></th>"
      "<th class=\"number\">distance<br><small>pixels</small></th></tr></thead>\n<tbody>\n";
  for (const records::Violation& violation : counterexample.violations) {
    text += violation_row(violation, counterexample.source);
  }
  return text + "</tbody>\n</table>\n";
}

/// The picture made of characters. If the viewer shows the same, it is only for readers without
/// scripts.
std::string close_up_of(const Counterexample& counterexample, bool has_viewer) {
  if (counterexample.close_up.empty()) return "";
  std::string text = has_viewer ? "<pre class=\"unscripted\">" : "<pre>";
  for (const std::string& line : counterexample.close_up) text += html(line) + "\n";
  return text + "</pre>\n";
}

/// The state, vertices and triangles, written as on a terminal.
std::string case_of(const cases::Case& source) {
  return "<details class=\"case\"><summary>The case: state, vertices, triangles</summary>\n<pre>" +
         html(case_text(source)) + "</pre></details>\n";
}

std::string counterexample_section(const Run& run, const Counterexample& counterexample,
                                   const Shown* shown, bool is_open) {
  const cases::Found found = counterexample.source.found.value_or(cases::Found());
  std::string way = found.verdict;
  for (const std::string& word : records::special_words(found)) way += ", " + word;
  std::string text = section_start(
      shown, "<span class=\"violated\">✗</span>",
      fmt::format("<span class=\"title\">{}</span> <small>on {}: {}, case {}</small>",
                  html(found.law), html(found.backend), html(way), found.index % records::kRedrawn),
      is_open);
  if (!counterexample.source.name.empty()) {
    // The name is that of the original case, and may no longer describe this one.
    text += fmt::format("<p>{}“{}”</p>\n", counterexample.is_shrunk() ? "Made smaller from " : "",
                        html(counterexample.source.name));
  }
  if (shown != nullptr) text += inspection_of(*shown);
  text += violations_of(counterexample);
  text += close_up_of(counterexample, shown != nullptr && !shown->data.empty());
  text += case_of(counterexample.source);
  return text + fmt::format("<p><code>{}</code></p>\n</details>\n",
                            html(replay_command(run, records::file_of(counterexample))));
}

/// Says what some counterexamples have in common, and what was tried on the first of them.
std::string cause_heading(const Run& run, std::size_t index) {
  const records::Cause& cause = run.causes[index];
  std::string text =
      fmt::format("<h3>Cause {}: {}</h3>\n", index + 1, html(cause_line(run, cause)));
  if (cause.hint) text += "<p><b>Hint:</b> " + html(hint_text(cause)) + ".</p>\n";
  if (cause.tried.empty()) return text;
  text += "<p>Of the first:</p>\n<ul>\n";
  for (const std::string& tried : cause.tried) text += "<li>it " + html(tried) + "</li>\n";
  return text + "</ul>\n";
}

std::string worst_section(const Shown& shown) {
  const Inspection& inspection = *shown.inspection;
  std::string what = inspection.kind ? std::string(to_string(*inspection.kind)) : "";
  if (inspection.stratum) what += fmt::format(", {}", to_string(*inspection.stratum));
  const InspectedSample* const sample = inspected_sample(inspection);
  std::string error;
  if (sample != nullptr) {
    for (const InspectedValue& value : sample->values) {
      if (value.attribute != inspection.attribute || !value.scale_error) continue;
      error = fmt::format(": {} scale ULP", html(number_text(value.scale_error)));
    }
  }
  std::string text =
      section_start(&shown, "<span class=\"unchecked\">◦</span>",
                    fmt::format("<span class=\"title\">{}{}</span> <small>on {}, by {}</small>",
                                what, error, html(inspection.backend), html(inspection.law)),
                    false);
  if (!inspection.source.name.empty()) text += "<p>“" + html(inspection.source.name) + "”</p>\n";
  return text + inspection_of(shown) + case_of(inspection.source) + "</details>\n";
}

const Shown* shown_of(const std::vector<Shown>& all, std::size_t counterexample) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Shown& shown) {
    return shown.inspection->occasion == records::Occasion::counterexample &&
           shown.inspection->counterexample == counterexample;
  });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::string findings_of(const Run& run) {
  std::vector<std::string> data = inspection_data(run.inspections, kMostData);
  std::vector<Shown> all;
  std::string worst;
  for (std::size_t i = 0; i < run.inspections.size(); ++i) {
    all.push_back({&run.inspections[i], i, std::move(data[i])});
    if (run.inspections[i].occasion == records::Occasion::worst) worst += worst_section(all.back());
  }
  std::string text;
  if (!run.counterexamples.empty()) {
    text +=
        "<section id=\"counterexamples\">\n<h2>Counterexamples</h2>\n<p class=\"unit\">One of each "
        "law, backend and way to fail. Commands are for the folder that this file is in.</p>\n";
    bool is_first = true;
    const auto add = [&](std::size_t i) {
      text += counterexample_section(run, run.counterexamples[i], shown_of(all, i), is_first);
      is_first = false;
    };
    for (std::size_t i = 0; i < run.causes.size(); ++i) {
      text += cause_heading(run, i);
      for (const std::uint64_t place : run.causes[i].counterexamples) {
        add(static_cast<std::size_t>(place));
      }
    }
    for (const std::size_t i : without_cause(run)) add(i);
    text += "</section>\n";
  }
  if (!worst.empty()) {
    text +=
        "<section id=\"worst\">\n<h2>Worst cases</h2>\n<p class=\"unit\">The largest error against "
        "the exact triangle of each backend, kind and stratum, whether it violates a law or "
        "not.</p>\n" +
        worst + "</section>\n";
  }
  return text;
}

}  // namespace rastercheck::reports
