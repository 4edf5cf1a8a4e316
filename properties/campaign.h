#pragma once

// A campaign: every chosen law on every chosen backend, over the corpus and over random cases.
//
// It is cut into tasks that depend on nothing but themselves, and what tasks find merges exactly:
// however they are split over processes, and in whatever order they end, the outcome is the same to
// the byte.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"
#include "properties/law.h"
#include "records/counterexample.h"
#include "records/record.h"
#include "records/run.h"

namespace rastercheck::properties {

/// What part of a campaign found.
struct Findings {
  records::RecordSet records;
  /// By (law, backend, index); of each law and backend the records::kMostCounterexamples with the
  /// lowest indices.
  std::vector<records::Counterexample> counterexamples;
  /// A fault of the oracle or the harness: the rest is worth nothing. One line.
  std::optional<std::string> fault;
  bool operator==(const Findings&) const = default;
};

/// Adds `from`; of two faults the first stays.
void merge(Findings& into, Findings from);

/// Some cases of one law on one backend: corpus cases, or random ones of the campaign's seed.
struct Task {
  std::string backend;  ///< specification
  std::string law;      ///< name
  bool is_corpus = false;
  std::uint64_t first = 0;  ///< index of the first case
  std::uint64_t last = 0;   ///< one past the last
  bool operator==(const Task&) const = default;
};

struct CampaignOptions {
  std::uint64_t seed = 0;
  std::uint64_t cases_per_law = 1000;
  std::vector<std::string> backends{"cpu"};
  std::vector<std::string> laws;  ///< names
};

/// The campaign's work, corpus first. Short tasks, so that processes end together.
std::vector<Task> tasks_of(const CampaignOptions& options, std::size_t corpus_size);

/// The stratum of the corpus in records.
inline constexpr std::string_view kCorpusStratum = "corpus";
/// The stratum of a scene: this and its name.
inline constexpr std::string_view kSceneStratum = "scene ";

/// The labels that random cases of the laws did not reach often enough (least_reached), by law,
/// backend and label. What a backend does not promise need not have been reached.
std::vector<records::UnreachedLabel> unreached_labels(const CampaignOptions& options,
                                                      const records::RecordSet& records);

/// Runs tasks, one after the other; keeps the backends it has made.
class TaskRunner {
 public:
  TaskRunner(std::uint64_t seed, std::vector<cases::Case> corpus);

  const std::vector<cases::Case>& corpus() const { return corpus_; }

  /// What the task found. Fails where there is no such law, backend or corpus case.
  Result<Findings> run(const Task& task);

 private:
  Result<backends::Backend*> backend(const std::string& specification);

  std::uint64_t seed_;
  std::vector<cases::Case> corpus_;
  std::map<std::string, std::unique_ptr<backends::Backend>> backends_;
};

/// A case to be checked, and where it comes from.
struct NumberedCase {
  cases::Case source;
  std::string stratum;
  std::uint64_t index = 0;
};

/// Checks a case and adds the outcome to the findings: counts, errors, labels, and, where the law
/// is violated, a counterexample: the one triangle that suffices, if one does, else the case.
void check_case(const Law& law, const std::string& specification, backends::Backend& backend,
                std::uint64_t seed, const NumberedCase& numbered, Findings& findings);

/// A drawing that fails is a violation of whatever was to be checked: what the backend says stands
/// in its note. Nothing is said of a case with positions beyond float32, which no backend gets.
Check check_or_note(const Law& law, const cases::Case& c, backends::Backend& backend,
                    const CheckOptions& options);

/// In a word, how a check of a case that the law speaks of came out: the class of its first
/// violation, or "held".
std::string verdict_of(const Check& check);

/// Keeps a counterexample of the case in the findings, if its index is among the lowest.
void keep_counterexample(const Law& law, const std::string& specification,
                         backends::Backend& backend, std::uint64_t seed,
                         const NumberedCase& numbered, const Check& check, Findings& findings);

/// The case files of a folder (*.json), in the order of their names; a case without a name gets its
/// file's. Fails at the first that cannot be read.
Result<std::vector<cases::Case>> read_corpus(const std::string& directory);

}  // namespace rastercheck::properties
