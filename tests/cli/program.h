#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace rastercheck::cli {

struct Outcome {
  int code = -1;  ///< exit code; −signal where it was killed
  std::string out;
  std::string err;
};

/// Runs the `rastercheck` program with these arguments, `input` on its standard input.
Outcome run_program(const std::vector<std::string>& arguments, const std::string& input = "");

/// The same with the program that has the backends `damaged:…` too (properties/damaged_kind.cpp).
Outcome run_damaged_program(const std::vector<std::string>& arguments,
                            const std::string& input = "");

/// Runs a shell script; $PROGRAM and $DAMAGED are the two programs above.
Outcome run_shell(const std::string& script);

/// The damaged program while it runs. What a test ends early, it ends by kill().
class RunningProgram {
 public:
  explicit RunningProgram(const std::vector<std::string>& arguments);
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram();

  void kill(int signal) const;
  /// Until it has ended. Once.
  Outcome wait();

 private:
  struct Streams;
  std::unique_ptr<Streams> streams_;
  int process_ = 0;
};

/// Whether it failed as CONTRACT has it: this exit code, nothing on standard output, and on the
/// other one line that starts with "rastercheck: ".
bool is_failure(const Outcome& outcome, int code);

/// What failed and how, for messages.
std::ostream& operator<<(std::ostream& stream, const Outcome& outcome);

/// A case file's text: the square of two triangles that fills 8×8 pixels, w = 1, with the
/// attributes x, the window x, and one, which is 1. Its name is "square".
std::string square_case(const std::string& more_keys = "");

/// A run.json without the line of its environment, the only one that is another each time.
std::string without_environment(const std::string& run_json);

/// A file of the source tree.
std::string source_file(const std::string& relative);

}  // namespace rastercheck::cli
