#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "backends/internal/channel.h"
#include "backends/internal/log_tail.h"
#include "backends/internal/wire.h"
#include "backends/isolation.h"
#include "cases/child_process.h"
#include "cases/error.h"

namespace rastercheck::backends {

/// A process that draws with a backend (serve_backend()).
class WorkerProcess {
 public:
  /// Starts the process and receives its greeting. An error names the specification as its file. If
  /// the process ends or does not answer, the failure is `unavailable`.
  static Result<WorkerProcess> start(const std::string& specification, const Isolation& isolation);

  const Greeting& greeting() const { return greeting_; }

  /// Asks a question and returns the answer. Fails if the process ends (Failure::crash) or does not
  /// answer in time (Failure::hang). After a failure, the process is gone.
  Result<std::string> ask(const Request& request);
  /// Adds what was written to standard error since the last question to an error.
  Error with_last_words(Error error);
  /// Ends the process because its last answer was invalid, and returns that as an error.
  Error end_for_nonsense();

 private:
  using Clock = std::chrono::steady_clock;

  WorkerProcess(std::string specification, const Isolation& isolation, cases::ChildProcess process,
                Channel channel, LogTail log)
      : specification_(std::move(specification)),
        isolation_(isolation),
        process_(std::move(process)),
        channel_(std::move(channel)),
        log_(std::move(log)) {}

  Result<std::string> receive(std::string_view doing, std::uint64_t most);
  bool wait();
  Error loss(std::string_view doing);
  Clock::time_point deadline() const;

  std::string specification_;
  Isolation isolation_;
  cases::ChildProcess process_;
  Channel channel_;
  LogTail log_;
  Clock::time_point deadline_;
  std::uint64_t beats_ = 0;  ///< the number of beats when last checked
  bool is_late_ = false;
  Greeting greeting_;
};

}  // namespace rastercheck::backends
