// report.html: a run as a single self-contained page. Its scripts sort tables, enhance histograms,
// follow links and show inspections.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "records/summary.h"
#include "reports/format.h"
#include "reports/internal/html.h"
#include "reports/internal/page.h"
#include "reports/internal/picture_figure.h"
#include "reports/internal/report_findings.h"
#include "reports/internal/report_front.h"
#include "reports/internal/report_laws.h"
#include "reports/internal/report_power.h"
#include "reports/internal/report_side_by_side.h"
#include "reports/internal/report_style.h"
#include "reports/internal/viewer.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports::report_html_format {
namespace {

using records::LawSummary;
using records::Run;

std::string pictures_of(const Run& run) {
  if (run.pictures.empty()) return "";
  std::string text = fmt::format("<section id=\"{}\">\n<h2>Pictures</h2>\n", kPicturesLink);
  if (!run.plan.scene.empty()) text += "<p>Scene: " + html(run.plan.scene) + "</p>\n";
  text += "<div class=\"pictures\">\n";
  for (const records::Picture& picture : run.pictures) text += picture_figure(picture);
  return text + "</div>\n</section>\n";
}

/// Lists the drivers' known defects, and how often each was seen.
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

/// The page's title, for a browser's tab: the backends and the outcome.
std::string title_of(const Run& run, const std::vector<LawSummary>& rows) {
  return html(fmt::format("{}: {}", fmt::join(run.plan.backends, ", "), headline(run, rows)));
}

std::string write(const Run& run) {
  const std::vector<LawSummary> rows = records::summarize(run);
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>{} – RasterCheck</title>\n<style>\n{}{}</style>\n</head>\n<body>\n<main>\n",
      viewer_policy(), title_of(run, rows), kReportStyle, kViewerStyle);
  const Findings findings = findings_of(run);
  text += front_of(run, rows) + side_by_side_section(run) + findings.counterexamples +
          scene_section(run) + judged_section(run, rows) + properties_section(run, rows) +
          gaps_section(run, rows) + power_of(rows) + findings.worst + pictures_of(run) +
          known_of(run) + again_section(run) + "</main>\n";
  return text + viewer_scripts() + "</body>\n</html>\n";
}

const FormatRegistration kRegistration({"html", "report.html", &write});

}  // namespace
}  // namespace rastercheck::reports::report_html_format
