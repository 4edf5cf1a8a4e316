#include "reports/internal/compare_front.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "reports/internal/compare_entries.h"
#include "reports/internal/compare_growths.h"
#include "reports/internal/compare_wording.h"
#include "reports/internal/html.h"
#include "reports/internal/page.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

std::string counted_figure(std::string_view term, std::uint64_t number, std::string_view of) {
  return definition(term,
                    fmt::format("<strong>{}</strong> <small>{}</small>", grouped(number), of));
}

std::string front_figures(const records::Comparison& comparison) {
  const std::uint64_t worse = count_of(comparison, records::Change::worse);
  return "<dl class=\"figures\">\n" +
         counted_figure("worse", worse,
                        worse > 0 ? fmt::format("{} not allowed", grouped(refused(comparison)))
                                  : std::string("entries")) +
         counted_figure("better", count_of(comparison, records::Change::better), "entries") +
         counted_figure("the same", count_of(comparison, records::Change::same), "entries") +
         counted_figure("new", count_of(comparison, records::Change::appeared), "entries") +
         counted_figure("gone", count_of(comparison, records::Change::gone), "entries") +
         counted_figure("cases that grew", comparison.grown_cases,
                        fmt::format("of {}", grouped(comparison.compared_cases))) +
         "</dl>\n";
}

std::string largest_growth(const Gate& gate, std::size_t number) {
  const records::Comparison& comparison = gate.comparisons[number];
  if (comparison.growths.empty()) return "";
  const records::CaseGrowth& growth = comparison.growths.front();
  std::string text = fmt::format("<p class=\"finding\">Largest growth: <a href=\"#{}\">{}, {}</a>",
                                 growth_id(number, 0), html(growth.law), html(case_text(growth)));
  const auto part = part_to_look_at(gate, comparison, growth);
  const std::string stage =
      part ? fmt::format("; the stage to look at is <strong>{}</strong>", to_string(part->stage))
           : "";
  if (growth.after) {
    text += fmt::format(
        ": {}: <strong>{} → {} scale ULP</strong>{}", html(place_text(growth, *growth.after)),
        growth.before ? number_text(records::magnitude(growth.before->error)) : std::string("none"),
        number_text(records::magnitude(growth.after->error)), stage);
  }
  if (growth.outcome_after != growth.outcome_before) {
    text += fmt::format(": <strong>{} → {}</strong>", to_string(growth.outcome_before),
                        to_string(growth.outcome_after));
  }
  if (growth.mismatches_after > growth.mismatches_before) {
    text += fmt::format(": <strong>{} → {} wrong samples and values</strong>",
                        grouped(growth.mismatches_before), grouped(growth.mismatches_after));
  }
  text += ".</p>\n";
  const std::vector<std::string> stages = stage_lines(comparison, 1);
  if (!stages.empty()) {
    text += "<p class=\"finding\">Stage whose part grew most: " + html(stages.front()) + ".</p>\n";
  }
  return text;
}

std::string taken_text(const records::Taken& taken) {
  std::string text = html(taken.version.empty() ? "–" : taken.version);
  // Shortened as git does it; compare.json has the whole hash.
  constexpr std::size_t kShort = 12;
  if (!taken.commit.empty()) text += ", <code>" + html(taken.commit.substr(0, kShort)) + "</code>";
  for (const std::string& more : {taken.instruction_set, taken.compiler}) {
    if (!more.empty()) text += ", " + html(more);
  }
  return text;
}

std::string gate_facts(const Gate& gate, const records::Comparison& comparison) {
  std::string options;
  for (const std::string& word : records::option_words(comparison.plan)) options += " " + word;
  return "<dl class=\"facts\">\n" + definition("baseline", html(to_string(comparison.key))) +
         definition("of the file", "<code>" + html(gate.baseline_file) + "</code>") +
         definition("recorded with", taken_text(comparison.before)) +
         definition("now", html(comparison.backend)) +
         definition("of the file", "<code>" + html(gate.current_file) + "</code>") +
         definition("drawn with", taken_text(comparison.after)) +
         definition("seed", std::to_string(comparison.plan.seed)) +
         definition("cases per property", grouped(comparison.plan.cases_per_law)) +
         (options.empty() ? "" : definition("options", html(options.substr(1)))) + "</dl>\n";
}

}  // namespace

std::string compare_headline(const Gate& gate) {
  if (gate.comparisons.size() == 1) return verdict_sentence(gate.comparisons.front());
  const auto worse = static_cast<std::uint64_t>(
      std::count_if(gate.comparisons.begin(), gate.comparisons.end(),
                    [](const records::Comparison& comparison) { return refused(comparison) > 0; }));
  const std::string all = counted(gate.comparisons.size(), "backend", "backends");
  return worse > 0 ? fmt::format("Regression on {} of {}.", worse, all)
                   : fmt::format("No regression on {}.", all);
}

std::string compare_front(const Gate& gate, std::size_t number) {
  const records::Comparison& comparison = gate.comparisons[number];
  std::string text;
  if (gate.comparisons.size() > 1) {
    text += fmt::format("<h2 id=\"backend-{}\" class=\"{}\">{}</h2>\n", number,
                        refused(comparison) > 0 ? "violated" : "held",
                        html(verdict_sentence(comparison)));
  }
  text += front_figures(comparison) + largest_growth(gate, number) +
          fmt::format("<p>{}</p>\n", html(bits_sentence(comparison)));
  const std::string worse = worse_table(comparison, number);
  return text + "<div class=\"front\">\n<section>\n" +
         (worse.empty() ? "<p>No entry is worse than the baseline.</p>\n" : worse) +
         "</section>\n<aside>\n<h2>What was compared</h2>\n" + gate_facts(gate, comparison) +
         "<h2>To accept the new numbers</h2>\n<p><code>" + html(approve_command(gate)) +
         "</code></p>\n</aside>\n</div>\n";
}

std::string policy_section(const records::PolicyReview& review) {
  if (review.expired.empty() && review.unused.empty()) return "";
  std::string text = "<section>\n<h2>The policy</h2>\n<ul class=\"gaps\">\n";
  for (const std::string& line : review.expired) {
    text += "<li>Expired: " + html(line) + "</li>\n";
  }
  for (const std::string& line : review.unused) {
    text += "<li>Unused, so it can be removed: " + html(line) + "</li>\n";
  }
  return text + "</ul>\n</section>\n";
}

}  // namespace rastercheck::reports
