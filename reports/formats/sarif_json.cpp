// results.sarif: SARIF 2.1.0, for code scanning. A rule is a law, and a result is a counterexample.
// The location of a result is the case file, relative to the run's folder. Its fingerprint is the
// kind of failure: law, backend, verdict and, unless they are the usual ones, kind of value and
// condition (records::special_words).

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "records/summary.h"
#include "reports/commands.h"
#include "reports/finding_text.h"
#include "reports/format.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports::sarif_json_format {
namespace {

using nlohmann::json;
using records::Run;

json rules_of(const Run& run) {
  json rules = json::array();
  for (const std::string& law : run.plan.laws) {
    rules.push_back({{"id", law},
                     {"shortDescription", {{"text", records::sentence_of(run, law)}}},
                     {"defaultConfiguration", {{"level", "error"}}}});
  }
  return rules;
}

json result_of(const Run& run, const records::Counterexample& counterexample) {
  const cases::Found found = counterexample.source.found.value_or(cases::Found());
  std::string text = counted(counterexample.violation_count, "violation", "violations") + " on " +
                     found.backend + ".";
  if (!counterexample.violations.empty()) {
    text += " " + finding_text(counterexample.violations.front(), counterexample.source) + ".";
  }
  text += " Replay with: " + replay_command(run, records::file_of(counterexample));
  const json location = {{"physicalLocation",
                          {{"artifactLocation", {{"uri", records::file_of(counterexample)}}},
                           {"region", {{"startLine", 1}}}}}};
  std::string fingerprint = found.law + "/" + found.backend + "/" + found.verdict;
  for (const std::string& word : records::special_words(found)) fingerprint += "/" + word;
  json result = {{"ruleId", found.law},
                 {"level", "error"},
                 {"message", {{"text", text}}},
                 {"locations", json::array({location})},
                 {"partialFingerprints", {{"propertyBackendVerdict/v1", fingerprint}}}};
  const auto law = std::find(run.plan.laws.begin(), run.plan.laws.end(), found.law);
  if (law != run.plan.laws.end()) result["ruleIndex"] = law - run.plan.laws.begin();
  return result;
}

std::string write(const Run& run) {
  json driver = {{"name", "RasterCheck"}, {"rules", rules_of(run)}};
  const auto version = run.environment.find("version");
  if (version != run.environment.end()) driver["version"] = version->second;
  json results = json::array();
  for (const records::Counterexample& counterexample : run.counterexamples) {
    results.push_back(result_of(run, counterexample));
  }
  const json document = {
      {"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
      {"version", "2.1.0"},
      {"runs", json::array({{{"tool", {{"driver", driver}}}, {"results", results}}})}};
  return document.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

const FormatRegistration kRegistration({"sarif", "results.sarif", &write, true});

}  // namespace
}  // namespace rastercheck::reports::sarif_json_format
