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
#include <filesystem>
#include <system_error>
#include <utility>

#include "backends/driver_root.h"

namespace rastercheck::backends {
namespace {

/// The longest single wait, in milliseconds. Longer waits are split, because poll() takes an int.
constexpr std::int64_t kLongestPoll = 60'000;
/// How long a crashing process may take to end.
constexpr std::chrono::milliseconds kLongestEnd{1000};
/// The most bytes of a greeting or a contract.
constexpr std::uint64_t kMostMessageBytes = 65536;
constexpr std::string_view kWhileDrawing = "while drawing";
constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20U;

tl::unexpected<Error> process_failure(const std::string& what) {
  return tl::unexpected(Error{what, "", std::strerror(errno)});
}

Result<std::vector<std::string>> command_of(const std::string& specification,
                                            const Isolation& isolation) {
  Result<std::vector<std::string>> command = loader_command(specification);
  if (!command) return command;
  const bool has_loader = !command->empty();
  command->insert(command->end(), isolation.command.begin(), isolation.command.end());
  // In a process that a loader starts, a name in /proc/self means the loader.
  if (has_loader && isolation.command[0].starts_with("/proc/self/")) {
    std::error_code problem;
    (*command)[command->size() - isolation.command.size()] =
        std::filesystem::read_symlink(isolation.command[0], problem).string();
    if (problem) return tl::unexpected(Error{specification, "", problem.message()});
  }
  command->insert(command->end(),
                  {"--seconds", fmt::format("{}", isolation.timeout.count()), "--memory",
                   std::to_string(isolation.memory), "--", specification});
  return command;
}

/// The most bytes of the answer to a request: of a drawing in which each triangle covers each
/// sample, or of a picture, plus a reserve.
std::uint64_t most_bytes(const Request& request) {
  constexpr double kMost = 0x1p40;
  const cases::Case& c = request.source;
  const double samples =
      static_cast<double>(c.framebuffer.width) * c.framebuffer.height * c.framebuffer.samples;
  if (request.question == Question::picture) {
    // A depth and the channels: one for each attribute, or a colour.
    const double sample =
        4 + 4 * static_cast<double>(std::max<std::size_t>(c.attributes.size(), 4));
    return static_cast<std::uint64_t>(std::min(samples * sample, kMost)) + kMostMessageBytes;
  }
  const bool is_assembly = request.question == Question::assembly;
  if (request.question != Question::drawing && !is_assembly) return kMostMessageBytes;
  // Each index begins at most one triangle or line.
  const std::size_t primitives = is_assembly ? request.indices.size() : c.triangles.size();
  const double fragments = samples * static_cast<double>(primitives);
  // A triangle number, x, y, sample and depth; for each attribute, its value and two derivatives.
  const double fragment = 13 + 12 * static_cast<double>(c.attributes.size());
  return static_cast<std::uint64_t>(std::min(fragments * fragment, kMost)) + kMostMessageBytes;
}

/// Returns the two ends of a socket.
Result<std::array<cases::Descriptor, 2>> socket_pair() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return process_failure("socketpair");
  }
  return std::array{cases::Descriptor(ends[0]), cases::Descriptor(ends[1])};
}

/// Returns the two ends of a pipe. The first is the reading end, which is non-blocking.
Result<std::array<cases::Descriptor, 2>> log_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return process_failure("pipe");
  std::array both{cases::Descriptor(ends[0]), cases::Descriptor(ends[1])};
  if (::fcntl(ends[0], F_SETFL, O_NONBLOCK) != 0) return process_failure("fcntl");
  return both;
}

}  // namespace

Result<WorkerProcess> WorkerProcess::start(const std::string& specification,
                                           const Isolation& isolation) {
  const Result<std::vector<std::string>> command = command_of(specification, isolation);
  if (!command) return tl::unexpected(command.error());
  Result<SharedMemory> memory = SharedMemory::create(Channel::memory_size());
  if (!memory) return tl::unexpected(memory.error());
  Result<std::array<cases::Descriptor, 2>> bells = socket_pair();
  if (!bells) return tl::unexpected(bells.error());
  Result<std::array<cases::Descriptor, 2>> log = log_pipe();
  if (!log) return tl::unexpected(log.error());
  auto& [bell, their_bell] = *bells;
  auto& [words, their_words] = *log;
  Result<cases::ChildProcess> process = cases::ChildProcess::start(
      *command, {their_bell.number(), memory->file(), their_words.number()},
      cases::ProcessGroup::own);
  if (!process) return tl::unexpected(process.error());
  // If these stayed open here, the bell and the log would never report their end after the process
  // has ended.
  their_bell.close();
  their_words.close();

  WorkerProcess worker(specification, isolation, *std::move(process),
                       Channel(*std::move(memory), std::move(bell)), LogTail(std::move(words)));
  worker.deadline_ = worker.deadline();
  const Result<std::string> said = worker.receive("while starting", kMostMessageBytes);
  std::optional<Greeting> greeting;
  if (said) greeting = unpack_greeting(*said);
  if (!greeting) {
    Error lost = said ? worker.end_for_nonsense() : said.error();
    lost.failure = Failure::unavailable;
    return tl::unexpected(lost);
  }
  if (greeting->problem) return tl::unexpected(worker.with_last_words(*greeting->problem));
  worker.greeting_ = *std::move(greeting);
  return worker;
}

WorkerProcess::Clock::time_point WorkerProcess::deadline() const {
  constexpr std::chrono::duration<double> kLongest = std::chrono::hours(24);
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::min(isolation_.timeout, kLongest));
}

Result<std::string> WorkerProcess::ask(const Request& request) {
  log_.read();
  if (process_.has_ended_within({})) return tl::unexpected(loss("after its last answer"));
  log_.forget();
  const bool is_drawing = request.question == Question::drawing ||
                          request.question == Question::assembly ||
                          request.question == Question::picture;
  const std::string_view doing = is_drawing ? kWhileDrawing : "while giving its contract";
  deadline_ = deadline();
  if (!channel_.send(pack(request), [this] { return wait(); })) {
    return tl::unexpected(loss(doing));
  }
  return receive(doing, most_bytes(request));
}

Result<std::string> WorkerProcess::receive(std::string_view doing, std::uint64_t most) {
  std::optional<std::string> answer = channel_.receive(most, [this] { return wait(); });
  if (!answer) return tl::unexpected(loss(doing));
  return *std::move(answer);
}

/// Waits until the bell rings. Returns false if it never will, or if the process is silent for too
/// long. Meanwhile, reads what the process writes.
bool WorkerProcess::wait() {
  for (;;) {
    // The time limit starts again with each sign of progress.
    if (const std::uint64_t beats = channel_.beats(); beats != beats_) {
      beats_ = beats;
      deadline_ = deadline();
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_ - Clock::now());
    is_late_ = left.count() <= 0;
    if (is_late_) return false;
    // Also watch for the process's end, because its children may hold the bell open and never ring
    // it.
    std::array<pollfd, 3> ends{
        {{channel_.bell(), POLLIN, 0}, {log_.pipe(), POLLIN, 0}, {process_.end(), POLLIN, 0}}};
    const int most = static_cast<int>(std::min<std::int64_t>(left.count(), kLongestPoll));
    if (::poll(ends.data(), ends.size(), most) < 0) {
      if (errno != EINTR) return false;
      continue;
    }
    if (ends[1].revents != 0) log_.read();
    if (ends[0].revents != 0) return true;
    if (ends[2].revents != 0) return false;
  }
}

Error WorkerProcess::end_for_nonsense() {
  is_late_ = false;
  return loss("after an invalid answer");
}

/// Ends the process and reports how it ended.
Error WorkerProcess::loss(std::string_view doing) {
  // A process that closed the channel is about to end, so wait to learn how. If it does not end in
  // time, it is killed.
  const bool has_ended =
      process_.has_ended_within(is_late_ ? std::chrono::milliseconds(0) : kLongestEnd);
  process_.kill();
  const cases::ProcessEnd end = process_.wait();
  const bool is_late = is_late_ && !has_ended;
  std::string how = to_string(end);
  if (is_late) {
    how = fmt::format("did not answer within {} s (--timeout)", isolation_.timeout.count());
  } else if (end.signal == SIGXCPU) {
    how = fmt::format("used more processor time than {} s of wall time allow",
                      isolation_.timeout.count());
  } else if (!has_ended) {
    how = "closed its connection and was stopped";
  }
  std::string more;
  if (is_late && doing == kWhileDrawing) more = "; large cases may need more time";
  if (end.most_memory >= isolation_.memory / 2) {
    more += fmt::format("; it used {} MiB of the {} MiB allowed", end.most_memory / kMebibyte,
                        isolation_.memory / kMebibyte);
  }
  return with_last_words({specification_, "", fmt::format("its process {} {}{}", how, doing, more),
                          is_late || end.signal == SIGXCPU ? Failure::hang : Failure::crash});
}

Error WorkerProcess::with_last_words(Error error) {
  log_.read();
  const std::string words = log_.last_lines();
  if (!words.empty()) error.reason += "; its last output: " + words;
  return error;
}

}  // namespace rastercheck::backends
