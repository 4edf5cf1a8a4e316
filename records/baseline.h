#pragma once

// The baseline of the regression gate: results of a run, kept for comparison with later runs; only
// of the cases that every run with the same seed has (is_frozen() of record.h). Plain data;
// baseline_json.h reads and writes the file.
//
// A baseline consists of sections, each made from a run (gate/sections.h). A comparison takes two
// sections, so either side may come from a run or from a baseline file.

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/error.h"
#include "records/counterexample.h"
#include "records/histogram.h"
#include "records/record.h"
#include "records/run.h"
#include "records/signed_sum.h"
#include "records/specimen.h"
#include "records/stage_split.h"

namespace rastercheck::records {

/// The version of the baseline file.
inline constexpr std::uint64_t kBaselineVersion = 3;
inline constexpr const char* kBaselineFile = "rastercheck-baseline.json";

/// Identifies a section.
struct BaselineKey {
  std::string backend;          ///< section_name() of the backend, or a name that the user gave
                                ///< instead
  std::string architecture;     ///< "x86_64"
  std::string instruction_set;  ///< "avx2"; empty: any
  std::string compiler;         ///< "GNU 12.2.0"; empty: any
  auto operator<=>(const BaselineKey&) const = default;
};

/// Identifies one line of figures.
struct EntryKey {
  std::string law;
  AttributeKind kind = AttributeKind::coverage;
  std::optional<Stratum> stratum;  ///< the fragments' stratum; empty: all strata of the kind
  auto operator<=>(const EntryKey&) const = default;
};

/// Certified figures of a baseline's cases; all else (quantiles, shares) follows from the figures.
struct EntryFigures {
  CaseCounts cases;     ///< the law's cases; only for kind `coverage`
  Noticed power;        ///< all defects together; only for kind `coverage`
  ClassCounts classes;  ///< only in the entry for all strata together
  /// Counts fragments or values of the kind that were drawn but not judged; only for all strata
  /// together. Absent in files written before such fragments and values were counted.
  std::optional<std::uint64_t> not_judged = std::nullopt;
  Histogram histogram;  ///< histogram of |error| against the exact triangle
  Enclosure worst;      ///< the largest |error|; 0 if none
  /// By stage, the sum of |part| over all errors; only for laws that split errors.
  std::map<Stage, SignedSum> stages;
  bool operator==(const EntryFigures&) const = default;
};

/// A case within its law.
using CaseNumber = std::pair<Origin, std::uint64_t>;

/// The result of one case (CaseRecord explains each member).
struct CaseFigures {
  std::uint64_t found_digest = 0;
  std::uint64_t mismatches = 0;
  WorstOfCase worst;
  /// Also `held` for every case of a law whose outcomes are missing from the file
  /// (are_outcomes_known).
  CaseOutcome outcome = CaseOutcome::held;
  bool operator==(const CaseFigures&) const = default;
};

/// The cases of one law.
struct LawCases {
  std::uint64_t count = 0;  ///< number of cases, including not applicable ones
  /// Sum, modulo 2^64, of a digest of (origin, index, digest of the case file) of each case: cases
  /// can be added to it.
  std::uint64_t digest = 0;
  std::map<CaseNumber, CaseFigures> cases;  ///< the applicable cases only
  bool operator==(const LawCases&) const = default;
};

/// The provenance of a section: recorded, never compared.
struct Taken {
  std::string backend;          ///< as given on the command line, whatever the key calls it
  std::string version;          ///< the program's version
  std::string commit;           ///< empty if unknown
  std::string instruction_set;  ///< the machine's, whatever the key says
  std::string compiler;         ///< likewise
  bool operator==(const Taken&) const = default;
};

/// Why changed figures were accepted into the baseline.
struct Approval {
  std::string reason;
  std::string version;
  std::string commit;
  std::vector<std::string> changes;  ///< one line each, old and new
  bool operator==(const Approval&) const = default;
};

struct BaselineSection {
  BaselineKey key;
  std::uint64_t records_version = kRecordsVersion;
  std::uint64_t rules_version = kRulesVersion;
  Plan plan;  ///< only the members that decide which cases the baseline has and how they are judged
              ///< (frozen())
  Taken taken;
  std::vector<Approval> approvals;  ///< in the order given
  std::map<EntryKey, EntryFigures> entries;
  std::map<std::string, LawCases> laws;         ///< every law that was run, by id
  std::map<std::uint64_t, std::string> corpus;  ///< index → case name, the same for all laws
  /// Drawn parts of some cases: for display, never compared.
  std::vector<Specimen> specimens = {};
  bool operator==(const BaselineSection&) const = default;
};

struct Baseline {
  std::vector<BaselineSection> sections;  ///< ordered by key, one per key
  bool operator==(const Baseline&) const = default;
};

/// Returns a backend's name in baselines. A plugin's path is put in lexically normal form, so that
/// "plugin:./a.so" and "plugin:a.so" are the same.
std::string section_name(const std::string& backend);

/// True if the outcomes of a law's cases were kept, that is, if the counts of violated and of known
/// cases match the law's figures.
bool are_outcomes_known(const BaselineSection& section, const std::string& law);

/// Adds the figures of further cases.
void merge(EntryFigures& into, const EntryFigures& from);

/// Inserts a section, replacing any section with the same key.
void put(Baseline& baseline, BaselineSection section);

/// "cpu on x86_64", "cpu on x86_64, avx2, GNU 12.2.0".
std::string to_string(const BaselineKey& key);

/// "LAW: smooth, sliver"; "LAW: coverage".
std::string to_string(const EntryKey& key);

}  // namespace rastercheck::records
