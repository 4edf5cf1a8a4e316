#pragma once

// Checks a law on a backend made by the caller, in the caller's process: for test programs of your
// own rasterizer (properties/campaign/testing.h wraps this for GoogleTest).

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "backends/backend.h"
#include "cases/error.h"
#include "properties/campaign/campaign.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Makes the backend to check; nullptr on failure.
using MakeTried = std::function<std::unique_ptr<backends::Backend>()>;

struct TrialOptions {
  std::uint64_t seed = 1;
  std::uint64_t cases = 100;  ///< number of random cases
  std::string corpus;         ///< folder of case files to check first; empty: none
  std::string output;         ///< folder for counterexamples, created if missing; empty: none
  records::ShrinkBudget shrinking = {};  ///< limits for the counterexample
};

/// Reads the options from the environment: RASTERCHECK_SEED, RASTERCHECK_CASES, RASTERCHECK_CORPUS
/// and RASTERCHECK_OUTPUT, each if set. Without RASTERCHECK_CORPUS the corpus is `corpus`, if that
/// folder exists. Fails on an invalid number; the error's file is the variable.
Result<TrialOptions> trial_options(const std::string& corpus);

struct Trial {
  /// Skipped: the backend does not promise what the law is about, or the law applied to no case.
  /// Failed: the backend violates the law, the law could not be checked, or its random cases did
  /// not reach its labels.
  enum class Outcome { held, skipped, failed };
  Outcome outcome = Outcome::held;
  /// Why the law was skipped or failed, for people, over several lines; for a violation includes
  /// the case file or its path. Empty if the law held.
  std::string text;
};

/// Checks a law on a backend, called `name` in messages: corpus cases, then random ones, the same
/// as in a campaign with that seed. Stops at the first failure and shrinks it.
Trial try_law(const Law& law, const std::string& name, const MakeTried& make,
              const TrialOptions& options);

}  // namespace rastercheck::properties
