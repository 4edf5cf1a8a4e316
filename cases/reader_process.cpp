#include "cases/reader_process.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace rastercheck::cases {
namespace {

/// The reason why a process failed.
std::string reason_of(const ChildOutcome& outcome, std::string_view what,
                      const ProcessLimits& limits) {
  if (!outcome.is_whole) return fmt::format("the {0} reader's answer is larger than any {0}", what);
  if (outcome.end.signal == SIGXCPU) {
    return fmt::format("the {} reader took longer than {} s", what, limits.seconds);
  }
  if (outcome.end.signal != 0) {
    return fmt::format("the {} reader crashed ({})", what, ::strsignal(outcome.end.signal));
  }
  return fmt::format("the {} reader {}", what, to_string(outcome.end));
}

bool write_all(int to, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(to, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

ProcessLimits default_reader_limits() {
  constexpr unsigned kSeconds = 120;
  const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
  return {pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 2, kSeconds};
}

Result<std::string> reply_of_reader(const std::vector<std::string>& command,
                                    const std::string& file, std::string_view what,
                                    const ProcessLimits& limits) {
  Result<ChildOutcome> outcome = run_child(command, limits.memory);
  if (!outcome) return tl::unexpected(outcome.error());
  if (!outcome->is_whole || outcome->end.signal != 0 || outcome->end.exit_code != 0) {
    return tl::unexpected(Error{file, "", reason_of(*outcome, what, limits)});
  }
  return std::move(outcome->output);
}

Result<void> serve_reply(const std::function<std::string()>& answer, const ProcessLimits& limits) {
  // Libraries' readers print; their output must not get into the answer.
  const Result<Descriptor> answers = take_standard_output();
  if (!answers) return tl::unexpected(answers.error());
  return limit_this_process(limits).and_then([&]() -> Result<void> {
    if (write_all(answers->number(), answer())) return {};
    return tl::unexpected(Error{"standard output", "", std::strerror(errno)});
  });
}

}  // namespace rastercheck::cases
