#include "reports/internal/report_front.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "records/share.h"
#include "reports/commands.h"
#include "reports/internal/html.h"
#include "reports/internal/page.h"
#include "reports/internal/picture_figure.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::Enclosure;
using records::LawSummary;
using records::LawVerdict;
using records::Run;

/// Explains the terms in the table below.
constexpr std::string_view kJudgedSentence =
    "A backend is a rasterizer or driver, a case some triangles to draw, a sample a place of a "
    "pixel that a triangle covers or not, a law what is true of every right drawing. Whatever was "
    "drawn has been judged in exact arithmetic.";

/// Sorts the rows that need attention to the front. Rows of equal urgency keep the order of the
/// laws.
std::vector<LawSummary> by_urgency(std::vector<LawSummary> rows) {
  const auto rank = [](const LawSummary& row) {
    switch (row.verdict) {
      case LawVerdict::violated:
        return 0;
      case LawVerdict::known:
        return 1;
      case LawVerdict::thin:
        return 2;
      case LawVerdict::held:
        return 3;
      case LawVerdict::not_checked:
        break;
    }
    return 4;
  };
  std::stable_sort(rows.begin(), rows.end(),
                   [&rank](const LawSummary& a, const LawSummary& b) { return rank(a) < rank(b); });
  return rows;
}

std::string table_of(const Run& run, const std::vector<LawSummary>& rows) {
  // If the run has a single backend, the heading names it, so rows need not.
  std::string text = fmt::format("<table class=\"verdicts sortable{}\">\n",
                                 run.plan.backends.size() == 1 ? " of-one" : "");
  text +=
      "<thead><tr><th>law</th><th>backend</th>"
      "<th>verdict</th><th class=\"number\">worst<br><small>scale ULP</small></th>"
      "<th class=\"number\">p99<br><small>scale ULP</small></th>"
      "<th class=\"number\">beyond<br>contract<br><small>scale ULP</small></th>"
      "<th class=\"number\">cases</th><th class=\"number\">fragments</th>"
      "<th class=\"number\">not<br>judged</th></tr></thead>\n<tbody>\n";
  for (const LawSummary& row : by_urgency(rows)) {
    const std::string law = fmt::format("<a href=\"#{}\">{}</a>", law_link(row.law), html(row.law));
    text += "<tr>" + cell(law) + cell(html(row.backend)) + cell(verdict_word(row)) +
            number_cell("worst ULP", number_text(row.ideal.worst)) +
            number_cell("p99 ULP", at_most_text(row.ideal.p99)) +
            number_cell("beyond contract", number_text(row.excess.worst)) +
            number_cell("cases", grouped(row.cases.checked)) +
            number_cell("fragments", grouped(row.judged.fragments)) +
            number_cell("not judged", not_judged_share(row.judged)) + "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

/// How many answers each level of the oracle gave; empty if no such counts are known.
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

/// The sum of a backend's rows, with their largest error.
struct BackendFigures {
  std::string backend;
  std::vector<LawSummary> rows;
  std::optional<Enclosure> worst;
  std::optional<Enclosure> p99;
  std::optional<Enclosure> excess;
};

void keep_greater(std::optional<Enclosure>& kept, const std::optional<Enclosure>& other) {
  if (other && (!kept || other->hi > kept->hi)) kept = other;
}

std::vector<BackendFigures> by_backend(const Run& run, const std::vector<LawSummary>& rows) {
  std::vector<BackendFigures> all;
  for (const std::string& backend : run.plan.backends) {
    BackendFigures figures;
    figures.backend = backend;
    for (const LawSummary& row : rows) {
      if (row.backend != backend) continue;
      figures.rows.push_back(row);
      keep_greater(figures.worst, row.ideal.worst);
      keep_greater(figures.p99, row.ideal.p99);
      keep_greater(figures.excess, row.excess.worst);
    }
    all.push_back(figures);
  }
  return all;
}

std::string figure(std::string_view term, const std::string& number, const std::string& of) {
  return definition(term, fmt::format("<strong>{}</strong> <small>{}</small>", number, of));
}

/// The result of each backend, if there are several.
std::string backends_table(const std::vector<BackendFigures>& all) {
  std::string text =
      "<table class=\"backends\">\n<thead><tr><th>backend</th><th>verdict</th>"
      "<th class=\"number\">worst error<br><small>scale ULP</small></th>"
      "<th class=\"number\">p99 error<br><small>largest of a law</small></th>"
      "<th class=\"number\">beyond contract<br><small>scale "
      "ULP</small></th></tr></thead>\n<tbody>\n";
  for (const BackendFigures& of : all) {
    const LawVerdict verdict = records::verdict_of(of.rows);
    text += "<tr>" + cell(html(of.backend)) +
            cell(fmt::format("<span class=\"{}\">{} {}</span>", verdict_class(verdict),
                             verdict_sign(verdict), html(verdict_sentence(of.rows)))) +
            number_cell("worst error", number_text(of.worst)) +
            number_cell("p99 error", at_most_text(of.p99)) +
            number_cell("beyond contract", number_text(of.excess)) + "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

/// The most important figures, in large type.
std::string run_figures(const Run& run, const std::vector<LawSummary>& rows,
                        const LawSummary& total) {
  const records::Counts& counts = total.counts;
  std::string text =
      "<dl class=\"figures\">\n" +
      figure("cases checked", grouped(total.cases.checked),
             counted(rows.size(), "check", "checks")) +
      figure("samples judged", grouped(counts.required + counts.forbidden + counts.permitted),
             fmt::format("{} undecided", grouped(counts.undecided)));
  const std::vector<BackendFigures> all = by_backend(run, rows);
  if (all.size() == 1) {
    text += figure("worst error", number_text(all[0].worst), "scale ULP") +
            figure("p99 error", at_most_text(all[0].p99), "scale ULP, the largest of a law");
  }
  return text + "</dl>\n" + (all.size() > 1 ? backends_table(all) : "");
}

std::string facts_of(const LawSummary& total) {
  const records::Counts& counts = total.counts;
  return "<dl class=\"facts\">\n" +
         definition("fragments judged", grouped(total.judged.fragments)) +
         (total.judged.not_judged.empty()
              ? ""
              : definition("not judged", fmt::format("{} of fragments and values: {}",
                                                     not_judged_share(total.judged),
                                                     records::not_judged_words(total.judged)))) +
         definition("samples", fmt::format("{} required, {} forbidden, {} permitted, {} undecided",
                                           grouped(counts.required), grouped(counts.forbidden),
                                           grouped(counts.permitted), grouped(counts.undecided))) +
         levels_of(total) + "</dl>\n";
}

/// The reasons why a law did not judge cases, with counts if there are several.
std::string reasons_text(const LawSummary& row) {
  const auto reasons = records::reasons_of(row);
  if (reasons.size() == 1 && row.cases.checked == 0) return reasons.front().second;
  std::string text;
  for (const auto& [cases, why] : reasons) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", counted(cases, "time", "times"), why);
  }
  return text;
}

/// Lists laws that held, but on too few cases to say much; empty if there are none.
std::string thin_of(const std::vector<LawSummary>& rows) {
  std::string text;
  for (const LawSummary& row : rows) {
    if (row.verdict != LawVerdict::thin) continue;
    const std::string why = reasons_text(row);
    text += fmt::format("<li>{}</li>\n",
                        html(fmt::format("{} on {}: {}{}", row.law, row.backend,
                                         records::thin_words(row), why.empty() ? "" : "; " + why)));
  }
  if (text.empty()) return "";
  return fmt::format(
      "<section>\n<h2>Held on few cases</h2>\n<p>{}.</p>\n<ul class=\"gaps\">\n{}</ul>\n"
      "</section>\n",
      html(records::thin_sentence(rows)), text);
}

/// Lists what was not done: cases that were not checked, labels that were not reached, laws that
/// did not apply to any case.
std::string gaps_of(const Run& run, const std::vector<LawSummary>& rows) {
  std::string text;
  const auto add = [&text](const std::string& sentence) {
    text += fmt::format("<li>{}</li>\n", html(sentence));
  };
  for (const std::string& caveat : records::caveats(run)) add(caveat);
  for (const records::UnreachedLabel& label : run.unreached)
    add(records::unreached_sentence(label));
  for (const records::UnexpectedPass& pass : run.unexpected)
    add(records::unexpected_sentence(pass));
  // Laws with the same reasons share a line.
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> laws;
  for (const LawSummary& row : rows) {
    if (row.verdict != LawVerdict::not_checked) continue;
    const std::string why = reasons_text(row);
    laws[{row.backend, why.empty() ? "no case says anything of it" : why}].push_back(row.law);
  }
  for (const auto& [reason, names] : laws) {
    add(fmt::format("{} on {}: {}",
                    names.size() == 1 ? names[0] : counted(names.size(), "", "laws"), reason.first,
                    reason.second));
  }
  const std::uint64_t permitted = totals(rows).counts.permitted;
  if (permitted > 0) {
    add(counted(permitted, "sample was permitted either way: whatever was drawn is right",
                "samples were permitted either way: whatever was drawn is right"));
  }
  if (text.empty()) text = "<li>Nothing was left out.</li>\n";
  return "<section>\n<h2>Not checked</h2>\n<ul class=\"gaps\">\n" + text + "</ul>\n</section>\n";
}

/// The scene's result, with a preview of the drawing; empty if the run has no scene.
std::string scene_of(const Run& run) {
  if (run.scenes.empty()) return "";
  std::string text = "<section>\n<h2>The scene</h2>\n";
  for (const records::SceneResult& scene : run.scenes) {
    text += fmt::format("<p>{}</p>\n", html(records::scene_sentence(scene)));
  }
  if (!run.pictures.empty()) {
    text += fmt::format(
        "<div class=\"pictures\">\n{}</div>\n"
        "<p><a href=\"#{}\">All pictures, also of the errors</a></p>\n",
        picture_figure(run.pictures.front()), kPicturesLink);
  }
  return text + "</section>\n";
}

/// Says how to repeat the run, and what it ran on.
std::string again(const Run& run) {
  std::string text = fmt::format(
      "<section>\n<h2>To do it again</h2>\n<p><code>{}</code></p>\n<dl class=\"facts\">\n{}",
      html(run_command(run)), definition("seed", std::to_string(run.plan.seed)));
  for (const auto& [name, value] : run.environment) text += definition(html(name), html(value));
  return text + "</dl>\n</section>\n";
}

}  // namespace

std::string front_of(const Run& run, const std::vector<LawSummary>& rows) {
  const LawSummary total = totals(rows);
  return fmt::format(
             "<header>\n<p class=\"name\">RasterCheck</p>\n<h1 class=\"{}\">{}</h1>\n<p>{}</p>\n"
             "</header>\n",
             verdict_class(total.verdict), html(verdict_sentence(rows)), html(kJudgedSentence)) +
         run_figures(run, rows, total) +
         fmt::format("<p class=\"unit\">{}</p>\n", html(kUnitSentence)) +
         "<div class=\"front\">\n<section>\n<h2>Every law on " +
         (run.plan.backends.size() == 1 ? html(run.plan.backends[0])
                                        : std::string("every backend")) +
         "</h2>\n" + table_of(run, rows) +
         fmt::format("<p class=\"unit\">{}</p>\n", html(kExcessSentence)) + facts_of(total) +
         "</section>\n<aside>\n" + scene_of(run) + again(run) + thin_of(rows) + gaps_of(run, rows) +
         "</aside>\n</div>\n";
}

}  // namespace rastercheck::reports
