#pragma once

// What holding one framebuffer against the truth gives, as plain data.

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

/// What was judged of the fragments: whether they are there at all, or one of their values, by the
/// way it varies. The kind decides the unit of its errors (RULES §5).
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

/// How one fragment, or one value of it, came out. Those that are no numbers are classes of their
/// own and have no error. Infinity stands for 2^128, the number after the largest float32: it is
/// correct where the exact value lies beyond that or within the bound of it.
enum class FragmentClass {
  correct,             ///< drawn rightly; the value is within the bound
  beyond_bound,        ///< a number, but farther from the exact value than the bound
  missing,             ///< required and not drawn
  extra,               ///< drawn and forbidden
  wrong_triangle,      ///< drawn, but not from the nearest triangle (depth test only)
  not_a_number,        ///< NaN
  infinite,            ///< infinite where float32 holds the exact value, or of the wrong sign
  wrong_sign_of_zero,  ///< the other zero, where all vertex values are the same zero
  // Of drawings that there are not; no fragment is counted so.
  failed,  ///< the backend says why it did not draw, or what it gave is no drawing
  crash,   ///< its process ended
  hang,    ///< it did not answer in time
};

/// Of JSON output and tables.
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

/// Why what was drawn is judged by no law: of coverage a fragment, else a value of one.
enum class NotJudged {
  not_promised,   ///< the triangle, or the attribute, has numbers that no promise is made of
  without_bound,  ///< its bound would let any number pass
  left_free,      ///< the rules let it be any number
  undefined,      ///< the rules say nothing of it: 1/w <= 0 where it is evaluated
};
constexpr auto names_of(NotJudged /*type*/) {
  return std::to_array<std::string_view>(
      {"not promised", "without bound", "left free", "undefined"});
}
constexpr std::string_view to_string(NotJudged why) { return cases::name_of(why); }

/// How many fragments, or values of them, came out in each class.
struct ClassCounts {
  /// [FragmentClass], up to those that fragments have
  std::array<std::uint64_t, static_cast<std::size_t>(FragmentClass::failed)> counts{};

  std::uint64_t& operator[](FragmentClass fragment_class) {
    return counts[static_cast<std::size_t>(fragment_class)];
  }
  std::uint64_t operator[](FragmentClass fragment_class) const {
    return counts[static_cast<std::size_t>(fragment_class)];
  }
  bool operator==(const ClassCounts&) const = default;
};

/// One error that was seen, where, and of what.
struct WorstError {
  /// (actual − exact) in the unit of its kind, signed. It is to depend on nothing but the fragment
  /// (so: as narrow as doubles get, not as narrow as some comparison needed), or records of
  /// different splits of the work would differ.
  Enclosure error;
  /// The exact value: a fraction in lowest terms, "84/5", or a range of two where the contract
  /// leaves it open.
  std::string exact;
  /// What the backend gave; finite, as all that is not is a class.
  float actual = 0;
  std::uint64_t case_index = 0;  ///< of its law and seed
  std::string case_name;         ///< empty where the case has none
  cases::SamplePlace place = {};
  /// Index into the case's attributes; nothing for depth.
  std::optional<std::uint32_t> attribute;
  bool operator==(const WorstError&) const = default;
};

/// The largest error below and above the exact values; nothing where there was none on that side.
struct Extremes {
  std::optional<WorstError> most_negative;
  std::optional<WorstError> most_positive;
  bool operator==(const Extremes&) const = default;
};

/// Samples by verdict. `undecided` is what the oracle could not answer; a run prints it, and it is
/// zero.
struct Counts {
  std::uint64_t required = 0;
  std::uint64_t forbidden = 0;
  std::uint64_t permitted = 0;
  std::uint64_t undecided = 0;
  bool operator==(const Counts&) const = default;
};

/// What makes a fragment's values hard, the first that holds of its triangle and case. Errors are
/// kept apart by it, so that many easy fragments do not hide what few hard ones show.
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

/// What answered: of each sample that was looked at, its verdict; of each judged value, all that
/// was asked of its error.
struct Levels {
  LevelCounts samples;
  LevelCounts values;
  bool operator==(const Levels&) const = default;
};

/// How large errors of one sort were.
struct ErrorSizes {
  Histogram histogram;  ///< of |error|
  Extremes extremes;
  SignedSum sum;
  bool operator==(const ErrorSizes&) const = default;
};

/// The errors of one attribute kind, in its unit.
struct ErrorStatistics {
  /// Beyond what the contract leaves open, 0 within it: what the bound is held against.
  ErrorSizes excess;
  /// Against the value of the exact triangle, or of the snapped one where values come from that
  /// (oracle/judge.h), whatever the contract leaves open: how precise it is. Not of fragments where
  /// that triangle has no value.
  ErrorSizes ideal;
  ClassCounts classes;
  /// How many were drawn and not judged, by why; these are in no class and have no errors. Only
  /// fragments of coverage are in a class all the same, as `correct`.
  std::map<NotJudged, std::uint64_t> not_judged;
  /// `ideal` by what makes a fragment hard; only strata that have one.
  std::map<Stratum, ErrorSizes> strata;
  /// Magnitudes of the parts of errors, by what makes a fragment hard and the stage that made them
  /// (stage_split.h); of laws that split errors.
  std::map<Stratum, std::map<Stage, SignedSum>> stages;
  bool operator==(const ErrorStatistics&) const = default;
};

/// What judging one framebuffer gives; only kinds that the case has appear.
struct Judgement {
  Counts counts;
  Levels levels;
  std::map<AttributeKind, ErrorStatistics> errors;
  bool operator==(const Judgement&) const = default;
};

}  // namespace rastercheck::records
