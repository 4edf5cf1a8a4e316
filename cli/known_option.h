#pragma once

#include <string>

#include "cli/command.h"
#include "properties/campaign/known_defects.h"
#include "records/plan.h"

namespace rastercheck::cli {

/// Which lists of known defects violations are held against.
struct KnownOption {
  properties::KnownSources given;  ///< besides those that come with the program
  bool is_none = false;

  /// All of them; none where there are to be none.
  properties::KnownSources sources() const;
};

/// Adds --known and --no-known to a command.
void add_known(CLI::App& app, KnownOption& option);
/// Adds them to a command that makes a plan.
void add_known(CLI::App& app, records::Plan& plan);

}  // namespace rastercheck::cli
