#include "properties/campaign/workers.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

#include "cases/child_process.h"
#include "properties/campaign/internal/findings_json.h"

namespace rastercheck::properties {
namespace {

Error system_error(const std::string& what) { return {what, "", std::strerror(errno)}; }

/// Sends whole lines over a file descriptor, and assembles received parts into lines.
class LineChannel {
 public:
  explicit LineChannel(int number) : number_(number) {}

  bool send(std::string line) const {
    line += '\n';
    std::string_view rest = line;
    while (!rest.empty()) {
      const ssize_t written = write_some(rest);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) return false;
      rest.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
  }

  /// Waits for data and reads it; returns false at the end or on an error.
  bool receive() {
    std::array<char, 65536> part{};
    for (;;) {
      const ssize_t count = ::read(number_, part.data(), part.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      received_.append(part.data(), static_cast<std::size_t>(count));
      return true;
    }
  }

  /// Returns the next complete line that was received.
  std::optional<std::string> next_line() {
    const std::size_t end = received_.find('\n', searched_);
    if (end == std::string::npos) {
      searched_ = received_.size();
      return std::nullopt;
    }
    std::string line = received_.substr(0, end);
    received_.erase(0, end + 1);
    searched_ = 0;
    return line;
  }

 private:
  ssize_t write_some(std::string_view text) const {
    // If the socket's other end is gone, sending fails instead of raising a signal that ends the
    // process.
    const ssize_t sent = ::send(number_, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == ENOTSOCK) return ::write(number_, text.data(), text.size());
    return sent;
  }

  int number_;
  std::string received_;
  std::size_t searched_ = 0;
};

/// A worker process and its current task.
class Worker {
 public:
  static Result<std::unique_ptr<Worker>> start(const std::vector<std::string>& command) {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
      return tl::unexpected(system_error("socketpair"));
    }
    cases::Descriptor ours(ends[0]);
    const cases::Descriptor theirs(ends[1]);
    Result<cases::ChildProcess> process = cases::ChildProcess::start(
        command, {theirs.number(), theirs.number()}, cases::ProcessGroup::own);
    if (!process) return tl::unexpected(process.error());
    return std::unique_ptr<Worker>(new Worker(*std::move(process), std::move(ours)));
  }

  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  /// Closing the socket ends an idle worker; a busy worker is killed.
  ~Worker() {
    if (task_) process_.kill();
    socket_.close();
    process_.wait();
  }

  int socket() const { return socket_.number(); }
  bool is_busy() const { return task_.has_value(); }
  std::size_t task() const { return *task_; }

  /// Gives the worker the task at index `place` of the list.
  bool give(std::size_t place, const Task& task) {
    task_ = place;
    return channel_.send(task_to_line(task));
  }
  /// Asks the worker to end its task early.
  void hurry() const { channel_.send(""); }
  bool receive() { return channel_.receive(); }
  std::optional<std::string> next_line() { return channel_.next_line(); }
  void finish_task() { task_.reset(); }

  /// Call once the worker has closed its socket: ends its process, and says how the process ended.
  std::string ending() {
    process_.kill();  // in case the process goes on without its socket
    task_.reset();
    return to_string(process_.wait());
  }

 private:
  Worker(cases::ChildProcess process, cases::Descriptor socket)
      : process_(std::move(process)), socket_(std::move(socket)), channel_(socket_.number()) {}

  cases::ChildProcess process_;
  cases::Descriptor socket_;
  LineChannel channel_;
  std::optional<std::size_t> task_;
};

/// The longest delay until `is_to_end` is noticed, in milliseconds.
constexpr int kPollTime = 100;

using Workers = std::vector<std::unique_ptr<Worker>>;

/// Hands out tasks and passes on their findings until all are done.
class Dispatcher {
 public:
  Dispatcher(Workers& workers, const std::vector<Task>& tasks, const TaskDone& done,
             const IsToEnd& is_to_end)
      : workers_(workers), tasks_(&tasks), done_(&done), is_to_end_(&is_to_end) {}

  /// Leaves workers that are not busy, for the next tasks; after an error, none.
  Result<void> run(const std::vector<std::string>& command, int jobs) {
    Result<void> done = run_all(command, static_cast<std::size_t>(jobs));
    if (!done) workers_.clear();
    return done;
  }

 private:
  Result<void> run_all(const std::vector<std::string>& command, std::size_t jobs) {
    is_ending_ = *is_to_end_ && (*is_to_end_)();
    for (std::size_t i = 0; i < jobs && has_more() && !error_; ++i) {
      if (i == workers_.size()) {
        Result<std::unique_ptr<Worker>> worker = Worker::start(command);
        if (!worker) return tl::unexpected(worker.error());
        workers_.push_back(*std::move(worker));
      }
      feed(*workers_[i]);
    }
    while (!error_ && wait_for_some()) {
    }
    if (error_) return tl::unexpected(*error_);
    return {};
  }

  bool has_more() const { return !is_ending_ && next_ < tasks_->size(); }

  void feed(Worker& worker) {
    if (!has_more()) return;
    const std::size_t place = next_++;
    if (!worker.give(place, (*tasks_)[place])) lose(worker);
  }

  /// Waits for a message from any worker and handles it; returns false if no worker is busy.
  bool wait_for_some() {
    std::vector<pollfd> sockets;
    std::vector<Worker*> busy;
    for (const auto& worker : workers_) {
      if (!worker->is_busy()) continue;
      sockets.push_back({worker->socket(), POLLIN, 0});
      busy.push_back(worker.get());
    }
    if (busy.empty()) return false;
    if (::poll(sockets.data(), sockets.size(), *is_to_end_ ? kPollTime : -1) < 0) {
      if (errno != EINTR) error_ = system_error("poll");
      return true;
    }
    if (!is_ending_ && *is_to_end_ && (*is_to_end_)()) {
      is_ending_ = true;
      end_early();
      return true;
    }
    for (std::size_t i = 0; i < busy.size() && !error_; ++i) {
      if (sockets[i].revents != 0) hear(*busy[i]);
    }
    return true;
  }

  /// Asks shrinking workers to end early; ends checking workers at once.
  void end_early() {
    std::erase_if(workers_, [this](const std::unique_ptr<Worker>& worker) {
      return worker->is_busy() && (*tasks_)[worker->task()].kind != TaskKind::shrink;
    });
    for (const auto& worker : workers_) {
      if (worker->is_busy()) worker->hurry();
    }
  }

  void hear(Worker& worker) {
    if (!worker.receive()) return lose(worker);
    const std::optional<std::string> line = worker.next_line();
    if (!line) return;
    Result<Findings> found = findings_from_line(*line);
    if (!found) {
      error_ = found.error();
      return;
    }
    const std::size_t place = worker.task();
    worker.finish_task();
    if (!(*done_)(place, *std::move(found))) is_ending_ = true;
    feed(worker);
  }

  void lose(Worker& worker) {
    const Task& task = (*tasks_)[worker.task()];
    std::string which = "a counterexample";
    if (task.kind == TaskKind::known) which = "the case of a known defect";
    if (task.kind == TaskKind::random || task.kind == TaskKind::corpus) {
      which = "cases " + std::to_string(task.first) + " to " + std::to_string(task.last - 1);
    }
    error_ = Error{"worker", "",
                   worker.ending() + " while checking the property '" + task.law + "' on " +
                       task.backend + ", " + which};
  }

  Workers& workers_;
  const std::vector<Task>* tasks_;
  const TaskDone* done_;
  const IsToEnd* is_to_end_;
  std::size_t next_ = 0;
  bool is_ending_ = false;
  std::optional<Error> error_;
};

/// True if standard input has data or is closed, which asks to end early.
bool is_asked_to_hurry() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return ::poll(&input, 1, 0) > 0;
}

}  // namespace

Result<void> run_tasks(TaskRunner& runner, const std::vector<Task>& tasks, const TaskDone& done,
                       const IsToEnd& is_to_end) {
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (is_to_end && is_to_end()) break;
    Result<Findings> found = runner.run(tasks[i], is_to_end);
    if (!found) return tl::unexpected(found.error());
    const bool may_be_part = tasks[i].kind != TaskKind::shrink && is_to_end && is_to_end();
    if ((may_be_part && !found->fault) || !done(i, *std::move(found))) break;
  }
  return {};
}

class TaskProcesses::Pool {
 public:
  Pool(std::vector<std::string> command, int jobs) : command_(std::move(command)), jobs_(jobs) {
    assert(jobs >= 1);
  }
  Result<void> run(const std::vector<Task>& tasks, const TaskDone& done, const IsToEnd& is_to_end) {
    return Dispatcher(workers_, tasks, done, is_to_end).run(command_, jobs_);
  }

 private:
  std::vector<std::string> command_;
  int jobs_;
  Workers workers_;
};

TaskProcesses::TaskProcesses(std::vector<std::string> command, int jobs)
    : pool_(std::make_unique<Pool>(std::move(command), jobs)) {}

TaskProcesses::~TaskProcesses() = default;

Result<void> TaskProcesses::run(const std::vector<Task>& tasks, const TaskDone& done,
                                const IsToEnd& is_to_end) {
  return pool_->run(tasks, done, is_to_end);
}

Result<void> run_tasks_in_processes(const std::vector<std::string>& command, int jobs,
                                    const std::vector<Task>& tasks, const TaskDone& done,
                                    const IsToEnd& is_to_end) {
  return TaskProcesses(command, jobs).run(tasks, done, is_to_end);
}

Result<void> serve_tasks(TaskRunner& runner) {
  // Backends may print; their output must not mix with the protocol.
  const Result<cases::Descriptor> answers = cases::take_standard_output();
  if (!answers) return tl::unexpected(answers.error());
  LineChannel input(STDIN_FILENO);
  const LineChannel output(answers->number());
  while (input.receive()) {
    while (const std::optional<std::string> line = input.next_line()) {
      if (line->empty()) continue;  // asks to end a task that had already ended
      const std::optional<Task> task = task_from_line(*line);
      if (!task) return tl::unexpected(Error{"-", "", "not a task of a campaign"});
      const std::string answer = findings_to_line(runner.run(*task, &is_asked_to_hurry));
      // The parent may be gone. Then nobody needs the answer, and this process is not at fault.
      if (!output.send(answer)) return {};
    }
  }
  return {};
}

}  // namespace rastercheck::properties
