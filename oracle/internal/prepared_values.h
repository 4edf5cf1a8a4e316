#pragma once

// What the first two levels of the cascade (docs/oracle.md) know of a triangle's values before any
// is judged: the map and the numbers that errors are computed with, what has to be asked besides,
// and where what they decide is counted.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "oracle/internal/centroid_filter.h"
#include "oracle/internal/filter_kernels.h"
#include "oracle/internal/placement_filter.h"
#include "oracle/internal/triangle_filter.h"
#include "oracle/internal/triangle_setup.h"
#include "oracle/internal/value_statistics.h"
#include "oracle/level.h"
#include "oracle/triangle_truth.h"
#include "records/judgement.h"

namespace rastercheck::oracle {

/// How the first two levels know a value: by the triangle's one map, as a copy of a vertex's, as
/// one of those that a pixel holds, or not at all.
enum class ValueMethod { exact, copy, map, centroid };

/// A value of the triangle's fragments.
struct PreparedValue {
  enum class Zero { none, positive, negative };

  std::optional<std::uint32_t> attribute;  ///< nothing for the depth
  records::AttributeKind kind = records::AttributeKind::depth;
  ValueMethod method = ValueMethod::exact;
  std::optional<records::NotJudged> why_free;  ///< where it is not judged
  /// The contract leaves no range open, so that one count serves excess and ideal error. Where it
  /// is false they may still be equal.
  bool is_single = false;
  /// The contract leaves a range open: the first two levels know the ideal error, and of the range
  /// what `readings` say.
  bool is_open = false;
  bool at_center = false;  ///< evaluated at the pixel's centre, which is not the sample
  /// Surely a mean of the vertices' values, depth within its range; else each value is asked.
  bool is_mean = false;
  bool is_clamped = false;      ///< the same, of a depth that the rules clamp
  Zero only_zero = Zero::none;  ///< what all three vertices have
  double bound = 0;
  ValueFilter filter;
  ShiftedReadings readings;
  /// Where what lies beyond an open range is counted, too.
  EnclosedErrors* excesses = nullptr;
  EnclosedErrors* errors = nullptr;  ///< where it is counted, if by the first two levels
  // The extremes so far, where excess and ideal error are counted apart: what may exceed either is
  // left to the exact level.
  const records::Extremes* ideal_extremes = nullptr;
  const records::Extremes* excess_extremes = nullptr;
};

/// What makes a triangle's fragments hard.
records::Stratum stratum_of(const TriangleSetup& triangle);

/// The values of one triangle after the other.
class PreparedValues {
 public:
  /// All must outlive it.
  PreparedValues(const SceneTruth& scene, Level first, ValueStatistics& statistics)
      : scene_(&scene), first_level_(first), statistics_(&statistics) {}

  /// What follows is of this triangle, which must outlive it, as must the filter of its coverage.
  void prepare(const TriangleTruth& truth, const TriangleFilter& coverage);

  records::Stratum stratum() const { return stratum_; }
  /// What the first two levels evaluate; nullptr: nothing.
  const ProjectiveMap* map() const { return map_; }
  /// That map's, about the corner of the filter's box.
  const std::array<FilterLine, 3>& edges() const { return edges_; }
  /// The depth, then the attributes.
  const std::vector<PreparedValue>& values() const { return values_; }
  /// What asks for the values that pixels hold; nothing where none does.
  std::optional<CentroidFilter>& centroids() { return centroids_; }
  bool has_center() const { return has_center_; }  ///< some value is `at_center`
  /// Where samples, and the centres of pixels with several, are shifted to, as the contract leaves
  /// it open; nothing where it does not, or no value asks.
  const std::optional<PlacementFilter>& sample_shifts() const { return sample_shifts_; }
  const std::optional<PlacementFilter>& center_shifts() const { return center_shifts_; }

 private:
  void set_edges();
  void set_shifts();
  void set_centroids();
  bool set_readings(PreparedValue& value) const;
  PreparedValue make_value(std::optional<std::uint32_t> attribute) const;
  void set_flat_filter(PreparedValue& value) const;
  void set_attribute_scale(PreparedValue& value) const;
  bool set_filter(PreparedValue& value) const;
  bool set_depth_filter(ValueFilter& filter) const;

  const SceneTruth* scene_;
  Level first_level_;
  ValueStatistics* statistics_;

  const TriangleTruth* truth_ = nullptr;
  const TriangleSetup* triangle_ = nullptr;
  const TriangleFilter* coverage_ = nullptr;
  records::Stratum stratum_ = records::Stratum::ordinary;
  const ProjectiveMap* map_ = nullptr;
  std::array<FilterLine, 3> edges_{};
  std::vector<PreparedValue> values_;
  bool has_center_ = false;
  bool is_open_ = false;  ///< the map is the exact triangle's, one of several
  std::optional<PlacementFilter> sample_shifts_;
  std::optional<PlacementFilter> center_shifts_;
  std::optional<CentroidFilter> centroids_;
};

}  // namespace rastercheck::oracle
