// unfinished.json:
//
//   {"format": "rastercheck-unfinished", "version": 1,
//    "plan": {"seed": 1, "cases_per_law": 1000, "backends": ["cpu"], "laws": ["…"],
//             "shrink_tries": 1000, "shrink_seconds": 5, "corpus": "…", "corpus_digest": "…",
//             "scene": "", "scene_size": 512, "program": "0.1.0",
//             "contract_file": "…", "contract": {a contract file}},
//    "saved": [{a case file}, …],
//    "tasks": 4400, "done": [[0, 17], [19, 20]],
//    "records": […], "counterexamples": […], "unexpected": […]}
//
// "done" has ranges of all tasks, from the first to one past the last. "shrink_seconds" is absent
// where there is no such limit, the contract where each backend is held to its own; "known" and
// "known_digest" of the plan, "keeps_cases", "shard" ({"index": 2, "count": 7}), "cases"
// (records/case_record_json.h) and "unexpected" are absent where there is nothing of the kind.

#include "properties/campaign/checkpoint.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/contract_json.h"
#include "cases/json.h"
#include "cases/json_node.h"
#include "properties/draw.h"
#include "records/case_record_json.h"
#include "records/counterexample_json.h"
#include "records/known_json.h"
#include "records/record_json.h"
#include "records/shard_json.h"

namespace rastercheck::properties {
namespace {

using cases::JsonNode;
using nlohmann::json;

/// Tasks in all: more than any campaign has (campaign.cpp), and few enough for a list.
constexpr std::uint64_t kMostTasksInAll = std::uint64_t{1} << 28U;

json plan_to_json(const RunPlan& plan) {
  json object{{"seed", plan.campaign.seed},
              {"cases_per_law", plan.campaign.cases_per_law},
              {"backends", plan.campaign.backends},
              {"laws", plan.campaign.laws},
              {"shrink_tries", plan.campaign.shrinking.tries},
              {"corpus", plan.corpus},
              {"corpus_digest", plan.corpus_digest},
              {"scene", plan.scene},
              {"scene_size", plan.scene_size},
              {"program", plan.program}};
  if (!plan.options.empty()) object["options"] = plan.options;
  if (plan.campaign.keeps_cases) object["keeps_cases"] = true;
  if (plan.campaign.shard) object["shard"] = records::shard_number_to_json(*plan.campaign.shard);
  if (!plan.known.empty()) object["known"] = plan.known;
  if (!plan.known_digest.empty()) object["known_digest"] = plan.known_digest;
  if (const auto& seconds = plan.campaign.shrinking.seconds) {
    object["shrink_seconds"] = cases::float64_to_json(*seconds);
  }
  if (!plan.contract_file.empty()) {
    object["contract_file"] = plan.contract_file;
    object["contract"] = cases::parse_json(cases::to_json(plan.terms), "").value_or(json());
  }
  return object;
}

std::vector<std::string> texts_of(const JsonNode& node) {
  std::vector<std::string> texts;
  for (const JsonNode& element : node.elements()) texts.push_back(element.text());
  return texts;
}

RunPlan read_plan(const JsonNode& node) {
  node.expect_object({"seed", "cases_per_law", "backends", "laws", "shrink_tries", "corpus",
                      "corpus_digest", "scene", "scene_size", "program"},
                     {"options", "keeps_cases", "shard", "shrink_seconds", "known", "known_digest",
                      "contract_file", "contract"});
  RunPlan plan;
  plan.campaign.seed = node["seed"].count();
  plan.campaign.cases_per_law = node["cases_per_law"].count();
  plan.campaign.backends = texts_of(node["backends"]);
  plan.campaign.laws = texts_of(node["laws"]);
  plan.campaign.shrinking.tries = node["shrink_tries"].count();
  if (node.has("shrink_seconds")) {
    plan.campaign.shrinking.seconds = node["shrink_seconds"].float64();
  }
  if (node.has("keeps_cases")) plan.campaign.keeps_cases = node["keeps_cases"].boolean();
  if (node.has("shard")) plan.campaign.shard = records::shard_number_from_json(node["shard"]);
  if (node.has("options")) plan.options = texts_of(node["options"]);
  plan.corpus = node["corpus"].text();
  plan.corpus_digest = node["corpus_digest"].text();
  if (node.has("known")) plan.known = node["known"].text();
  if (node.has("known_digest")) plan.known_digest = node["known_digest"].text();
  plan.scene = node["scene"].text();
  plan.scene_size = static_cast<int>(node["scene_size"].integer(1, cases::kMaxSize));
  plan.program = node["program"].text();
  if (node.has("contract_file")) {
    plan.contract_file = node["contract_file"].text();
    if (plan.contract_file.empty()) node["contract_file"].refuse("must be a file");
    plan.terms = cases::read_contract_terms(node["contract"]);
  } else if (node.has("contract")) {
    node.refuse("missing key 'contract_file'");
  }
  return plan;
}

json done_to_json(const std::vector<bool>& is_done) {
  json ranges = json::array();
  for (std::size_t i = 0; i < is_done.size(); ++i) {
    if (!is_done[i]) continue;
    const std::size_t first = i;
    while (i < is_done.size() && is_done[i]) ++i;
    ranges.push_back({first, i});
  }
  return ranges;
}

std::vector<bool> read_done(const JsonNode& root) {
  const auto tasks = static_cast<std::size_t>(root["tasks"].count(kMostTasksInAll));
  std::vector<bool> is_done(tasks);
  for (const JsonNode& range : root["done"].elements()) {
    const auto [from, to] = range.two_elements("first and last");
    const auto first = static_cast<std::size_t>(from.count(tasks));
    const auto last = static_cast<std::size_t>(to.count(tasks));
    for (std::size_t i = first; i < last; ++i) is_done[i] = true;
  }
  return is_done;
}

Checkpoint read_checkpoint(const JsonNode& root) {
  root.expect_format("rastercheck-unfinished");
  if (root.has("version") && root["version"].count() != 1) {
    root["version"].refuse("version must be 1");
  }
  root.expect_object(
      {"format", "version", "plan", "saved", "tasks", "done", "records", "counterexamples"},
      {"cases", "unexpected"});
  Checkpoint checkpoint;
  if (root.failed()) return checkpoint;
  checkpoint.plan = read_plan(root["plan"]);
  for (const JsonNode& node : root["saved"].elements()) {
    if (root.failed()) break;
    checkpoint.saved.push_back(cases::read_case(node));
    if (!checkpoint.saved.back().found) node.refuse("has no 'found'");
  }
  checkpoint.is_done = read_done(root);
  for (const JsonNode& node : root["counterexamples"].elements()) {
    if (root.failed()) break;
    records::Counterexample one = records::counterexample_from_json(node);
    if (!one.source.found) node.refuse("its case has no 'found'");
    if (!root.failed()) keep(checkpoint.findings, std::move(one));
  }
  if (root.has("unexpected")) {
    for (const JsonNode& node : root["unexpected"].elements()) {
      keep(checkpoint.findings, records::unexpected_pass_from_json(node));
    }
  }
  if (root.has("cases")) {
    checkpoint.findings.cases = records::case_records_from_json(root["cases"]);
  }
  if (!root.failed()) checkpoint.findings.records = records::records_from_json(root["records"]);
  return checkpoint;
}

}  // namespace

std::vector<Task> tasks_of(const Checkpoint& checkpoint, std::size_t corpus_size,
                           const KnownByBackend& known) {
  const RunPlan& plan = checkpoint.plan;
  const bool is_held_to_own = plan.contract_file.empty();
  return tasks_of(plan.campaign, corpus_size, checkpoint.saved,
                  is_held_to_own ? known : KnownByBackend{});
}

std::string digest_of(const std::vector<cases::Case>& cases) {
  std::string files;  // which differ where the cases do
  for (const cases::Case& c : cases) files += cases::to_json(c);
  return fmt::format("{:016x}", fnv1a(files));
}

std::string checkpoint_file(const std::string& directory) {
  return (std::filesystem::path(directory) / "unfinished.json").string();
}

std::string to_json(const Checkpoint& checkpoint) {
  json saved = json::array();
  for (const cases::Case& c : checkpoint.saved) {
    saved.push_back(cases::parse_json(cases::to_json(c), "").value_or(json()));
  }
  json counterexamples = json::array();
  for (const records::Counterexample& one : checkpoint.findings.counterexamples) {
    counterexamples.push_back(records::counterexample_to_json(one));
  }
  json document{{"format", "rastercheck-unfinished"},
                {"version", 1},
                {"plan", plan_to_json(checkpoint.plan)},
                {"saved", std::move(saved)},
                {"tasks", checkpoint.is_done.size()},
                {"done", done_to_json(checkpoint.is_done)},
                {"records", records::records_to_json(checkpoint.findings.records)},
                {"counterexamples", std::move(counterexamples)}};
  if (const auto& cases = checkpoint.findings.cases) {
    document["cases"] = records::case_records_to_json(*cases);
  }
  for (const records::UnexpectedPass& pass : checkpoint.findings.unexpected) {
    document["unexpected"].push_back(records::unexpected_pass_to_json(pass));
  }
  return document.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

Result<Checkpoint> parse_checkpoint(std::string_view text, const std::string& file) {
  return cases::read_json(text, file, &read_checkpoint);
}

}  // namespace rastercheck::properties
