#pragma once

// Judges the values of one triangle's drawn samples, a batch at a time, by the three levels of the
// cascade (docs/oracle.md). A level returns an enclosure of a value's error. The enclosure decides
// the value if it answers all three questions:
//
//   Is it within the bound?   Which bucket of the histogram?   Is it a new extreme?
//
// If one question stays open, the next level is asked; the last level, judge_value, answers all
// questions.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cases/fragments.h"
#include "oracle/internal/filter_kernels.h"
#include "oracle/internal/intervals.h"
#include "oracle/internal/prepared_values.h"
#include "oracle/internal/triangle_filter.h"
#include "oracle/internal/value_judge.h"
#include "oracle/internal/value_statistics.h"
#include "oracle/judge.h"

namespace rastercheck::oracle {

/// The judgement of a batch's values.
class JudgedBatch {
 public:
  /// True if all values of a sample are right.
  bool is_right(std::size_t lane) const { return !is_wrong_[lane]; }
  /// The values of a sample, depth first.
  std::vector<JudgedValue> values_of(std::size_t lane) const;

 private:
  friend class ValueCascade;
  struct Column {
    records::AttributeKind kind;
    std::optional<std::uint32_t> attribute;
    Batch<float> actual;
    // If is_by_enclosure, [lo, hi] encloses the error of a right value: both excess and ideal error
    // or, if is_open, the ideal error alone. Otherwise the value is in `one_by_one_`.
    Batch<double> lo;
    Batch<double> hi;
    Batch<bool> is_by_enclosure;
    bool has_ideal = true;             ///< if false, there is no ideal error, and lo and hi are
                                       ///< meaningless
    bool is_open = false;              ///< the excess may differ from the ideal error
    Batch<records::Enclosure> excess;  ///< only if is_open
  };
  struct OneValue {
    std::size_t column;
    std::size_t lane;
    JudgedValue value;
  };
  std::vector<Column> columns_;
  std::vector<OneValue> one_by_one_;
  Batch<bool> is_wrong_{};
};

class ValueCascade {
 public:
  /// The scene, the drawing and the statistics must outlive the object.
  ValueCascade(const SceneTruth& scene, const cases::Fragments& drawn, const JudgeOptions& options,
               ValueStatistics& statistics);

  /// Begins a triangle. The triangle and the filter of its coverage must outlive its batches; all
  /// its samples must lie in the filter's box.
  void begin(const TriangleTruth& truth, const TriangleFilter& filter);

  /// Judges all values of up to kBatchSize fragments (indices into the framebuffer), whose samples
  /// are required or permitted. The result holds until the next call.
  const JudgedBatch& judge(std::span<const std::size_t> fragments);

 private:
  void gather(std::span<const std::size_t> fragments);
  void judge_column(const PreparedValue& prepared, std::size_t index,
                    std::span<const std::size_t> fragments);
  void find_between(const PreparedValue& prepared, int count);
  void filter_column(const PreparedValue& prepared, int count, const Batch<float>& actual);
  bool is_between(std::size_t lane) const {
    return (is_between_[lane / 64] >> (lane % 64) & 1U) != 0;
  }
  void take_centroids(const PreparedValue& prepared, std::span<const std::size_t> fragments,
                      JudgedBatch::Column& column);
  void filter_stored(const PreparedValue& prepared, int count, const Batch<float>& actual);
  void take_stored(const PreparedValue& prepared, std::span<const std::size_t> fragments,
                   JudgedBatch::Column& column);
  void find_between_roundings(const PreparedValue& prepared, int count, const Batch<float>& actual);
  int forbidden_sign(const PreparedValue& prepared) const;
  bool is_on_side(const PreparedValue& prepared, const records::Enclosure& error) const;
  ErrorLimits limits_of(const PreparedValue& prepared) const;
  bool is_certain(const PreparedValue& prepared, float actual,
                  const records::Enclosure& error) const;
  void count_filtered(const PreparedValue& prepared, int count, JudgedBatch::Column& column);
  bool take(const PreparedValue& prepared, float actual, const records::Enclosure& error,
            std::size_t fragment);
  records::Enclosure by_interval(const PreparedValue& prepared, std::size_t lane,
                                 float actual) const;
  void note(const PreparedValue& prepared, EnclosedErrors& errors, const records::Enclosure& error,
            std::size_t fragment);
  bool take_beyond(const PreparedValue& prepared, JudgedBatch::Column& column, std::size_t lane,
                   std::size_t fragment);
  void judge_exactly(const PreparedValue& prepared, std::size_t column, std::size_t lane,
                     std::size_t fragment);

  // Ordered by alignment, widest first.
  BatchWeights at_sample_{};
  BatchWeights at_center_{};
  BatchShifts sample_shifts_{};
  BatchShifts center_shifts_{};
  mutable std::optional<std::array<IntervalLine, 3>> interval_edges_;

  const SceneTruth* scene_;
  const cases::Fragments* drawn_;
  std::uint64_t case_index_;
  ValueStatistics* statistics_;
  const TriangleTruth* truth_ = nullptr;
  const TriangleFilter* coverage_ = nullptr;
  cases::SamplePlace first_place_;  ///< the first place of a batch
  std::vector<std::size_t> open_;   ///< lanes still undecided after a level
  JudgedBatch judged_;
  PreparedValues prepared_;

  Batch<double> x_{};  ///< pixels from the corner of the filter's box
  Batch<double> y_{};
  Batch<double> center_x_{};
  Batch<double> center_y_{};
  Batch<double> computed_{};
  Batch<double> lo_{};  ///< ends of the enclosures of a column's errors
  Batch<double> hi_{};
  CountedErrors counted_{};
  std::array<std::uint64_t, kBatchSize / 64> is_between_{};  ///< one bit for each value of a column
  Level first_level_;
  bool is_prepared_ = false;  ///< prepared_ holds this triangle's values
};

}  // namespace rastercheck::oracle
