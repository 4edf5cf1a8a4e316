#pragma once

#include <cstddef>
#include <string>

#include "cases/child_process.h"

namespace rastercheck::backends {

/// Collects what a process writes to a pipe, and keeps the last lines.
class LogTail {
 public:
  /// Takes the pipe's reading end, which must be non-blocking.
  explicit LogTail(cases::Descriptor pipe) : pipe_(std::move(pipe)) {}

  /// The pipe's descriptor; negative once no process can write to the pipe any more.
  int pipe() const { return pipe_.number(); }
  /// Reads what is available, or only part of it if that is a lot.
  void read();
  void forget() { text_.clear(); }
  /// The last lines as printable text, joined into one line: "a / b / c". Empty if the process
  /// wrote nothing.
  std::string last_lines() const;

 private:
  cases::Descriptor pipe_;
  std::string text_;
};

}  // namespace rastercheck::backends
