#include "properties/campaign/internal/findings_json.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "cases/error_json.h"
#include "cases/json_node.h"
#include "cases/names.h"
#include "records/case_record_json.h"
#include "records/counterexample_json.h"
#include "records/known_json.h"
#include "records/record_json.h"

namespace rastercheck::properties {
namespace {

using cases::JsonNode;
using nlohmann::json;

constexpr const char* kWorker = "worker";

/// The findings, or the error that the worker tells instead.
Result<Findings> read_findings(const JsonNode& root) {
  if (root.has("error")) return tl::unexpected(cases::error_from_json(root));
  root.expect_object({"records", "counterexamples"}, {"cases", "fault", "unexpected"});
  Findings findings;
  if (root.failed()) return findings;
  findings.records = records::records_from_json(root["records"]);
  if (root.has("cases")) findings.cases = records::case_records_from_json(root["cases"]);
  for (const JsonNode& node : root["counterexamples"].elements()) {
    if (root.failed()) break;
    findings.counterexamples.push_back(records::counterexample_from_json(node));
    // By it counterexamples are ordered.
    if (!findings.counterexamples.back().source.found) node.refuse("its case has no 'found'");
  }
  if (root.has("unexpected")) {
    for (const JsonNode& node : root["unexpected"].elements()) {
      keep(findings, records::unexpected_pass_from_json(node));
    }
  }
  if (root.has("fault")) findings.fault = root["fault"].text();
  return findings;
}

Task read_task(const JsonNode& root) {
  root.expect_object({"backend", "law", "kind", "first", "last"}, {"subject"});
  Task task{root["backend"].text(), root["law"].text(), root["kind"].enumerator<TaskKind>(),
            root["first"].count(), root["last"].count()};
  if (root.has("subject")) task.subject = records::counterexample_from_json(root["subject"]);
  return task;
}

}  // namespace

std::string findings_to_line(const Result<Findings>& findings) {
  json line;
  if (!findings) {
    line = cases::error_to_json(findings.error());
  } else {
    line["records"] = records::records_to_json(findings->records);
    if (findings->cases) line["cases"] = records::case_records_to_json(*findings->cases);
    line["counterexamples"] = json::array();
    for (const records::Counterexample& one : findings->counterexamples) {
      line["counterexamples"].push_back(records::counterexample_to_json(one));
    }
    for (const records::UnexpectedPass& pass : findings->unexpected) {
      line["unexpected"].push_back(records::unexpected_pass_to_json(pass));
    }
    if (findings->fault) line["fault"] = *findings->fault;
  }
  return line.dump(-1, ' ', false, json::error_handler_t::replace);
}

Result<Findings> findings_from_line(const std::string& line) {
  Result<Result<Findings>> said = cases::read_json(line, kWorker, &read_findings);
  if (!said) return tl::unexpected(said.error());
  return *std::move(said);
}

std::string task_to_line(const Task& task) {
  json object{{"backend", task.backend},
              {"law", task.law},
              {"kind", cases::name_of(task.kind)},
              {"first", task.first},
              {"last", task.last}};
  if (task.subject) object["subject"] = records::counterexample_to_json(*task.subject);
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::optional<Task> task_from_line(const std::string& line) {
  Result<Task> task = cases::read_json(line, kWorker, &read_task);
  if (!task) return std::nullopt;
  // Such a task is about a case of its own, and that one says where it is from.
  const bool has_subject = task->subject && task->subject->source.found;
  if ((task->kind == TaskKind::saved || task->kind == TaskKind::shrink) != has_subject) {
    return std::nullopt;
  }
  return *std::move(task);
}

}  // namespace rastercheck::properties
