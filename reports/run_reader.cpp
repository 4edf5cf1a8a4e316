#include "reports/run_reader.h"

#include <fmt/format.h>

#include <limits>
#include <utility>
#include <vector>

#include "cases/files.h"
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

namespace rastercheck::reports {
namespace {

using cases::JsonNode;

void check_header(const JsonNode& root) {
  // These first: of a later version, its unknown keys are not what is wrong.
  root.expect_format("rastercheck-run");
  if (root.has("version") && root["version"].count() != records::kRecordsVersion) {
    root["version"].refuse(fmt::format("version must be {}", records::kRecordsVersion));
  }
  root.expect_object({"format", "version", "plan", "records", "counterexamples", "unreached",
                      "pictures", "environment"},
                     {"rules_version", "cases", "specimens", "shard", "cases_left", "inspections",
                      "known", "unexpected_passes", "sentences"});
}

std::map<std::string, std::string> read_text_by_key(const JsonNode& node) {
  std::map<std::string, std::string> texts;
  for (const std::string& key : node.keys()) texts[key] = node[key].text();
  return texts;
}

records::Picture read_picture(const JsonNode& node) {
  constexpr auto kLargest = std::uint64_t{std::numeric_limits<int>::max()};
  node.expect_object({"name", "caption", "width", "height", "png"});
  records::Picture picture;
  picture.name = node["name"].text();
  picture.caption = node["caption"].text();
  picture.width = static_cast<int>(node["width"].count(kLargest));
  picture.height = static_cast<int>(node["height"].count(kLargest));
  Result<std::string> png = from_base64(node["png"].text());
  if (!png) node["png"].refuse(png.error().reason);
  picture.png = std::move(png).value_or("");
  return picture;
}

records::UnreachedLabel read_unreached(const JsonNode& node) {
  node.expect_object({"law", "backend", "label", "reached", "least", "checked"});
  records::UnreachedLabel label;
  label.law = node["law"].text();
  label.backend = node["backend"].text();
  label.label = node["label"].text();
  label.reached = node["reached"].count();
  label.least = node["least"].count();
  label.checked = node["checked"].count();
  return label;
}

records::Run read_document(const JsonNode& root) {
  records::Run run;
  check_header(root);
  if (root.failed()) return run;
  // Files from before it was written are of the first.
  run.rules_version = root.has("rules_version") ? root["rules_version"].count() : 1;
  run.plan = cases::read_as<records::Plan>(root["plan"]);
  if (root.has("sentences")) run.sentences = read_text_by_key(root["sentences"]);
  if (root.has("shard") != run.plan.shard.has_value()) {
    root.refuse("'shard' belongs to a plan with 'shard', and the other way round");
  }
  if (root.has("shard")) run.shard = cases::read_as<records::Shard>(root["shard"]);
  if (root.has("cases_left")) run.cases_left = root["cases_left"].count();
  for (const JsonNode& node : root["counterexamples"].elements()) {
    if (root.failed()) return run;
    run.counterexamples.push_back(cases::read_as<records::Counterexample>(node));
  }
  if (root.has("inspections")) {
    for (const JsonNode& node : root["inspections"].elements()) {
      if (root.failed()) return run;
      run.inspections.push_back(cases::read_as<records::Inspection>(node));
    }
  }
  for (const JsonNode& node : root["unreached"].elements()) {
    if (root.failed()) return run;
    run.unreached.push_back(read_unreached(node));
  }
  if (root.has("known")) {
    for (const JsonNode& node : root["known"].elements()) {
      if (root.failed()) return run;
      run.known.push_back(cases::read_as<records::KnownOfBackend>(node));
    }
  }
  if (root.has("unexpected_passes")) {
    for (const JsonNode& node : root["unexpected_passes"].elements()) {
      run.unexpected.push_back(cases::read_as<records::UnexpectedPass>(node));
    }
  }
  for (const JsonNode& node : root["pictures"].elements()) {
    if (root.failed()) return run;
    run.pictures.push_back(read_picture(node));
  }
  if (root.has("cases")) run.cases = cases::read_as<records::CaseRecordSet>(root["cases"]);
  if (root.has("specimens"))
    run.specimens = cases::read_as<std::vector<records::Specimen>>(root["specimens"]);
  run.environment = read_text_by_key(root["environment"]);
  if (!root.failed()) run.records = cases::read_as<records::RecordSet>(root["records"]);
  return run;
}

}  // namespace

Result<records::Run> parse_run(std::string_view text, const std::string& file) {
  return cases::read_json(text, file, &read_document);
}

Result<records::Run> read_run(const std::string& file) {
  return cases::read_text(file).and_then(
      [&file](const std::string& text) { return parse_run(text, file); });
}

}  // namespace rastercheck::reports
