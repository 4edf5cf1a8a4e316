#pragma once

// The baseline of the regression gate: what a run found of its frozen cases, kept to hold later
// runs against. As plain data; baseline_json.h reads and writes the file.
//
// A section is made from a run (gate/sections.h), and a baseline is sections. Comparing is one
// section against another, so that runs and baseline files stand on either side alike.

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
inline constexpr std::uint64_t kBaselineVersion = 2;
inline constexpr const char* kBaselineFile = "rastercheck-baseline.json";

/// What a section is of.
struct BaselineKey {
  std::string backend;          ///< section_name() of it, or a name given instead
  std::string architecture;     ///< "x86_64"
  std::string instruction_set;  ///< "avx2"; empty: of any
  std::string compiler;         ///< "GNU 12.2.0"; empty: of any
  auto operator<=>(const BaselineKey&) const = default;
};

/// What one line of figures is of.
struct EntryKey {
  std::string law;
  AttributeKind kind = AttributeKind::coverage;
  std::optional<Stratum> stratum;  ///< of fragments; nothing: all of the kind
  auto operator<=>(const EntryKey&) const = default;
};

/// Certified figures of the frozen cases; all else (quantiles, shares) follows from them.
struct EntryFigures {
  CaseCounts cases;     ///< of the law; of kind `coverage` only
  Noticed power;        ///< of all defects together; likewise
  ClassCounts classes;  ///< of all strata together only
  /// Fragments or values of the kind that were drawn and not judged, of all strata together only.
  /// Files from before they were counted have none.
  std::optional<std::uint64_t> not_judged = std::nullopt;
  Histogram histogram;  ///< of magnitudes of errors against the exact triangle
  Enclosure worst;      ///< the largest magnitude; 0 without one
  /// Magnitudes of the parts of errors; of laws that split them.
  std::map<Stage, SignedSum> stages;
  bool operator==(const EntryFigures&) const = default;
};

/// A case within its law.
using CaseNumber = std::pair<Origin, std::uint64_t>;

/// What one case gave (CaseRecord has what each member is).
struct CaseFigures {
  std::uint64_t found_digest = 0;
  std::uint64_t mismatches = 0;
  WorstOfCase worst;
  /// `held` of all cases of a law in files from before it was kept, too (are_outcomes_known).
  CaseOutcome outcome = CaseOutcome::held;
  bool operator==(const CaseFigures&) const = default;
};

/// The cases of one law.
struct LawCases {
  std::uint64_t count = 0;   ///< those that the law says nothing of among them
  std::uint64_t digest = 0;  ///< of (origin, index, digest of the case file) of all, in order
  std::map<CaseNumber, CaseFigures> cases;  ///< without those that the law says nothing of
  bool operator==(const LawCases&) const = default;
};

/// Where a section comes from: recorded, and not compared.
struct Taken {
  std::string backend;          ///< as given on the command line, whatever the key calls it
  std::string version;          ///< of this program
  std::string commit;           ///< empty where that is not known
  std::string instruction_set;  ///< of the machine, whatever the key says of it
  std::string compiler;         ///< likewise
  bool operator==(const Taken&) const = default;
};

/// Why figures were taken over.
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
  Plan plan;  ///< what of it decides which cases are frozen and how they are judged (frozen)
  Taken taken;
  std::vector<Approval> approvals;  ///< in the order in which they were given
  std::map<EntryKey, EntryFigures> entries;
  std::map<std::string, LawCases> laws;         ///< all that were run, by id
  std::map<std::uint64_t, std::string> corpus;  ///< index → name of the case, the same in all laws
  /// What was drawn of parts of some cases: to be shown, and not compared.
  std::vector<Specimen> specimens = {};
  bool operator==(const BaselineSection&) const = default;
};

struct Baseline {
  std::vector<BaselineSection> sections;  ///< ordered by key, one of each
  bool operator==(const Baseline&) const = default;
};

/// A backend's name in baselines: of a plugin with its path in lexically normal form, so that
/// "plugin:./a.so" and "plugin:a.so" are one.
std::string section_name(const std::string& backend);

/// Whether outcomes of a law's cases were kept: as many are violated, and known, as its figures
/// say.
bool are_outcomes_known(const BaselineSection& section, const std::string& law);

/// Puts a section in the place of that of its key, or where none is of its key.
void put(Baseline& baseline, BaselineSection section);

/// "cpu on x86_64", "cpu on x86_64, avx2, GNU 12.2.0".
std::string to_string(const BaselineKey& key);

/// "LAW: smooth, sliver"; "LAW: coverage".
std::string to_string(const EntryKey& key);

}  // namespace rastercheck::records
