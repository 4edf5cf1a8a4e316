#pragma once

// What a run found, as plain data that merges exactly.
//
// Merging adds counts and keeps the larger of two extremes. Larger is a total order that takes in
// every member of a WorstError, so that merging is associative and commutative: however a run's
// cases are split over processes, and in whatever order their records come together, the result is
// the same to the byte. Records hold nothing that depends on machine, time or split.
//
// Errors are compared by their enclosures. Two different errors between the same neighbouring
// doubles, which differ by less than 2^-52 of themselves, count as equally large.

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "records/defect.h"
#include "records/judgement.h"

namespace rastercheck::records {

/// The strata of cases that no generator names: of the corpus, of saved counterexamples, of known
/// defects, and of a scene, this and its name.
inline constexpr std::string_view kCorpusStratum = "corpus";
inline constexpr std::string_view kSavedStratum = "saved";
inline constexpr std::string_view kKnownStratum = "known";
inline constexpr std::string_view kSceneStratum = "scene ";

/// What a record is of; records are ordered by these, first to last.
struct RecordKey {
  std::string law;      ///< the property's id
  std::string backend;  ///< as given on the command line
  AttributeKind attribute_kind = AttributeKind::coverage;
  std::string stratum;  ///< the part of the law's cases, as its generator names them
  auto operator<=>(const RecordKey&) const = default;
};

/// How many cases, by what became of them.
struct CaseCounts {
  std::uint64_t checked = 0;
  std::uint64_t not_applicable = 0;  ///< the law says nothing of them
  std::uint64_t violations = 0;      ///< of those checked, known ones not among them
  std::uint64_t known = 0;           ///< of those checked: violated in known ways only (known.h)
  bool operator==(const CaseCounts&) const = default;
};

/// What belongs to a law's cases and not to one kind of value (cases, counts, labels, levels,
/// power) stands in the record of kind `coverage`, so that sums over kinds count it once.
struct Record {
  CaseCounts cases;
  Counts counts;
  ErrorStatistics errors;
  std::map<std::string, std::uint64_t> labels;  ///< label → cases that reached it
  std::map<std::string, std::uint64_t> known;   ///< known entry's id → cases violated so
  /// Why → cases that the law says nothing of, those in place of which others were drawn among
  /// them. Files from before there were reasons have none.
  std::map<std::string, std::uint64_t> not_applicable_because;
  Levels levels;
  Power power;  ///< what was noticed of drawings of the law's cases that were made wrong
  bool operator==(const Record&) const = default;
};

using RecordSet = std::map<RecordKey, Record>;

/// Whether the record is of cases that every run of the same seed has: of the corpus and random
/// ones, not saved counterexamples, known defects and scenes.
bool is_frozen(const RecordKey& key);

/// Keeps the error as an extreme of its side if it is the larger one there. Of equally large ones
/// the first stays, by (case index, case name, triangle, y, x, sample, attribute, exact, actual).
/// An error of exactly 0 is on neither side.
void keep(Extremes& extremes, const WorstError& error);

/// Whether keep() could change the extremes for an error so enclosed: what to ask before the rest
/// of a WorstError is put together.
bool may_keep(const Extremes& extremes, const Enclosure& error);

/// The larger of both, by magnitude; of equally large ones the negative. nullptr without one.
const WorstError* worst_of(const Extremes& extremes);

/// Adds what judging one framebuffer gave: its counts to the record of kind `coverage`, its errors
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
