#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace rastercheck::cli {

struct Outcome {
  int code = -1;  ///< exit code; −signal if it was killed
  std::string out;
  std::string err;
};

/// Runs the `rastercheck` program with these arguments and `input` as its standard input.
Outcome run_program(const std::vector<std::string>& arguments, const std::string& input = "");

/// Like run_program(), with the program that also has the backends `damaged:…`
/// (properties/damaged_kind.cpp).
Outcome run_damaged_program(const std::vector<std::string>& arguments,
                            const std::string& input = "");

/// Runs a shell script; $PROGRAM and $DAMAGED are the two programs above.
Outcome run_shell(const std::string& script);

/// The damaged program while it runs. A test that ends it early calls kill().
class RunningProgram {
 public:
  explicit RunningProgram(const std::vector<std::string>& arguments);
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram();

  void kill(int signal) const;
  /// Waits until the program has ended. To be called once.
  Outcome wait();

 private:
  struct Streams;
  std::unique_ptr<Streams> streams_;
  int process_ = 0;
};

/// True if the program failed as CONTRACT requires: with this exit code, nothing on standard
/// output, and on standard error one line that starts with "rastercheck: ".
bool is_failure(const Outcome& outcome, int code);

/// Prints what failed and how, for messages.
std::ostream& operator<<(std::ostream& stream, const Outcome& outcome);

/// The text of a case file: the square of two triangles that fills 8×8 pixels, w = 1. Its
/// attributes are `x`, the window x, and `one`, the constant 1. Its name is "square".
std::string square_case(const std::string& more_keys = "");

/// A run.json without the line of its environment, the only line that differs between runs.
std::string without_environment(const std::string& run_json);

/// A file of the source tree.
std::string source_file(const std::string& relative);

}  // namespace rastercheck::cli
