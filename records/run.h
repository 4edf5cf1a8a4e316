#pragma once

// Everything a run found: what run.json holds, and all that reports are made from.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
  std::string name;     ///< file name without extension, as "bunny-cpu"
  std::string caption;  ///< one sentence
  int width = 0;        ///< pixels
  int height = 0;       ///< pixels
  std::string png;      ///< the file's bytes
  bool operator==(const Picture&) const = default;
};

/// A label that a law's random cases had to reach, and did too seldom: the law has not tested what
/// it claims to.
struct UnreachedLabel {
  std::string law;
  std::string backend;
  std::string label;
  std::uint64_t reached = 0;  ///< cases
  std::uint64_t least = 0;    ///< cases that had to, of those checked
  std::uint64_t checked = 0;
  bool operator==(const UnreachedLabel&) const = default;
};

/// The version of what is exactly true and of how errors are counted: another one where the same
/// drawing may be judged otherwise. Figures of two versions are not compared.
inline constexpr std::uint64_t kRulesVersion = 1;
/// The version of the form in which records are kept.
inline constexpr std::uint64_t kRecordsVersion = 3;

struct Run {
  std::uint64_t rules_version = kRulesVersion;
  Plan plan;
  /// What the plan's laws state, by id.
  std::map<std::string, std::string> sentences = {};
  /// Of a run that is one part of its campaign (Plan::shard). Nobody says of it which labels it had
  /// to reach.
  std::optional<Shard> shard = std::nullopt;
  std::uint64_t cases_left = 0;  ///< not checked, as the run was interrupted
  RecordSet records;
  /// What each case gave; nothing where that was not kept.
  std::optional<CaseRecordSet> cases = std::nullopt;
  /// What was drawn of parts of some cases, ordered by backend, key and triangle; of runs that keep
  /// what cases gave.
  std::vector<Specimen> specimens = {};
  /// Ordered by (law, backend, verdict), one of each.
  std::vector<Counterexample> counterexamples;
  /// What these have in common, those of most counterexamples first; each of one backend. Every
  /// counterexample is of one.
  std::vector<Cause> causes = {};
  /// Counterexamples in their order, then worst cases by (law, backend, kind, stratum).
  std::vector<Inspection> inspections = {};
  /// Ordered by (law, backend, label).
  std::vector<UnreachedLabel> unreached;
  /// Which promise of their API drivers were held to, by backend.
  std::map<std::string, cases::DriverPromise> held_to = {};
  /// Lists of what was known of the backends.
  std::vector<KnownOfBackend> known;
  /// Known defects that no longer show; in order.
  std::vector<UnexpectedPass> unexpected;
  /// What became of the plan's scene, backend by backend.
  std::vector<SceneResult> scenes = {};
  std::vector<Picture> pictures;
  /// All that depends on machine or time: version, compiler, jobs, date, seconds…
  std::map<std::string, std::string> environment;
  bool operator==(const Run&) const = default;
};

/// What a law of the run states; its id where the run does not say.
const std::string& sentence_of(const Run& run, const std::string& law);

/// "Not reached: LAW on BACKEND: 'tie' in 2 of 1000 cases, where at least 13 had to."
std::string unreached_sentence(const UnreachedLabel& label);

/// "Unexpected pass: the case of llvmpipe-3 no longer violates LAW on gl:llvmpipe."; what that
/// means.
std::string unexpected_sentence(const UnexpectedPass& pass);

/// A law that an expectation list had a run leave out on a backend.
struct SkippedLaw {
  std::string backend;
  std::string law;
  std::string file;  ///< the list
  auto operator<=>(const SkippedLaw&) const = default;
};
/// Gives those of a run, in order.
std::vector<SkippedLaw> skipped_laws(const Run& run);

/// The label of cases that were not drawn any more, as their backend was given up: they count as
/// violations.
inline constexpr std::string_view kGivenUp = "not drawn, as the backend was given up";

/// What else a reader has to know of a run: that it is a shard, that it was interrupted, that
/// shrinking was cut short, that a list of known defects is of another version of the driver, which
/// entries have run out, which laws were skipped.
std::vector<std::string> caveats(const Run& run);

/// A text as part of a file's name: what is neither letter nor digit made '-'.
std::string file_word(std::string_view text);

/// The file that a counterexample is saved as, within the run's folder:
/// "counterexamples/LAW-BACKEND-VERDICT.json", with what is neither letter nor digit made '-'.
std::string file_of(const Counterexample& counterexample);

}  // namespace rastercheck::records
