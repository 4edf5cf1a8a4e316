#pragma once

// Starts child processes, waits for them, and limits their resources.

#include <sys/types.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cases/error.h"

namespace rastercheck::cases {

/// A file descriptor, closed on destruction.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  void close() {
    if (is_open()) ::close(std::exchange(number_, -1));
  }

 private:
  int number_ = -1;
};

/// Descriptors of this process that a child gets as its standard streams, and one more.
struct ChildStreams {
  int input = STDIN_FILENO;
  int output = STDOUT_FILENO;
  int error = STDERR_FILENO;
  int fourth = -1;  ///< becomes descriptor 3 of the child; negative for none
};

/// Decides whether Ctrl-C in a terminal, which ends a whole process group, ends a child as well.
enum class ProcessGroup { of_parent, own };

/// How a process ended.
struct ProcessEnd {
  int signal = 0;  ///< the signal that ended the process; 0 if none did
  int exit_code = 0;
  std::uint64_t most_memory = 0;  ///< peak, bytes; 0 if unknown
};

/// "was killed by signal Killed", "ended with exit code 1".
std::string to_string(const ProcessEnd& end);

/// A child process. The destructor kills it if it still runs, and waits for it.
class ChildProcess {
 public:
  /// Starts a command: program and arguments. A program without a slash in its name is searched for
  /// on PATH. Fails if the program cannot be started.
  static Result<ChildProcess> start(const std::vector<std::string>& command,
                                    const ChildStreams& streams, ProcessGroup group);

  ChildProcess(ChildProcess&& other) noexcept
      : process_(std::exchange(other.process_, 0)),
        group_(other.group_),
        end_of_process_(std::move(other.end_of_process_)),
        end_(other.end_) {}
  ChildProcess& operator=(ChildProcess&&) = delete;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// Sends a signal to the process or, if it has a process group of its own, to that whole group;
  /// SIGTERM lets the process end in its own way. Does nothing after wait().
  void kill(int signal = SIGKILL) const;
  /// A descriptor that becomes readable when the process has ended; negative if the system lacks
  /// such descriptors.
  int end() const { return end_of_process_.number(); }
  /// Waits at most `time` for the process to end. Returns true if the process has ended, false if
  /// it has not or if that is unknown.
  bool has_ended_within(std::chrono::milliseconds time) const;
  /// Waits until the process has ended.
  ProcessEnd wait();

 private:
  ChildProcess(pid_t process, ProcessGroup group);

  pid_t process_;  ///< 0 after wait()
  ProcessGroup group_;
  Descriptor end_of_process_;
  ProcessEnd end_;
};

/// The outcome of a child process that ran one command.
struct ChildOutcome {
  std::string output;    ///< what it wrote to standard output
  bool is_whole = true;  ///< false if it wrote too much and was killed
  ProcessEnd end;
};

/// Runs a command to its end, with this process's standard input and in its process group. Discards
/// its standard error. Kills it if it writes more than `most_output` bytes. Fails if the command
/// cannot be started.
Result<ChildOutcome> run_child(const std::vector<std::string>& command, std::uint64_t most_output);

/// Reserves this process's standard output for answers and returns its descriptor. Anything that
/// other code prints from now on goes to standard error.
Result<Descriptor> take_standard_output();

/// The resources that a process may use from now on.
struct ProcessLimits {
  std::uint64_t memory = 0;  ///< bytes beyond those already in use
  unsigned seconds = 0;      ///< processor time, then SIGXCPU ends the process; 0: no limit
  bool may_write = false;    ///< may write to files
  /// True if only private memory that the process may write counts as memory. Otherwise all of its
  /// address space counts, including what it merely reserves.
  bool may_reserve_memory = false;
  bool operator==(const ProcessLimits&) const = default;
};

/// Limits this process, and disables core dumps.
Result<void> limit_this_process(const ProcessLimits& limits);

/// Limits this process to `time` of further processor time, on all processors together; SIGXCPU
/// then ends the process. Replaces any earlier limit.
Result<void> limit_processor_time_from_now(std::chrono::duration<double> time);

}  // namespace rastercheck::cases
