#include "reports/internal/report_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string_view>

#include "reports/internal/histogram_svg.h"
#include "reports/internal/html.h"
#include "reports/internal/page.h"
#include "reports/internal/stage_table.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::LawSummary;
using records::LawVerdict;

constexpr std::size_t kLongestWorstValue = 160;  ///< characters

std::string histogram_figure(const records::SizeSummary& sizes, std::string_view caption,
                             const std::optional<Limit>& limit) {
  if (sizes.values == 0) return "";
  return fmt::format(
      "<figure data-histogram=\"{}\"><figcaption>{}: {}, worst {}</figcaption>\n{}</figure>\n",
      html(histogram_data(sizes.histogram, limit)), caption,
      counted(sizes.values, "value", "values"), number_text(sizes.worst),
      histogram_svg(sizes.histogram, caption, limit));
}

/// The place of the worst error, and its value.
std::string worst_text(const records::SizeSummary& sizes) {
  if (!sizes.worst_at) return "";
  const records::WorstError& worst = *sizes.worst_at;
  const std::string of =
      worst.attribute ? fmt::format("attribute {}", *worst.attribute) : std::string("depth");
  return fmt::format(
      "<p>Worst error {}: case {}{}, triangle {}, pixel ({}, {}), sample {}, {}; exact "
      "<span class=\"value\">{}</span>, actual <span class=\"value\">{}</span>.</p>\n",
      html(records::to_decimal(worst.error, 6)), worst.case_index,
      worst.case_name.empty() ? "" : " “" + html(worst.case_name) + "”", worst.place.triangle,
      worst.place.x, worst.place.y, worst.place.sample, of,
      html(elided(worst.exact, kLongestWorstValue)), fmt::format("{}", worst.actual));
}

std::string precision_of(const LawSummary& row) {
  if (row.precision.empty()) return "";
  std::string text =
      "<h4>Precision by stratum</h4>\n<table class=\"sortable\">\n<thead><tr><th>kind</th>"
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

std::string labels_of(const LawSummary& row) {
  std::string text = "<p class=\"labels\">Labels reached: ";
  if (row.labels.empty()) text += "none";
  return text + counted_spans(row.labels) + "</p>\n";
}

/// Lists the known defects that explain the law's violations, and the reasons why the law did not
/// apply to other cases.
std::string reasons_list(const LawSummary& row) {
  std::string text;
  const auto add = [&text](std::string_view title,
                           const std::map<std::string, std::uint64_t>& all) {
    if (all.empty()) return;
    text += fmt::format("<p class=\"labels\">{}: {}</p>\n", title, counted_spans(all));
  };
  add("Known defects", row.known);
  add("Does not apply to cases, because", row.not_applicable_because);
  return text;
}

/// The reference for a row's errors. For a violated law it is the bound that was exceeded, which
/// may differ between triangles; otherwise it is the greatest error of a correctly rounded value.
Limit limit_of(const records::Run& run, const LawSummary& row) {
  std::optional<records::Enclosure> bound;
  for (const records::Counterexample& counterexample : run.counterexamples) {
    const auto& found = counterexample.source.found;
    if (!found || found->law != row.law || found->backend != row.backend) continue;
    for (const records::Violation& violation : counterexample.violations) {
      if (!bound) bound = violation.bound;
    }
  }
  if (!bound || bound->hi <= 0) return {records::kRoundingError, "correct rounding"};
  return {bound->hi, "bound"};
}

/// Shows where a row's figures come from: histograms, strata, stages, classes, labels.
std::string details_of(const records::Run& run, const LawSummary& row) {
  std::string text = reasons_list(row);
  if (row.cases.not_applicable > 0) {
    text += fmt::format("<p>The property does not apply to {}.</p>\n",
                        counted(row.cases.not_applicable, "other case", "other cases"));
  }
  if (row.ideal.values + row.excess.values > 0) {
    const Limit rounding{records::kRoundingError, "correct rounding"};
    text += "<div class=\"charts\">\n" +
            histogram_figure(row.ideal, "Against the exact triangle", rounding) +
            histogram_figure(row.excess, "After allowances", limit_of(run, row)) + "</div>\n" +
            worst_text(row.ideal) + precision_of(row);
  }
  return text + stage_table(row) + "<h4>Fragments and values by class</h4>\n" +
         classes_of(row.classes) + labels_of(row);
}

std::string number_cells(const LawSummary& row) {
  return number_cell("worst ULP", number_text(row.ideal.worst)) +
         number_cell("p99 ULP", at_most_text(row.ideal.p99)) +
         number_cell("after allowances", number_text(row.excess.worst)) +
         number_cell("cases", grouped(row.cases.checked)) +
         number_cell("fragments", grouped(row.judged.fragments)) +
         number_cell("not judged", not_judged_share(row.judged));
}

/// One property on one backend: a row of figures, and a row with everything else, which opens on
/// demand. `is_first` is true for the property's first row, to which the address #property=… leads.
std::string property_rows(const records::Run& run, const LawSummary& row, bool is_first) {
  const std::string& sentence = records::sentence_of(run, row.law);
  std::string text =
      fmt::format("<tbody>\n<tr>{}{}{}{}</tr>\n", cell(html(row.law)), cell(html(row.backend)),
                  cell(verdict_word(row)), number_cells(row));
  return text +
         fmt::format(
             "<tr class=\"more\"><td colspan=\"9\"><details class=\"property\"{} "
             "data-property=\"{}\">\n<summary>{}</summary>\n{}</details></td></tr>\n</tbody>\n",
             is_first ? fmt::format(" id=\"{}\"", law_link(row.law)) : std::string(), html(row.law),
             html(sentence), details_of(run, row));
}

}  // namespace

std::string properties_section(const records::Run& run, const std::vector<LawSummary>& all) {
  std::vector<LawSummary> rows;
  std::copy_if(all.begin(), all.end(), std::back_inserter(rows),
               [](const LawSummary& row) { return row.verdict != LawVerdict::not_checked; });
  if (rows.empty()) return "";
  // The most urgent first; otherwise the order of the properties.
  std::stable_sort(rows.begin(), rows.end(), [](const LawSummary& a, const LawSummary& b) {
    return urgency(a.verdict) < urgency(b.verdict);
  });
  // If the run has a single backend, the heading names it, so rows need not.
  std::string text = fmt::format(
      "<section id=\"properties\">\n<h2>Properties</h2>\n<p class=\"unit\">{}</p>\n"
      "<table class=\"verdicts sortable{}\">\n<thead><tr><th>property</th><th>backend</th>"
      "<th>verdict</th><th class=\"number\">worst<br><small>scale ULP</small></th>"
      "<th class=\"number\">p99<br><small>scale ULP</small></th>"
      "<th class=\"number\">after<br>allowances<br><small>scale ULP</small></th>"
      "<th class=\"number\">cases</th><th class=\"number\">fragments</th>"
      "<th class=\"number\">not<br>judged</th></tr></thead>\n",
      html(kExcessSentence), run.plan.backends.size() == 1 ? " of-one" : "");
  std::set<std::string_view> named;
  for (const LawSummary& row : rows) text += property_rows(run, row, named.insert(row.law).second);
  text += "</table>\n";
  if (has_precision(rows)) {
    text += fmt::format(
        "<details>\n<summary>How to read the tables of precision</summary>\n<p "
        "class=\"unit\">{}</p>\n"
        "</details>\n",
        html(kPrecisionSentence));
  }
  return text + "</section>\n";
}

}  // namespace rastercheck::reports
