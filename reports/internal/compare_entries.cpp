#include "reports/internal/compare_entries.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <tuple>

#include "records/share.h"
#include "reports/internal/compare_wording.h"
#include "reports/internal/histogram_svg.h"
#include "reports/internal/html.h"
#include "reports/internal/page.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

/// Maximum numbers of entries with a section, and of entries with a row in the table.
constexpr std::size_t kMostSections = 16;
constexpr std::size_t kMostRows = 60;
/// The number of rows that are visible at first.
constexpr std::size_t kFirstRows = 8;
/// The number of sections that are expanded at first.
constexpr std::size_t kMostOpen = 2;

/// The sort key of an entry: how much its wrong samples or values, and its largest error,
/// increased.
struct Growth {
  bool is_refused = false;
  std::uint64_t wrong = 0;
  double worst = 0;
};

Growth growth_of(const records::EntryChange& entry) {
  Growth growth;
  growth.is_refused = !entry.allowed_because;
  for (const records::FigureChange& change : entry.figures) {
    if (change.change != records::Change::worse) continue;
    const bool is_wrong = change.figure == records::Figure::violations ||
                          change.figure == records::Figure::mismatches;
    if (is_wrong) growth.wrong += change.after.count - change.before.count;
    if (change.figure == records::Figure::worst && change.before.size && change.after.size) {
      growth.worst = change.after.size->hi - change.before.size->hi;
    }
  }
  return growth;
}

bool comes_before(const records::EntryChange* a, const records::EntryChange* b) {
  const auto rank = [](const records::EntryChange* entry) {
    const Growth growth = growth_of(*entry);
    return std::tuple(growth.is_refused, growth.wrong, growth.worst);
  };
  return rank(a) > rank(b);
}

/// A sentence for each figure of the entry that changed in this way.
std::string figures_that(records::Change change, const records::EntryChange& entry) {
  std::string text;
  for (const records::FigureChange& figure : entry.figures) {
    if (figure.change != change) continue;
    text += (text.empty() ? "" : "<br>") + html(figure_sentence(figure));
  }
  return text;
}

std::string allowed_text(const records::EntryChange& entry) {
  return entry.allowed_because ? "<span class=\"held\">✓ allowed</span><br><small>" +
                                     html(*entry.allowed_because) + "</small>"
                               : std::string("<span class=\"violated\">✗ worse</span>");
}

constexpr std::string_view kWorseStart =
    "<table class=\"worse\">\n<thead><tr><th>entry</th>"
    "<th class=\"number\">worst<br><small>ULP</small></th>"
    "<th class=\"number\">p99<br><small>ULP</small></th><th class=\"number\">misrounded</th>"
    "<th>other figures</th><th>policy</th></tr></thead>\n<tbody>\n";

/// "0.5 → 2.3"; a dash if the figure did not change.
std::string change_text(const records::EntryChange& entry, records::Figure figure) {
  for (const records::FigureChange& change : entry.figures) {
    if (change.figure != figure) continue;
    if (figure != records::Figure::misrounded) {
      const OldAndNew texts = figure_texts(change);
      return html(texts.before) + " → " + html(texts.after);
    }
    return records::share_text(change.before.count, change.before.of) + " → " +
           records::share_text(change.after.count, change.after.of);
  }
  return std::string(kNothing);
}

/// The counts that grew: violations and mismatches.
std::string wrong_text(const records::EntryChange& entry) {
  std::string text;
  for (const records::FigureChange& change : entry.figures) {
    const bool is_count = !change.before.size && change.figure != records::Figure::misrounded;
    if (!is_count || change.change != records::Change::worse) continue;
    text += (text.empty() ? "" : "<br>") + html(figure_sentence(change));
  }
  return text.empty() ? std::string(kNothing) : text;
}

/// Returns a row of the table of worse entries. `name` is HTML.
std::string worse_row(const records::EntryChange& entry, const std::string& name) {
  return "<tr>" + cell(name) +
         number_cell("worst, ULP", change_text(entry, records::Figure::worst)) +
         number_cell("p99, ULP", change_text(entry, records::Figure::p99)) +
         number_cell("misrounded", change_text(entry, records::Figure::misrounded)) +
         named_cell("other figures", wrong_text(entry)) +
         named_cell("policy", allowed_text(entry)) + "</tr>\n";
}

std::string more_line(std::size_t all, std::size_t shown) {
  if (all <= shown) return "";
  return fmt::format("<p class=\"unit\">… and {} more, in compare.json.</p>\n",
                     grouped(all - shown));
}

std::string figure_table(const records::EntryChange& entry) {
  std::string text =
      "<table class=\"figures-of\">\n<thead><tr><th>figure</th><th class=\"number\">baseline</th>"
      "<th class=\"number\">now</th><th>change</th></tr></thead>\n<tbody>\n";
  for (const records::FigureChange& change : entry.figures) {
    const OldAndNew texts = figure_texts(change);
    const bool is_worse = change.change == records::Change::worse;
    text += "<tr>" + cell(html(figure_name(change))) + number_cell("baseline", html(texts.before)) +
            number_cell("now", html(texts.after)) +
            named_cell("change", is_worse ? "<span class=\"violated\">✗ worse</span>"
                                          : "<span class=\"held\">✓ better</span>") +
            "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

std::string share_cell(std::string_view name, const std::optional<double>& share) {
  return number_cell(name, share ? fmt::format("{:.1f}%", *share * 100) : std::string(kNothing));
}

/// The contribution of each stage to the errors, and the stage whose part grew.
std::string stages_of(const records::EntryChange& entry) {
  if (entry.stages.empty()) return "";
  std::string text =
      "<h4>Errors by stage</h4>\n<table class=\"stages-of\">\n<thead><tr><th>stage</th>"
      "<th class=\"number\">mean part, baseline<br><small>scale ULP</small></th>"
      "<th class=\"number\">now<br><small>scale ULP</small></th>"
      "<th class=\"number\">share, baseline</th><th class=\"number\">now</th></tr></thead>\n"
      "<tbody>\n";
  for (const records::StageChange& stage : entry.stages) {
    const bool has_grown = stage.stage == entry.grown_stage;
    text += fmt::format("<tr{}>", has_grown ? " class=\"largest\"" : "") +
            cell(fmt::format("<span class=\"key stage-{}\"></span>{}{}",
                             static_cast<int>(stage.stage), to_string(stage.stage),
                             has_grown ? " <strong>← grew most</strong>" : "")) +
            number_cell("mean, baseline", mean_text(stage.mean_before)) +
            number_cell("mean, now", mean_text(stage.mean_after)) +
            share_cell("share, baseline", stage.share_before) +
            share_cell("share, now", stage.share_after) + "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

std::string distribution_of(const records::EntryChange& entry) {
  const std::string title =
      fmt::format("Magnitudes of errors, {}: {} in the baseline and {} now, at most {} and {}",
                  to_string(entry.key), counted(entry.before.histogram.count(), "value", "values"),
                  counted(entry.after.histogram.count(), "value", "values"),
                  number_text(entry.before.worst), number_text(entry.after.worst));
  const std::string svg = overlay_svg(entry.before.histogram, entry.after.histogram, title);
  if (svg.empty()) return "";
  return "<figure class=\"overlay\">" + svg +
         "<figcaption><span class=\"swatch before\"></span> baseline, outlined "
         "<span class=\"swatch after\"></span> now, filled</figcaption>\n"
         "<details><summary>The numbers</summary>\n" +
         overlay_table(entry.before.histogram, entry.after.histogram) + "</details></figure>\n";
}

std::string section_of(const records::Comparison& comparison, std::size_t number,
                       const records::EntryChange& entry, bool is_open) {
  std::string text = fmt::format(
      "<details class=\"finding\" id=\"{}\"{}>\n<summary>{} <span "
      "class=\"title\">{}</span></summary>"
      "\n",
      entry_id(comparison, number, entry), is_open ? " open" : "",
      entry.allowed_because ? "<span class=\"held\">✓</span>" : "<span class=\"violated\">✗</span>",
      html(to_string(entry.key)));
  if (entry.allowed_because) {
    text += "<p>Worse, but allowed by the policy: " + html(*entry.allowed_because) + "</p>\n";
  }
  return text + "<div class=\"entry\">\n" + distribution_of(entry) + "<div>\n" +
         figure_table(entry) + stages_of(entry) + "</div>\n</div>\n</details>\n";
}

std::string names_of_laws(const std::vector<std::string>& laws) {
  std::string text;
  for (const std::string& law : laws) text += (text.empty() ? "" : ", ") + html(law);
  return text;
}

}  // namespace

std::vector<const records::EntryChange*> worse_entries(const records::Comparison& comparison) {
  std::vector<const records::EntryChange*> worse;
  for (const records::EntryChange& entry : comparison.entries) {
    if (entry.change == records::Change::worse) worse.push_back(&entry);
  }
  std::stable_sort(worse.begin(), worse.end(), &comes_before);
  return worse;
}

std::string entry_id(const records::Comparison& comparison, std::size_t number,
                     const records::EntryChange& entry) {
  return fmt::format("entry-{}-{}", number, &entry - comparison.entries.data());
}

std::string worse_table(const records::Comparison& comparison, std::size_t number) {
  const std::vector<const records::EntryChange*> worse = worse_entries(comparison);
  if (worse.empty()) return "";
  const std::size_t shown = std::min(worse.size(), kMostRows);
  const std::size_t first = std::min(shown, kFirstRows);
  const auto rows = [&](std::size_t from, std::size_t to) {
    std::string text(kWorseStart);
    for (std::size_t i = from; i < to; ++i) {
      const records::EntryChange& entry = *worse[i];
      const std::string name = html(to_string(entry.key));
      const std::string id = entry_id(comparison, number, entry);
      text += worse_row(entry,
                        i < kMostSections ? fmt::format("<a href=\"#{}\">{}</a>", id, name) : name);
    }
    return text + "</tbody>\n</table>\n";
  };
  std::string text = rows(0, first);
  if (shown > first) {
    text += fmt::format("<details><summary>{} more worse entries</summary>\n{}</details>\n",
                        shown - first, rows(first, shown));
  }
  return text + more_line(worse.size(), kMostRows);
}

std::string entry_sections(const records::Comparison& comparison, std::size_t number) {
  const std::vector<const records::EntryChange*> worse = worse_entries(comparison);
  if (worse.empty()) return "";
  std::string text = "<section>\n<h2>What is worse</h2>\n";
  for (std::size_t i = 0; i < std::min(worse.size(), kMostSections); ++i) {
    text += section_of(comparison, number, *worse[i], i < kMostOpen);
  }
  return text + more_line(worse.size(), kMostSections) + "</section>\n";
}

std::string other_entries(const records::Comparison& comparison) {
  std::string rows;
  std::size_t all = 0;
  for (const records::EntryChange& entry : comparison.entries) {
    if (entry.change == records::Change::same || entry.change == records::Change::worse) continue;
    if (++all > kMostRows) continue;
    rows += "<tr>" + cell(html(to_string(entry.key))) +
            named_cell("change", std::string(to_string(entry.change))) +
            named_cell("figures", figures_that(records::Change::better, entry)) + "</tr>\n";
  }
  if (all == 0 && comparison.gone_laws.empty() && comparison.new_laws.empty()) return "";
  std::string text = "<section>\n<h2>Better, new and gone</h2>\n";
  if (!rows.empty()) {
    text +=
        "<table class=\"others\">\n<thead><tr><th>entry</th><th>change</th><th>figures</th></tr>"
        "</thead>\n<tbody>\n" +
        rows + "</tbody>\n</table>\n" + more_line(all, kMostRows);
  }
  if (!comparison.new_laws.empty()) {
    text += "<p>Properties that the baseline does not have: " + names_of_laws(comparison.new_laws) +
            "</p>\n";
  }
  if (!comparison.gone_laws.empty()) {
    text +=
        "<p>Properties of the baseline that were not run: " + names_of_laws(comparison.gone_laws) +
        "</p>\n";
  }
  return text + "</section>\n";
}

}  // namespace rastercheck::reports
