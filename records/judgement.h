#pragma once

// The result of judging one framebuffer against the exact answer, as plain data.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "cases/case.h"
#include "cases/names.h"
#include "cases/sample_place.h"
#include "records/enclosure.h"
#include "records/histogram.h"
#include "records/signed_sum.h"
#include "records/stage_split.h"

namespace rastercheck::records {

/// The judged aspect of a fragment: its presence, or one of its values, by interpolation. The kind
/// decides the unit of its errors (RULES §5).
enum class AttributeKind {
  coverage,       ///< samples drawn or not; has no errors, only classes
  depth,          ///< ULP of max(|n|, |f|), or steps of a fixed-point target
  smooth,         ///< scale ULP
  noperspective,  ///< scale ULP
  flat,           ///< scale ULP
};

/// The kind of an attribute's errors.
constexpr AttributeKind kind_of(cases::Interpolation interpolation) {
  switch (interpolation) {
    case cases::Interpolation::smooth:
      return AttributeKind::smooth;
    case cases::Interpolation::noperspective:
      return AttributeKind::noperspective;
    case cases::Interpolation::flat:
      break;
  }
  return AttributeKind::flat;
}

/// The class of one fragment, or of one of its values. NaN and wrong infinities are classes of
/// their own and have no error. Infinity stands for 2^128, the number after the largest float32: an
/// infinite value is correct if the exact value exceeds this number in magnitude, or falls short of
/// it by no more than the bound.
enum class FragmentClass {
  correct,             ///< correctly drawn; the value is within the bound
  beyond_bound,        ///< a number, but farther from the exact value than the bound
  missing,             ///< required and not drawn
  extra,               ///< drawn and forbidden
  wrong_triangle,      ///< drawn, but not from the nearest triangle (depth test only)
  not_a_number,        ///< NaN
  infinite,            ///< infinite although float32 holds the exact value, or of the wrong sign
  wrong_sign_of_zero,  ///< the other zero, although all vertex values are the same zero
  // Classes of failed drawings; never counted for a fragment.
  failed,  ///< the backend reported an error, or its answer is not a drawing
  crash,   ///< the backend's process ended
  hang,    ///< the backend did not answer in time
};

/// The names in JSON output and tables.
constexpr auto names_of(AttributeKind /*type*/) {
  return std::to_array<std::string_view>({"coverage", "depth", "smooth", "noperspective", "flat"});
}
constexpr auto names_of(FragmentClass /*type*/) {
  return std::to_array<std::string_view>({"correct", "beyond bound", "missing", "extra",
                                          "wrong triangle", "not a number", "infinite",
                                          "wrong sign of zero", "failed", "crash", "hang"});
}
constexpr std::string_view to_string(AttributeKind kind) { return cases::name_of(kind); }
constexpr std::string_view to_string(FragmentClass fragment_class) {
  return cases::name_of(fragment_class);
}

/// Why a drawn fragment (for coverage) or one of its values is not judged.
enum class NotJudged {
  not_promised,   ///< the triangle or the attribute has numbers that the contract excludes
  without_bound,  ///< the bound allows any number
  left_free,      ///< the rules allow any number
  undefined,      ///< the rules do not define the value: 1/w <= 0 at its place
};
constexpr auto names_of(NotJudged /*type*/) {
  return std::to_array<std::string_view>(
      {"not promised", "without bound", "left free", "undefined"});
}
constexpr std::string_view to_string(NotJudged why) { return cases::name_of(why); }

/// Counts fragments, or their values, by class.
struct ClassCounts {
  /// [FragmentClass], only classes that fragments can have
  std::array<std::uint64_t, static_cast<std::size_t>(FragmentClass::failed)> counts{};

  std::uint64_t& operator[](FragmentClass fragment_class) {
    return counts[static_cast<std::size_t>(fragment_class)];
  }
  std::uint64_t operator[](FragmentClass fragment_class) const {
    return counts[static_cast<std::size_t>(fragment_class)];
  }
  bool operator==(const ClassCounts&) const = default;
};

/// One observed error, with its place and value.
struct WorstError {
  /// (actual − exact) in the unit of its kind, signed. Must be the narrowest enclosure in doubles,
  /// which depends only on the fragment. If it were only as narrow as some comparison needed,
  /// records of different splits of the work would differ.
  Enclosure error;
  /// The exact value: a fraction in lowest terms, "84/5", or a range of two if the contract leaves
  /// it open.
  std::string exact;
  /// The backend's value; finite, because NaN and infinities have a class instead of an error.
  float actual = 0;
  std::uint64_t case_index = 0;  ///< index among the cases of the law and seed
  std::string case_name;         ///< empty if unnamed
  cases::SamplePlace place = {};
  /// Index into the case's attributes; empty for depth.
  std::optional<std::uint32_t> attribute;
  bool operator==(const WorstError&) const = default;
};

/// The largest errors below and above the exact values; empty if no error is on that side.
struct Extremes {
  std::optional<WorstError> most_negative;
  std::optional<WorstError> most_positive;
  bool operator==(const Extremes&) const = default;
};

/// Samples by verdict. `undecided` counts samples that the oracle could not decide; a run prints
/// this count, which is zero.
struct Counts {
  std::uint64_t required = 0;
  std::uint64_t forbidden = 0;
  std::uint64_t permitted = 0;
  std::uint64_t undecided = 0;
  bool operator==(const Counts&) const = default;
};

/// The condition that makes a fragment's values hard: the first in this list that its triangle and
/// case meet. Errors are kept apart by stratum, so that many easy fragments do not hide the few
/// hard ones.
enum class Stratum {
  clipped,       ///< a vertex lies beyond a clip plane or clip distance, or has w <= 0
  near_horizon,  ///< the greatest w is more than 16 times the least
  sliver,        ///< the least height is below 1/64 of the longest edge, in window space
  multisampled,  ///< several samples per pixel
  ordinary,
};
constexpr auto names_of(Stratum /*type*/) {
  return std::to_array<std::string_view>(
      {"clipped", "near horizon", "sliver", "multisampled", "ordinary"});
}
constexpr std::string_view to_string(Stratum stratum) { return cases::name_of(stratum); }

/// How many answers each level of the oracle's cascade gave (docs/oracle.md); all are certain.
struct LevelCounts {
  std::uint64_t filter = 0;    ///< doubles with an error bound known beforehand
  std::uint64_t interval = 0;  ///< interval arithmetic
  std::uint64_t exact = 0;     ///< exact numbers
  bool operator==(const LevelCounts&) const = default;
};

/// The answers of the levels. A sample counts at the level that gave its verdict; a judged value
/// counts at the level that answered every question about its error.
struct Levels {
  LevelCounts samples;
  LevelCounts values;
  bool operator==(const Levels&) const = default;
};

/// Sizes of a set of errors.
struct ErrorSizes {
  Histogram histogram;  ///< histogram of |error|
  Extremes extremes;
  SignedSum sum;
  bool operator==(const ErrorSizes&) const = default;
};

/// The errors of one attribute kind, in its unit.
struct ErrorStatistics {
  /// Errors beyond what the contract leaves open, 0 within; these are compared with the bound.
  ErrorSizes excess;
  /// Errors against the exact triangle, or against the snapped triangle if values come from that
  /// (oracle/judge.h), whatever the contract leaves open. These errors measure the precision.
  /// Excludes fragments for which that triangle has no value.
  ErrorSizes ideal;
  ClassCounts classes;
  /// Drawn but not judged, by reason; these have no errors and no class, except that fragments of
  /// kind coverage are still in class `correct`.
  std::map<NotJudged, std::uint64_t> not_judged;
  /// `ideal` by stratum; only strata with an error.
  std::map<Stratum, ErrorSizes> strata;
  /// By stratum and stage, the sum of |part| over all errors (stage_split.h); only for laws that
  /// split errors.
  std::map<Stratum, std::map<Stage, SignedSum>> stages;
  bool operator==(const ErrorStatistics&) const = default;
};

/// The result of judging one framebuffer; only kinds that the case has.
struct Judgement {
  Counts counts;
  Levels levels;
  std::map<AttributeKind, ErrorStatistics> errors;
  bool operator==(const Judgement&) const = default;
};

}  // namespace rastercheck::records
