#pragma once

// Child processes: started, waited for, limited.

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

/// A file descriptor that is closed when it goes.
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

/// Descriptors of this process that a child gets as its standard streams.
struct ChildStreams {
  int input = STDIN_FILENO;
  int output = STDOUT_FILENO;
  int error = STDERR_FILENO;
};

/// Whether Ctrl-C in a terminal, which ends a whole process group, ends a child as well.
enum class ProcessGroup { of_parent, own };

/// How a process ended.
struct ProcessEnd {
  int signal = 0;  ///< that ended it, 0 where none did
  int exit_code = 0;
  std::uint64_t most_memory = 0;  ///< bytes that it had at once; 0 where there is no telling
};

/// "ended by signal Killed", "ended with exit code 1".
std::string to_string(const ProcessEnd& end);

/// A child process; killed, if it has not ended, and waited for when it goes.
class ChildProcess {
 public:
  /// Starts a command: program and arguments. A program without a slash in its name is looked for
  /// on PATH. Fails where it cannot be started.
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

  /// With all that it started, where it has a group of its own; by SIGTERM it may end in its own
  /// way. Changes nothing of one that has ended and was waited for.
  void kill(int signal = SIGKILL) const;
  /// A descriptor that can be read from once it has ended; below 0 where the system has none.
  int end() const { return end_of_process_.number(); }
  /// Waits until it has ended, or for so long; whether it has, as far as can be told.
  bool has_ended_within(std::chrono::milliseconds time) const;
  /// Waits until it has ended.
  ProcessEnd wait();

 private:
  ChildProcess(pid_t process, ProcessGroup group);

  pid_t process_;  ///< 0: it has been waited for
  ProcessGroup group_;
  Descriptor end_of_process_;
  ProcessEnd end_;
};

/// What became of a child process that was asked one thing.
struct ChildOutcome {
  std::string output;    ///< on standard output
  bool is_whole = true;  ///< false where it said more than it may, and was killed
  ProcessEnd end;
};

/// Runs a command to its end with this process's standard input, in its process group; what it says
/// on standard error is dropped. It may say `most_output` bytes. Fails where it cannot be started.
Result<ChildOutcome> run_child(const std::vector<std::string>& command, std::uint64_t most_output);

/// The standard output of this process, for its answers: what others print from now on goes to
/// standard error.
Result<Descriptor> take_standard_output();

/// What a process may use from now on.
struct ProcessLimits {
  std::uint64_t memory = 0;  ///< bytes beyond those that it has
  unsigned seconds = 0;      ///< of processor time, 0 for any; SIGXCPU ends it then
  bool may_write = false;    ///< to the files that it can open
  bool operator==(const ProcessLimits&) const = default;
};

/// Limits this process, which also leaves no core dumps from now on.
Result<void> limit_this_process(const ProcessLimits& limits);

/// Ends this process by SIGXCPU once it has used so much processor time more, on all processors
/// together. What was said before no longer holds.
Result<void> limit_processor_time_from_now(std::chrono::duration<double> time);

}  // namespace rastercheck::cases
