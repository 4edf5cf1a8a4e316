#pragma once

#include <string>

#include "cli/command.h"
#include "records/plan.h"

namespace rastercheck::cli {

/// Which lists of known defects violations are held against.
struct KnownOption {
  std::string directory;  ///< empty: those that come with the program
  bool is_none = false;

  /// The folder; empty where there is to be none.
  std::string folder() const;
};

/// Adds --known and --no-known to a command.
void add_known(CLI::App& app, KnownOption& option);
/// Adds them to a command that makes a plan.
void add_known(CLI::App& app, records::Plan& plan);

}  // namespace rastercheck::cli
