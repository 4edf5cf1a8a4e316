#pragma once

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

/// A file of the source tree.
std::string source_file(const std::string& relative);

}  // namespace rastercheck::cli
