#pragma once

#include <string>
#include <vector>

namespace rastercheck::cli {

/// What --help says of a command.
struct Help {
  std::vector<std::string> command;   ///< {"corpus", "add"}; empty of the program
  std::vector<std::string> commands;  ///< that it lists
  std::vector<std::string> options;   ///< that it lists, "--json"
  std::string text;
};

/// The program's, and that of every command which one of them lists.
std::vector<Help> all_help();

/// "corpus add".
std::string joined(const std::vector<std::string>& words);

}  // namespace rastercheck::cli
