#include "backends/internal/worker_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

namespace rastercheck::backends {
namespace {

/// Milliseconds; more than poll() takes at once is waited for in parts.
constexpr std::int64_t kLongestPoll = 60'000;
/// What a process that crashes may take to be gone.
constexpr std::chrono::milliseconds kLongestEnd{1000};
constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20U;

tl::unexpected<Error> failure(const std::string& what) {
  return tl::unexpected(Error{what, "", std::strerror(errno)});
}

std::vector<std::string> command_of(const std::string& specification, const Isolation& isolation) {
  std::vector<std::string> command = isolation.command;
  command.insert(command.end(),
                 {"--seconds", fmt::format("{}", isolation.timeout.count()), "--memory",
                  std::to_string(isolation.memory), "--", specification});
  return command;
}

/// Two ends of a socket.
Result<std::array<cases::Descriptor, 2>> socket_pair() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return failure("socketpair");
  }
  return std::array{cases::Descriptor(ends[0]), cases::Descriptor(ends[1])};
}

/// The ends of a pipe, the one to be read first, which does not block.
Result<std::array<cases::Descriptor, 2>> log_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return failure("pipe");
  std::array both{cases::Descriptor(ends[0]), cases::Descriptor(ends[1])};
  if (::fcntl(ends[0], F_SETFL, O_NONBLOCK) != 0) return failure("fcntl");
  return both;
}

}  // namespace

Result<WorkerProcess> WorkerProcess::start(const std::string& specification,
                                           const Isolation& isolation) {
  Result<SharedMemory> memory = SharedMemory::create(Channel::memory_size());
  if (!memory) return tl::unexpected(memory.error());
  Result<std::array<cases::Descriptor, 2>> bells = socket_pair();
  if (!bells) return tl::unexpected(bells.error());
  Result<std::array<cases::Descriptor, 2>> log = log_pipe();
  if (!log) return tl::unexpected(log.error());
  auto& [bell, their_bell] = *bells;
  auto& [words, their_words] = *log;
  Result<cases::ChildProcess> process = cases::ChildProcess::start(
      command_of(specification, isolation),
      {their_bell.number(), memory->file(), their_words.number()}, cases::ProcessGroup::own);
  if (!process) return tl::unexpected(process.error());
  // Or there would be no end of what can be heard when the process has ended.
  their_bell.close();
  their_words.close();

  WorkerProcess worker(specification, isolation, *std::move(process),
                       Channel(*std::move(memory), std::move(bell)), LogTail(std::move(words)));
  const Result<std::string> said = worker.receive("when it was started");
  std::optional<Greeting> greeting;
  if (said) greeting = unpack_greeting(*said);
  if (!greeting) {
    Error lost = said ? worker.loss("when it was started") : said.error();
    lost.failure = Failure::unavailable;
    return tl::unexpected(lost);
  }
  if (greeting->problem) return tl::unexpected(*greeting->problem);
  worker.greeting_ = *std::move(greeting);
  return worker;
}

Result<std::string> WorkerProcess::ask(const Request& request) {
  const char* const doing =
      request.question == Question::drawing ? "while it drew" : "when asked for its contract";
  log_.read();
  log_.forget();
  deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(isolation_.timeout);
  if (!channel_.send(pack(request), [this] { return wait(); })) {
    return tl::unexpected(loss(doing));
  }
  return receive(doing);
}

Result<std::string> WorkerProcess::receive(std::string_view doing) {
  deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(isolation_.timeout);
  std::optional<std::string> answer =
      channel_.receive(isolation_.memory, [this] { return wait(); });
  if (!answer) return tl::unexpected(loss(doing));
  return *std::move(answer);
}

/// Until the bell rings, or nobody is there to ring it; hears what is said meanwhile.
bool WorkerProcess::wait() {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_ - Clock::now());
    is_late_ = left.count() <= 0;
    if (is_late_) return false;
    std::array<pollfd, 2> ends{{{channel_.bell(), POLLIN, 0}, {log_.pipe(), POLLIN, 0}}};
    const int most = static_cast<int>(std::min<std::int64_t>(left.count(), kLongestPoll));
    if (::poll(ends.data(), ends.size(), most) < 0 && errno != EINTR) return false;
    if (ends[1].revents != 0) log_.read();
    if (ends[0].revents != 0) return true;
  }
}

/// Ends the process, and says how it ended.
Error WorkerProcess::loss(std::string_view doing) {
  // One that hung up is about to end, and has to say how; if it goes on it is of no use.
  if (!is_late_) process_.has_ended_within(kLongestEnd);
  process_.kill();
  const cases::ProcessEnd end = process_.wait();
  log_.read();
  const bool is_hang = is_late_ || end.signal == SIGXCPU;
  const std::string how =
      is_late_ ? fmt::format("did not answer within {} s", isolation_.timeout.count())
      : end.signal == SIGXCPU
          ? fmt::format("took more processor time than {} s of wall time can have",
                        isolation_.timeout.count())
          : to_string(end);
  std::string more;
  if (end.most_memory >= isolation_.memory / 2) {
    more = fmt::format("; it had taken {} MiB, of {} MiB that it may take",
                       end.most_memory / kMebibyte, isolation_.memory / kMebibyte);
  }
  const std::string words = log_.last_lines();
  if (!words.empty()) more += "; its last words: " + words;
  return {specification_, "", fmt::format("its process {} {}{}", how, doing, more),
          is_hang ? Failure::hang : Failure::crash};
}

}  // namespace rastercheck::backends
