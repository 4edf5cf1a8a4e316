#include "records/inspection_json.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/float_text.h"
#include "cases/json.h"
#include "records/enclosure_json.h"

namespace rastercheck::records {
namespace {

using cases::JsonNode;
using nlohmann::json;

constexpr std::string_view kEdges = "three edges";
constexpr std::string_view kRows = "three rows";
constexpr std::string_view kColumns = "three fractions";

void put(json& object, const char* key, const std::optional<Enclosure>& enclosure) {
  if (enclosure) object[key] = enclosure_to_json(*enclosure);
}
void put(json& object, const char* key, const std::optional<std::uint32_t>& number) {
  if (number) object[key] = *number;
}

std::optional<Enclosure> read_enclosure(const JsonNode& node, std::string_view key) {
  if (!node.has(key)) return std::nullopt;
  return enclosure_from_json(node[key]);
}
std::optional<std::uint32_t> read_count(const JsonNode& node, std::string_view key) {
  if (!node.has(key)) return std::nullopt;
  return node[key].count<std::uint32_t>();
}

json points_to_json(const std::vector<WindowPoint>& points) {
  json array = json::array();
  for (const WindowPoint& point : points) {
    array.push_back({cases::float64_to_json(point.x), cases::float64_to_json(point.y)});
  }
  return array;
}

std::vector<WindowPoint> read_points(const JsonNode& node) {
  std::vector<WindowPoint> points;
  for (const JsonNode& element : node.elements()) {
    const auto [x, y] = element.two_elements("x and y");
    points.push_back({x.float64(), y.float64()});
  }
  return points;
}

std::string actual_text(float actual) {
  // A NaN's sign is not the value's.
  return std::isnan(actual) ? "nan" : cases::to_hex(actual);
}

float read_actual(const JsonNode& node) {
  const std::string text = node.text();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (text == "nan") return std::numeric_limits<float>::quiet_NaN();
  if (text == "inf") return kInfinity;
  if (text == "-inf") return -kInfinity;
  return node.hex_float32();
}

json value_to_json(const InspectedValue& value) {
  json object = json::object();
  put(object, "attribute", value.attribute);
  if (!value.exact.empty()) object["exact"] = value.exact;
  if (value.nearest) object["nearest"] = cases::float64_to_json(*value.nearest);
  if (value.actual) object["actual"] = actual_text(*value.actual);
  put(object, "scale_error", value.scale_error);
  put(object, "local_error", value.local_error);
  put(object, "excess", value.excess);
  put(object, "kappa", value.kappa);
  put(object, "kappa_d", value.kappa_d);
  return object;
}

InspectedValue read_value(const JsonNode& node) {
  node.expect_object({}, {"attribute", "exact", "nearest", "actual", "scale_error", "local_error",
                          "excess", "kappa", "kappa_d"});
  InspectedValue value;
  value.attribute = read_count(node, "attribute");
  if (node.has("exact")) value.exact = node["exact"].text();
  if (node.has("nearest")) value.nearest = node["nearest"].float64();
  if (node.has("actual")) value.actual = read_actual(node["actual"]);
  value.scale_error = read_enclosure(node, "scale_error");
  value.local_error = read_enclosure(node, "local_error");
  value.excess = read_enclosure(node, "excess");
  value.kappa = read_enclosure(node, "kappa");
  value.kappa_d = read_enclosure(node, "kappa_d");
  return value;
}

json sample_to_json(const InspectedSample& sample) {
  json object{{"x", sample.place.x},
              {"y", sample.place.y},
              {"sample", sample.place.sample},
              {"verdict", to_string(sample.verdict)},
              {"reason", to_string(sample.reason)},
              {"is_drawn", sample.is_drawn}};
  put(object, "distance", sample.distance);
  if (sample.edges) {
    for (const Enclosure& edge : *sample.edges) object["edges"].push_back(enclosure_to_json(edge));
  }
  for (const InspectedValue& value : sample.values) {
    object["values"].push_back(value_to_json(value));
  }
  return object;
}

InspectedSample read_sample(const JsonNode& node) {
  node.expect_object({"x", "y", "sample", "verdict", "reason", "is_drawn"},
                     {"distance", "edges", "values"});
  InspectedSample sample;
  sample.place.x = node["x"].count<std::uint32_t>();
  sample.place.y = node["y"].count<std::uint32_t>();
  sample.place.sample = node["sample"].count<std::uint32_t>();
  sample.verdict = node["verdict"].enumerator<Verdict>();
  sample.reason = node["reason"].enumerator<Reason>();
  sample.is_drawn = node["is_drawn"].boolean();
  sample.distance = read_enclosure(node, "distance");
  if (node.has("edges")) {
    const std::vector<JsonNode> edges = node["edges"].elements(3, 3, kEdges);
    auto& read = sample.edges.emplace();
    for (std::size_t i = 0; i < edges.size(); ++i) read[i] = enclosure_from_json(edges[i]);
  }
  if (node.has("values")) {
    for (const JsonNode& value : node["values"].elements()) {
      sample.values.push_back(read_value(value));
    }
  }
  return sample;
}

json split_to_json(const ErrorSplit& split) {
  json parts = json::array();
  for (const StagePart& part : split.parts) {
    parts.push_back({{"stage", to_string(part.stage)}, {"error", enclosure_to_json(part.error)}});
  }
  json object{{"parts", std::move(parts)},
              {"total", enclosure_to_json(split.total)},
              {"is_traced", split.is_traced}};
  put(object, "attribute", split.attribute);
  return object;
}

ErrorSplit read_split(const JsonNode& node) {
  node.expect_object({"parts", "total", "is_traced"}, {"attribute"});
  ErrorSplit split;
  split.attribute = read_count(node, "attribute");
  for (const JsonNode& part : node["parts"].elements()) {
    part.expect_object({"stage", "error"});
    split.parts.push_back({part["stage"].enumerator<Stage>(), enclosure_from_json(part["error"])});
  }
  split.total = enclosure_from_json(node["total"]);
  split.is_traced = node["is_traced"].boolean();
  return split;
}

void read_q_matrix(const JsonNode& node, Inspection& inspection) {
  const std::vector<JsonNode> rows = node.elements(3, 3, kRows);
  auto& read = inspection.q_matrix.emplace();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<JsonNode> columns = rows[i].elements(3, 3, kColumns);
    for (std::size_t j = 0; j < columns.size(); ++j) read[i][j] = columns[j].text();
  }
}

/// Why and what was looked at.
void read_subject(const JsonNode& node, Inspection& inspection) {
  inspection.occasion = node["occasion"].enumerator<Occasion>();
  inspection.law = node["law"].text();
  inspection.backend = node["backend"].text();
  inspection.counterexample = node["counterexample"].count();
  if (node.has("kind")) inspection.kind = node["kind"].enumerator<AttributeKind>();
  if (node.has("stratum")) inspection.stratum = node["stratum"].enumerator<Stratum>();
  inspection.source = cases::read_case(node["case"]);
  inspection.pattern = read_points(node["pattern"]);
  inspection.place.triangle = node["triangle"].count<std::uint32_t>();
  inspection.place.x = node["x"].count<std::uint32_t>();
  inspection.place.y = node["y"].count<std::uint32_t>();
  inspection.place.sample = node["sample"].count<std::uint32_t>();
  inspection.attribute = read_count(node, "attribute");
}

/// Of a sample or value outside of it a report would have no picture.
void check_place(const JsonNode& node, const InspectedSample& sample, const Inspection& whole) {
  if (node.failed()) return;
  const bool is_within = sample.place.x >= whole.left &&
                         sample.place.x - whole.left < whole.width && sample.place.y >= whole.top &&
                         sample.place.y - whole.top < whole.height;
  if (!is_within) node.refuse("not within the inspected part");
  if (sample.place.sample >= whole.pattern.size())
    node["sample"].refuse("not in the sample pattern");
}

void read_part(const JsonNode& node, Inspection& inspection) {
  inspection.left = node["left"].count<std::uint32_t>();
  inspection.top = node["top"].count<std::uint32_t>();
  inspection.width = node["width"].count<std::uint32_t>(kMostInspected);
  inspection.height = node["height"].count<std::uint32_t>(kMostInspected);
  for (const JsonNode& element : node["samples"].elements()) {
    if (node.failed()) return;
    inspection.samples.push_back(read_sample(element));
    check_place(element, inspection.samples.back(), inspection);
  }
}

}  // namespace

json inspection_to_json(const Inspection& inspection) {
  const Result<json> source = cases::parse_json(cases::to_json(inspection.source), "inspection");
  json outlines = json::array();
  for (const auto& outline : inspection.outlines) outlines.push_back(points_to_json(outline));
  json samples = json::array();
  for (const InspectedSample& sample : inspection.samples) {
    samples.push_back(sample_to_json(sample));
  }
  json splits = json::array();
  for (const ErrorSplit& split : inspection.splits) splits.push_back(split_to_json(split));
  json object{{"occasion", to_string(inspection.occasion)},
              {"law", inspection.law},
              {"backend", inspection.backend},
              {"counterexample", inspection.counterexample},
              {"case", source.value_or(json())},
              {"pattern", points_to_json(inspection.pattern)},
              {"triangle", inspection.place.triangle},
              {"x", inspection.place.x},
              {"y", inspection.place.y},
              {"sample", inspection.place.sample},
              {"outlines", std::move(outlines)},
              {"left", inspection.left},
              {"top", inspection.top},
              {"width", inspection.width},
              {"height", inspection.height},
              {"samples", std::move(samples)},
              {"splits", std::move(splits)}};
  if (inspection.kind) object["kind"] = to_string(*inspection.kind);
  if (inspection.stratum) object["stratum"] = to_string(*inspection.stratum);
  put(object, "attribute", inspection.attribute);
  if (inspection.q_matrix) object["q_matrix"] = *inspection.q_matrix;
  if (inspection.coverage_stage) {
    object["coverage_stage"] = to_string(*inspection.coverage_stage);
  }
  return object;
}

Inspection inspection_from_json(const JsonNode& node) {
  node.expect_object(
      {"occasion", "law", "backend", "counterexample", "case", "pattern", "triangle", "x", "y",
       "sample", "outlines", "left", "top", "width", "height", "samples", "splits"},
      {"kind", "stratum", "attribute", "q_matrix", "coverage_stage"});
  Inspection inspection;
  if (node.failed()) return inspection;
  read_subject(node, inspection);
  if (node.has("q_matrix")) read_q_matrix(node["q_matrix"], inspection);
  for (const JsonNode& outline : node["outlines"].elements()) {
    inspection.outlines.push_back(read_points(outline));
  }
  read_part(node, inspection);
  for (const JsonNode& split : node["splits"].elements()) {
    inspection.splits.push_back(read_split(split));
  }
  if (node.has("coverage_stage")) {
    inspection.coverage_stage = node["coverage_stage"].enumerator<Stage>();
  }
  return inspection;
}

}  // namespace rastercheck::records
