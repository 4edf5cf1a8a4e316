#include "records/counterexample_json.h"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/json.h"
#include "records/enclosure_json.h"

namespace rastercheck::records {
namespace {

using cases::JsonNode;
using nlohmann::json;

Violation read_violation(const JsonNode& node) {
  node.expect_object({"class", "kind", "triangle", "x", "y", "sample", "exact", "actual", "note"},
                     {"attribute", "error", "bound", "distance"});
  Violation violation;
  violation.fragment_class = node["class"].enumerator<FragmentClass>();
  violation.kind = node["kind"].enumerator<AttributeKind>();
  violation.place.triangle = node["triangle"].count<std::uint32_t>();
  violation.place.x = node["x"].count<std::uint32_t>();
  violation.place.y = node["y"].count<std::uint32_t>();
  violation.place.sample = node["sample"].count<std::uint32_t>();
  violation.exact = node["exact"].text();
  violation.actual = node["actual"].text();
  violation.note = node["note"].text();
  if (node.has("attribute")) violation.attribute = node["attribute"].count<std::uint32_t>();
  if (node.has("error")) violation.error = enclosure_from_json(node["error"]);
  if (node.has("bound")) violation.bound = enclosure_from_json(node["bound"]);
  if (node.has("distance")) violation.distance = enclosure_from_json(node["distance"]);
  return violation;
}

}  // namespace

json violation_to_json(const Violation& violation) {
  json object{{"class", to_string(violation.fragment_class)},
              {"kind", to_string(violation.kind)},
              {"triangle", violation.place.triangle},
              {"x", violation.place.x},
              {"y", violation.place.y},
              {"sample", violation.place.sample},
              {"exact", violation.exact},
              {"actual", violation.actual},
              {"note", violation.note}};
  if (violation.attribute) object["attribute"] = *violation.attribute;
  if (violation.error) object["error"] = enclosure_to_json(*violation.error);
  if (violation.bound) object["bound"] = enclosure_to_json(*violation.bound);
  if (violation.distance) object["distance"] = enclosure_to_json(*violation.distance);
  return object;
}

json counterexample_to_json(const Counterexample& counterexample) {
  // The writer's own text is what a case file holds, so that the two cannot drift apart.
  const Result<json> source =
      cases::parse_json(cases::to_json(counterexample.source), "counterexample");
  json violations = json::array();
  for (const Violation& violation : counterexample.violations) {
    violations.push_back(violation_to_json(violation));
  }
  json object{{"case", source.value_or(json())},
              {"violation_count", counterexample.violation_count},
              {"violations", std::move(violations)},
              {"origin", to_string(counterexample.origin)}};
  if (const auto& shrinking = counterexample.shrinking) {
    object["shrinking"] = {{"tries", shrinking->tries}, {"is_least", shrinking->is_least}};
  }
  if (!counterexample.close_up.empty()) object["close_up"] = counterexample.close_up;
  return object;
}

Counterexample counterexample_from_json(const JsonNode& node) {
  node.expect_object({"case", "violation_count", "violations"},
                     {"origin", "shrinking", "close_up"});
  Counterexample counterexample;
  if (node.failed()) return counterexample;
  counterexample.source = cases::read_case(node["case"]);
  counterexample.violation_count = node["violation_count"].count();
  for (const JsonNode& violation : node["violations"].elements()) {
    if (node.failed()) break;
    counterexample.violations.push_back(read_violation(violation));
  }
  if (node.has("origin")) counterexample.origin = node["origin"].enumerator<Origin>();
  if (node.has("shrinking")) {
    const JsonNode shrinking = node["shrinking"];
    shrinking.expect_object({"tries", "is_least"});
    counterexample.shrinking = {shrinking["tries"].count(), shrinking["is_least"].boolean()};
  }
  if (node.has("close_up")) {
    for (const JsonNode& line : node["close_up"].elements()) {
      counterexample.close_up.push_back(line.text());
    }
  }
  return counterexample;
}

}  // namespace rastercheck::records
