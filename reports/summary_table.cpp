#include "reports/summary_table.h"

#include <fmt/color.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "cases/json.h"
#include "records/enclosure_json.h"
#include "records/share.h"
#include "records/side_by_side.h"
#include "reports/internal/wording.h"
#include "reports/text_table.h"

namespace rastercheck::reports {
namespace {

using records::LawVerdict;

nlohmann::ordered_json enclosure_json(const std::optional<records::Enclosure>& enclosure) {
  if (!enclosure) return nullptr;
  return cases::json_of(*enclosure);
}

nlohmann::ordered_json sizes_json(const records::SizeSummary& sizes) {
  return {{"values", sizes.values},
          {"worst", enclosure_json(sizes.worst)},
          {"p99", enclosure_json(sizes.p99)}};
}

nlohmann::ordered_json precision_json(const records::Precision& precision) {
  nlohmann::ordered_json json{{"kind", to_string(precision.kind)},
                              {"stratum", nullptr},
                              {"values", precision.values},
                              {"min", enclosure_json(precision.min)},
                              {"max", enclosure_json(precision.max)},
                              {"mean", enclosure_json(precision.mean)},
                              {"p50", enclosure_json(precision.p50)},
                              {"p99", enclosure_json(precision.p99)},
                              {"p99.9", enclosure_json(precision.p999)},
                              {"misrounded", precision.misrounded}};
  if (precision.stratum) json["stratum"] = to_string(*precision.stratum);
  return json;
}

nlohmann::ordered_json precision_json(const std::vector<records::Precision>& rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const records::Precision& row : rows) json.push_back(precision_json(row));
  return json;
}

nlohmann::ordered_json judged_json(const records::Judged& judged) {
  return {{"asked", judged.asked},
          {"applicable", judged.applicable},
          {"fragments", judged.fragments},
          {"values", judged.values},
          {"not_judged", judged.not_judged}};
}

nlohmann::ordered_json power_json(const records::Power& power) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [defect, noticed] : power) {
    json[std::string(to_string(defect))] = {{"drawings", noticed.drawings},
                                            {"noticed", noticed.noticed}};
  }
  return json;
}

fmt::text_style style_of(LawVerdict verdict) {
  switch (verdict) {
    case LawVerdict::violated:
      return fmt::fg(fmt::terminal_color::red) | fmt::emphasis::bold;
    case LawVerdict::known:
    case LawVerdict::thin:
      return fmt::fg(fmt::terminal_color::yellow);
    case LawVerdict::held:
      return fmt::fg(fmt::terminal_color::green);
    case LawVerdict::not_checked:
      break;
  }
  return {};
}

nlohmann::ordered_json levels_json(const records::LevelCounts& levels) {
  return {{"filter", levels.filter}, {"interval", levels.interval}, {"exact", levels.exact}};
}

nlohmann::ordered_json side_by_side_json(const records::SideBySide& pair) {
  const auto counts_json = [](const records::SideCounts& counts) {
    return nlohmann::ordered_json{{"both_right", counts.both_right},
                                  {"only_first_right", counts.only_first_right},
                                  {"only_second_right", counts.only_second_right},
                                  {"neither_right", counts.neither_right}};
  };
  nlohmann::ordered_json json{{"first", pair.first},
                              {"second", pair.second},
                              {"judged_first", pair.judged_first},
                              {"judged_second", pair.judged_second},
                              {"same_cases", pair.counts.cases()},
                              {"known_first", pair.known_first},
                              {"known_second", pair.known_second}};
  json.update(counts_json(pair.counts));
  json["properties"] = nlohmann::ordered_json::object();
  for (const records::SideBySideLaw& law : pair.laws)
    json["properties"][law.law] = counts_json(law.counts);
  return json;
}

}  // namespace

std::string summary_table(const std::vector<records::LawSummary>& rows, bool quiet,
                          std::optional<std::size_t> columns) {
  std::vector<std::vector<std::string>> cells;
  if (!quiet) {
    cells.push_back({"property", "backend", "cases", "fragments", "not judged", "worst ULP",
                     "p99 ULP", "after allowances", "verdict"});
  }
  for (const records::LawSummary& row : rows) {
    cells.push_back({row.law, row.backend, std::to_string(row.cases.checked),
                     std::to_string(row.judged.fragments), not_judged_share(row.judged),
                     number_text(row.ideal.worst), at_most_text(row.ideal.p99),
                     number_text(row.excess.worst),
                     row.verdict == LawVerdict::known || row.verdict == LawVerdict::thin
                         ? verdict_text(row)
                         : std::string(to_string(row.verdict))});
  }
  return quiet ? text_table(cells) : text_table(cells, columns);
}

std::vector<records::LawSummary> notable_rows(const std::vector<records::LawSummary>& rows) {
  std::vector<records::LawSummary> notable;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(notable), [](const auto& row) {
    return row.verdict != LawVerdict::held && row.verdict != LawVerdict::not_checked;
  });
  return notable;
}

std::string verdict_lines(const records::Run& run, const std::vector<records::LawSummary>& rows,
                          bool has_color) {
  std::string lines;
  for (const std::string& backend : run.plan.backends) {
    std::string line;
    for (const VerdictCount& count : verdict_counts(run, rows, backend)) {
      if (!line.empty()) line += ", ";
      line += has_color ? fmt::format(style_of(count.verdict), "{}", count.text) : count.text;
    }
    if (!line.empty()) lines += fmt::format("{}: {}.\n", cases::printable(backend), line);
  }
  return lines;
}

std::string summary_counts(const std::vector<records::LawSummary>& rows) {
  const records::LawSummary total = totals(rows);
  const records::Counts& counts = total.counts;
  const std::string decided = records::decided_sentence(total.levels, counts.undecided);
  return fmt::format("Samples: {} required, {} forbidden, {} permitted, {} undecided.\n",
                     counts.required, counts.forbidden, counts.permitted, counts.undecided) +
         (decided.empty() ? "" : decided + "\n");
}

std::string known_text(const records::Run& run) {
  std::map<std::string, std::string> by_backend;
  for (const records::KnownSummary& known : records::known_defects(run)) {
    if (known.cases == 0) continue;
    std::string& text = by_backend[known.backend];
    text += fmt::format("{}{} in {}", text.empty() ? "" : "; ", known.entry.id,
                        counted(known.cases, "case", "cases"));
  }
  std::string all;
  for (const auto& [backend, text] : by_backend) {
    all += fmt::format("Known defects of {}: {}.\n", backend, text);
  }
  return all;
}

std::string not_judged_text(const std::vector<records::LawSummary>& rows) {
  std::map<std::string, records::Judged> by_backend;
  for (const records::LawSummary& row : rows) records::merge(by_backend[row.backend], row.judged);
  std::string all;
  for (const auto& [backend, judged] : by_backend) {
    if (judged.not_judged.empty()) continue;
    all += fmt::format("Not judged on {}: {} of the fragments and values of all properties, {}.\n",
                       cases::printable(backend), not_judged_share(judged),
                       records::not_judged_words(judged));
  }
  return all;
}

std::string power_text(const std::vector<records::LawSummary>& rows) {
  std::string all;
  for (const auto& [backend, power] : records::power_by_backend(rows)) {
    const records::Noticed sum = records::total(power);
    all += fmt::format("Made wrong on purpose on {}: {}, {} noticed.\n", cases::printable(backend),
                       counted(sum.drawings, "drawing", "drawings"), grouped(sum.noticed));
  }
  return all;
}

std::string not_checked_text(const std::vector<records::LawSummary>& rows) {
  // Laws with the same reason and number of cases share a line. Counts are negative, so that the
  // most cases come first.
  std::map<std::tuple<std::string, std::int64_t, std::string>, std::string> laws;
  for (const records::LawSummary& row : rows) {
    if (row.verdict != LawVerdict::not_checked && row.verdict != LawVerdict::thin) continue;
    for (const auto& [cases, why] : records::reasons_of(row)) {
      std::string& text = laws[{row.backend, -static_cast<std::int64_t>(cases), why}];
      text += (text.empty() ? "" : "; ") + row.law;
    }
  }
  if (laws.empty()) return "";
  std::vector<std::vector<std::string>> cells{{"backend", "cases", "not judged, as", "properties"}};
  for (const auto& [key, text] : laws) {
    const auto& [backend, cases, why] = key;
    cells.push_back({cases::printable(backend), grouped(static_cast<std::uint64_t>(-cases)),
                     cases::printable(why), text});
  }
  return "Properties that held on few cases, or none:\n" + text_table(cells);
}

std::string thin_text(const std::vector<records::LawSummary>& rows) {
  const std::string sentence = records::thin_sentence(rows);
  return sentence.empty() ? "" : sentence + ".\n";
}

std::string summary_json(const records::Run& run, const std::vector<records::LawSummary>& rows) {
  nlohmann::ordered_json json{{"seed", run.plan.seed},
                              {"properties", nlohmann::ordered_json::array()}};
  for (const records::LawSummary& row : rows) {
    nlohmann::ordered_json unreached = nlohmann::ordered_json::array();
    for (const records::UnreachedLabel& label : row.unreached) unreached.push_back(label.label);
    json["properties"].push_back({{"property", row.law},
                                  {"backend", row.backend},
                                  {"checked", row.cases.checked},
                                  {"not_applicable", row.cases.not_applicable},
                                  {"violations", row.cases.violations},
                                  {"known", row.cases.known},
                                  {"known_defects", row.known},
                                  {"not_applicable_because", row.not_applicable_because},
                                  {"judged", judged_json(row.judged)},
                                  {"required", row.counts.required},
                                  {"forbidden", row.counts.forbidden},
                                  {"permitted", row.counts.permitted},
                                  {"undecided", row.counts.undecided},
                                  {"samples_decided", levels_json(row.levels.samples)},
                                  {"values_decided", levels_json(row.levels.values)},
                                  {"ideal_error", sizes_json(row.ideal)},
                                  {"beyond_contract", sizes_json(row.excess)},
                                  {"precision", precision_json(row.precision)},
                                  {"power", power_json(row.power)},
                                  {"labels", row.labels},
                                  {"unreached", unreached},
                                  {"verdict", to_string(row.verdict)}});
  }
  for (const records::SideBySide& pair : records::side_by_side(run)) {
    json["side_by_side"].push_back(side_by_side_json(pair));
  }
  if (!run.scenes.empty()) json["scenes"] = nlohmann::ordered_json::array();
  for (const records::SceneResult& scene : run.scenes) {
    json["scenes"].push_back({{"file", scene.file},
                              {"backend", scene.backend},
                              {"triangles", scene.triangles},
                              {"fragments", scene.fragments},
                              {"values", scene.values},
                              {"judged", scene.judged},
                              {"open", scene.open},
                              {"wrong", scene.wrong},
                              {"is_known", scene.is_known},
                              {"not_judged", scene.not_judged},
                              {"values_not_judged", scene.values_not_judged}});
  }
  return json.dump();
}

}  // namespace rastercheck::reports
