#pragma once

// A triangle's values, prepared for the first two levels of the cascade (docs/oracle.md): the map
// and the numbers that errors are computed with, the further questions to ask, and the counters of
// decided values.

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

/// How the first two levels compute a value: from the triangle's one map, as a copy of a vertex's
/// value, as one of the values in a pixel, as a depth with a bias or in a unorm format, or not at
/// all.
enum class ValueMethod { exact, copy, map, centroid, stored };

/// How a depth of the map becomes one that is stored.
struct StoredFilter {
  records::Enclosure offset{0, 0};  ///< the bias's
  records::Enclosure inner{0, 0};   ///< offsets between these are certainly allowed, if lo <= hi
  double least = 0;                 ///< the ends that the sum is clamped to
  double greatest = 1;
  int bits = 0;      ///< of the unorm format; 0 for float32
  double units = 1;  ///< 1/ulp, or steps
  bool is_open = false;
  double reach = 0;  ///< in steps, if is_open
  /// If is_open: the exact triangle's depth is permitted; PreparedValue::readings are known.
  bool permits_exact = false;
  bool has_readings = false;
};

/// A value of the triangle's fragments.
struct PreparedValue {
  enum class Zero { none, positive, negative };

  std::optional<std::uint32_t> attribute;  ///< empty for the depth
  records::AttributeKind kind = records::AttributeKind::depth;
  ValueMethod method = ValueMethod::exact;
  std::optional<records::NotJudged> why_free;  ///< set if the value is not judged
  /// True if the contract leaves no range open, so that one count serves excess and ideal error. If
  /// false, the two may still be equal.
  bool is_single = false;
  /// True if the contract leaves a range open. The first two levels then know the ideal error, but
  /// about the range only what `readings` imply.
  bool is_open = false;
  bool at_center = false;  ///< evaluated at the pixel's centre, which is not the sample
  /// True if the value certainly lies between the vertices' values. Without depth clamp, a depth
  /// then also lies in the viewport's depth range. If false, each value is tested.
  bool is_mean = false;
  bool is_clamped = false;      ///< each depth is tested to lie within the clamped range
  Zero only_zero = Zero::none;  ///< set if all three vertices have this zero
  double bound = 0;
  ValueFilter filter;  ///< in units of depth if the method is `stored`
  StoredFilter stored;
  ShiftedReadings readings;
  /// Where the excess of values beyond an open range is counted.
  EnclosedErrors* excesses = nullptr;
  EnclosedErrors* errors = nullptr;  ///< where the first two levels count the value, if they do
  // The extremes so far, if excess and ideal error are counted apart. A value that may exceed
  // either of them is left to the exact level.
  const records::Extremes* ideal_extremes = nullptr;
  const records::Extremes* excess_extremes = nullptr;
};

/// The property that makes a triangle's fragments hard.
records::Stratum stratum_of(const TriangleSetup& triangle);

/// Prepares the values of one triangle after another.
class PreparedValues {
 public:
  /// The scene and the statistics must outlive the object.
  PreparedValues(const SceneTruth& scene, Level first, ValueStatistics& statistics)
      : scene_(&scene), first_level_(first), statistics_(&statistics) {}

  /// Prepares a triangle. The triangle and the filter of its coverage must outlive their use here.
  void prepare(const TriangleTruth& truth, const TriangleFilter& coverage);

  records::Stratum stratum() const { return stratum_; }
  /// The map that the first two levels evaluate; nullptr if none.
  const ProjectiveMap* map() const { return map_; }
  /// The map's edges, relative to the corner of the filter's box.
  const std::array<FilterLine, 3>& edges() const { return edges_; }
  /// The depth, then the attributes.
  const std::vector<PreparedValue>& values() const { return values_; }
  /// The filter for the values in a pixel; empty if no value needs it.
  std::optional<CentroidFilter>& centroids() { return centroids_; }
  bool has_center() const { return has_center_; }  ///< some value is `at_center`
  /// The shifts of samples, and of the centres of pixels with several samples, that an open
  /// contract allows; empty if the contract is not open or no value needs them.
  const std::optional<PlacementFilter>& sample_shifts() const { return sample_shifts_; }
  const std::optional<PlacementFilter>& center_shifts() const { return center_shifts_; }

 private:
  void set_edges();
  int exact_bits_of_edges() const;
  void set_shifts();
  void set_centroids();
  bool set_readings(PreparedValue& value) const;
  PreparedValue make_value(std::optional<std::uint32_t> attribute) const;
  bool may_lie_behind(const PreparedValue& value) const;
  void set_flat_filter(PreparedValue& value) const;
  void set_attribute_scale(PreparedValue& value) const;
  bool set_filter(PreparedValue& value) const;
  bool set_depth_filter(ValueFilter& filter) const;
  bool set_stored(PreparedValue& value) const;

  const SceneTruth* scene_;
  Level first_level_;
  ValueStatistics* statistics_;

  const TriangleTruth* truth_ = nullptr;
  const TriangleSetup* triangle_ = nullptr;
  const TriangleFilter* coverage_ = nullptr;
  records::Stratum stratum_ = records::Stratum::ordinary;
  const ProjectiveMap* map_ = nullptr;
  std::array<FilterLine, 3> edges_{};
  int exact_bits_ = 0;  ///< ValueFilter::exact_bits for edges_
  std::vector<PreparedValue> values_;
  bool has_center_ = false;
  bool is_open_ = false;  ///< the map is the exact triangle's, one of several
  std::optional<PlacementFilter> sample_shifts_;
  std::optional<PlacementFilter> center_shifts_;
  std::optional<CentroidFilter> centroids_;
};

}  // namespace rastercheck::oracle
