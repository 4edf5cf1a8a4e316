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
  /// Starts it and hears its greeting. The error's file is the specification; a process that ended
  /// or did not answer is `unavailable`.
  static Result<WorkerProcess> start(const std::string& specification, const Isolation& isolation);

  const Greeting& greeting() const { return greeting_; }

  /// The answer to a request. Fails where the process ends (Failure::crash) or does not answer in
  /// time (Failure::hang); it is gone then.
  Result<std::string> ask(const Request& request);
  /// Ends the process, whose last answer was none, and says so.
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
  std::uint64_t beats_ = 0;  ///< of the channel, when last looked at
  bool is_late_ = false;
  Greeting greeting_;
};

}  // namespace rastercheck::backends
