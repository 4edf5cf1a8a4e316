#pragma once

// Coverage of one triangle, row by row, by all three levels of the cascade (docs/oracle.md).

#include <cstdint>
#include <memory>
#include <vector>

#include "oracle/internal/triangle_filter.h"
#include "oracle/triangle_truth.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// The verdicts of a row of pixels.
class CoverageRow {
 public:
  /// A sample that the first level of the cascade leaves open.
  struct OpenSample {
    int x = 0;
    int sample = 0;
    std::optional<records::SampleVerdict> decision;  ///< empty until decided
  };

  /// Decides all samples of row y, which must be a row of the filter's box.
  void classify(const TriangleTruth& truth, const TriangleFilter& filter, int y,
                records::LevelCounts& levels);

  /// Samples per pixel.
  int samples() const { return static_cast<int>(verdicts_.size()); }
  bool is_required(int x, int sample) const {
    const auto bit = static_cast<std::size_t>(x - x0_);
    return (verdicts_[static_cast<std::size_t>(sample)].required[bit / 64] >> (bit % 64) & 1U) != 0;
  }
  /// The samples that are neither strictly inside nor outside: those required by a tie, and those
  /// permitted. Ordered by x, then sample.
  const std::vector<OpenSample>& special() const { return special_; }
  /// Calls take(x, sample, decision) for each required or permitted sample, ordered by x, then
  /// sample.
  template <typename Take>
  void for_each_covered(const Take& take) const {
    auto next = special_.begin();
    for (int x = x0_; x < x1_; ++x) {
      for (int s = 0; s < samples(); ++s) {
        if (next != special_.end() && next->x == x && next->sample == s) {
          take(x, s, *next++->decision);
        } else if (is_required(x, s)) {
          take(x, s, records::SampleVerdict{records::Verdict::required, records::Reason::inside});
        }
      }
    }
  }

  std::uint64_t required() const { return required_; }    ///< number of samples
  std::uint64_t permitted() const { return permitted_; }  ///< number of samples

 private:
  void decide_open(const TriangleTruth& truth, const TriangleFilter& filter, int y,
                   records::LevelCounts& levels);

  int x0_ = 0;
  int x1_ = 0;
  std::vector<RowVerdicts> verdicts_;  ///< [sample]
  std::vector<OpenSample> open_;       ///< samples that the first level left open
  std::vector<OpenSample> special_;
  std::uint64_t required_ = 0;
  std::uint64_t permitted_ = 0;
};

}  // namespace rastercheck::oracle
