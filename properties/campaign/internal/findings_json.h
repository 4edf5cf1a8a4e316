#pragma once

// Findings as one line of JSON, from a worker process to the one that asked for them:
//
//   {"records": […], "counterexamples": […], "fault": "…"}
//
// or, of a task that could not be run, {"error": {"file": "…", "place": "…", "reason": "…"}}.
// "fault" is absent where there is none, as are "unexpected", of known defects that do not show,
// and "cases" (records/case_record_json.h), where what each case gave is not kept.

#include <string>

#include "cases/error.h"
#include "properties/campaign/campaign.h"

namespace rastercheck::properties {

/// One line, without its end.
std::string findings_to_line(const Result<Findings>& findings);

/// The error is the task's own, or, with the file "worker", that of a line that is no such answer.
Result<Findings> findings_from_line(const std::string& line);

/// A task as one line, without its end, and back; nothing of a line that is no task.
std::string task_to_line(const Task& task);
std::optional<Task> task_from_line(const std::string& line);

}  // namespace rastercheck::properties
