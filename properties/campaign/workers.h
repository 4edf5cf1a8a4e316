#pragma once

// Spreads a campaign's tasks over worker processes of the same program. Each worker gets one task
// at a time over a socket, which serves as its standard input and output. Workers are processes,
// not threads, for three reasons. A crash ends only one worker and is reported with its law and
// cases. Backends that hold a driver or a plugin need not be safe to call from two threads. A
// rounding mode or signal handler set by foreign code affects no other task.
//
// A caller may end early: a shrinking task then returns its best case so far; a checking task is
// dropped and counts as not done.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cases/error.h"
#include "properties/campaign/campaign.h"

namespace rastercheck::properties {

/// Called for every finished task, in any order, with its index in the list; return false to get no
/// more tasks.
using TaskDone = std::function<bool(std::size_t task, Findings found)>;

/// Runs the tasks one after the other in this process. Begins no further task once `is_to_end`,
/// called in the caller's thread, returns true.
Result<void> run_tasks(TaskRunner& runner, const std::vector<Task>& tasks, const TaskDone& done,
                       const IsToEnd& is_to_end = {});

/// Processes for several lists of tasks, one after the other.
///
/// Each process is a process group of its own, so that Ctrl-C in a terminal reaches only the
/// parent. All end when the parent ends, however it ends.
class TaskProcesses {
 public:
  /// `command`, program and arguments, must call serve_tasks() with the same seed and corpus. Up to
  /// `jobs` >= 1 processes are started when there are tasks for them, and kept.
  TaskProcesses(std::vector<std::string> command, int jobs);
  TaskProcesses(const TaskProcesses&) = delete;
  TaskProcesses& operator=(const TaskProcesses&) = delete;
  ~TaskProcesses();

  /// Runs the tasks. Fails if a process cannot be started or ends before its task, or if a task
  /// fails; then ends all processes. May be called from any thread, by one at a time.
  Result<void> run(const std::vector<Task>& tasks, const TaskDone& done,
                   const IsToEnd& is_to_end = {});

 private:
  class Pool;
  std::unique_ptr<Pool> pool_;
};

/// Runs the tasks in `jobs` processes of their own.
Result<void> run_tasks_in_processes(const std::vector<std::string>& command, int jobs,
                                    const std::vector<Task>& tasks, const TaskDone& done,
                                    const IsToEnd& is_to_end = {});

/// The worker's side: answers each task from standard input with findings on the original standard
/// output, until the input ends. An empty line during a task asks for an early end. Anything
/// printed meanwhile goes to standard error.
Result<void> serve_tasks(TaskRunner& runner);

}  // namespace rastercheck::properties
