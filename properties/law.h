#pragma once

// Laws: what has to hold of every case, stated as a sentence. A file in properties/laws/ defines
// one and registers it:
//
//   const LawRegistration kRegistration({.id = "constants-stay-constant",
//                                        .sentence = "constants stay constant",
//                                        .reason = "Σ c e_i / Σ e_i is c.",
//                                        .exceptions = "flat attributes, which are copies",
//                                        .generate = &generate,
//                                        .check = &check,
//                                        .covers = {cover(5, "clipped")}});
//
// docs/adding-a-law.md walks through it. A law is checked on a Case alone, wherever it comes from:
// its generator, the corpus, or a saved counterexample.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/clip_case.h"
#include "cases/error.h"
#include "properties/draw.h"
#include "records/counterexample.h"
#include "records/judgement.h"
#include "records/shard.h"

namespace rastercheck::properties {

/// A case of a law's own making.
struct Generated {
  cases::Case source;
  std::string stratum;
};

/// What a law found of one case.
struct Check {
  bool is_applicable = true;  ///< else the law says nothing of the case, and the rest is empty
  /// Else why, in a clause of the law's or the backend's own; may be empty. Of few texts: records
  /// count cases by it, but for numbers after a colon.
  std::string why_not = {};
  records::Judgement judgement;
  std::uint64_t violation_count = 0;
  std::vector<records::Violation> violations;  ///< records::kMostViolations, of each sort the first
  std::vector<std::string> labels;             ///< what the case reached, each once
  /// A fault of the oracle itself (oracle::JudgedDrawing::fault), or of the harness: nothing else
  /// counts.
  std::optional<std::string> fault;
  /// Entries of what is known of the driver that all violations kept are of; else empty.
  std::vector<std::string> known = {};
};

/// A label that the law's own cases have to reach, or it has not tested what it claims to.
struct Cover {
  int percent = 0;  ///< of the cases checked, at least
  std::string_view label;
  /// Whether it says how something was decided that a contract may leave open: it is asked only of
  /// backends that draw what the case asks for (draws_what_is_asked_for).
  bool is_decided = false;
};

constexpr Cover cover(int percent, std::string_view label) { return {percent, label, false}; }
constexpr Cover cover_decided(int percent, std::string_view label) {
  return {percent, label, true};
}

struct Law {
  /// Never changes: cases are drawn from it, and records, baselines, lists of known defects and
  /// --property know the law by it. Lower-case letters, digits and hyphens.
  std::string_view id;
  /// What has to hold, for readers; may be said better at any time.
  std::string_view sentence;
  /// Why it holds, for readers of docs/properties.md; the file's opening comment has the proof.
  std::string_view reason;
  /// What it says nothing of: cases, samples, attributes, backends.
  std::string_view exceptions;
  Generated (*generate)(Draw& draw) = nullptr;
  /// Draws the case, perhaps changed ones too, and says what is wrong. Fails where the backend
  /// cannot draw it. `index` is the case's, for the records.
  Result<Check> (*check)(const cases::ClipCase& c, backends::Backend& backend,
                         std::uint64_t index) = nullptr;
  /// In place of `check` of a law that is about cameras, or about what a vertex stage does: takes
  /// the case with its camera, also where clip positions are beyond float32.
  Result<Check> (*check_given)(const cases::Case& c, backends::Backend& backend,
                               std::uint64_t index) = nullptr;
  /// Whether a backend promises at all what the law is about; nullptr: every backend does. Where it
  /// does not, the law says nothing of any case, and that is no fault of a run.
  bool (*is_promised)(backends::Backend& backend) = nullptr;
  /// Of one that does not, what it lacks: the reason that reports give. A clause.
  std::string_view unpromised = {};
  /// What its random cases have to reach.
  std::vector<Cover> covers = {};
};

/// The least number of `checked` cases that have to reach a label: the chance that independent
/// cases which reach it with the probability that its Cover states are fewer is below 10^-6. Never
/// more than that share of them; 0 of few cases.
std::uint64_t least_reached(const Cover& cover, std::uint64_t checked);

/// Whether a backend promises the coverage, basis and tie rule that a case names (asked of each
/// API's own ones), and values in perspective: not one that rounds positions in its own way, or
/// leaves ties open.
bool draws_what_is_asked_for(backends::Backend& backend);

/// Whether a backend promises that what has no say in a fragment leaves its bits alone
/// (cases::Contract::is_invariant).
bool draws_invariantly(backends::Backend& backend);

/// What a law finds of a case, which may have a camera. Fails where the backend cannot draw it, and
/// where it cannot be handed over, as clip positions are beyond float32.
Result<Check> check_law(const Law& law, const cases::Case& c, backends::Backend& backend,
                        std::uint64_t index);

/// Whether the law has something to say of a backend.
bool is_promised(const Law& law, backends::Backend& backend);

/// What a backend promises of these laws; `name` is its own in the records. Of nullptr, a backend
/// that cannot be made: all laws, and to draw in a way of its own.
records::BackendPromises promises_of(const std::string& name, backends::Backend* backend,
                                     std::span<const std::string> laws);

/// All laws, in the order of their ids.
std::span<const Law> laws();
/// The law of an id; nullptr where there is none.
const Law* find_law(std::string_view id);

/// The choices that a law's random case is made by, for a backend that draws everything: generate()
/// takes them.
Draw draw_of(const Law& law, std::uint64_t seed, std::uint64_t index);

/// A law's random case, made for a backend that draws so much.
Generated random_case(const Law& law, std::uint64_t seed, std::uint64_t index,
                      const cases::Capabilities& capabilities);

/// Says what random cases of a backend are made for: what it draws, and the numbers that it makes
/// promises of.
cases::Capabilities capabilities_of(const backends::Backend& backend);

struct LawRegistration {
  explicit LawRegistration(const Law& law);
};

/// A case by one of all generators, each as likely as another; the stratum is the generator's name.
Generated generate_any(Draw& draw);

}  // namespace rastercheck::properties
