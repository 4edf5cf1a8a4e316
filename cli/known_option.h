#pragma once

#include <string>

#include "cli/command.h"
#include "properties/campaign/known_defects.h"
#include "records/plan.h"

namespace rastercheck::cli {

/// The lists of known defects to compare violations with.
struct KnownOption {
  properties::KnownSources given;  ///< in addition to those that come with the program
  bool is_none = false;

  /// Returns all sources; none if `is_none`.
  properties::KnownSources sources() const;
};

/// Adds the options --known and --no-known to a command.
void add_known(CLI::App& app, KnownOption& option);
/// Adds both options to a command that makes a plan.
void add_known(CLI::App& app, records::Plan& plan);

}  // namespace rastercheck::cli
