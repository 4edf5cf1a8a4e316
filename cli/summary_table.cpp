#include "cli/summary_table.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/output.h"
#include "records/enclosure_json.h"

namespace rastercheck::cli {
namespace {

std::string worst_text(const records::SizeSummary& sizes) {
  return sizes.worst ? records::to_decimal(*sizes.worst, 4) : "-";
}

/// A quantile is known to a bucket: its upper border is what it does not exceed.
std::string quantile_text(const records::SizeSummary& sizes) {
  if (!sizes.p99) return "-";
  return sizes.p99->hi == 0 ? "0" : fmt::format("<= {:.4g}", sizes.p99->hi);
}

nlohmann::ordered_json sizes_json(const records::SizeSummary& sizes) {
  nlohmann::ordered_json json{{"values", sizes.values}, {"worst", nullptr}, {"p99", nullptr}};
  if (sizes.worst) json["worst"] = {sizes.worst->lo, sizes.worst->hi};
  if (sizes.p99) json["p99"] = {sizes.p99->lo, sizes.p99->hi};
  return json;
}

nlohmann::ordered_json enclosure_json(const std::optional<records::Enclosure>& enclosure) {
  if (!enclosure) return nullptr;
  return records::enclosure_to_json(*enclosure);
}

nlohmann::ordered_json precision_json(const records::Precision& precision) {
  nlohmann::ordered_json json{{"kind", to_string(precision.kind)}, {"stratum", nullptr}};
  if (precision.stratum) json["stratum"] = to_string(*precision.stratum);
  json["values"] = precision.values;
  json["min"] = enclosure_json(precision.min);
  json["max"] = enclosure_json(precision.max);
  json["mean"] = enclosure_json(precision.mean);
  json["p50"] = enclosure_json(precision.p50);
  json["p99"] = enclosure_json(precision.p99);
  json["p99.9"] = enclosure_json(precision.p999);
  json["misrounded"] = precision.misrounded;
  return json;
}

nlohmann::ordered_json precision_json(const std::vector<records::Precision>& rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const records::Precision& row : rows) json.push_back(precision_json(row));
  return json;
}

nlohmann::ordered_json levels_json(const records::LevelCounts& levels) {
  return {{"filter", levels.filter}, {"interval", levels.interval}, {"exact", levels.exact}};
}

}  // namespace

std::string summary_table(std::span<const records::LawSummary> rows, bool quiet) {
  std::vector<std::vector<std::string>> cells;
  if (!quiet) {
    cells.push_back({"law", "backend", "cases", "fragments", "worst ULP", "p99 ULP",
                     "beyond contract", "verdict"});
  }
  for (const records::LawSummary& row : rows) {
    cells.push_back({row.law, row.backend, std::to_string(row.cases.checked),
                     std::to_string(row.fragments), worst_text(row.ideal), quantile_text(row.ideal),
                     worst_text(row.excess), std::string(to_string(row.verdict))});
  }
  return table(cells);
}

std::string summary_json(const records::Run& run, std::span<const records::LawSummary> rows) {
  nlohmann::ordered_json json{{"seed", run.seed}, {"laws", nlohmann::ordered_json::array()}};
  for (const records::LawSummary& row : rows) {
    nlohmann::ordered_json unreached = nlohmann::ordered_json::array();
    for (const records::UnreachedLabel& label : row.unreached) unreached.push_back(label.label);
    json["laws"].push_back({{"law", row.law},
                            {"backend", row.backend},
                            {"checked", row.cases.checked},
                            {"not_applicable", row.cases.not_applicable},
                            {"violations", row.cases.violations},
                            {"fragments", row.fragments},
                            {"required", row.counts.required},
                            {"forbidden", row.counts.forbidden},
                            {"permitted", row.counts.permitted},
                            {"undecided", row.counts.undecided},
                            {"samples_decided", levels_json(row.levels.samples)},
                            {"values_decided", levels_json(row.levels.values)},
                            {"ideal_error", sizes_json(row.ideal)},
                            {"beyond_contract", sizes_json(row.excess)},
                            {"precision", precision_json(row.precision)},
                            {"labels", row.labels},
                            {"unreached", unreached},
                            {"verdict", to_string(row.verdict)}});
  }
  return json.dump();
}

}  // namespace rastercheck::cli
