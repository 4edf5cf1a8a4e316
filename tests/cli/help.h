#pragma once

#include <string>
#include <vector>

namespace rastercheck::cli {

/// The text that --help prints for a command.
struct Help {
  std::vector<std::string> command;   ///< {"corpus", "add"}; empty for the program itself
  std::vector<std::string> commands;  ///< the commands that it lists
  std::vector<std::string> options;   ///< the options that it lists, such as "--json"
  std::string text;
};

/// The help of the program and of every command listed in any help.
std::vector<Help> all_help();

/// The words joined by spaces: "corpus add".
std::string joined(const std::vector<std::string>& words);

}  // namespace rastercheck::cli
