#include "reports/internal/report_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "cases/float_text.h"
#include "reports/cause_text.h"
#include "reports/commands.h"
#include "reports/counterexample_text.h"
#include "reports/finding_text.h"
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
constexpr std::size_t kLongestTitle = 240;    ///< characters
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
        return "; most of this error is <strong>allowed</strong>";
      case records::Stage::excess:
        return "";
      default:
        return fmt::format("; most of this error is from <strong>{}</strong>", to_string(*largest));
    }
  }
  return "";
}

/// The exact value and the drawn one in full, after `start`.
std::string value_sentence(const Inspection& inspection, const InspectedValue& value,
                           const std::string& start) {
  const bool is_range = value.exact.starts_with('[');
  std::string text =
      fmt::format("<p class=\"finding\">{}{} {} {}", start, name_of(inspection, value.attribute),
                  is_range ? "must be within" : "is exactly",
                  value.exact.empty() ? "not defined" : shortened_value(value.exact));
  if (value.nearest && value.exact.find('/') != std::string::npos) {
    text += fmt::format(" ≈ {}", shortened_value(fmt::format("{}", *value.nearest)));
  }
  if (!value.actual) return text + ", and was not drawn.</p>\n";
  text += fmt::format(
      ", and was drawn as {} <small>{}</small>",
      shortened_value(std::isnan(*value.actual) ? "NaN" : fmt::format("{}", *value.actual)),
      cases::to_hex(*value.actual));
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
  // The heading of a counterexample names the place already.
  const std::string start =
      inspection.occasion == records::Occasion::counterexample ? "" : place_of(inspection) + ": ";
  for (const InspectedValue& value : sample->values) {
    const bool is_of_coverage = !inspection.attribute && inspection.splits.empty();
    // A heading with "NaN" or "inf" says it all.
    if (start.empty() && !is_of_coverage && value.attribute == inspection.attribute &&
        value.actual && !std::isfinite(*value.actual)) {
      return "";
    }
    if (value.attribute == inspection.attribute && !is_of_coverage) {
      return value_sentence(inspection, value, start);
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
        split.is_traced ? ""
                        : " <small>(this backend does not report its stages: “left open” is what "
                          "its contract allows, “excess” the rest)</small>",
        split_table(split));
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
  std::string text = sentence_of(*shown.inspection);
  // Without the inspected sample, the viewer has nothing to select at first.
  if (!shown.data.empty() && inspected_sample(*shown.inspection) != nullptr) {
    text += fmt::format(
        "<div class=\"viewer-place\"></div>\n<script type=\"application/json\">{}</script>\n",
        shown.data);
  }
  return text + splits_of(*shown.inspection);
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
  std::string where = "–";
  if (violation.has_place()) {
    where = html(finding_place(violation, source));
    if (violation.attribute) where += ": " + html(finding_value(violation, source));
  }
  if (!violation.note.empty()) what += "<br><small>" + html(violation.note) + "</small>";
  return "<tr>" + cell(where) + cell(what) +
         named_cell("must be", violation.has_place() ? shortened_value(violation.exact) : "–") +
         named_cell("drawn", violation.has_place() ? shortened_value(violation.actual) : "–") +
         number_cell("error, ULP", number(violation.error)) +
         number_cell("allowed, ULP", number(violation.bound)) +
         number_cell("distance, pixels", number(violation.distance)) + "</tr>\n";
}

std::string violations_of(const Counterexample& counterexample) {
  std::string text = fmt::format(
      "<p>{}{}</p>\n", counted(counterexample.violation_count, "violation", "violations"),
      counterexample.violation_count > counterexample.violations.size()
          ? fmt::format(", the first {}:", counterexample.violations.size())
          : ":");
  text +=
      "<table class=\"sortable\">\n<thead><tr><th>where</th><th>what</th><th>must be</th>"
      "<th>drawn</th><th class=\"number\">error<br><small>scale ULP</small></th>"
      "<th class=\"number\">allowed<br><small>scale ULP</small></th>"
      "<th class=\"number\">distance<br><small>pixels</small></th></tr></thead>\n<tbody>\n";
  for (const records::Violation& violation : counterexample.violations) {
    text += violation_row(violation, counterexample.source);
  }
  return text + "</tbody>\n</table>\n";
}

/// The picture made of characters; only for readers without scripts if the viewer shows the same
/// pixels.
std::string close_up_of(const Counterexample& counterexample, bool has_viewer) {
  if (counterexample.close_up.empty()) return "";
  std::string text = has_viewer ? "<pre class=\"unscripted\">" : "<pre>";
  for (const std::string& line : counterexample.close_up) text += html(line) + "\n";
  return text + "</pre>\n";
}

/// The state, vertices and triangles, written as on a terminal. `origin` names the case that it was
/// made from; may be empty.
std::string case_of(const cases::Case& source, const std::string& origin, bool is_open) {
  return fmt::format(
      "<details class=\"case\"{}><summary>The case: state, vertices, "
      "triangles</summary>\n<pre>{}</pre>"
      "\n{}</details>\n",
      is_open ? " open" : "", html(case_text(source)),
      origin.empty() ? "" : fmt::format("<p><small>{}</small></p>\n", html(origin)));
}

/// The commands that help next: they need the folder that the page is in.
std::string next_commands(const Run& run, const Counterexample& counterexample) {
  const std::string file = records::file_of(counterexample);
  std::string text = fmt::format(
      "<dl class=\"next\">\n<div><dt>check it again</dt><dd><code>{}</code></dd></div>\n",
      html(replay_command(run, file)));
  const auto& violations = counterexample.violations;
  if (!violations.empty() && violations.front().has_place()) {
    records::WorstError place;
    place.place = violations.front().place;
    text += fmt::format("<div><dt>explain the sample</dt><dd><code>{}</code></dd></div>\n",
                        html(explain_command(run, file, place)));
  }
  return text + "</dl>\n";
}

/// The counterexample's fault in a line, or its verdict if no violation was kept.
std::string title_of(const Counterexample& counterexample, const cases::Found& found) {
  if (counterexample.violations.empty()) return found.verdict;
  return finding_text(counterexample.violations.front(), counterexample.source);
}

std::string counterexample_section(const Run& run, const Counterexample& counterexample,
                                   const Shown* shown, bool is_open) {
  const cases::Found found = counterexample.source.found.value_or(cases::Found());
  std::string text = section_start(
      shown, "<span class=\"violated\">✗</span>",
      fmt::format("<span class=\"title\">{}</span> <small>{}{}, case {}</small>",
                  html(elided(title_of(counterexample, found), kLongestTitle)), html(found.law),
                  run.plan.backends.size() == 1 ? "" : " on " + html(found.backend),
                  found.index % records::kRedrawn),
      is_open);
  if (shown != nullptr) text += inspection_of(*shown);
  text += close_up_of(counterexample, shown != nullptr && !shown->data.empty());
  // The heading has the first violation.
  const auto& violations = counterexample.violations;
  if (counterexample.violation_count > 1 || violations.empty() || !violations.front().has_place()) {
    text += violations_of(counterexample);
  }
  // The name is that of the original case, and may no longer describe this one.
  const std::string& name = counterexample.source.name;
  const std::string origin =
      name.empty() ? ""
                   : fmt::format("{} the case “{}”, whose name is no diagnosis of this backend.",
                                 counterexample.is_shrunk() ? "Shrunk from" : "This is", name);
  text += case_of(counterexample.source, origin, is_open);
  return text + next_commands(run, counterexample) + "</details>\n";
}

/// Says what the counterexamples of a cause have in common, and gives the hint, if any.
std::string cause_heading(const Run& run, std::size_t index) {
  const records::Cause& cause = run.causes[index];
  std::string text = fmt::format("<h3>{}. {}</h3>\n", index + 1, html(cause_line(run, cause)));
  if (cause.hint) text += "<p><b>Hint:</b> " + html(hint_text(cause)) + ".</p>\n";
  return text;
}

/// Lists the experiments on the first counterexample of a cause.
std::string tried_of(const records::Cause& cause, bool is_open) {
  if (cause.tried.empty()) return "";
  std::string text = fmt::format(
      "<details class=\"tried\"{}><summary>Experiments on its smallest "
      "counterexample</summary>\n<ul>\n",
      is_open ? " open" : "");
  for (const std::string& tried : cause.tried) text += "<li>It " + html(tried) + "</li>\n";
  return text + "</ul>\n</details>\n";
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
  return text + inspection_of(shown) + case_of(inspection.source, "", false) + "</details>\n";
}

/// The run's inspections. For counterexamples of coverage, they show coverage: a sample that must
/// not be drawn may have the right values.
std::vector<Inspection> shown_inspections(const Run& run) {
  std::vector<Inspection> all = run.inspections;
  for (Inspection& inspection : all) {
    if (inspection.occasion != records::Occasion::counterexample ||
        inspection.counterexample >= run.counterexamples.size()) {
      continue;
    }
    const auto& violations =
        run.counterexamples[static_cast<std::size_t>(inspection.counterexample)].violations;
    if (violations.empty() || violations.front().kind != records::AttributeKind::coverage) continue;
    inspection.attribute.reset();
    inspection.splits.clear();
  }
  return all;
}

const Shown* shown_of(const std::vector<Shown>& all, std::size_t counterexample) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Shown& shown) {
    return shown.inspection->occasion == records::Occasion::counterexample &&
           shown.inspection->counterexample == counterexample;
  });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

Findings findings_of(const Run& run) {
  const std::vector<Inspection> inspections = shown_inspections(run);
  std::vector<std::string> data = inspection_data(inspections, kMostData);
  std::vector<Shown> all;
  Findings findings;
  for (std::size_t i = 0; i < inspections.size(); ++i) {
    all.push_back({&inspections[i], i, std::move(data[i])});
    if (inspections[i].occasion == records::Occasion::worst) {
      findings.worst += worst_section(all.back());
    }
  }
  const auto section = [&](std::size_t i, bool is_open) {
    return counterexample_section(run, run.counterexamples[i], shown_of(all, i), is_open);
  };
  std::string text;
  for (std::size_t i = 0; i < run.causes.size(); ++i) {
    const std::vector<std::uint64_t>& of = run.causes[i].counterexamples;
    text += "<section class=\"cause\">\n" + cause_heading(run, i) +
            tried_of(run.causes[i], i == 0) + section(static_cast<std::size_t>(of.front()), i == 0);
    std::string others;
    for (std::size_t k = 1; k < of.size(); ++k) {
      others += section(static_cast<std::size_t>(of[k]), false);
    }
    if (!others.empty()) {
      text += fmt::format("<details class=\"others\"><summary>{}</summary>\n{}</details>\n",
                          counted(of.size() - 1, "more counterexample", "more counterexamples"),
                          others);
    }
    text += "</section>\n";
  }
  bool is_first = text.empty();
  for (const std::size_t i : without_cause(run)) {
    text += section(i, is_first);
    is_first = false;
  }
  if (!text.empty()) {
    findings.counterexamples =
        "<section id=\"counterexamples\">\n<h2>What is wrong</h2>\n" + text +
        "<p class=\"unit\">Commands are for the folder that this page is in.</p>\n</section>\n";
  }
  if (!findings.worst.empty()) {
    findings.worst =
        "<section id=\"worst\">\n<h2>Largest errors</h2>\n<p class=\"unit\">Against the exact "
        "triangle, one of each backend, kind and stratum. Most of such an error may be allowed: "
        "what is wrong stands above.</p>\n" +
        findings.worst + "</section>\n";
  }
  return findings;
}

}  // namespace rastercheck::reports
