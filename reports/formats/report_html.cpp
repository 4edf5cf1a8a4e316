// report.html: a run as one page that needs nothing else: no scripts, no files beside it.

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "records/share.h"
#include "records/summary.h"
#include "reports/base64.h"
#include "reports/commands.h"
#include "reports/format.h"
#include "reports/internal/histogram_svg.h"
#include "reports/internal/html.h"
#include "reports/internal/report_style.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::Counterexample;
using records::LawSummary;
using records::LawVerdict;
using records::Run;

constexpr std::size_t kLongestValue = 160;  ///< characters
constexpr int kEnlarged = 320;              ///< pixels of width below which a picture is enlarged

/// The verdict as a word, with a sign for those who skim and a class for its colour.
std::string verdict_mark(const LawSummary& row) {
  switch (row.verdict) {
    case LawVerdict::held:
      return R"(<span class="held">✓ held</span>)";
    case LawVerdict::violated:
      return fmt::format(R"(<span class="violated">✗ violated in {}</span>)",
                         counted(row.cases.violations, "case", "cases"));
    case LawVerdict::known:
      return fmt::format(R"(<span class="unchecked">≈ {}</span>)", verdict_text(row));
    case LawVerdict::not_checked:
      break;
  }
  const std::string why = records::why_not_checked(row);
  return R"(<span class="unchecked">– not checked)" +
         (why.empty() ? "" : "<br><small>" + html(why) + "</small>") + "</span>";
}

std::string cell(const std::string& content) { return "<td>" + content + "</td>"; }

/// Cells that a narrow screen, which has no header, shows with their column's name.
std::string named_cell(std::string_view name, const std::string& content) {
  return fmt::format("<td class=\"named\" data-name=\"{}\">{}</td>", name, content);
}
std::string number_cell(std::string_view name, const std::string& content) {
  return fmt::format("<td class=\"number\" data-name=\"{}\">{}</td>", name, content);
}

std::string table_of(const std::vector<LawSummary>& rows) {
  std::string text =
      "<table class=\"verdicts\">\n<thead><tr><th>law</th><th>backend</th><th>verdict</th>"
      "<th class=\"number\">worst<br><small>scale ULP</small></th>"
      "<th class=\"number\">p99<br><small>scale ULP</small></th>"
      "<th class=\"number\">beyond contract<br><small>scale ULP</small></th>"
      "<th class=\"number\">cases</th><th class=\"number\">fragments</th></tr></thead>\n<tbody>\n";
  for (const LawSummary& row : rows) {
    text += "<tr>" + cell(html(row.law)) + cell(html(row.backend)) + cell(verdict_mark(row)) +
            number_cell("worst ULP", number_text(row.ideal.worst)) +
            number_cell("p99 ULP", at_most_text(row.ideal.p99)) +
            number_cell("beyond contract", number_text(row.excess.worst)) +
            number_cell("cases", grouped(row.cases.checked)) +
            number_cell("fragments", grouped(row.fragments)) + "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

std::string definition(std::string_view term, const std::string& content) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", term, content);
}

/// How many answers each level of the oracle gave; nothing where none is known to have.
std::string levels_of(const LawSummary& total) {
  const std::uint64_t undecided = total.counts.undecided;
  std::string text;
  if (total.levels.samples != records::LevelCounts()) {
    text += definition(
        "samples decided",
        fmt::format("{}; {} undecided", records::levels_text(total.levels.samples, undecided),
                    grouped(undecided)));
  }
  if (total.levels.values != records::LevelCounts()) {
    text += definition("values decided", records::levels_text(total.levels.values, 0));
  }
  return text;
}

std::string facts_of(const Run& run, const LawSummary& total) {
  const records::Counts& counts = total.counts;
  return "<dl class=\"facts\">\n" + definition("cases checked", grouped(total.cases.checked)) +
         definition("fragments checked", grouped(total.fragments)) +
         definition("samples", fmt::format("{} required, {} forbidden, {} permitted, {} undecided",
                                           grouped(counts.required), grouped(counts.forbidden),
                                           grouped(counts.permitted), grouped(counts.undecided))) +
         levels_of(total) + definition("seed", std::to_string(run.seed)) +
         definition("to do it again", "<code>" + html(run_command(run)) + "</code>") + "</dl>\n";
}

/// What was not done: cases that were not checked, labels that were not reached.
std::string gaps_of(const Run& run) {
  std::string text;
  for (const std::string& caveat : records::caveats(run)) {
    text += fmt::format("<p>{}</p>\n", html(caveat));
  }
  for (const records::UnreachedLabel& label : run.unreached) {
    text += fmt::format("<p>{}</p>\n", html(records::unreached_sentence(label)));
  }
  for (const records::UnexpectedPass& pass : run.unexpected) {
    text += fmt::format("<p>{}</p>\n", html(records::unexpected_sentence(pass)));
  }
  return text;
}

std::string first_screen(const Run& run, const std::vector<LawSummary>& rows) {
  const LawSummary total = totals(rows);
  const std::string_view style = total.verdict == LawVerdict::held       ? "held"
                                 : total.verdict == LawVerdict::violated ? "violated"
                                                                         : "unchecked";
  return fmt::format(
             "<header>\n<p class=\"name\">RasterCheck</p>\n<h1 class=\"{}\">{}</h1>\n</header>\n",
             style, html(verdict_sentence(rows))) +
         table_of(rows) + gaps_of(run) +
         fmt::format("<p class=\"unit\">{}</p>\n<p class=\"unit\">{}</p>\n", html(kUnitSentence),
                     html(kExcessSentence)) +
         facts_of(run, total);
}

std::string pictures_of(const Run& run) {
  if (run.pictures.empty()) return "";
  std::string text = "<section>\n<h2>Pictures</h2>\n";
  if (!run.scene.empty()) text += "<p>Scene: " + html(run.scene) + "</p>\n";
  text += "<div class=\"pictures\">\n";
  for (const records::Picture& picture : run.pictures) {
    // Small ones are enlarged, and their pixels are what is to be seen.
    const std::string_view style = picture.width < kEnlarged ? " class=\"small\"" : "";
    text += fmt::format(
        "<figure><img{} src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">"
        "<figcaption>{}</figcaption></figure>\n",
        style, to_base64(picture.png), picture.width, picture.height, html(picture.name),
        html(picture.caption));
  }
  return text + "</div>\n</section>\n";
}

std::string histogram_figure(const records::SizeSummary& sizes, std::string_view caption) {
  const std::string svg = histogram_svg(sizes.histogram, caption);
  return fmt::format("<figure><figcaption>{}: {}, worst {}</figcaption>\n{}</figure>\n", caption,
                     counted(sizes.values, "value", "values"), number_text(sizes.worst), svg);
}

/// Where the worst error is, and what it is of.
std::string worst_text(const records::SizeSummary& sizes) {
  if (!sizes.worst_at) return "";
  const records::WorstError& worst = *sizes.worst_at;
  const std::string of =
      worst.attribute ? fmt::format("attribute {}", *worst.attribute) : std::string("depth");
  return fmt::format(
      "<p>Worst error {}: case {}{}, triangle {}, pixel ({}, {}), sample {}, {}; exact "
      "<span class=\"value\">{}</span>, actual <span class=\"value\">{}</span>.</p>\n",
      html(records::to_decimal(worst.error, 6)), worst.case_index,
      worst.case_name.empty() ? "" : " “" + html(worst.case_name) + "”", worst.triangle, worst.x,
      worst.y, worst.sample, of, html(elided(worst.exact, kLongestValue)),
      fmt::format("{}", worst.actual));
}

std::string precision_of(const LawSummary& row) {
  if (row.precision.empty()) return "";
  std::string text =
      "<h4>Precision by stratum</h4>\n<table>\n<thead><tr><th>kind</th>"
      "<th>stratum</th>";
  for (const std::string_view column : kPrecisionColumns) {
    text += fmt::format("<th class=\"number\">{}</th>", column);
  }
  text += "</tr></thead>\n<tbody>\n";
  for (const records::Precision& precision : row.precision) {
    text += "<tr>" + cell(std::string(to_string(precision.kind))) +
            cell(std::string(stratum_text(precision)));
    const auto cells = precision_cells(precision);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      text += number_cell(kPrecisionColumns[i], cells[i]);
    }
    text += "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

std::string classes_of(const records::ClassCounts& classes) {
  std::string text;
  for (std::size_t i = 0; i < classes.counts.size(); ++i) {
    const auto fragment_class = static_cast<records::FragmentClass>(i);
    if (classes.counts[i] == 0 && fragment_class != records::FragmentClass::correct) continue;
    text += definition(to_string(fragment_class), grouped(classes.counts[i]));
  }
  return "<dl class=\"facts\">\n" + text + "</dl>\n";
}

std::string counted_spans(const std::map<std::string, std::uint64_t>& all) {
  std::string text;
  for (const auto& [name, cases] : all) {
    text += fmt::format("<span>{} {}</span> ", html(name), grouped(cases));
  }
  return text;
}

std::string labels_of(const LawSummary& row) {
  std::string text = "<p class=\"labels\">Labels reached: ";
  if (row.labels.empty()) text += "none";
  return text + counted_spans(row.labels) + "</p>\n";
}

/// Which known defects its violations are of, and why it says nothing of other cases.
std::string reasons_of(const LawSummary& row) {
  std::string text;
  const auto add = [&text](std::string_view title,
                           const std::map<std::string, std::uint64_t>& all) {
    if (all.empty()) return;
    text += fmt::format("<p class=\"labels\">{}: {}</p>\n", title, counted_spans(all));
  };
  add("Known defects", row.known);
  add("Not of cases, because", row.not_applicable_because);
  return text;
}

std::string law_section(const LawSummary& row) {
  std::string text = fmt::format("<section class=\"law\">\n<h3>{} <small>on {}</small></h3>\n<p>{}",
                                 html(row.law), html(row.backend), verdict_mark(row));
  text += fmt::format(", {} checked", counted(row.cases.checked, "case", "cases"));
  if (row.cases.not_applicable > 0) {
    text += fmt::format(", {} more that it says nothing of", grouped(row.cases.not_applicable));
  }
  text += "</p>\n" + reasons_of(row);
  if (row.ideal.values + row.excess.values > 0) {
    text += "<div class=\"charts\">\n" + histogram_figure(row.ideal, "Against the exact triangle") +
            histogram_figure(row.excess, "Beyond what the contract leaves open") + "</div>\n" +
            worst_text(row.ideal) + precision_of(row);
  }
  return text + "<h4>Fragments and values by class</h4>\n" + classes_of(row.classes) +
         labels_of(row) + "</section>\n";
}

std::string violation_row(const records::Violation& violation, const cases::Case& source) {
  const auto number = [](const std::optional<records::Enclosure>& value) {
    return html(number_text(value));
  };
  const auto value = [](const std::string& text) {
    return "<span class=\"value\">" + html(elided(text, kLongestValue)) + "</span>";
  };
  std::string what(to_string(violation.fragment_class));
  if (violation.has_place()) what += fmt::format(", {}", to_string(violation.kind));
  if (!violation.note.empty()) what += "<br><small>" + html(violation.note) + "</small>";
  return "<tr>" + cell(html(place_text(violation, source))) + cell(what) +
         named_cell("exact", value(violation.has_place() ? violation.exact : "–")) +
         named_cell("actual", value(violation.has_place() ? violation.actual : "–")) +
         number_cell("error, ULP", number(violation.error)) +
         number_cell("bound, ULP", number(violation.bound)) +
         number_cell("distance, pixels", number(violation.distance)) + "</tr>\n";
}

std::string counterexample_section(const Run& run, const Counterexample& counterexample) {
  const cases::Found found = counterexample.source.found.value_or(cases::Found());
  std::string text =
      fmt::format("<section class=\"law\">\n<h3>{} <small>on {}, case {}</small></h3>\n",
                  html(found.law), html(found.backend), found.index);
  if (!counterexample.source.name.empty()) {
    text += "<p>“" + html(counterexample.source.name) + "”</p>\n";
  }
  text += fmt::format("<p><code>{}</code></p>\n",
                      html(replay_command(run, records::file_of(counterexample))));
  text += fmt::format("<p>{}{}</p>\n",
                      counted(counterexample.violation_count, "violation", "violations"),
                      counterexample.violation_count > counterexample.violations.size()
                          ? fmt::format(", the first {}:", counterexample.violations.size())
                          : ":");
  text +=
      "<table>\n<thead><tr><th>where</th><th>what</th><th>exact</th><th>actual</th>"
      "<th class=\"number\">error<br><small>ULP</small></th>"
      "<th class=\"number\">bound<br><small>ULP</small></th>"
      "<th class=\"number\">distance<br><small>pixels</small></th></tr></thead>\n<tbody>\n";
  for (const records::Violation& violation : counterexample.violations) {
    text += violation_row(violation, counterexample.source);
  }
  text += "</tbody>\n</table>\n";
  if (!counterexample.close_up.empty()) {
    text += "<pre>";
    for (const std::string& line : counterexample.close_up) text += html(line) + "\n";
    text += "</pre>\n";
  }
  return text + "</section>\n";
}

/// What is known of the drivers, and how often it was seen.
std::string known_of(const Run& run) {
  if (run.known.empty()) return "";
  std::string text =
      "<section>\n<h2>Known defects</h2>\n<table>\n<thead><tr><th>defect</th><th>backend</th>"
      "<th class=\"number\">cases</th><th>reason</th><th>rule</th></tr></thead>\n<tbody>\n";
  for (const records::KnownSummary& known : records::known_defects(run)) {
    text += "<tr>" + cell(html(known.entry.id)) + cell(html(known.backend)) +
            number_cell("cases", known.is_passed ? "unexpected pass" : grouped(known.cases)) +
            cell(html(known.entry.reason)) + cell(html(known.entry.rule)) + "</tr>\n";
  }
  return text + "</tbody>\n</table>\n</section>\n";
}

std::string environment_of(const Run& run) {
  std::string text = "<section>\n<h2>Environment</h2>\n<dl class=\"facts\">\n";
  for (const auto& [name, value] : run.environment) text += definition(html(name), html(value));
  return text + "</dl>\n</section>\n";
}

std::string write(const Run& run) {
  const std::vector<LawSummary> rows = records::summarize(run);
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>RasterCheck: {}</title>\n<style>\n{}</style>\n</head>\n<body>\n<main>\n",
      html(verdict_sentence(rows)), kReportStyle);
  text += first_screen(run, rows) + pictures_of(run);
  if (!run.counterexamples.empty()) {
    text += fmt::format("<p><a href=\"#counterexamples\">{}</a></p>\n",
                        counted(run.counterexamples.size(), "counterexample", "counterexamples"));
  }
  text += "<section>\n<h2>Law by law</h2>\n";
  if (has_precision(rows)) {
    text += fmt::format("<p class=\"unit\">{}</p>\n", html(kPrecisionSentence));
  }
  for (const LawSummary& row : rows) text += law_section(row);
  text += "</section>\n";
  if (!run.counterexamples.empty()) {
    text +=
        "<section id=\"counterexamples\">\n<h2>Counterexamples</h2>\n<p>Commands are for the "
        "folder that this file is in.</p>\n";
    for (const Counterexample& counterexample : run.counterexamples) {
      text += counterexample_section(run, counterexample);
    }
    text += "</section>\n";
  }
  return text + known_of(run) + environment_of(run) + "</main>\n</body>\n</html>\n";
}

const FormatRegistration kRegistration({"html", "report.html", &write});

}  // namespace
}  // namespace rastercheck::reports
