#pragma once

#include <sys/types.h>

#include <memory>
#include <string>
#include <vector>

#include "cases/error.h"

namespace rastercheck::bench {

/// A process that answers lines with lines, "ok …" or "error …", and ends when its input does.
class PeerProcess {
 public:
  /// Starts a program in this process's environment, changed by `settings`: "NAME=value" sets a
  /// variable, "NAME" removes it.
  static Result<std::unique_ptr<PeerProcess>> start(const std::string& program,
                                                    const std::vector<std::string>& settings);

  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;
  ~PeerProcess();

  /// Waits for the next answer and returns the text after "ok ". Fails with the text after "error
  /// ", or if the process has ended.
  Result<std::string> hear();
  Result<std::string> ask(const std::string& line);

 private:
  PeerProcess(std::string program, pid_t process, int socket)
      : program_(std::move(program)), process_(process), socket_(socket) {}

  std::string program_;
  pid_t process_;
  int socket_;
  std::string heard_;
};

}  // namespace rastercheck::bench
