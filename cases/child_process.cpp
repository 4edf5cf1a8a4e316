#include "cases/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <utility>

namespace rastercheck::cases {
namespace {

tl::unexpected<Error> failure(const std::string& what, int problem) {
  return tl::unexpected(Error{what, "", std::strerror(problem)});
}

/// The end of a pipe, closed when it goes.
class PipeEnd {
 public:
  explicit PipeEnd(int number) : number_(number) {}
  PipeEnd(const PipeEnd&) = delete;
  PipeEnd& operator=(const PipeEnd&) = delete;
  ~PipeEnd() { close(); }
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }

 private:
  int number_;
};

/// Starts the command with `output` as its standard output; 0, or why it cannot be started.
int spawn(const std::vector<std::string>& command, int output, pid_t& process) {
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const int problem =
      ::posix_spawn(&process, arguments.front(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return problem;
}

/// Reads until the other end is closed; false where there is more than `most`.
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

/// Bytes of address space that this process has.
std::uint64_t address_space() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

Result<ChildOutcome> run_child(const std::vector<std::string>& command, std::uint64_t most_output) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return failure("pipe", errno);
  const PipeEnd ours(ends[0]);
  PipeEnd theirs(ends[1]);
  pid_t process = 0;
  if (const int problem = spawn(command, theirs.number(), process); problem != 0) {
    return failure(command.front(), problem);
  }
  theirs.close();

  ChildOutcome outcome;
  outcome.is_whole = read_all(ours.number(), most_output, outcome.output);
  if (!outcome.is_whole) ::kill(process, SIGKILL);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  return outcome;
}

Result<void> limit_this_process(const ProcessLimits& limits) {
  // Of the address space, because that is what allocations fail by; sanitizers have terabytes of it
  // from the start.
  const rlim_t memory = address_space() + limits.memory;
  const std::array<std::pair<__rlimit_resource, rlimit>, 4> all{
      {{RLIMIT_AS, {memory, memory}},
       {RLIMIT_CPU, {limits.seconds, limits.seconds + 1}},
       {RLIMIT_CORE, {0, 0}},
       {RLIMIT_FSIZE, {0, 0}}}};
  for (const auto& [resource, limit] : all) {
    if (::setrlimit(resource, &limit) != 0) return failure("setrlimit", errno);
  }
  return {};
}

}  // namespace rastercheck::cases
