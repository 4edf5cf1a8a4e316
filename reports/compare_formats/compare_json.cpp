// compare.json: the findings of a comparison, for other programs.
//
//   {"format": "rastercheck-comparison", "version": 1, "baseline": "FILE", "current": "FILE",
//    "regression": true, "expired": ["…"], "unused": ["…"],
//    "comparisons": [{
//      "backend": "cpu", "architecture": "x86_64", "instruction_set": "", "compiler": "",
//      "plan": {"seed": 1, "cases_per_property": 100},   records/plan_json.h
//      "before": {"backend": "cpu", "version": "0.1.0", "commit": "…", "instruction_set": "avx2",
//                 "compiler": "…"},
//      "after": {…},
//      "entries": {"same": 500, "better": 1, "worse": 2, "new": 0, "gone": 0, "refused": 1},
//      "changed": [{"property": "…", "kind": "smooth", "stratum": "sliver", "change": "worse",
//                   "allowed_because": "…",
//                   "figures": [{"figure": "worst", "change": "worse", "before": [0.5, 0.5],
//                                "after": [0.7, 0.7]},
//                               {"figure": "misrounded", "before": {"count": 1, "of": 9}, …},
//                               {"figure": "missing", "before": 0, "after": 2, …}]}],
//      "stages": [{"property": "…", "kind": "smooth", "grown": "set-up", "stages": [
//         {"stage": "set-up", "mean_before": [0.1, 0.1], "mean_after": [0.2, 0.2],
//          "share_before": 0.1, "share_after": 0.2}]}],
//      "cases": 19228, "changed_cases": 20, "grown_cases": 10,
//      "growths": [{"property": "…", "origin": "random", "index": 12, "name": "…",
//                   "kind": "smooth", "stratum": "sliver", "file": "grown/….json",
//                   "outcome_before": "held", "outcome_after": "violated", "mismatches_before": 0,
//                   "mismatches_after": 1, "before": {a worst error as in records}, "after": {…},
//                   "part_to_look_at": {"stage": "set-up", "error": [0.3, 0.3]},
//                   "commands": ["rastercheck replay …"]}],
//      "gone_properties": [], "new_properties": []}]}
//
// "changed" has the entries that are not the same. "stages" has the entries of laws that split
// errors, if a stage's part grew. Members that do not apply are left out: "stratum",
// "allowed_because", "name", "kind", "before", "after" and others.

#include <nlohmann/json.hpp>

#include "records/enclosure_json.h"
#include "records/plan_json.h"
#include "records/record_json.h"
#include "reports/compare_format.h"
#include "reports/internal/compare_wording.h"

namespace rastercheck::reports::compare_json_format {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const records::FigureValue& value) {
  if (value.size) return cases::json_of(*value.size);
  if (value.of > 0) return {{"count", value.count}, {"of", value.of}};
  return value.count;
}

ordered_json json_of(const records::FigureChange& figure) {
  return {{"figure", figure_name(figure)},
          {"change", to_string(figure.change)},
          {"before", json_of(figure.before)},
          {"after", json_of(figure.after)}};
}

ordered_json json_of(const records::EntryKey& key) {
  ordered_json object{{"property", key.law}, {"kind", to_string(key.kind)}};
  if (key.stratum) object["stratum"] = to_string(*key.stratum);
  return object;
}

ordered_json json_of(const records::EntryChange& entry) {
  ordered_json object = json_of(entry.key);
  object["change"] = to_string(entry.change);
  if (entry.allowed_because) object["allowed_because"] = *entry.allowed_because;
  object["figures"] = ordered_json::array();
  for (const records::FigureChange& figure : entry.figures)
    object["figures"].push_back(json_of(figure));
  return object;
}

ordered_json stages_of(const records::EntryChange& entry) {
  ordered_json object = json_of(entry.key);
  object["grown"] = to_string(*entry.grown_stage);
  object["stages"] = ordered_json::array();
  for (const records::StageChange& stage : entry.stages) {
    ordered_json one{{"stage", to_string(stage.stage)}};
    if (stage.mean_before) one["mean_before"] = cases::json_of(*stage.mean_before);
    if (stage.mean_after) one["mean_after"] = cases::json_of(*stage.mean_after);
    if (stage.share_before) one["share_before"] = *stage.share_before;
    if (stage.share_after) one["share_after"] = *stage.share_after;
    object["stages"].push_back(std::move(one));
  }
  return object;
}

ordered_json json_of(const Gate& gate, const records::Comparison& comparison,
                     const records::CaseGrowth& growth) {
  ordered_json object{
      {"property", growth.law}, {"origin", to_string(growth.origin)}, {"index", growth.index}};
  if (!growth.name.empty()) object["name"] = growth.name;
  if (growth.kind) object["kind"] = to_string(*growth.kind);
  if (growth.stratum) object["stratum"] = to_string(*growth.stratum);
  if (growth.outcome_before != growth.outcome_after) {
    object["outcome_before"] = to_string(growth.outcome_before);
    object["outcome_after"] = to_string(growth.outcome_after);
  }
  object["mismatches_before"] = growth.mismatches_before;
  object["mismatches_after"] = growth.mismatches_after;
  if (growth.before) object["before"] = cases::json_of(*growth.before);
  if (growth.after) object["after"] = cases::json_of(*growth.after);
  if (const auto part = part_to_look_at(gate, comparison, growth)) {
    object["part_to_look_at"] = {{"stage", to_string(part->stage)},
                                 {"error", cases::json_of(part->error)}};
  }
  if (!gate.folder.empty()) object["file"] = file_of(comparison, growth);
  object["commands"] = growth_commands(gate, comparison, growth);
  return object;
}

ordered_json json_of(const records::Taken& taken) {
  return {{"backend", taken.backend},
          {"version", taken.version},
          {"commit", taken.commit},
          {"instruction_set", taken.instruction_set},
          {"compiler", taken.compiler}};
}

ordered_json counts_of(const records::Comparison& comparison) {
  ordered_json counts = ordered_json::object();
  for (std::size_t i = 0; i < names_of(records::Change{}).size(); ++i) {
    const auto change = static_cast<records::Change>(i);
    counts[std::string(to_string(change))] = count_of(comparison, change);
  }
  counts["refused"] = refused(comparison);
  return counts;
}

ordered_json json_of(const Gate& gate, const records::Comparison& comparison) {
  ordered_json changed = ordered_json::array();
  ordered_json stages = ordered_json::array();
  for (const records::EntryChange& entry : comparison.entries) {
    if (entry.change != records::Change::same) changed.push_back(json_of(entry));
    if (entry.grown_stage) stages.push_back(stages_of(entry));
  }
  ordered_json growths = ordered_json::array();
  for (const records::CaseGrowth& growth : comparison.growths) {
    growths.push_back(json_of(gate, comparison, growth));
  }
  return {{"backend", comparison.key.backend},
          {"architecture", comparison.key.architecture},
          {"instruction_set", comparison.key.instruction_set},
          {"compiler", comparison.key.compiler},
          {"plan", cases::json_of(comparison.plan)},
          {"before", json_of(comparison.before)},
          {"after", json_of(comparison.after)},
          {"entries", counts_of(comparison)},
          {"changed", std::move(changed)},
          {"stages", std::move(stages)},
          {"cases", comparison.compared_cases},
          {"changed_cases", comparison.changed_cases},
          {"grown_cases", comparison.grown_cases},
          {"growths", std::move(growths)},
          {"gone_properties", comparison.gone_laws},
          {"new_properties", comparison.new_laws}};
}

std::string write(const Gate& gate) {
  ordered_json comparisons = ordered_json::array();
  for (const records::Comparison& comparison : gate.comparisons) {
    comparisons.push_back(json_of(gate, comparison));
  }
  const ordered_json all{{"format", "rastercheck-comparison"},
                         {"version", 1},
                         {"baseline", gate.baseline_file},
                         {"current", gate.current_file},
                         {"regression", refused(gate.comparisons) > 0},
                         {"expired", gate.policy.expired},
                         {"unused", gate.policy.unused},
                         {"comparisons", std::move(comparisons)}};
  return all.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

const CompareFormatRegistration kRegistration({"json", "compare.json", &write});

}  // namespace
}  // namespace rastercheck::reports::compare_json_format
