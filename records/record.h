#pragma once

// The results of a run, as plain data that merges exactly.
//
// Merging adds counts and keeps the larger of two extremes. "Larger" is a total order over every
// member of a WorstError, so merging is associative and commutative: the result is the same to the
// byte, however a run's cases are split over processes and in whatever order records merge. Records
// hold nothing that depends on machine, time or split.
//
// Errors are compared by their enclosures. Two different errors between the same neighbouring
// doubles, with a relative difference below 2^-52, count as equally large.

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "records/defect.h"
#include "records/judgement.h"

namespace rastercheck::records {

/// Strata of cases that no generator names: corpus, saved counterexamples, known defects, and
/// scenes (the prefix "scene " and the scene's name).
inline constexpr std::string_view kCorpusStratum = "corpus";
inline constexpr std::string_view kSavedStratum = "saved";
inline constexpr std::string_view kKnownStratum = "known";
inline constexpr std::string_view kSceneStratum = "scene ";

/// Identifies a record; records are ordered by these members, first to last.
struct RecordKey {
  std::string law;      ///< the property's id
  std::string backend;  ///< as given on the command line
  AttributeKind attribute_kind = AttributeKind::coverage;
  std::string stratum;  ///< the part of the law's cases, named by the generator
  auto operator<=>(const RecordKey&) const = default;
};

/// Counts cases by outcome.
struct CaseCounts {
  std::uint64_t checked = 0;
  std::uint64_t not_applicable = 0;  ///< the law does not apply
  std::uint64_t violations = 0;  ///< checked cases with at least one violation that is not known
  std::uint64_t known = 0;       ///< checked cases whose violations are all known (known.h)
  bool operator==(const CaseCounts&) const = default;
};

/// The results of one law on one backend for one kind and stratum. Members that belong to cases and
/// not to one kind of value (cases, counts, labels, levels, power) are kept only in the record of
/// kind `coverage`, so that sums over kinds count them once.
struct Record {
  CaseCounts cases;
  Counts counts;
  ErrorStatistics errors;
  std::map<std::string, std::uint64_t> labels;  ///< label → cases that reached it
  /// Id of a known entry → cases counted as `known` with violations that the entry covers.
  std::map<std::string, std::uint64_t> known;
  /// Reason → cases to which the law does not apply, including cases that were replaced by another.
  /// Empty in files written before reasons were kept.
  std::map<std::string, std::uint64_t> not_applicable_because;
  Levels levels;
  Power power;  ///< how many wrong drawings of the law's cases were noticed
  bool operator==(const Record&) const = default;
};

using RecordSet = std::map<RecordKey, Record>;

/// True if the record's cases are in every run with the same seed: corpus and random cases, not
/// saved counterexamples, known defects or scenes.
bool is_frozen(const RecordKey& key);

/// Keeps the error as the extreme of its side if it is larger than the present extreme. Of equally
/// large errors, the first in the order of (case index, case name, triangle, y, x, sample,
/// attribute, exact, actual) stays. An error of exactly 0 is on neither side.
void keep(Extremes& extremes, const WorstError& error);

/// True if keep() could change the extremes for an error in this enclosure; check this before
/// building a full WorstError.
bool may_keep(const Extremes& extremes, const Enclosure& error);

/// The extreme of larger magnitude; the negative one if equal; nullptr if neither exists.
const WorstError* worst_of(const Extremes& extremes);

/// Adds the judgement of one framebuffer: its counts to the record of kind `coverage`, its errors
/// to the records of their kinds. The key's own attribute kind is ignored.
void add(RecordSet& into, RecordKey key, const Judgement& judgement);

/// Adds `from` to `into`.
void merge(Counts& into, const Counts& from);
void merge(CaseCounts& into, const CaseCounts& from);
void merge(ClassCounts& into, const ClassCounts& from);
void merge(Extremes& into, const Extremes& from);
void merge(ErrorSizes& into, const ErrorSizes& from);
void merge(ErrorStatistics& into, const ErrorStatistics& from);
void merge(LevelCounts& into, const LevelCounts& from);
void merge(Levels& into, const Levels& from);
void merge(Judgement& into, const Judgement& from);
void merge(Record& into, const Record& from);
void merge(RecordSet& into, const RecordSet& from);

}  // namespace rastercheck::records
