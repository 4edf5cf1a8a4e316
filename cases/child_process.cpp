#include "cases/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <utility>

namespace rastercheck::cases {
namespace {

tl::unexpected<Error> call_failure(const std::string& what, int problem) {
  return tl::unexpected(Error{what, "", std::strerror(problem)});
}

/// Reads until the other end is closed; returns false if more than `most` bytes come.
bool read_all(int from, std::uint64_t most, std::string& all) {
  std::array<char, 65536> part{};
  for (;;) {
    const ssize_t count = ::read(from, part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    if (all.size() + static_cast<std::size_t>(count) > most) return false;
    all.append(part.data(), static_cast<std::size_t>(count));
  }
}

/// The bytes of memory that this process has: of its address space, or of what it may write.
std::uint64_t memory_in_use(bool is_address_space) {
  // Sizes in pages: program, resident, shared, text, libraries (always 0), data.
  std::array<std::uint64_t, 6> pages{};
  std::ifstream sizes("/proc/self/statm");
  for (std::uint64_t& size : pages) sizes >> size;
  return (is_address_space ? pages.front() : pages.back()) *
         static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

std::string to_string(const ProcessEnd& end) {
  if (end.signal != 0) return std::string("was killed by signal ") + ::strsignal(end.signal);
  return "ended with exit code " + std::to_string(end.exit_code);
}

Result<ChildProcess> ChildProcess::start(const std::vector<std::string>& command,
                                         const ChildStreams& streams, ProcessGroup group) {
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  if (group == ProcessGroup::own) posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int kFourth = 3;
  for (const auto& [from, to] :
       {std::pair(streams.input, STDIN_FILENO), std::pair(streams.output, STDOUT_FILENO),
        std::pair(streams.error, STDERR_FILENO), std::pair(streams.fourth, kFourth)}) {
    if (from < 0) continue;
    // Needed even if both are the same, because the descriptor must stay open in the child.
    posix_spawn_file_actions_adddup2(&actions, from, to);
  }
  pid_t process = 0;
  const int problem =
      ::posix_spawnp(&process, arguments.front(), &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (problem != 0) {
    return tl::unexpected(
        Error{command.front(), "", std::string("cannot be started: ") + std::strerror(problem)});
  }
  return ChildProcess(process, group);
}

ChildProcess::ChildProcess(pid_t process, ProcessGroup group)
    // Makes the system call directly, because the C library's header declares pidfd_open() only for
    // C.
    : process_(process),
      group_(group),
      end_of_process_(static_cast<int>(::syscall(SYS_pidfd_open, process, 0))) {}

ChildProcess::~ChildProcess() {
  kill();
  wait();
}

void ChildProcess::kill(int signal) const {
  if (process_ == 0) return;
  ::kill(group_ == ProcessGroup::own ? -process_ : process_, signal);
}

bool ChildProcess::has_ended_within(std::chrono::milliseconds time) const {
  if (process_ == 0) return true;
  const auto deadline = std::chrono::steady_clock::now() + time;
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd ended{end(), POLLIN, 0};
    const int count = ::poll(&ended, 1, std::max(0, static_cast<int>(left.count())));
    if (count >= 0 || errno != EINTR) return count > 0;
  }
}

ProcessEnd ChildProcess::wait() {
  if (process_ == 0) return end_;
  int status = 0;
  rusage used{};
  while (::wait4(process_, &status, 0, &used) < 0 && errno == EINTR) {
  }
  process_ = 0;
  constexpr std::uint64_t kKibibyte = 1024;
  // A child begins as a copy of its parent, whose memory is counted as the child's. So only a peak
  // above the parent's is known to be the child's own.
  rusage of_parent{};
  ::getrusage(RUSAGE_SELF, &of_parent);
  if (used.ru_maxrss > of_parent.ru_maxrss) {
    end_.most_memory = static_cast<std::uint64_t>(used.ru_maxrss) * kKibibyte;
  }
  if (WIFSIGNALED(status)) end_.signal = WTERMSIG(status);
  if (WIFEXITED(status)) end_.exit_code = WEXITSTATUS(status);
  return end_;
}

Result<ChildOutcome> run_child(const std::vector<std::string>& command, std::uint64_t most_output) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return call_failure("pipe", errno);
  const Descriptor ours(ends[0]);
  Descriptor theirs(ends[1]);
  const Descriptor nowhere(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  if (!nowhere.is_open()) return call_failure("/dev/null", errno);
  Result<ChildProcess> child = ChildProcess::start(
      command, {.output = theirs.number(), .error = nowhere.number()}, ProcessGroup::of_parent);
  if (!child) return tl::unexpected(child.error());
  theirs.close();

  ChildOutcome outcome;
  outcome.is_whole = read_all(ours.number(), most_output, outcome.output);
  if (!outcome.is_whole) child->kill();
  outcome.end = child->wait();
  return outcome;
}

Result<Descriptor> take_standard_output() {
  Descriptor answers(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3));
  if (!answers.is_open() || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
    return call_failure("standard output", errno);
  }
  return answers;
}

Result<void> limit_this_process(const ProcessLimits& limits) {
  // Limits sizes that make allocations fail. The limit adds to the present size, because sanitizers
  // have terabytes of address space from the start.
  const std::uint64_t has = memory_in_use(!limits.may_reserve_memory);
  const rlim_t memory = has + std::min(limits.memory, RLIM_INFINITY - 1 - has);
  const auto counted = limits.may_reserve_memory ? RLIMIT_DATA : RLIMIT_AS;
  std::vector<std::pair<__rlimit_resource, rlimit>> all{{counted, {memory, memory}},
                                                        {RLIMIT_CORE, {0, 0}}};
  if (!limits.may_write) all.push_back({RLIMIT_FSIZE, {0, 0}});
  if (limits.seconds > 0) all.push_back({RLIMIT_CPU, {limits.seconds, limits.seconds + 1}});
  for (auto& [resource, limit] : all) {
    // Keeps limits that are already stricter.
    rlimit now{};
    if (::getrlimit(resource, &now) != 0) return call_failure("getrlimit", errno);
    limit.rlim_max = std::min(limit.rlim_max, now.rlim_max);
    limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max);
    if (::setrlimit(resource, &limit) != 0) return call_failure("setrlimit", errno);
  }
  return {};
}

Result<void> limit_processor_time_from_now(std::chrono::duration<double> time) {
  timespec used{};
  if (::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used) != 0)
    return call_failure("clock_gettime", errno);
  // Limits are whole seconds; rounds up, so that the limit is not shorter than asked for.
  const rlim_t seconds = static_cast<rlim_t>(used.tv_sec) + static_cast<rlim_t>(time.count()) + 2;
  rlimit limit{};
  if (::getrlimit(RLIMIT_CPU, &limit) != 0) return call_failure("getrlimit", errno);
  limit.rlim_cur = std::min(seconds, limit.rlim_max);
  if (::setrlimit(RLIMIT_CPU, &limit) != 0) return call_failure("setrlimit", errno);
  return {};
}

}  // namespace rastercheck::cases
