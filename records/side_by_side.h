#pragma once

// Backends of one run side by side: on the same cases, which of two backends is right?
//
// Each backend is judged by its own contract. So two backends may both be right and draw different
// values; that is no disagreement here. A known defect of a backend is wrong all the same.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "records/case_outcomes.h"
#include "records/judgement.h"
#include "records/run.h"

namespace rastercheck::records {

/// Counts cases that are the same on two backends and were judged on both.
struct SideCounts {
  std::uint64_t both_right = 0;
  std::uint64_t only_first_right = 0;
  std::uint64_t only_second_right = 0;
  std::uint64_t neither_right = 0;
  bool operator==(const SideCounts&) const = default;

  std::uint64_t cases() const {
    return both_right + only_first_right + only_second_right + neither_right;
  }
  std::uint64_t differing() const { return only_first_right + only_second_right; }
};

/// Names a case of a law.
struct CasePlace {
  Origin origin = Origin::random;
  std::uint64_t index = 0;
  bool operator==(const CasePlace&) const = default;
};

/// The most cases that are named for each kind of disagreement.
inline constexpr std::size_t kMostPlaces = 3;

/// One law on two backends.
struct SideBySideLaw {
  std::string law;
  SideCounts counts;
  /// The first cases of each disagreement: corpus, then random cases.
  std::vector<CasePlace> only_first_right;
  std::vector<CasePlace> only_second_right;
  bool operator==(const SideBySideLaw&) const = default;
};

/// The largest errors of one kind beyond what the contracts leave open, over all cases of each
/// backend, the same or not. Empty if the backend has no value of this kind.
struct SideErrors {
  AttributeKind kind = AttributeKind::smooth;
  std::optional<Enclosure> first;
  std::optional<Enclosure> second;
  bool operator==(const SideErrors&) const = default;
};

/// Two backends.
struct SideBySide {
  std::string first;
  std::string second;
  std::uint64_t judged_first = 0;   ///< cases judged on `first`, whether or not on `second`
  std::uint64_t judged_second = 0;  ///< cases judged on `second`, whether or not on `first`
  /// Cases of the same number that were judged on both but are not the same case.
  std::uint64_t unlike = 0;
  SideCounts counts;
  std::uint64_t known_first = 0;   ///< common cases in which `first` shows known defects only
  std::uint64_t known_second = 0;  ///< common cases in which `second` shows known defects only
  /// Laws with at least one such case, in the plan's order.
  std::vector<SideBySideLaw> laws;
  std::vector<SideErrors> errors;
  bool operator==(const SideBySide&) const = default;
};

/// With up to this many backends, every pair is compared; with more, each is compared with the
/// first only.
inline constexpr std::size_t kMostInAllPairs = 3;

/// Compares a run's backends, in the order of the plan. Empty for a run of one backend, for a shard
/// (which gives its backends different cases), and for a run that kept no outcomes.
std::vector<SideBySide> side_by_side(const Run& run);

}  // namespace rastercheck::records
