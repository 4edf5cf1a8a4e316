#pragma once

// A campaign's tasks spread over processes. RapidCheck is not thread-safe, so parallel work is done
// by worker processes of the same program, each fed one task at a time over a socket that is its
// standard input and output.

#include <functional>
#include <string>
#include <vector>

#include "cases/error.h"
#include "properties/campaign.h"

namespace rastercheck::properties {

/// Told of every task that is done: cases so far, cases in all.
using Progress = std::function<void(std::uint64_t done, std::uint64_t all)>;

/// Runs the tasks one after the other in this process.
Result<Findings> run_tasks(TaskRunner& runner, const std::vector<Task>& tasks,
                           const Progress& progress);

/// Runs the tasks in `jobs` >= 1 processes of `command` (program and arguments), which are to call
/// serve_tasks() with the same seed and corpus. Fails where a process cannot be started, ends
/// before its task does, or where a task fails; all are ended then. May be called from a thread of
/// its own: it touches nothing but its arguments.
Result<Findings> run_tasks_in_processes(const std::vector<std::string>& command, int jobs,
                                        const std::vector<Task>& tasks, const Progress& progress);

/// The other end: answers each task that comes on standard input with its findings on what was
/// standard output, until the input ends. What is printed meanwhile goes to standard error.
Result<void> serve_tasks(TaskRunner& runner);

}  // namespace rastercheck::properties
