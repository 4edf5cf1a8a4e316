#include "cli/hunt_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>

#include "cases/json.h"
#include "cases/names.h"
#include "cli/terminal.h"
#include "records/enclosure.h"
#include "reports/commands.h"
#include "reports/counterexample_text.h"
#include "reports/text_table.h"

namespace rastercheck::cli {
namespace {

using nlohmann::ordered_json;
using properties::Guide;

/// Significant digits of errors in the table. Enclosures are far narrower.
constexpr int kDigits = 4;

std::string percent(double share) { return fmt::format("{:.2f}%", 100 * share); }

/// The size of an error: its digits that are certain.
std::string size_text(const records::Enclosure& error) {
  return records::to_decimal(records::magnitude(error), kDigits);
}

std::string number_text(const std::optional<double>& number) {
  return number ? fmt::format("{:.3g}", *number) : "–";
}

/// True for stages that decide where a triangle lies. Under a contract that leaves snapping open,
/// their parts count for nothing, and can be any size.
bool is_of_positions(records::Stage stage) {
  using records::Stage;
  return stage == Stage::transform || stage == Stage::clip_space || stage == Stage::snap ||
         stage == Stage::left_open;
}

/// The stage with the largest part of an error, and the part: "weights 3.9". Leaves out parts of
/// positions.
std::string stage_text(std::optional<records::ErrorSplit> split) {
  if (!split) return "–";
  std::erase_if(split->parts, [](const auto& part) { return is_of_positions(part.stage); });
  const auto largest = records::largest_part(*split);
  if (!largest) return "–";
  const auto part = std::find_if(split->parts.begin(), split->parts.end(),
                                 [&](const auto& one) { return one.stage == *largest; });
  return fmt::format("{} {}", records::to_string(*largest), size_text(part->error));
}

std::string found_text(const properties::HuntEntry& entry) {
  return fmt::format("step {}, {}", entry.step, cases::name_of(entry.made_by));
}

/// The guide's quantity of the worst case of a niche; "–" if the niche is empty.
std::string worst_text(const properties::HuntOutcome& outcome,
                       const properties::HuntArchive::Niche& niche, Guide guide) {
  const auto found = outcome.archive.niches().find(niche);
  if (found == outcome.archive.niches().end()) return "–";
  const double score = found->second.front().error.score(guide);
  return guide == Guide::share ? percent(score) : fmt::format("{:.4g}", score);
}

/// All niches in which the hunt or the sampling found something.
std::set<properties::HuntArchive::Niche> niches_of(const HuntResults& results) {
  std::set<properties::HuntArchive::Niche> niches;
  for (const auto& [niche, entries] : results.hunted.archive.niches()) niches.insert(niche);
  if (!results.sampled) return niches;
  for (const auto& [niche, entries] : results.sampled->archive.niches()) niches.insert(niche);
  return niches;
}

void print_table(const properties::HuntPlan& plan, const HuntResults& results, bool quiet) {
  std::vector<std::vector<std::string>> cells;
  if (!quiet) {
    cells.push_back({"value, stratum", "share of the bound", "excess", "bound", "error",
                     "condition", "mostly from", "found", "case"});
    if (results.sampled) cells.front().insert(cells.front().begin() + 2, "sampling");
  }
  for (const auto& niche : niches_of(results)) {
    std::vector<std::string> row{
        fmt::format("{}, {}", records::to_string(niche.kind), records::to_string(niche.stratum))};
    const auto trophy =
        std::find_if(results.trophies.begin(), results.trophies.end(), [&niche](const auto& one) {
          return one.entry.error.kind == niche.kind && one.entry.error.stratum == niche.stratum;
        });
    if (trophy == results.trophies.end()) {
      row.insert(row.end(), {"–", "–", "–", "–", "–", "–", "–", "–"});
    } else {
      const properties::HuntedError& error = trophy->entry.error;
      const auto place = static_cast<std::size_t>(trophy - results.trophies.begin());
      row.insert(row.end(), {error.share() ? percent(*error.share()) : "–", size_text(error.excess),
                             error.bound ? size_text(*error.bound) : "–",
                             error.ideal ? size_text(*error.ideal) : "–",
                             number_text(trophy->kappa), stage_text(trophy->split),
                             found_text(trophy->entry), results.trophy_files[place]});
    }
    if (results.sampled) {
      row.insert(row.begin() + 2, worst_text(*results.sampled, niche, plan.guide));
    }
    cells.push_back(std::move(row));
  }
  fmt::print("{}", reports::text_table(cells, quiet ? std::nullopt : terminal_columns()));
}

/// Prints counterexamples, each with the step that found it. The case of that step may be a changed
/// copy, which no random case equals.
void print_counterexamples(const HuntResults& results) {
  for (std::size_t i = 0; i < results.counterexamples.size(); ++i) {
    const records::Counterexample& one = results.counterexamples[i];
    fmt::print("\nFound in step {}: {}\n{}{}", one.source.found->index, one.source.found->verdict,
               reports::violations_text(one.violations, one.violation_count, terminal_columns()),
               reports::case_text(one.source));
    fmt::print("  Again: {}\n",
               reports::command_line({"rastercheck", "replay", results.counterexample_files[i]}));
  }
}

void print_counts(const properties::HuntPlan& plan, const HuntResults& results) {
  const properties::HuntOutcome& outcome = results.hunted;
  std::uint64_t left_out = 0;
  for (const auto& [why, count] : outcome.not_applicable_because) left_out += count;
  const auto source = [&outcome](properties::HuntSource of) {
    const auto found = outcome.sources.find(of);
    return found == outcome.sources.end() ? std::uint64_t{0} : found->second;
  };
  const std::uint64_t given = source(properties::HuntSource::given);
  fmt::print("\n{} of {} steps: {}{} random cases, {} of the corpus, {} moved; {} checked.\n",
             outcome.steps, plan.steps, given > 0 ? fmt::format("{} given cases, ", given) : "",
             source(properties::HuntSource::random), source(properties::HuntSource::corpus),
             source(properties::HuntSource::moved), outcome.checked);
  if (left_out > 0) fmt::print("Not checked: {} cases.\n", left_out);
  for (const auto& [why, count] : outcome.not_applicable_because) {
    fmt::print("  {}: {}\n", count, cases::printable(why));
  }
  if (outcome.known > 0) fmt::print("Violated in known ways only: {} cases.\n", outcome.known);
  if (outcome.not_of_case > 0) {
    fmt::print("Not compared, as the property measured them on changed cases: {} errors.\n",
               outcome.not_of_case);
  }
  fmt::print("{} cases violated the property in ways that are not known; counterexamples: {}.\n",
             outcome.violations, outcome.counterexamples.size());
  if (results.in_baseline) {
    fmt::print("{} of these worst cases added to {}; {} were there before.\n",
               results.in_baseline->added, results.in_baseline->file, results.in_baseline->there);
  }
  fmt::print("Seed {}.\n", plan.seed);
}

ordered_json json_of(const records::Enclosure& enclosure) {
  return ordered_json::array({enclosure.lo, enclosure.hi});
}

ordered_json json_of(const std::optional<records::Enclosure>& enclosure) {
  return enclosure ? json_of(*enclosure) : ordered_json();
}

ordered_json json_of(const std::optional<double>& number) {
  return number ? ordered_json(*number) : ordered_json();
}

ordered_json json_of(const properties::HuntEntry& entry) {
  const properties::HuntedError& error = entry.error;
  return {{"kind", records::to_string(error.kind)},
          {"stratum", records::to_string(error.stratum)},
          {"share", json_of(error.share())},
          {"excess", json_of(error.excess)},
          {"bound", json_of(error.bound)},
          {"error", json_of(error.ideal)},
          {"exact", error.exact},
          {"actual", error.actual},
          {"triangle_y_x_sample", {error.at.triangle, error.at.y, error.at.x, error.at.sample}},
          {"attribute", error.attribute ? ordered_json(*error.attribute) : ordered_json()},
          {"step", entry.step},
          {"made_by", cases::name_of(entry.made_by)},
          {"moves", entry.moves}};
}

ordered_json json_of(const properties::HuntTrophy& trophy, const std::string& file) {
  ordered_json json = json_of(trophy.entry);
  json["kappa"] = json_of(trophy.kappa);
  json["kappa_d"] = json_of(trophy.kappa_d);
  json["stages"] = ordered_json::array();
  if (trophy.split) {
    for (const records::StagePart& part : trophy.split->parts) {
      json["stages"].push_back(
          {{"stage", records::to_string(part.stage)}, {"error", json_of(part.error)}});
    }
  }
  json["is_least"] = trophy.shrinking && trophy.shrinking->is_least;
  json["errs_again"] = trophy.errs_again;
  json["file"] = file;
  return json;
}

/// Counts of an outcome, and the worst entry of each niche as it was found.
ordered_json json_of(const properties::HuntOutcome& outcome) {
  ordered_json sources;
  for (const auto& [source, count] : outcome.sources) {
    sources[std::string(cases::name_of(source))] = count;
  }
  ordered_json moves;
  for (const auto& [name, counts] : outcome.moves) {
    moves[std::string(name)] = {{"made", counts.made}, {"kept", counts.kept}};
  }
  ordered_json worst = ordered_json::array();
  for (const auto& [niche, entries] : outcome.archive.niches()) {
    worst.push_back(json_of(entries.front()));
  }
  return {{"steps", outcome.steps},
          {"sources", sources},
          {"checked", outcome.checked},
          {"not_applicable", outcome.not_applicable_because},
          {"known", outcome.known},
          {"not_compared", outcome.not_of_case},
          {"violations", outcome.violations},
          {"moves", moves},
          {"worst", worst}};
}

}  // namespace

void print_hunt_json(const properties::HuntPlan& plan, const HuntResults& results) {
  ordered_json document{{"format", "rastercheck-hunt"},
                        {"version", 1},
                        {"property", plan.law},
                        {"backend", plan.backend},
                        {"seed", plan.seed},
                        {"guide", cases::name_of(plan.guide)},
                        {"hunted", json_of(results.hunted)},
                        {"sampled", nullptr},
                        {"worst", ordered_json::array()},
                        {"counterexamples", ordered_json::array()}};
  if (results.sampled) document["sampled"] = json_of(*results.sampled);
  for (std::size_t i = 0; i < results.trophies.size(); ++i) {
    document["worst"].push_back(json_of(results.trophies[i], results.trophy_files[i]));
  }
  for (std::size_t i = 0; i < results.counterexamples.size(); ++i) {
    document["counterexamples"].push_back(
        {{"step", results.counterexamples[i].source.found->index},
         {"verdict", results.counterexamples[i].source.found->verdict},
         {"file", results.counterexample_files[i]}});
  }
  if (results.in_baseline) {
    document["baseline"] = {{"file", results.in_baseline->file},
                            {"added", results.in_baseline->added},
                            {"there", results.in_baseline->there}};
  }
  fmt::print("{}\n", document.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
}

void print_hunt(const properties::HuntPlan& plan, const HuntResults& results, bool quiet) {
  print_table(plan, results, quiet);
  if (quiet) return;
  if (niches_of(results).empty()) {
    fmt::print("No value with an error was found for which the backend promises a bound.\n");
  }
  for (const properties::HuntTrophy& trophy : results.trophies) {
    if (trophy.errs_again) continue;
    fmt::print("The case of step {} did not err as much when it was drawn again.\n",
               trophy.entry.step);
  }
  print_counterexamples(results);
  print_counts(plan, results);
}

}  // namespace rastercheck::cli
