#pragma once

// Everything a run found: the content of run.json and the only input of reports.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/case_outcomes.h"
#include "records/case_record.h"
#include "records/cause.h"
#include "records/counterexample.h"
#include "records/inspection.h"
#include "records/known.h"
#include "records/plan.h"
#include "records/record.h"
#include "records/scene_result.h"
#include "records/shard.h"
#include "records/specimen.h"

namespace rastercheck::records {

/// A picture of the run, PNG.
struct Picture {
  std::string name;     ///< file name without extension, such as "bunny-cpu"
  std::string caption;  ///< one sentence
  int width = 0;        ///< pixels
  int height = 0;       ///< pixels
  std::string png;      ///< the file's bytes
  bool operator==(const Picture&) const = default;
};

/// A label that a law's random cases reached too seldom: the law has not tested what it claims to.
struct UnreachedLabel {
  std::string law;
  std::string backend;
  std::string label;
  std::uint64_t reached = 0;  ///< cases that reached the label
  std::uint64_t least = 0;    ///< required number of cases, out of `checked`
  std::uint64_t checked = 0;
  bool operator==(const UnreachedLabel&) const = default;
};

/// The version of the exact rules and of error counting. Changes whenever the same drawing may be
/// judged differently; figures of two versions are never compared.
inline constexpr std::uint64_t kRulesVersion = 1;
/// The version of the record format.
inline constexpr std::uint64_t kRecordsVersion = 3;

struct Run {
  std::uint64_t rules_version = kRulesVersion;
  Plan plan;
  /// The sentences of the plan's laws, by id.
  std::map<std::string, std::string> sentences = {};
  /// Set if the run is one part of a campaign (Plan::shard). A shard has no required labels.
  std::optional<Shard> shard = std::nullopt;
  std::uint64_t cases_left = 0;  ///< cases not checked because the run was interrupted
  RecordSet records;
  /// Each case's result; empty if not kept.
  std::optional<CaseRecordSet> cases = std::nullopt;
  /// Which cases were right, by backend; only for runs of several backends.
  std::optional<CaseOutcomeSet> outcomes = std::nullopt;
  /// The first case of each disagreement of two backends (properties/campaign/side_by_side.h).
  std::vector<Difference> differences = {};
  /// Drawn parts of some cases, ordered by backend, key and triangle; only if the run keeps each
  /// case's result.
  std::vector<Specimen> specimens = {};
  /// One for each combination of law, backend, verdict, kind and condition, ordered by these.
  std::vector<Counterexample> counterexamples;
  /// Groups of the counterexamples by likely cause, largest first. Each cause belongs to one
  /// backend, and each counterexample to one cause.
  std::vector<Cause> causes = {};
  /// Counterexamples in their order, then worst cases by (law, backend, kind, stratum).
  std::vector<Inspection> inspections = {};
  /// Ordered by (law, backend, label).
  std::vector<UnreachedLabel> unreached;
  /// By backend, the promise of the API that a driver was held to.
  std::map<std::string, cases::DriverPromise> held_to = {};
  /// Lists of known defects of the backends.
  std::vector<KnownOfBackend> known;
  /// Known defects that no longer show, sorted.
  std::vector<UnexpectedPass> unexpected;
  /// The result of the plan's scene for each backend.
  std::vector<SceneResult> scenes = {};
  std::vector<Picture> pictures;
  /// Everything that depends on machine or time: version, compiler, jobs, date, seconds…
  std::map<std::string, std::string> environment;
  bool operator==(const Run&) const = default;
};

/// The key in Run::environment whose value says what draws for a backend, such as a driver's name
/// and version.
std::string drawn_by_key(const std::string& backend);

/// Returns the law's sentence, or its id if the run has no sentence for it.
const std::string& sentence_of(const Run& run, const std::string& law);

/// "Not reached: LAW on BACKEND: 'tie' in 2 of 1000 cases; at least 13 were required."
std::string unreached_sentence(const UnreachedLabel& label);

/// "Unexpected pass: the case of llvmpipe-3 no longer violates LAW on gl:llvmpipe; …", followed by
/// what that means.
std::string unexpected_sentence(const UnexpectedPass& pass);

/// A law that a run skipped on a backend because of an expectation list.
struct SkippedLaw {
  std::string backend;
  std::string law;
  std::string file;  ///< the list
  auto operator<=>(const SkippedLaw&) const = default;
};
/// Returns the skipped laws of a run, in order.
std::vector<SkippedLaw> skipped_laws(const Run& run);

/// The label of cases left undrawn because the backend was given up; these count as violations.
inline constexpr std::string_view kGivenUp = "not drawn, as the backend was given up";

/// Returns sentences on what else a reader must know about a run. Examples: the run is a shard or
/// was interrupted; a contract file or an API's promise decided the verdicts; shrinking had a time
/// limit; a list of known defects is for another version of the driver; laws were skipped; a
/// backend was given up.
std::vector<std::string> caveats(const Run& run);

/// Makes a text fit for a file's name: replaces all but letters and digits by '-'.
std::string file_word(std::string_view text);

/// Returns the file of a counterexample within the run's folder:
/// "counterexamples/LAW-BACKEND-VERDICT.json", with the special_words() of the case after the
/// verdict, each part as by file_word().
std::string file_of(const Counterexample& counterexample);

}  // namespace rastercheck::records
