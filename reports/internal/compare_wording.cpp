#include "reports/internal/compare_wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cases/float_text.h"
#include "cases/json.h"
#include "records/share.h"
#include "reports/commands.h"
#include "reports/internal/exact_text.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::Enclosure;

constexpr int kErrorDigits = 6;
constexpr int kMostDigits = 17;  // enough to tell any two doubles apart

/// The certain digits of both sizes, with enough digits to differ.
OldAndNew sizes_text(const Enclosure& before, const Enclosure& after) {
  OldAndNew texts;
  for (int digits = kErrorDigits; digits <= kMostDigits; ++digits) {
    texts = {records::to_decimal(before, digits), records::to_decimal(after, digits)};
    if (texts.before != texts.after || before == after) return texts;
  }
  const auto ends = [](const Enclosure& one) { return fmt::format("[{}, {}]", one.lo, one.hi); };
  return {ends(before), ends(after)};
}

/// The old error is "none" if no nonzero error is known for the baseline. It need not have been 0:
/// laws that draw twice judge values only where the drawings differ.
OldAndNew old_and_new_errors(const records::CaseGrowth& growth, const records::WorstError& after) {
  const Enclosure is = records::magnitude(after.error);
  if (!growth.before) return {"none", records::to_decimal(is, kErrorDigits)};
  return sizes_text(records::magnitude(growth.before->error), is);
}

OldAndNew shares_text(const records::FigureValue& before, const records::FigureValue& after) {
  const auto text = [](const records::FigureValue& value) {
    return fmt::format("{} ({} of {})", records::share_text(value.count, value.of),
                       grouped(value.count), grouped(value.of));
  };
  return {text(before), text(after)};
}

bool is_size(records::Figure figure) {
  return figure == records::Figure::worst || figure == records::Figure::p50 ||
         figure == records::Figure::p99 || figure == records::Figure::p999;
}

bool is_share(records::Figure figure) {
  return figure == records::Figure::misrounded || figure == records::Figure::not_judged;
}

std::string actual_value_text(const records::WorstError& worst) {
  return fmt::format("{:.9g} ({})", worst.actual, cases::to_hex(worst.actual));
}

bool is_same_place(const records::WorstError& a, const records::WorstError& b) {
  return a.place.triangle == b.place.triangle && a.place.x == b.place.x && a.place.y == b.place.y &&
         a.place.sample == b.place.sample && a.attribute == b.attribute;
}

/// A run with the settings of the current side, for making commands.
records::Run as_run(const records::Comparison& comparison) {
  records::Run run;
  run.plan = comparison.plan;
  run.plan.backends = {comparison.backend};
  return run;
}

std::string counted_entries(std::uint64_t number) { return counted(number, "entry", "entries"); }

}  // namespace

std::string verdict_sentence(const records::Comparison& comparison) {
  const std::uint64_t worse = count_of(comparison, records::Change::worse);
  const std::uint64_t refused_ones = refused(comparison);
  std::string text =
      refused_ones > 0
          ? fmt::format("Regression: {} of {} worse than the baseline of {}", refused_ones,
                        counted_entries(comparison.entries.size()), to_string(comparison.key))
          : fmt::format("No regression: {} compared with the baseline of {}",
                        counted_entries(comparison.entries.size()), to_string(comparison.key));
  std::string rest;
  const auto add = [&rest](std::uint64_t number, std::string_view what) {
    if (number == 0) return;
    rest += fmt::format("{}{} {}", rest.empty() ? "" : ", ", grouped(number), what);
  };
  add(worse - refused_ones, "worse, but allowed");
  add(count_of(comparison, records::Change::better), "better");
  add(count_of(comparison, records::Change::appeared), "new");
  add(count_of(comparison, records::Change::gone), "gone");
  add(count_of(comparison, records::Change::same), "the same");
  return text + (rest.empty() ? "." : "; " + rest + ".");
}

std::string bits_sentence(const records::Comparison& comparison) {
  if (comparison.changed_cases == 0) {
    return fmt::format("All {} drew the same bits.",
                       counted(comparison.compared_cases, "case", "cases"));
  }
  std::string text = fmt::format(
      "{} of {} drew different bits; errors grew in {}.", grouped(comparison.changed_cases),
      counted(comparison.compared_cases, "case", "cases"), grouped(comparison.grown_cases));
  if (count_of(comparison, records::Change::worse) == 0 &&
      count_of(comparison, records::Change::better) == 0) {
    text += " No number changed, so this is not a regression.";
  }
  return text;
}

OldAndNew figure_texts(const records::FigureChange& change) {
  const auto& [figure, fragment_class, how, before, after] = change;
  if (is_share(figure)) return shares_text(before, after);
  if (!is_size(figure)) return {grouped(before.count), grouped(after.count)};
  const Enclosure was = before.size.value_or(Enclosure());
  const Enclosure is = after.size.value_or(Enclosure());
  if (figure == records::Figure::worst) return sizes_text(was, is);
  return {at_most_text(was), at_most_text(is)};
}

std::string figure_sentence(const records::FigureChange& change) {
  const OldAndNew texts = figure_texts(change);
  return fmt::format("{} {} → {}{}", figure_name(change), texts.before, texts.after,
                     is_size(change.figure) ? " ULP" : "");
}

std::string case_text(const records::CaseGrowth& growth) {
  if (growth.origin == records::Origin::random) return fmt::format("random case {}", growth.index);
  constexpr std::size_t kLongestName = 50;
  return fmt::format("case {} of the corpus, “{}”", growth.index,
                     cases::printable(elided(growth.name, kLongestName)));
}

std::string place_text(const records::CaseGrowth& growth, const records::WorstError& at) {
  std::string text;
  if (growth.kind) text += fmt::format("{}, ", to_string(*growth.kind));
  if (growth.stratum) text += fmt::format("{}, ", to_string(*growth.stratum));
  text += fmt::format("triangle {}, pixel ({}, {}), sample {}", at.place.triangle, at.place.x,
                      at.place.y, at.place.sample);
  if (at.attribute) text += fmt::format(", attribute {}", *at.attribute);
  return text;
}

std::vector<std::string> growth_lines(const records::CaseGrowth& growth) {
  constexpr std::size_t kLongestFraction = 40;
  std::vector<std::string> lines;
  if (growth.after) {
    const OldAndNew sizes = old_and_new_errors(growth, *growth.after);
    lines.push_back(place_text(growth, *growth.after));
    lines.push_back(fmt::format("error {} → {} ULP", sizes.before, sizes.after));
    if (!growth.after->exact.empty()) {
      lines.push_back("exact " + exact_text(growth.after->exact, kLongestFraction));
    }
    lines.push_back("now   " + actual_value_text(*growth.after));
  }
  if (growth.after && growth.before) {
    std::string was = "then  " + actual_value_text(*growth.before);
    if (!is_same_place(*growth.before, *growth.after)) {
      was +=
          fmt::format(", at triangle {}, pixel ({}, {}), sample {}", growth.before->place.triangle,
                      growth.before->place.x, growth.before->place.y, growth.before->place.sample);
    }
    lines.push_back(was);
  }
  if (growth.outcome_before != growth.outcome_after) {
    lines.push_back(fmt::format("{}{} → {}", kOutcomeLine, to_string(growth.outcome_before),
                                to_string(growth.outcome_after)));
  }
  if (growth.mismatches_before != growth.mismatches_after) {
    lines.push_back(fmt::format("{}{} → {}", kMismatchesLine, grouped(growth.mismatches_before),
                                grouped(growth.mismatches_after)));
  }
  return lines;
}

const records::CloserLook* find_look(const Gate& gate, const records::Comparison& comparison,
                                     const records::CaseGrowth& growth) {
  const records::CaseKey key{growth.law, comparison.backend, growth.origin, growth.index};
  const auto look =
      std::find_if(gate.looks.begin(), gate.looks.end(), [&](const records::CloserLook& one) {
        return growth.kind && one.key == key && one.kind == growth.kind &&
               one.stratum == growth.stratum;
      });
  return look == gate.looks.end() ? nullptr : &*look;
}

std::optional<records::StagePart> part_to_look_at(const Gate& gate,
                                                  const records::Comparison& comparison,
                                                  const records::CaseGrowth& growth) {
  const auto size = [](const records::StagePart& part) {
    return part.stage == records::Stage::rounding ? 0 : records::magnitude_bound(part.error);
  };
  std::optional<records::StagePart> largest;
  const records::CloserLook* look = find_look(gate, comparison, growth);
  if (look == nullptr) return largest;
  for (const records::ErrorSplit& split : look->inspection.splits) {
    if (split.attribute != look->inspection.attribute || !split.is_traced) continue;
    for (const records::StagePart& part : split.parts) {
      if (size(part) > (largest ? size(*largest) : 0)) largest = part;
    }
  }
  return largest;
}

std::vector<std::string> stage_lines(const records::Comparison& comparison, std::size_t most) {
  struct Line {
    double growth;
    std::string text;
  };
  std::vector<Line> lines;
  for (const records::EntryChange& entry : comparison.entries) {
    for (const records::StageChange& stage : entry.stages) {
      if (stage.stage != entry.grown_stage || !stage.mean_after) continue;
      const Enclosure before = stage.mean_before.value_or(Enclosure());
      const auto percent = [](const std::optional<double>& share) {
        return share ? fmt::format("{:.3g}%", *share * 100) : std::string("0%");
      };
      lines.push_back(
          {growth_of(stage),
           fmt::format("{}, {}: {}, mean {} → {} ULP, {} → {} of all parts",
                       to_string(entry.key.kind),
                       entry.key.stratum ? to_string(*entry.key.stratum) : "all strata",
                       to_string(stage.stage), mean_text(before), mean_text(stage.mean_after),
                       percent(stage.share_before), percent(stage.share_after))});
    }
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Line& a, const Line& b) { return a.growth > b.growth; });
  if (lines.size() > most) lines.resize(most);
  std::vector<std::string> texts;
  texts.reserve(lines.size());
  for (Line& line : lines) texts.push_back(std::move(line.text));
  return texts;
}

std::vector<std::string> growth_commands(const Gate& gate, const records::Comparison& comparison,
                                         const records::CaseGrowth& growth) {
  if (gate.folder.empty()) return {};
  const std::string file =
      (std::filesystem::path(gate.folder) / file_of(comparison, growth)).string();
  const records::Run run = as_run(comparison);
  std::vector<std::string> commands{replay_command(run, file)};
  if (growth.after) commands.push_back(explain_command(run, file, *growth.after));
  return commands;
}

std::string approve_command(const Gate& gate) {
  std::vector<std::string> words{"rastercheck", "baseline",         "approve",        "--reason",
                                 "…",           gate.baseline_file, gate.current_file};
  for (const records::Comparison& comparison : gate.comparisons) {
    if (comparison.key.backend == records::section_name(comparison.backend)) continue;
    words.insert(words.end(), {"--as", comparison.key.backend});
  }
  return command_line(words);
}

}  // namespace rastercheck::reports
