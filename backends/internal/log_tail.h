#pragma once

#include <cstddef>
#include <string>

#include "cases/child_process.h"

namespace rastercheck::backends {

/// What a process says on a pipe, its last words kept.
class LogTail {
 public:
  /// The end to be read, which is not to block.
  explicit LogTail(cases::Descriptor pipe) : pipe_(std::move(pipe)) {}

  /// The pipe; below 0 once nobody can say anything any more.
  int pipe() const { return pipe_.number(); }
  /// Reads what is there, or some of it where that is a lot.
  void read();
  void forget() { text_.clear(); }
  /// The last lines, printable, in one: "a / b / c". Empty where nothing was said.
  std::string last_lines() const;

 private:
  cases::Descriptor pipe_;
  std::string text_;
};

}  // namespace rastercheck::backends
