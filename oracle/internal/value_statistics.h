#pragma once

// Where the errors of one judgement are counted.
//
// Mostly the contract leaves no value open; then a value's excess is its ideal error, and is
// counted once, by kind and stratum, and put into all three places at the end. So is the ideal
// error of a value that certainly lies within what is left open: its excess is 0. Of such errors
// the extremes are looked for among enclosures, and only what may be the largest at the end is
// computed exactly.

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

/// What the excess of a value is, whose ideal error is counted.
enum class Excess { ideal, zero };

/// Ideal errors of one kind and stratum, from which the excess follows.
class SingleErrors {
 public:
  records::ErrorSizes sizes;

  /// Errors strictly between these cannot be an extreme; at most and at least 0.
  double least() const { return -least_.size; }
  double most() const { return most_.size; }
  bool may_be_extreme(const records::Enclosure& error, const cases::SamplePlace& place) const {
    return most_.lets(error.hi, place) || least_.lets(-error.lo, place);
  }
  /// Notes an error that may be an extreme.
  void note(const ExtremeCandidate& candidate);
  void merge(SingleErrors&& other);
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
  SingleErrors& single(records::AttributeKind kind, records::Stratum stratum,
                       Excess excess = Excess::ideal);

  /// Settles the candidates of errors: computes them exactly (settle_extremes in value_judge.h).
  using Settle = std::function<void(SingleErrors&)>;

  /// Adds what was judged after this.
  void merge(ValueStatistics&& other, const Settle& settle);

  /// All in its place.
  records::Judgement finish(const Settle& settle);

 private:
  static constexpr std::size_t kKinds = names_of(records::AttributeKind{}).size();
  static constexpr std::size_t kStrata = names_of(records::Stratum{}).size();

  template <typename Take>
  void for_each_single(const Take& take) {
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
      for (std::size_t stratum = 0; stratum < kStrata; ++stratum) {
        for (const Excess excess : {Excess::ideal, Excess::zero}) {
          const auto& errors = single_[kind][stratum][static_cast<std::size_t>(excess)];
          if (!errors) continue;
          take(static_cast<records::AttributeKind>(kind), static_cast<records::Stratum>(stratum),
               excess, *errors);
        }
      }
    }
  }
  void put_in_place(records::AttributeKind kind, records::Stratum stratum, Excess excess,
                    const records::ErrorSizes& sizes);

  records::Judgement judgement_;
  using BothExcesses = std::array<std::unique_ptr<SingleErrors>, 2>;
  std::array<std::array<BothExcesses, kStrata>, kKinds> single_;
};

}  // namespace rastercheck::oracle
