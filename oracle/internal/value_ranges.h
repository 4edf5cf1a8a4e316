#pragma once

// Encloses all values that a backend may compute at a sample: the range that the contract leaves
// open, widened by the contract's bound. Outer ranges: never narrower than the true ones, and at
// most slightly wider, so that pictures (oracle/picture_truth.h) get no false alarms.
//
// Closed contracts. Doubles enclose the value r as the error of a computed 0 (filter_kernels.h).
//
// Open contracts. A placement's value at p is the exact triangle's value at some q with |p − q| <=
// R (depth_filter.h). With G(p) = Σ g_i E_i(p) for f = r(p) (filter_kernels.h), G(p) = 0 and
//
//   |r(q) − r(p)| = |G(q)|/Den(q) <= R (|G_x| + |G_y|)/(Den(p) − R (|Den_x| + |Den_y|)).
//
// For Shape::placed, values at samples also lie between the least and the greatest vertex value,
// except for the exact triangle's own value, which Basis::unspecified permits. If R is not known,
// the range is just these values. Elsewhere (centroids, centres of open triangles, poles, cameras),
// TriangleTruth answers.
//
// The bound. Where the contract's bound depends on the place, g and K (cases::ValueBound) are
// evaluated in doubles and rounded up by 2^-16 of themselves, far more than their roundings.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "oracle/internal/filter_kernels.h"
#include "oracle/internal/prepared_values.h"
#include "oracle/internal/triangle_filter.h"
#include "oracle/internal/value_statistics.h"
#include "oracle/picture_truth.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {

/// A sample of a triangle.
struct SampleAt {
  int x = 0;
  int y = 0;
  int sample = 0;
};

class ValueRanges {
 public:
  /// `is_wanted` has one flag for the depth, then one for each attribute. Values whose flag is
  /// false are not computed.
  ValueRanges(const SceneTruth& scene, std::vector<bool> is_wanted);

  /// Begins a triangle. The triangle and the filter of its coverage must outlive its batches.
  void begin(const TriangleTruth& truth, const TriangleFilter& filter);

  /// Finds the ranges at up to kBatchSize samples, none of them forbidden, into
  /// spans[place][value], with the depth first; values that are not wanted become free.
  void find(std::span<const SampleAt> places, std::span<ValueSpan> spans);

 private:
  /// The contract's bound of a value, in scale ULP.
  struct Bound {
    cases::ValueBound terms;
    /// The part that does not depend on the place; empty if nothing is promised.
    std::optional<double> fixed;
    bool varies = false;  ///< g and K count as well
    double magnitude = 0;
    double scale_ulp = 0;  ///< the ulp of the magnitude

    ValueSpan widen(const records::Enclosure& range, double ulps) const;
  };
  /// The terms of g and K in doubles, about the window's origin.
  struct Condition {
    double determinant = 0;  ///< |det M|
    double least_w = 0;
    std::array<double, 3> w{};
    std::array<double, 3> of_u{};  ///< |E|_i = of_u |u| + of_v |v| + constant
    std::array<double, 3> of_v{};
    std::array<double, 3> constant{};
  };

  Bound make_bound(std::optional<std::size_t> attribute) const;
  void set_condition();
  std::optional<double> varying_bound(const PreparedValue& prepared, const Bound& bound,
                                      std::size_t lane, const SampleAt& at) const;
  void gather(std::span<const SampleAt> places);
  std::optional<records::Enclosure> spread(const PreparedValue& prepared, std::size_t lane,
                                           const records::Enclosure& exact) const;
  std::optional<records::Enclosure> by_doubles(const PreparedValue& prepared,
                                               std::size_t lane) const;
  std::optional<records::Enclosure> exactly(const PreparedValue& prepared,
                                            const SampleAt& at) const;
  std::optional<double> bound_at(const PreparedValue& prepared, const Bound& bound,
                                 std::size_t lane, const SampleAt& at) const;

  const SceneTruth* scene_;
  std::vector<bool> is_wanted_;
  ValueStatistics unused_;  ///< PreparedValues needs counters
  PreparedValues prepared_;
  const TriangleTruth* truth_ = nullptr;
  const TriangleFilter* coverage_ = nullptr;
  std::optional<double> radius_;        ///< R; only for open triangles
  std::vector<Bound> bounds_;           ///< the depth, then the attributes
  std::optional<Condition> condition_;  ///< empty if doubles do not give g and K

  BatchWeights at_sample_{};
  BatchWeights at_center_{};
  Batch<double> x_{};  ///< pixels from the corner of the filter's box
  Batch<double> y_{};
  Batch<double> center_x_{};
  Batch<double> center_y_{};
  Batch<double> zeros_{};
  Batch<double> lo_{};
  Batch<double> hi_{};
};

}  // namespace rastercheck::oracle
