#pragma once

// The end of `rastercheck hunt`: its results, as text and as JSON.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/hunt.h"
#include "records/counterexample.h"

namespace rastercheck::cli {

/// What a hunt found, with the files in which it is.
struct HuntResults {
  properties::HuntOutcome hunted;
  std::optional<properties::HuntOutcome> sampled;  ///< for --compare-sampling
  std::vector<properties::HuntTrophy> trophies;
  std::vector<std::string> trophy_files;
  std::vector<records::Counterexample> counterexamples;  ///< shrunk
  std::vector<std::string> counterexample_files;
  /// With --baseline: how many of the worst cases the baseline has now, and how many of these it
  /// had before the hunt.
  struct InBaseline {
    std::string file;
    std::size_t added = 0;
    std::size_t there = 0;
  };
  std::optional<InBaseline> in_baseline;
};

/// Prints the table of worst cases, and counterexamples. `quiet` leaves all but the table's rows
/// out.
void print_hunt(const properties::HuntPlan& plan, const HuntResults& results, bool quiet);

/// Prints the same as one JSON document.
void print_hunt_json(const properties::HuntPlan& plan, const HuntResults& results);

}  // namespace rastercheck::cli
