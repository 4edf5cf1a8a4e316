#pragma once

// Where the errors of one judgement are counted.
//
// Mostly the contract leaves no value open; then a value's excess is its ideal error, and is
// counted once, by kind and stratum, and put into all three places at the end. Where a range is
// open the ideal error is counted, and of what lies beyond the range the excess as well; that of
// all others is 0. Of such errors the extremes are looked for among enclosures, and only what may
// be the largest at the end is computed exactly.

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
  std::optional<std::uint32_t> attribute;  ///< nothing for the depth
};

/// An error that extremes have to exceed. Of equal ones that of the first place is the extreme, in
/// whatever order they are seen.
struct ExtremeLimit {
  double size = 0;           ///< some error is at least this far from 0
  cases::SamplePlace place;  ///< of the first that is known to be, if size > 0

  /// Whether an error, at most this far from 0, may be an extreme.
  bool lets(double error_size, const cases::SamplePlace& error_place) const {
    return error_size > size || (error_size == size && size > 0 && error_place < place);
  }
  /// Takes an error into account that is at least this far from 0.
  void take(double error_size, const cases::SamplePlace& error_place);
};

/// Says what an enclosed error is: excess and ideal alike, or one of them.
enum class Meaning { both, ideal, excess };

/// Errors of one kind and stratum that enclosures are enough for.
class EnclosedErrors {
 public:
  explicit EnclosedErrors(Meaning what) : meaning(what) {}

  Meaning meaning;
  records::ErrorSizes sizes;

  /// Errors strictly between these cannot be an extreme; at most and at least 0.
  double least() const { return -least_.size; }
  double most() const { return most_.size; }
  bool may_be_extreme(const records::Enclosure& error, const cases::SamplePlace& place) const {
    return most_.lets(error.hi, place) || least_.lets(-error.lo, place);
  }
  /// Notes an error that may be an extreme.
  void note(const ExtremeCandidate& candidate);
  void merge(EnclosedErrors&& other);
  const std::vector<ExtremeCandidate>& candidates() const { return candidates_; }
  /// More than this would be slow to carry about: it is time to settle.
  bool has_many_candidates() const { return candidates_.size() >= 64; }
  /// The candidates have been computed exactly and kept in `sizes`, where they are extremes.
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

  /// Adds what was judged after this.
  void merge(ValueStatistics&& other, const Settle& settle);

  /// All in its place.
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
