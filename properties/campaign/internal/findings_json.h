#pragma once

// Findings as one line of JSON, from a worker process to its parent:
//
//   {"records": […], "counterexamples": […], "fault": "…"}
//
// or, for a task that could not be run, {"error": {"file": "…", "place": "…", "reason": "…"}}.
// "fault" and "unexpected" (known defects that no longer show) are absent if there are none, and
// "cases" (records/case_record_json.h) if case results are not kept.

#include <string>

#include "cases/error.h"
#include "properties/campaign/campaign.h"

namespace rastercheck::properties {

/// One line, without a newline.
std::string findings_to_line(const Result<Findings>& findings);

/// Fails with the task's own error, or with file "worker" if the line is malformed.
Result<Findings> findings_from_line(const std::string& line);

/// Converts a task to one line, without a newline, and back; empty for a malformed line.
std::string task_to_line(const Task& task);
std::optional<Task> task_from_line(const std::string& line);

}  // namespace rastercheck::properties
