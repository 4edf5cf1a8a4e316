// unfinished.json:
//
//   {"format": "rastercheck-unfinished", "version": 2,
//    "plan": {records/plan_json.h}, "corpus_digest": "…", "known_digest": "…", "program": "0.1.0",
//    "saved": [{a case file}, …],
//    "tasks": 4400, "done": [[0, 17], [19, 20]],
//    "records": […], "counterexamples": […], "unexpected": […]}
//
// "done" has ranges of all tasks, from the first to one past the last. "known_digest", "cases"
// (records/case_record_json.h) and "unexpected" are absent where there is nothing of the kind.

#include "properties/campaign/checkpoint.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/json.h"
#include "cases/json_node.h"
#include "properties/draw.h"
#include "records/case_record_json.h"
#include "records/counterexample_json.h"
#include "records/known_json.h"
#include "records/plan_json.h"
#include "records/record_json.h"

namespace rastercheck::properties {
namespace {

using cases::JsonNode;
using nlohmann::json;

constexpr std::uint64_t kVersion = 2;
/// Tasks in all: more than any campaign has (campaign.cpp), and few enough for a list.
constexpr std::uint64_t kMostTasksInAll = std::uint64_t{1} << 28U;

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
  if (root.has("version") && root["version"].count() != kVersion) {
    root["version"].refuse(fmt::format("version must be {}", kVersion));
  }
  root.expect_object({"format", "version", "plan", "corpus_digest", "program", "saved", "tasks",
                      "done", "records", "counterexamples"},
                     {"known_digest", "cases", "unexpected"});
  Checkpoint checkpoint;
  if (root.failed()) return checkpoint;
  checkpoint.plan = records::plan_from_json(root["plan"]);
  checkpoint.corpus_digest = root["corpus_digest"].text();
  checkpoint.program = root["program"].text();
  if (root.has("known_digest")) checkpoint.known_digest = root["known_digest"].text();
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
  const bool is_held_to_own = !checkpoint.plan.contract.has_value();
  return tasks_of(checkpoint.plan, corpus_size, checkpoint.saved,
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
                {"version", kVersion},
                {"plan", records::plan_to_json(checkpoint.plan)},
                {"corpus_digest", checkpoint.corpus_digest},
                {"program", checkpoint.program},
                {"saved", std::move(saved)},
                {"tasks", checkpoint.is_done.size()},
                {"done", done_to_json(checkpoint.is_done)},
                {"records", records::records_to_json(checkpoint.findings.records)},
                {"counterexamples", std::move(counterexamples)}};
  if (!checkpoint.known_digest.empty()) document["known_digest"] = checkpoint.known_digest;
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
