#include "reports/internal/report_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
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
  add("Not of cases, because", row.not_applicable_because);
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

std::string backend_section(const records::Run& run, const LawSummary& row) {
  std::string text =
      fmt::format("<section class=\"backend\">\n<h3>{} <small>on {}</small></h3>\n<p>{}",
                  html(row.law), html(row.backend), verdict_mark(row));
  text += fmt::format(", {} checked", counted(row.cases.checked, "case", "cases"));
  if (row.cases.not_applicable > 0) {
    text += fmt::format(", {} more that it says nothing of", grouped(row.cases.not_applicable));
  }
  text += "</p>\n" + reasons_list(row);
  if (row.ideal.values + row.excess.values > 0) {
    const Limit rounding{records::kRoundingError, "correct rounding"};
    text +=
        "<div class=\"charts\">\n" +
        histogram_figure(row.ideal, "Against the exact triangle", rounding) +
        histogram_figure(row.excess, "Beyond what the contract leaves open", limit_of(run, row)) +
        "</div>\n" + worst_text(row.ideal) + precision_of(row);
  }
  text += stage_table(row);
  return text + "<h4>Fragments and values by class</h4>\n" + classes_of(row.classes) +
         labels_of(row) + "</section>\n";
}

/// The section of one law, which is given by its consecutive rows.
std::string law_section(const records::Run& run, const LawSummary* first, const LawSummary* last) {
  std::string verdicts;
  bool is_violated = false;
  for (const LawSummary* row = first; row != last; ++row) {
    is_violated = is_violated || row->verdict == LawVerdict::violated;
    verdicts +=
        fmt::format(" <span class=\"{}\">{}</span> <small>{}</small>", verdict_class(row->verdict),
                    verdict_sign(row->verdict), html(row->backend));
  }
  // The heading also shows the law's id, which tables and commands use.
  const std::string& sentence = records::sentence_of(run, first->law);
  const std::string id =
      sentence == first->law ? "" : fmt::format(" <code>{}</code>", html(first->law));
  std::string text = fmt::format(
      "<details class=\"law\" id=\"{}\" data-law=\"{}\"{}>\n<summary><span "
      "class=\"title\">{}</span>{}"
      "{}</summary>\n",
      law_link(first->law), html(first->law), is_violated ? " open" : "", html(sentence), id,
      verdicts);
  for (const LawSummary* row = first; row != last; ++row) text += backend_section(run, *row);
  return text + "</details>\n";
}

}  // namespace

std::string laws_of(const records::Run& run, const std::vector<LawSummary>& rows) {
  if (rows.empty()) return "";
  std::string text = "<section>\n<h2>Law by law</h2>\n";
  if (has_precision(rows))
    text += fmt::format("<p class=\"unit\">{}</p>\n", html(kPrecisionSentence));
  const LawSummary* const end = rows.data() + rows.size();
  for (const LawSummary* first = rows.data(); first != end;) {
    const LawSummary* const next =
        std::find_if(first, end, [first](const LawSummary& row) { return row.law != first->law; });
    text += law_section(run, first, next);
    first = next;
  }
  return text + "</section>\n";
}

}  // namespace rastercheck::reports
