#pragma once

// A campaign's tasks spread over processes. RapidCheck is not thread-safe, so parallel work is done
// by worker processes of the same program, each fed one task at a time over a socket that is its
// standard input and output.
//
// A caller may end early: a task that shrinks then returns its best case so far, one that checks is
// dropped and counts as not done.

#include <functional>
#include <string>
#include <vector>

#include "cases/error.h"
#include "properties/campaign/campaign.h"

namespace rastercheck::properties {

/// Told of every task that is done, by its place in the list, in whatever order; false: no more
/// tasks are wanted.
using TaskDone = std::function<bool(std::size_t task, Findings found)>;

/// Runs the tasks one after the other in this process. No more are begun once `is_to_end`, which
/// the caller's thread is asked, says so.
Result<void> run_tasks(TaskRunner& runner, const std::vector<Task>& tasks, const TaskDone& done,
                       const IsToEnd& is_to_end = {});

/// Runs the tasks in `jobs` >= 1 processes of `command` (program and arguments), which are to call
/// serve_tasks() with the same seed and corpus. Fails where a process cannot be started, ends
/// before its task does, or where a task fails; all are ended then. May be called from a thread of
/// its own: it touches nothing but its arguments.
///
/// The processes are a process group each, so that Ctrl-C in a terminal reaches only the one that
/// gives out tasks. They end when that one does, however it does.
Result<void> run_tasks_in_processes(const std::vector<std::string>& command, int jobs,
                                    const std::vector<Task>& tasks, const TaskDone& done,
                                    const IsToEnd& is_to_end = {});

/// The other end: answers each task that comes on standard input with its findings on what was
/// standard output, until the input ends. An empty line in the middle of a task asks it to end
/// early. What is printed meanwhile goes to standard error.
Result<void> serve_tasks(TaskRunner& runner);

}  // namespace rastercheck::properties
