#include "tests/bench/peer_process.h"

#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

namespace rastercheck::bench {
namespace {

std::string_view name_of(std::string_view setting) { return setting.substr(0, setting.find('=')); }

/// The environment of this process, changed by the settings.
std::vector<std::string> environment_with(const std::vector<std::string>& settings) {
  std::vector<std::string> all;
  for (const std::string& setting : settings) {
    if (setting.find('=') != std::string::npos) all.push_back(setting);
  }
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const bool is_set = std::any_of(settings.begin(), settings.end(), [&](const std::string& s) {
      return name_of(s) == name_of(*entry);
    });
    if (!is_set) all.emplace_back(*entry);
  }
  return all;
}

}  // namespace

Result<std::unique_ptr<PeerProcess>> PeerProcess::start(const std::string& program,
                                                        const std::vector<std::string>& settings) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return tl::unexpected(Error{"socketpair", "", std::strerror(errno)});
  }
  std::string path = program;
  std::array<char*, 2> arguments = {path.data(), nullptr};
  std::vector<std::string> entries = environment_with(settings);
  std::vector<char*> environment;
  for (std::string& entry : entries) environment.push_back(entry.data());
  environment.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  pid_t process = 0;
  const int problem = ::posix_spawn(&process, path.c_str(), &actions, nullptr, arguments.data(),
                                    environment.data());
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (problem != 0) {
    ::close(ends[0]);
    return tl::unexpected(
        Error{program, "", std::string("cannot be started: ") + std::strerror(problem)});
  }
  return std::unique_ptr<PeerProcess>(new PeerProcess(program, process, ends[0]));
}

PeerProcess::~PeerProcess() {
  ::close(socket_);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

Result<std::string> PeerProcess::hear() {
  std::size_t end = 0;
  while ((end = heard_.find('\n')) == std::string::npos) {
    std::array<char, 4096> part{};
    const ssize_t count = ::read(socket_, part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return tl::unexpected(Error{program_, "", "it has ended"});
    heard_.append(part.data(), static_cast<std::size_t>(count));
  }
  const std::string line = heard_.substr(0, end);
  heard_.erase(0, end + 1);
  if (line.starts_with("ok ")) return line.substr(3);
  if (line.starts_with("error ")) return tl::unexpected(Error{"", "", line.substr(6)});
  return tl::unexpected(Error{program_, "", "no answer but '" + line + "'"});
}

Result<std::string> PeerProcess::ask(const std::string& line) {
  const std::string sent = line + "\n";
  // Lines are a few bytes, so they are sent whole. If the process has ended, hear() reports it.
  [[maybe_unused]] const ssize_t written = ::send(socket_, sent.data(), sent.size(), MSG_NOSIGNAL);
  return hear();
}

}  // namespace rastercheck::bench
