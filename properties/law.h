#pragma once

// Laws: properties that must hold for every case, each stated as a sentence. A file in
// properties/laws/ defines one and registers it:
//
//   const LawRegistration kRegistration({.id = "constants-stay-constant",
//                                        .sentence = "constants stay constant",
//                                        .reason = "Σ c e_i / Σ e_i is c.",
//                                        .exceptions = "flat attributes, which are copies",
//                                        .generate = &generate,
//                                        .check = &check,
//                                        .covers = {cover(5, "clipped")}});
//
// docs/adding-a-property.md walks through it. A law needs only a Case, which may come from the
// law's generator, the corpus, or a saved counterexample.

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

/// A case made by a law's generator.
struct Generated {
  cases::Case source;
  std::string stratum;
};

/// The result of checking a law on one case.
struct Check {
  /// False if the law does not apply; then all members below except `why_not` are empty.
  bool is_applicable = true;
  /// Why the law does not apply: a clause from the law or the backend; may be empty. Use few
  /// different texts: records count cases by the text up to the first colon.
  std::string why_not = {};
  records::Judgement judgement;
  std::uint64_t violation_count = 0;
  /// At most records::kMostViolations; a new sort replaces a repeated one.
  std::vector<records::Violation> violations;
  std::vector<std::string> labels;  ///< the labels that the case reached, each once
  /// A fault of the oracle itself (oracle::JudgedDrawing::fault) or of the harness; if set, nothing
  /// else counts.
  std::optional<std::string> fault;
  /// Ids of known-defect entries, if these explain all kept violations; else empty.
  std::vector<std::string> known = {};
};

/// A label that the law's own cases must reach for the law to have tested what it claims.
struct Cover {
  int percent = 0;  ///< least share of the cases checked
  std::string_view label;
  /// True if the label depends on a decision that a contract may leave open. If so, the label is
  /// required only of backends that draw what the case asks for (draws_what_is_asked_for).
  bool is_decided = false;
};

constexpr Cover cover(int percent, std::string_view label) { return {percent, label, false}; }
constexpr Cover cover_decided(int percent, std::string_view label) {
  return {percent, label, true};
}

struct Law {
  /// Never changes: random cases depend on the id, and records, baselines, known-defect lists and
  /// --property refer to it. Lower-case letters, digits and hyphens.
  std::string_view id;
  /// The property that must hold, for readers; may be reworded at any time.
  std::string_view sentence;
  /// Why it holds, for readers of docs/properties.md; the file's opening comment has the proof.
  std::string_view reason;
  /// Cases, samples, attributes and backends to which the law does not apply.
  std::string_view exceptions;
  Generated (*generate)(Draw& draw) = nullptr;
  /// Draws the case, perhaps changed versions too, and returns what is wrong. Fails if the backend
  /// cannot draw the case. `index` is the case's index, for the records.
  Result<Check> (*check)(const cases::ClipCase& c, backends::Backend& backend,
                         std::uint64_t index) = nullptr;
  /// Replaces `check` for laws about cameras or the vertex stage: takes the case with its camera,
  /// even if clip positions are beyond float32.
  Result<Check> (*check_given)(const cases::Case& c, backends::Backend& backend,
                               std::uint64_t index) = nullptr;
  /// Returns true if a backend promises what the law is about; nullptr if every backend does.
  /// Without that promise the law applies to no case, which does not make a run fail.
  bool (*is_promised)(backends::Backend& backend) = nullptr;
  /// A clause that says what a backend without that promise lacks; reports give it as the reason.
  std::string_view unpromised = {};
  /// True if the law is about samples that are covered one by one. It then applies to no backend
  /// that covers whole pixels (covers_pixels).
  bool needs_samples = false;
  /// True if the law assumes that covered samples lie in their triangle, and that triangles without
  /// area draw nothing. It then applies to no backend with outer conservative coverage.
  bool excludes_outer = false;
  /// True if the law also applies to cases of lines or points. Others assume triangles.
  bool takes_lines_and_points = false;
  /// Labels that the law's random cases must reach.
  std::vector<Cover> covers = {};
};

/// Returns how many of `checked` cases must reach a label. If cases are independent and reach the
/// label with the Cover's stated probability, the chance of fewer is below 10^-6. Never more than
/// the stated share; 0 for few cases.
std::uint64_t least_reached(const Cover& cover, std::uint64_t checked);

/// True if a backend promises the coverage, basis and tie rule that a case names (tested with each
/// API's defaults) and perspective-correct values. False if the backend rounds positions in its own
/// way or leaves ties open.
bool draws_what_is_asked_for(backends::Backend& backend);

/// True if a backend promises that irrelevant changes leave a fragment's bits unchanged
/// (cases::Contract::is_invariant).
bool draws_invariantly(backends::Backend& backend);

/// True if what a triangle covers is covered by parts of it, once: no contract of edges that all or
/// none own their samples, or of triangles that are left out. See Law::is_promised.
bool draws_all_parts_once(backends::Backend& backend);

/// True if a backend covers whole pixels, not samples (cases::Conservative).
bool covers_pixels(backends::Backend& backend);
/// True if it covers at least the pixels that triangles touch.
bool covers_touched_pixels(backends::Backend& backend);

/// Checks a law on a case, which may have a camera. Fails if the backend cannot draw the case, or
/// if clip positions are beyond float32 and the law needs them.
Result<Check> check_law(const Law& law, const cases::Case& c, backends::Backend& backend,
                        std::uint64_t index);

/// True if the backend promises what the law is about.
bool is_promised(const Law& law, backends::Backend& backend);

/// Why the backend does not promise what the law is about.
std::string_view why_unpromised(const Law& law, backends::Backend& backend);

/// Returns which of these laws the backend makes promises for; `name` is the backend's name in the
/// records. For nullptr (a backend that cannot be made): assumes that all laws are promised, but
/// not that cases are drawn as they ask.
records::BackendPromises promises_of(const std::string& name, backends::Backend* backend,
                                     std::span<const std::string> laws);

/// All laws, in the order of their ids.
std::span<const Law> laws();
/// The law with that id; nullptr if none.
const Law* find_law(std::string_view id);

/// The choices for a law's random case, to pass to generate(), for a backend that draws everything.
Draw draw_of(const Law& law, std::uint64_t seed, std::uint64_t index);

/// Makes a law's random case for a backend with these capabilities.
Generated random_case(const Law& law, std::uint64_t seed, std::uint64_t index,
                      const cases::Capabilities& capabilities);

/// Returns the capabilities that random cases for a backend must respect: the features that it
/// draws and the range of numbers for which it makes promises.
cases::Capabilities capabilities_of(const backends::Backend& backend);

struct LawRegistration {
  explicit LawRegistration(const Law& law);
};

/// Makes a case with a random generator of those for all laws (equally likely); the stratum is the
/// generator's name.
Generated generate_any(Draw& draw);

}  // namespace rastercheck::properties
