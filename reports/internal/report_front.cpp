#include "reports/internal/report_front.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "records/share.h"
#include "reports/commands.h"
#include "reports/internal/html.h"
#include "reports/internal/page.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::Enclosure;
using records::LawSummary;
using records::LawVerdict;
using records::Run;

/// What asks for a look comes first; else the order of the laws.
std::vector<LawSummary> by_urgency(std::vector<LawSummary> rows) {
  const auto rank = [](const LawSummary& row) {
    switch (row.verdict) {
      case LawVerdict::violated:
        return 0;
      case LawVerdict::known:
        return 1;
      case LawVerdict::not_checked:
        return 2;
      case LawVerdict::held:
        break;
    }
    return 3;
  };
  std::stable_sort(rows.begin(), rows.end(),
                   [&rank](const LawSummary& a, const LawSummary& b) { return rank(a) < rank(b); });
  return rows;
}

std::string table_of(const std::vector<LawSummary>& rows) {
  std::string text =
      "<table class=\"verdicts sortable\">\n<thead><tr><th>law</th><th>backend</th>"
      "<th>verdict</th><th class=\"number\">worst<br><small>scale ULP</small></th>"
      "<th class=\"number\">p99<br><small>scale ULP</small></th>"
      "<th class=\"number\">beyond<br>contract<br><small>scale ULP</small></th>"
      "<th class=\"number\">cases</th><th class=\"number\">fragments</th></tr></thead>\n<tbody>\n";
  for (const LawSummary& row : by_urgency(rows)) {
    const std::string law = fmt::format("<a href=\"#{}\">{}</a>", law_link(row.law), html(row.law));
    text += "<tr>" + cell(law) + cell(html(row.backend)) + cell(verdict_mark(row)) +
            number_cell("worst ULP", number_text(row.ideal.worst)) +
            number_cell("p99 ULP", at_most_text(row.ideal.p99)) +
            number_cell("beyond contract", number_text(row.excess.worst)) +
            number_cell("cases", grouped(row.cases.checked)) +
            number_cell("fragments", grouped(row.fragments)) + "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
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

/// The row whose errors are largest in a sense; nullptr where none has any.
template <typename SizeOf>
const LawSummary* greatest(const std::vector<LawSummary>& rows, const SizeOf& size_of) {
  const LawSummary* found = nullptr;
  for (const LawSummary& row : rows) {
    const std::optional<Enclosure> size = size_of(row);
    if (size && (found == nullptr || size->hi > size_of(*found)->hi)) found = &row;
  }
  return found;
}

std::string figure(std::string_view term, const std::string& number, const std::string& of) {
  return definition(term, fmt::format("<strong>{}</strong> <small>{}</small>", number, of));
}

/// The figures that a reader wants first, large.
std::string figures_of(const std::vector<LawSummary>& rows, const LawSummary& total) {
  const records::Counts& counts = total.counts;
  const auto worst_of = [](const LawSummary& row) { return row.ideal.worst; };
  const auto p99_of = [](const LawSummary& row) { return row.ideal.p99; };
  std::string text =
      "<dl class=\"figures\">\n" +
      figure("cases checked", grouped(total.cases.checked),
             counted(rows.size(), "check", "checks")) +
      figure("samples judged", grouped(counts.required + counts.forbidden + counts.permitted),
             counted(counts.undecided, "undecided", "undecided"));
  if (const LawSummary* row = greatest(rows, worst_of)) {
    text +=
        figure("worst error", number_text(row->ideal.worst), "scale ULP, " + html(row->backend));
  }
  if (const LawSummary* row = greatest(rows, p99_of)) {
    text += figure("p99 error", at_most_text(row->ideal.p99), "scale ULP, " + html(row->backend));
  }
  return text + "</dl>\n";
}

std::string facts_of(const LawSummary& total) {
  const records::Counts& counts = total.counts;
  return "<dl class=\"facts\">\n" + definition("fragments checked", grouped(total.fragments)) +
         definition("samples", fmt::format("{} required, {} forbidden, {} permitted, {} undecided",
                                           grouped(counts.required), grouped(counts.forbidden),
                                           grouped(counts.permitted), grouped(counts.undecided))) +
         levels_of(total) + "</dl>\n";
}

/// What was not done: cases that were not checked, labels that were not reached, laws that say
/// nothing of what there was.
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
  for (const LawSummary& row : rows) {
    if (row.verdict != LawVerdict::not_checked || !row.unreached.empty()) continue;
    const std::string why = records::why_not_checked(row);
    add(fmt::format("{} on {}: {}", row.law, row.backend,
                    why.empty() ? "no case says anything of it" : why));
  }
  const std::uint64_t permitted = totals(rows).counts.permitted;
  if (permitted > 0) {
    add(counted(permitted, "sample was permitted either way: whatever was drawn is right",
                "samples were permitted either way: whatever was drawn is right"));
  }
  if (text.empty()) text = "<li>Nothing was left out.</li>\n";
  return "<section>\n<h2>Not checked</h2>\n<ul class=\"gaps\">\n" + text + "</ul>\n</section>\n";
}

/// How to do it again, and what it was done with.
std::string again(const Run& run) {
  std::string text = fmt::format(
      "<section>\n<h2>To do it again</h2>\n<p><code>{}</code></p>\n<dl class=\"facts\">\n{}",
      html(run_command(run)), definition("seed", std::to_string(run.seed)));
  for (const auto& [name, value] : run.environment) text += definition(html(name), html(value));
  return text + "</dl>\n</section>\n";
}

}  // namespace

std::string front_of(const Run& run, const std::vector<LawSummary>& rows) {
  const LawSummary total = totals(rows);
  return fmt::format(
             "<header>\n<p class=\"name\">RasterCheck</p>\n<h1 class=\"{}\">{}</h1>\n</header>\n",
             verdict_class(total.verdict), html(verdict_sentence(rows))) +
         figures_of(rows, total) + fmt::format("<p class=\"unit\">{}</p>\n", html(kUnitSentence)) +
         "<div class=\"front\">\n<aside>\n" + gaps_of(run, rows) + again(run) +
         "</aside>\n<section>\n<h2>Every law on every backend</h2>\n" + table_of(rows) +
         fmt::format("<p class=\"unit\">{}</p>\n", html(kExcessSentence)) + facts_of(total) +
         "</section>\n</div>\n";
}

}  // namespace rastercheck::reports
