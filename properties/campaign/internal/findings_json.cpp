#include "properties/campaign/internal/findings_json.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "cases/error_json.h"
#include "cases/json.h"
#include "properties/campaign/internal/findings_members.h"

namespace rastercheck::properties {
namespace {

using cases::JsonNode;

constexpr const char* kWorker = "worker";

template <typename Archive, cases::Either<Findings> T>
void members_of_line(Archive& archive, T& findings) {
  members(archive, findings);
  archive.optional("fault", findings.fault);
}

/// Returns the findings, or the error that the worker sent instead.
Result<Findings> read_findings(const JsonNode& root) {
  if (root.has("error")) return tl::unexpected(cases::error_from_json(root));
  Findings findings;
  cases::read_object(root, [&](auto& archive) { members_of_line(archive, findings); });
  return findings;
}

}  // namespace

template <typename Archive, cases::Either<Task> T>
void members(Archive& archive, T& task) {
  archive.required("backend", task.backend);
  archive.required("property", task.law);
  archive.required("kind", task.kind);
  archive.required("first", task.first);
  archive.required("last", task.last);
  archive.optional("subject", task.subject);
}

std::string findings_to_line(const Result<Findings>& findings) {
  if (!findings) return cases::json_line(cases::error_to_json(findings.error()));
  nlohmann::json line;
  cases::write_object(line, [&](auto& archive) { members_of_line(archive, *findings); });
  return cases::json_line(line);
}

Result<Findings> findings_from_line(const std::string& line) {
  Result<Result<Findings>> said = cases::read_json(line, kWorker, &read_findings);
  if (!said) return tl::unexpected(said.error());
  return *std::move(said);
}

std::string task_to_line(const Task& task) { return cases::json_line(cases::json_of(task)); }

std::optional<Task> task_from_line(const std::string& line) {
  Result<Task> task = cases::read_json(line, kWorker, &cases::read_as<Task>);
  if (!task) return std::nullopt;
  // Only tasks of these kinds have a case of their own, which must say where it was found.
  const bool has_subject = task->subject && task->subject->source.found;
  if ((task->kind == TaskKind::saved || task->kind == TaskKind::shrink) != has_subject) {
    return std::nullopt;
  }
  return *std::move(task);
}

}  // namespace rastercheck::properties
