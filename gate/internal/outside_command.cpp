#include "gate/internal/outside_command.h"

#include <fcntl.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <sstream>
#include <string_view>

#include "cases/json.h"

namespace rastercheck::gate {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Time between two calls of is_to_end().
constexpr milliseconds kTurn{100};
/// Time that a command has to end in its own way: git removes its locks.
constexpr seconds kGrace{10};

Result<cases::Descriptor> open_file(const std::string& file, int flags) {
  constexpr mode_t kReadableByAll = 0644;
  cases::Descriptor opened(::open(file.c_str(), flags | O_CLOEXEC, kReadableByAll));
  if (opened.is_open()) return opened;
  return tl::unexpected(Error{file, "", std::string("cannot be opened: ") + std::strerror(errno)});
}

}  // namespace

Result<cases::ProcessEnd> run_outside(const std::vector<std::string>& command,
                                      const OutsideRun& how) {
  const Result<cases::Descriptor> nothing = open_file("/dev/null", O_RDONLY);
  if (!nothing) return tl::unexpected(nothing.error());
  const Result<cases::Descriptor> log = open_file(how.log, O_WRONLY | O_CREAT | O_APPEND);
  if (!log) return tl::unexpected(log.error());
  cases::ChildStreams streams{nothing->number(), log->number(), log->number()};
  Result<cases::Descriptor> output;
  if (!how.output.empty()) {
    output = open_file(how.output, O_WRONLY | O_CREAT | O_TRUNC);
    if (!output) return tl::unexpected(output.error());
    streams.output = output->number();
  }
  Result<cases::ChildProcess> child = cases::ChildProcess::start(command, streams, how.group);
  if (!child) return tl::unexpected(child.error());
  while (!child->has_ended_within(kTurn)) {
    if (!how.is_to_end()) continue;
    child->kill(SIGTERM);
    static_cast<void>(child->has_ended_within(kGrace));
    child->kill();  // also any processes that it left behind
    break;
  }
  return child->wait();
}

std::string telling_line(const std::string& text) {
  constexpr std::string_view kBlank = " \t\r";
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(kBlank);
    if (begin == std::string::npos) continue;
    last = line.substr(begin, line.find_last_not_of(kBlank) + 1 - begin);
    if (last.find("error:") != std::string::npos) break;
  }
  return cases::printable(last);
}

}  // namespace rastercheck::gate
