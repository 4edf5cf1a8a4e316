// run.json: everything a run found. All but "environment" depends on the run's seed and settings
// alone, to the byte. Read again by reports/run_reader.h.
//
//   {
//     "format": "rastercheck-run",
//     "version": 3,             records::kRecordsVersion
//     "rules_version": 1,       records::kRulesVersion
//     "plan": {…},              records/plan_json.h
//     "sentences": {"ID": "…"},
//     "shard": {…},             records/shard_json.h; only of a shard
//     "cases_left": 120,        only of a run that was interrupted
//     "records": […],           records/record_json.h
//     "cases": […],             records/case_record_json.h; only where they are kept
//     "specimens": […],         records/specimen_json.h; only where there are any
//     "counterexamples": […],   records/counterexample_json.h
//     "inspections": […],       records/inspection_json.h; only where there are any
//     "unreached": [{"law": "…", "backend": "cpu", "label": "tie", "reached": 2, "least": 13,
//                    "checked": 1000}],
//     "known": […],             records/known_json.h; only where something is known of a driver
//     "unexpected_passes": […], the same; only where there are any
//     "pictures": [{"name": "…", "caption": "…", "width": 640, "height": 480, "png": "base64…"}],
//     "environment": {"version": "0.1.0", …}
//   }
//
// A record, a case, a specimen, a counterexample, an inspection and a picture take a line each, so
// that a text comparison of two runs shows which differ.

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cases/json_node.h"
#include "records/case_record_json.h"
#include "records/counterexample_json.h"
#include "records/inspection_json.h"
#include "records/known_json.h"
#include "records/plan_json.h"
#include "records/record_json.h"
#include "records/shard_json.h"
#include "records/specimen_json.h"
#include "reports/base64.h"
#include "reports/format.h"

namespace rastercheck::reports::run_json_format {
namespace {

using nlohmann::json;

/// On one line; bytes that are not UTF-8 become U+FFFD, as the file has to be.
std::string text_of(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// An array, each element on a line of its own.
std::string lines_of(const json& array) {
  std::string text = "[";
  for (const json& element : array) text += (text.size() > 1 ? ",\n" : "\n") + text_of(element);
  return text + (array.empty() ? "]" : "\n]");
}

/// Each inspection, the largest of all that a run holds, as a document of its own: all together
/// would take many times their text.
std::string lines_of(const std::vector<records::Inspection>& inspections) {
  std::string text = "[";
  for (const records::Inspection& inspection : inspections) {
    text += text.size() > 1 ? ",\n" : "\n";
    text += text_of(cases::json_of(inspection));
  }
  return text + "\n]";
}

/// The same of case records, of which there may be many, too.
std::string lines_of(const records::CaseRecordSet& cases) {
  std::string text = "[";
  for (const auto& one : cases) {
    text += text.size() > 1 ? ",\n" : "\n";
    json object;
    write_value(object, one);
    text += text_of(object);
  }
  return text + "\n]";
}

json json_of(const records::Picture& picture) {
  return {{"name", picture.name},
          {"caption", picture.caption},
          {"width", picture.width},
          {"height", picture.height},
          {"png", to_base64(picture.png)}};
}

json json_of(const records::UnreachedLabel& label) {
  return {{"law", label.law},         {"backend", label.backend}, {"label", label.label},
          {"reached", label.reached}, {"least", label.least},     {"checked", label.checked}};
}

std::string write(const records::Run& run) {
  json counterexamples = json::array();
  for (const records::Counterexample& counterexample : run.counterexamples) {
    counterexamples.push_back(cases::json_of(counterexample));
  }
  json unreached = json::array();
  for (const records::UnreachedLabel& label : run.unreached) unreached.push_back(json_of(label));
  json known = json::array();
  for (const auto& one : run.known) known.push_back(cases::json_of(one));
  json unexpected = json::array();
  for (const auto& one : run.unexpected) {
    unexpected.push_back(cases::json_of(one));
  }
  json specimens = json::array();
  for (const records::Specimen& specimen : run.specimens) {
    specimens.push_back(cases::json_of(specimen));
  }
  json pictures = json::array();
  for (const records::Picture& picture : run.pictures) pictures.push_back(json_of(picture));

  std::string text = "{\n";
  const auto add = [&text](std::string_view key, const std::string& value) {
    text += fmt::format("{}\"{}\": {}", text.size() > 2 ? ",\n" : "", key, value);
  };
  add("format", "\"rastercheck-run\"");
  add("version", std::to_string(records::kRecordsVersion));
  add("rules_version", std::to_string(run.rules_version));
  add("plan", text_of(cases::json_of(run.plan)));
  if (!run.sentences.empty()) add("sentences", text_of(run.sentences));
  if (run.shard) add("shard", text_of(cases::json_of(*run.shard)));
  if (run.cases_left > 0) add("cases_left", std::to_string(run.cases_left));
  add("records", lines_of(cases::json_of(run.records)));
  if (run.cases) add("cases", lines_of(*run.cases));
  if (!run.specimens.empty()) add("specimens", lines_of(specimens));
  add("counterexamples", lines_of(counterexamples));
  if (!run.inspections.empty()) add("inspections", lines_of(run.inspections));
  add("unreached", lines_of(unreached));
  if (!run.known.empty()) add("known", lines_of(known));
  if (!run.unexpected.empty()) add("unexpected_passes", lines_of(unexpected));
  add("pictures", lines_of(pictures));
  add("environment", text_of(run.environment));
  return text + "\n}\n";
}

const FormatRegistration kRegistration({"json", "run.json", &write});

}  // namespace
}  // namespace rastercheck::reports::run_json_format
