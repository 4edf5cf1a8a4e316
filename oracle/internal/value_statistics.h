#pragma once

// Counts the errors of one judgement.
//
// Usually the contract leaves no value open. A value's excess is then its ideal error, which is
// counted once, by kind and stratum, and copied at the end to the statistics of the excess, the
// ideal error and the stratum. If a range is open, the ideal error is counted, and also the excess
// of each value beyond the range; all other excesses are 0. Extremes are tracked by enclosures, and
// only the errors that may still be the largest at the end are computed exactly.

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "cases/sample_place.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// An error that may turn out to be an extreme.
struct ExtremeCandidate {
  records::Enclosure error;
  cases::SamplePlace place;
  std::size_t fragment = 0;                ///< index into the framebuffer
  std::optional<std::uint32_t> attribute;  ///< empty for the depth
};

/// A lower limit for extremes. Among equal errors, the error at the first place is the extreme, in
/// whatever order the errors are seen.
struct ExtremeLimit {
  double size = 0;           ///< some error is at least this far from 0
  cases::SamplePlace place;  ///< the first known place with that error, if size > 0

  /// True if an error of size at most `error_size` may be an extreme.
  bool lets(double error_size, const cases::SamplePlace& error_place) const {
    return error_size > size || (error_size == size && size > 0 && error_place < place);
  }
  /// Takes into account an error of size at least `error_size`.
  void take(double error_size, const cases::SamplePlace& error_place);
};

/// The meaning of an enclosed error: both the excess and the ideal error, or one of the two.
enum class Meaning { both, ideal, excess };

/// Errors of one kind and stratum for which enclosures suffice.
class EnclosedErrors {
 public:
  explicit EnclosedErrors(Meaning what) : meaning(what) {}

  Meaning meaning;
  records::ErrorSizes sizes;

  /// Errors strictly between least() <= 0 and most() >= 0 cannot be extremes.
  double least() const { return -least_.size; }
  double most() const { return most_.size; }
  const ExtremeLimit& least_limit() const { return least_; }
  const ExtremeLimit& most_limit() const { return most_; }
  bool may_be_extreme(const records::Enclosure& error, const cases::SamplePlace& place) const {
    return most_.lets(error.hi, place) || least_.lets(-error.lo, place);
  }
  /// Records an error that may be an extreme.
  void note(const ExtremeCandidate& candidate);
  void merge(EnclosedErrors&& other);
  const std::vector<ExtremeCandidate>& candidates() const { return candidates_; }
  /// True if the candidates should be settled now, because more would slow the judge down.
  bool has_many_candidates() const { return candidates_.size() >= 64; }
  /// Call after the candidates have been computed exactly and the extremes kept in `sizes`.
  void settled();

 private:
  void prune();

  ExtremeLimit least_;
  ExtremeLimit most_;
  std::vector<ExtremeCandidate> candidates_;
};

class ValueStatistics {
 public:
  records::Judgement& judgement() { return judgement_; }
  records::ErrorStatistics& of(records::AttributeKind kind) { return judgement_.errors[kind]; }
  records::Levels& levels() { return judgement_.levels; }
  EnclosedErrors& enclosed(records::AttributeKind kind, records::Stratum stratum,
                           Meaning meaning = Meaning::both);

  /// Settles the candidates of errors: computes them exactly (settle_extremes in value_judge.h).
  using Settle = std::function<void(EnclosedErrors&)>;

  /// Adds the statistics of values that were judged after the values counted here.
  void merge(ValueStatistics&& other, const Settle& settle);

  /// Moves everything to its place and returns the judgement.
  records::Judgement finish(const Settle& settle);

 private:
  static constexpr std::size_t kKinds = names_of(records::AttributeKind{}).size();
  static constexpr std::size_t kStrata = names_of(records::Stratum{}).size();

  template <typename Take>
  void for_each_enclosed(const Take& take) {
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
      for (std::size_t stratum = 0; stratum < kStrata; ++stratum) {
        for (const auto& errors : enclosed_[kind][stratum]) {
          if (!errors) continue;
          take(static_cast<records::AttributeKind>(kind), static_cast<records::Stratum>(stratum),
               *errors);
        }
      }
    }
  }
  void put_in_place(records::AttributeKind kind, records::Stratum stratum,
                    const EnclosedErrors& enclosed);

  records::Judgement judgement_;
  using OfMeanings = std::array<std::unique_ptr<EnclosedErrors>, 3>;
  std::array<std::array<OfMeanings, kStrata>, kKinds> enclosed_;
};

}  // namespace rastercheck::oracle
