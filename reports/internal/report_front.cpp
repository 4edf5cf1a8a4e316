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

/// Explains the terms in the table.
constexpr std::string_view kJudgedSentence =
    "Each property was checked on many small drawings (cases). Samples and values were compared "
    "with the exact answer wherever the contract promises one.";

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

/// The largest errors of a backend's rows.
struct BackendFigures {
  std::string backend;
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

/// The verdicts of a backend as signs and words.
std::string verdicts_of(const Run& run, const std::vector<LawSummary>& rows,
                        std::string_view backend) {
  std::string text;
  for (const VerdictCount& count : verdict_counts(run, rows, backend)) {
    text +=
        fmt::format("{}<span class=\"{}\">{} {}</span>", text.empty() ? "" : ", ",
                    verdict_class(count.verdict), verdict_sign(count.verdict), html(count.text));
  }
  return text;
}

/// The result of each backend, if there are several.
std::string backends_table(const Run& run, const std::vector<LawSummary>& rows) {
  std::string text =
      "<table class=\"backends\">\n<thead><tr><th>backend</th><th>verdict</th>"
      "<th class=\"number\">worst error<br><small>scale ULP</small></th>"
      "<th class=\"number\">p99 error<br><small>largest of all</small></th>"
      "<th class=\"number\">after allowances<br><small>scale "
      "ULP</small></th></tr></thead>\n<tbody>\n";
  for (const BackendFigures& of : by_backend(run, rows)) {
    text += "<tr>" + cell(html(of.backend)) + cell(verdicts_of(run, rows, of.backend)) +
            number_cell("worst error", number_text(of.worst)) +
            number_cell("p99 error", at_most_text(of.p99)) +
            number_cell("after allowances", number_text(of.excess)) + "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

/// The most important figures, in large type.
std::string run_figures(const Run& run, const std::vector<LawSummary>& rows,
                        const LawSummary& total) {
  const records::Counts& counts = total.counts;
  std::string text =
      "<dl class=\"figures\">\n" +
      figure("cases checked", grouped(total.cases.checked), "of all properties") +
      figure("samples judged", grouped(counts.required + counts.forbidden + counts.permitted),
             fmt::format("{} undecided", grouped(counts.undecided)));
  const std::vector<BackendFigures> all = by_backend(run, rows);
  if (all.size() == 1) {
    text += figure("worst error", number_text(all[0].worst), "scale ULP") +
            figure("p99 error", at_most_text(all[0].p99), "scale ULP, the largest of a property") +
            figure("after allowances", number_text(all[0].excess),
                   "scale ULP, the worst; also of values with no single exact answer");
  }
  return text + "</dl>\n";
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

/// " on cpu"; empty if the run has no other backend.
std::string on_text(const Run& run, const std::string& backend) {
  return run.plan.backends.size() == 1 ? "" : " on " + backend;
}

/// Lists laws that held, but on too few cases to say much; empty if there are none.
std::string thin_of(const Run& run, const std::vector<LawSummary>& rows) {
  std::string text;
  for (const LawSummary& row : rows) {
    if (row.verdict != LawVerdict::thin) continue;
    const std::string why = reasons_text(row);
    text += fmt::format("<li>{}</li>\n",
                        html(fmt::format("{}{}: {}{}", row.law, on_text(run, row.backend),
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
    laws[{row.backend, why.empty() ? "no case was made for it" : why}].push_back(row.law);
  }
  std::string reasons;
  std::size_t unchecked = 0;
  for (const auto& [reason, names] : laws) {
    reasons += fmt::format(
        "<li>{}</li>\n",
        html(fmt::format("{}{}: {}",
                         names.size() == 1 ? names[0] : counted(names.size(), "", "properties"),
                         on_text(run, reason.first), reason.second)));
    unchecked += names.size();
  }
  constexpr std::size_t kMostShown = 6;
  if (laws.size() > kMostShown) {
    // All of them would be longer than what is wrong.
    reasons = fmt::format(
        "<li><details><summary>{}, for {} reasons</summary>\n<ul>\n{}</ul>\n</details></li>\n",
        counted(unchecked, "property", "properties"), laws.size(), reasons);
  }
  text += reasons;
  const std::uint64_t permitted = totals(rows).counts.permitted;
  if (permitted > 0) {
    add(counted(permitted, "sample", "samples") +
        " may be drawn or not, as the contract leaves it open");
  }
  if (text.empty()) text = "<li>Nothing was left out.</li>\n";
  return "<section>\n<h2>Not checked</h2>\n<ul class=\"gaps\">\n" + text + "</ul>\n</section>\n";
}

/// The known defects that a run saw, each with its reason; empty if there are none.
std::string known_ways(const Run& run) {
  std::string text;
  for (const records::KnownSummary& known : records::known_defects(run)) {
    if (known.cases == 0) continue;
    text += fmt::format("<li>{} <small>({}, {})</small></li>\n", html(known.entry.reason),
                        html(known.entry.id), counted(known.cases, "case", "cases"));
  }
  return text.empty() ? "" : "<p>Known defects that it shows:</p>\n<ul>\n" + text + "</ul>\n";
}

/// Names what was judged: backends, cases, scene.
std::string judged_of(const Run& run) {
  std::string text;
  for (const std::string& backend : run.plan.backends) {
    text += fmt::format("{}<b>{}</b>", text.empty() ? "" : ", ", html(backend));
    const auto drawn_by = run.environment.find(records::drawn_by_key(backend));
    if (drawn_by != run.environment.end()) text += fmt::format(" ({})", html(drawn_by->second));
  }
  text +=
      fmt::format(" · {} of each property, seed {}",
                  counted(run.plan.cases_per_law, "random case", "random cases"), run.plan.seed);
  if (!run.plan.scene.empty()) text += " · scene " + html(run.plan.scene);
  return text;
}

std::string_view mood_class(Mood mood) {
  switch (mood) {
    case Mood::good:
      return "held";
    case Mood::mixed:
      return "mixed";
    case Mood::bad:
      break;
  }
  return "violated";
}

}  // namespace

std::string front_of(const Run& run, const std::vector<LawSummary>& rows) {
  std::string text = fmt::format(
      "<header>\n<p class=\"name\">RasterCheck</p>\n<h1 class=\"{}\">{}</h1>\n"
      "<p class=\"judged\">{}</p>\n",
      mood_class(mood_of(rows)), html(headline(run, rows)), judged_of(run));
  if (run.plan.backends.size() == 1) {
    text += fmt::format("<p>{}</p>\n", verdicts_of(run, rows, run.plan.backends[0]));
  } else {
    text += backends_table(run, rows);
  }
  return text + known_ways(run) + "</header>\n";
}

std::string scene_section(const Run& run) {
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

std::string judged_section(const Run& run, const std::vector<LawSummary>& rows) {
  const LawSummary total = totals(rows);
  return fmt::format("<section>\n<h2>What was judged</h2>\n<p class=\"unit\">{}</p>\n",
                     html(kJudgedSentence)) +
         run_figures(run, rows, total) +
         fmt::format("<p class=\"unit\">{}</p>\n", html(kUnitSentence)) + facts_of(total) +
         "</section>\n";
}

std::string gaps_section(const Run& run, const std::vector<LawSummary>& rows) {
  return thin_of(run, rows) + gaps_of(run, rows);
}

std::string again_section(const Run& run) {
  std::string text = fmt::format(
      "<section>\n<h2>To repeat this run</h2>\n<p><code>{}</code></p>\n<dl class=\"facts\">\n",
      html(run_command(run)));
  for (const auto& [name, value] : run.environment) text += definition(html(name), html(value));
  return text + "</dl>\n</section>\n";
}

}  // namespace rastercheck::reports
