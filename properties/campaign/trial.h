#pragma once

// A law tried on a backend that the caller makes, in the caller's process: what a test program of
// somebody's own rasterizer asks for (properties/campaign/testing.h has it as cases of GoogleTest).

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "backends/backend.h"
#include "cases/error.h"
#include "properties/campaign/campaign.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Makes the backend that is tried; nothing where it cannot.
using MakeTried = std::function<std::unique_ptr<backends::Backend>()>;

struct TrialOptions {
  std::uint64_t seed = 1;
  std::uint64_t cases = 100;  ///< random ones
  std::string corpus;         ///< folder of case files, which come first; empty: none
  std::string output;         ///< folder for counterexamples, made where missing; empty: none
  records::ShrinkBudget shrinking = {};  ///< of the counterexample
};

/// The options of the environment: RASTERCHECK_SEED, RASTERCHECK_CASES, RASTERCHECK_CORPUS and
/// RASTERCHECK_OUTPUT, each where it is set. Without RASTERCHECK_CORPUS the corpus is `corpus`, if
/// there is such a folder. Fails where a number is none; the error's file is the variable.
Result<TrialOptions> trial_options(const std::string& corpus);

struct Trial {
  /// Skipped: the backend does not promise what the law is about, or no case was one that the law
  /// says anything of. Failed: it violates the law, or the law could not be tried, or its random
  /// cases did not reach what it is about.
  enum class Outcome { held, skipped, failed };
  Outcome outcome = Outcome::held;
  /// Why it was skipped or failed, for people, over several lines; of a violation with the case
  /// file, or where it is. Empty where it held.
  std::string text;
};

/// Tries a law on a backend, called `name` in what is said: the cases of the corpus, then random
/// ones, as a campaign of that seed checks them, up to the first that fails, which is made smaller.
Trial try_law(const Law& law, const std::string& name, const MakeTried& make,
              const TrialOptions& options);

}  // namespace rastercheck::properties
