#include "oracle/internal/prepared_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "oracle/internal/float_ulp.h"
#include "oracle/internal/stored_depth.h"
#include "oracle/internal/value_bound.h"
#include "oracle/internal/value_judge.h"

namespace rastercheck::oracle {
namespace {

using records::AttributeKind;
using records::Stratum;

/// 1/ulp(magnitude), a power of two.
double units_of(float magnitude) { return std::ldexp(1.0, -ulp_exponent(magnitude)); }

/// The value of the lowest set bit of a normal number.
double last_bit_of(double number) {
  constexpr std::uint64_t kFraction = (std::uint64_t{1} << 52U) - 1;
  const auto bits = std::bit_cast<std::uint64_t>(std::abs(number));
  const auto without_it = std::bit_cast<double>(bits & (bits - 1));
  return (bits & kFraction) == 0 ? std::abs(number) : std::abs(number) - without_it;
}

/// Sets the least and the greatest vertex value, s/p.
void set_ends(const ValueFilter& filter, ShiftedReadings& readings) {
  readings.least_end = {ShiftedReadings::kUnbounded, ShiftedReadings::kUnbounded};
  readings.greatest_end = {-ShiftedReadings::kUnbounded, -ShiftedReadings::kUnbounded};
  for (std::size_t i = 0; i < 3; ++i) {
    const double at_vertex = filter.s[i] / filter.p[i];
    const bool is_exact = std::fma(at_vertex, filter.p[i], -filter.s[i]) == 0;
    const double slack = is_exact ? 0 : std::abs(at_vertex) * 0x1p-50;
    readings.least_end.lo = std::min(readings.least_end.lo, at_vertex - slack);
    readings.least_end.hi = std::min(readings.least_end.hi, at_vertex + slack);
    readings.greatest_end.lo = std::max(readings.greatest_end.lo, at_vertex - slack);
    readings.greatest_end.hi = std::max(readings.greatest_end.hi, at_vertex + slack);
  }
}

}  // namespace

/// Window positions in double are precise enough for this.
Stratum stratum_of(const TriangleSetup& triangle) {
  constexpr double kHorizon = 16;  // greatest w over least
  constexpr double kSliver = 64;   // longest edge over least height
  if (triangle.has_nonpositive_w || triangle.has_clipped_vertex) return Stratum::clipped;
  const auto& [w, u, v] = triangle.near_positions();
  const auto [least_w, greatest_w] = std::minmax({w[0], w[1], w[2]});
  if (greatest_w > kHorizon * least_w) return Stratum::near_horizon;
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double du = u[(i + 1) % 3] - u[i];
    const double dv = v[(i + 1) % 3] - v[i];
    longest = std::max(longest, du * du + dv * dv);
  }
  const double area = std::abs((u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]));
  if (triangle.is_triangle() && area * kSliver < longest)
    return Stratum::sliver;  // height = twice the area / longest edge
  return triangle.scene->source().framebuffer.samples > 1 ? Stratum::multisampled
                                                          : Stratum::ordinary;
}

void PreparedValues::prepare(const TriangleTruth& truth, const TriangleFilter& coverage) {
  truth_ = &truth;
  triangle_ = &truth.setup();
  coverage_ = &coverage;
  stratum_ = stratum_of(*triangle_);
  map_ = triangle_->value_map();
  is_open_ = map_ == nullptr;
  // The ideal error refers to the exact triangle, except that cut triangles with basis snapped have
  // no ideal error.
  const bool has_ideal =
      triangle_->shape == Shape::placed || scene_->contract().basis == cases::Basis::unspecified;
  if (is_open_ && has_ideal) map_ = &triangle_->ideal;
  // The following assumes that w is a float32, which is not so with a camera.
  const bool is_filtered = map_ != nullptr && map_->orientation() != 0 &&
                           !scene_->source().camera && first_level_ != Level::exact &&
                           scene_->scene().is_in_pixels();
  if (!is_filtered) map_ = nullptr;
  if (map_ != nullptr) set_edges();
  exact_bits_ = map_ != nullptr && first_level_ == Level::filter ? exact_bits_of_edges() : 0;
  set_shifts();
  set_centroids();

  const std::size_t attributes = scene_->source().attributes.size();
  values_.resize(1 + attributes);
  values_[0] = make_value(std::nullopt);
  for (std::uint32_t a = 0; a < attributes; ++a) values_[1 + a] = make_value(a);
  has_center_ = std::any_of(values_.begin(), values_.end(),
                            [](const PreparedValue& value) { return value.at_center; });
}

void PreparedValues::set_centroids() {
  centroids_.reset();
  const bool is_asked =
      map_ != nullptr && triangle_->is_triangle() && !scene_->contract().conservative &&
      first_level_ == Level::filter && !scene_->scene().conventions().centroid_is_a_sample &&
      std::any_of(scene_->source().attributes.begin(), scene_->source().attributes.end(),
                  [](const auto& a) { return a.location == cases::Location::centroid; });
  if (is_asked) centroids_ = CentroidFilter::make(*triangle_, *map_, edges_, coverage_->box());
}

void PreparedValues::set_shifts() {
  sample_shifts_.reset();
  center_shifts_.reset();
  if (!is_open_ || map_ == nullptr || first_level_ != Level::filter) return;
  if (!triangle_->is_triangle()) return;
  // Samples of a covered pixel may lie outside every placement, which the filter does not expect.
  if (scene_->contract().conservative) return;
  const PixelBox& box = coverage_->box();
  sample_shifts_ = placement_filter(*triangle_, edges_, box, false);
  const cases::Case& source = scene_->source();
  const bool has_center =
      source.framebuffer.samples > 1 &&
      std::any_of(source.attributes.begin(), source.attributes.end(), [](const auto& attribute) {
        return attribute.location == cases::Location::center;
      });
  if (has_center) center_shifts_ = placement_filter(*triangle_, edges_, box, true);
}

/// Sets the edges of the values' map, or drops the map if doubles cannot hold them.
void PreparedValues::set_edges() {
  if (const FilterLine* edges = coverage_->edges_of(map_)) {
    std::copy_n(edges, 3, edges_.begin());
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<FilterLine> edge = filter_line(map_->edge(i), coverage_->box());
    if (!edge) {
      map_ = nullptr;
      return;
    }
    edges_[i] = *edge;
  }
}

/// The number of bits of the edge functions at samples of the box, if doubles hold the edge
/// functions without error (ValueFilter); else 0.
int PreparedValues::exact_bits_of_edges() const {
  // Every sample's distance from the box's corner is a multiple of this.
  constexpr double kStep = 1.0 / 16;
  const PixelBox& box = coverage_->box();
  double unit = std::numeric_limits<double>::infinity();
  double size = 0;
  for (const FilterLine& edge : edges_) {
    for (const double coefficient : {edge.a * kStep, edge.b * kStep, edge.c}) {
      if (coefficient != 0) unit = std::min(unit, last_bit_of(coefficient));
    }
    size += std::abs(edge.a) * (box.x1 - box.x0) + std::abs(edge.b) * (box.y1 - box.y0) +
            std::abs(edge.c);
  }
  // One bit more than necessary, as `size` is rounded.
  if (!(size < std::ldexp(unit, kMostExactBits - 1))) return 0;
  const int bits = std::ilogb(size / unit) + 2;
  for (std::size_t i = 0; i < 3; ++i) {
    const Line& line = map_->edge(i);
    const bool is_exact = line.a == Ring(edges_[i].a) && line.b == Ring(edges_[i].b) &&
                          line.at(corner_of(box)) == Ring(edges_[i].c);
    if (!is_exact) return 0;
  }
  return bits;
}

PreparedValue PreparedValues::make_value(std::optional<std::uint32_t> attribute) const {
  const cases::Case& source = scene_->source();
  PreparedValue value;
  value.attribute = attribute;
  value.kind = kind_of(source, attribute);
  value.why_free = why_free(*triangle_, attribute);
  if (value.why_free) return value;
  value.bound = least_bound(*triangle_, attribute);

  cases::Attribute declared;  // the depth keeps the default: at the sample
  if (attribute) {
    declared = source.attributes[*attribute];
    declared.location = scene_->scene().location_of(declared);
  }
  const bool is_flat = declared.interpolation == cases::Interpolation::flat;
  const bool is_centroid = declared.location == cases::Location::centroid && !is_flat;
  const bool is_claimed_otherwise =
      value.kind == AttributeKind::smooth && scene_->contract().claims != cases::Claim::perspective;
  value.is_single = !is_centroid && !is_claimed_otherwise && !scene_->contract().is_unspecified();
  value.errors = &statistics_->enclosed(value.kind, stratum_);
  if (!value.is_single) {
    records::ErrorStatistics& of_kind = statistics_->of(value.kind);
    value.ideal_extremes = &of_kind.strata[stratum_].extremes;
    value.excess_extremes = &of_kind.excess.extremes;
  }
  if (is_flat) {
    set_flat_filter(value);
  } else if (!attribute && scene_->scene().stores_depths()) {
    value.method = map_ != nullptr && set_stored(value) ? ValueMethod::stored : ValueMethod::exact;
  } else if (is_centroid) {
    const bool is_known = centroids_ && !is_claimed_otherwise && set_filter(value);
    value.method = is_known ? ValueMethod::centroid : ValueMethod::exact;
  } else if (map_ != nullptr && !is_claimed_otherwise) {
    value.at_center =
        declared.location == cases::Location::center && source.framebuffer.samples > 1;
    value.is_mean = !value.at_center && coverage_->edges_of(map_) != nullptr;
    const bool is_known =
        !may_lie_behind(value) && set_filter(value) && (!is_open_ || set_readings(value));
    value.method = is_known ? ValueMethod::map : ValueMethod::exact;
  }
  return value;
}

/// True if the value is affine and the filter, which tests 1/w only where it divides by it, might
/// see a sample with 1/w <= 0: one of a conservatively covered pixel, outside the triangle.
bool PreparedValues::may_lie_behind(const PreparedValue& value) const {
  if (!scene_->scene().covers_outside() || value.kind == AttributeKind::smooth) return false;
  const auto& positions = scene_->source().positions;
  const float w = positions[triangle_->indices[0]].w;
  const bool is_alike =
      w == positions[triangle_->indices[1]].w && w == positions[triangle_->indices[2]].w;
  return w <= 0 || !is_alike;
}

void PreparedValues::set_flat_filter(PreparedValue& value) const {
  const std::size_t vertex = triangle_->indices[scene_->scene().conventions().provoking_vertex];
  value.method = ValueMethod::copy;
  value.filter.s[0] = scene_->source().attributes_of(vertex)[*value.attribute];
  set_attribute_scale(value);
}

/// Sets everything that depends on the vertices' values alone.
void PreparedValues::set_attribute_scale(PreparedValue& value) const {
  std::array<float, 3> values{};
  float largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    values[i] = scene_->source().attributes_of(triangle_->indices[i])[*value.attribute];
    largest = std::max(largest, std::abs(values[i]));
  }
  value.filter.units = units_of(largest);
  const bool are_one_zero = largest == 0 && std::signbit(values[0]) == std::signbit(values[1]) &&
                            std::signbit(values[0]) == std::signbit(values[2]);
  if (!are_one_zero) return;
  value.only_zero =
      std::signbit(values[0]) ? PreparedValue::Zero::negative : PreparedValue::Zero::positive;
}

bool PreparedValues::set_filter(PreparedValue& value) const {
  const cases::Case& source = scene_->source();
  ValueFilter& filter = value.filter;
  for (std::size_t i = 0; i < 3; ++i) filter.edge_error[i] = edges_[i].band * (1 + 0x1p-40);
  filter.is_perspective = value.kind == AttributeKind::smooth;
  if (!filter.is_perspective) {
    const double determinant = near_double(map_->determinant());
    // Limits as for the edges' coefficients (triangle_filter.cpp), but for degree three instead of
    // two.
    constexpr double kLeast = 0x1p-900;
    constexpr double kMost = 0x1p900;
    if (determinant <= kLeast || determinant >= kMost) return false;
    filter.determinant = determinant;
    filter.determinant_error = kNearDoubleError * determinant;
  }
  const auto& vertices = triangle_->indices;
  const bool is_plain = std::all_of(vertices.begin(), vertices.end(), [&source](auto vertex) {
    return source.positions[vertex].w == 1;
  });
  if (filter.is_perspective || is_plain) filter.exact_bits = exact_bits_;
  if (!value.attribute) {
    value.is_clamped = scene_->scene().clamps_depth() && (source.depth_clamp || !value.is_mean);
    filter.units = units_of(std::max(source.viewport.min_depth, source.viewport.max_depth));
    return set_depth_filter(filter);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t vertex = triangle_->indices[i];
    filter.s[i] = source.attributes_of(vertex)[*value.attribute];
    if (!filter.is_perspective) filter.t[i] = source.positions[vertex].w;
  }
  set_attribute_scale(value);
  return true;
}

/// Returns false if doubles cannot tell where samples may be shifted to.
bool PreparedValues::set_readings(PreparedValue& value) const {
  const std::optional<PlacementFilter>& shifts = value.at_center ? center_shifts_ : sample_shifts_;
  if (!shifts) return false;
  ShiftedReadings& readings = value.readings;
  readings.edges = edges_;
  readings.edge_error = shifts->edge_error;
  readings.has_unshifted = scene_->contract().basis == cases::Basis::unspecified;
  if (triangle_->shape == Shape::placed && !value.at_center) set_ends(value.filter, readings);
  readings.least = readings.least_end.hi;
  readings.greatest = readings.greatest_end.lo;
  if (!value.attribute && scene_->scene().clamps_depth() && !scene_->scene().stores_depths()) {
    const auto& viewport = scene_->source().viewport;
    const auto [near, far] = std::minmax({double{viewport.min_depth}, double{viewport.max_depth}});
    readings.least = std::max(readings.least, near);
    readings.greatest = std::min(readings.greatest, far);
  }
  value.is_open = true;
  value.errors = &statistics_->enclosed(value.kind, stratum_, Meaning::ideal);
  value.excesses = &statistics_->enclosed(value.kind, stratum_, Meaning::excess);
  return true;
}

/// Returns false if a vertex's depth · w is not a double.
bool PreparedValues::set_depth_filter(ValueFilter& filter) const {
  const cases::Case& source = scene_->source();
  const cases::Viewport& viewport = source.viewport;
  const bool is_plain = viewport.min_depth == 0 && viewport.max_depth == 1;
  const bool is_halved = scene_->scene().conventions().depth_is_halved;
  for (std::size_t i = 0; i < 3; ++i) {
    const cases::ClipVertex& p = source.positions[triangle_->indices[i]];
    filter.p[i] = p.w;
    if (is_plain && !is_halved) {
      filter.s[i] = p.z;
      continue;
    }
    const records::Enclosure s = enclose(scene_->scene().depth_numerator(triangle_->indices[i]));
    if (s.lo != s.hi) return false;
    filter.s[i] = s.lo;
  }
  return true;
}

/// Returns false if doubles cannot tell the depths of the map, or what is added to them.
bool PreparedValues::set_stored(PreparedValue& value) const {
  const Scene& scene = scene_->scene();
  if (may_lie_behind(value) || !set_filter(value)) return false;
  StoredFilter& stored = value.stored;
  if (scene.has_depth_bias()) {
    const std::optional<DepthOffset>& offset = triangle_->depth_offset();
    if (!offset || !std::isfinite(offset->near.lo) || !std::isfinite(offset->near.hi)) return false;
    stored.offset = offset->near;
    // More than the enclosure is wider than what it encloses.
    stored.inner = {offset->near.lo + std::abs(offset->near.lo) * 0x1p-49,
                    offset->near.hi - std::abs(offset->near.hi) * 0x1p-49};
  }
  stored.least = near_double(scene.clamp_least());  // a float32, as the other end
  stored.greatest = near_double(scene.clamp_greatest());
  stored.bits = scene.unorm_bits();
  stored.units = stored.bits != 0 ? steps_of(stored.bits) : value.filter.units;
  value.filter.units = 1;
  value.filter.exact_bits = 0;
  value.is_clamped = false;
  value.is_mean = false;
  stored.is_open = has_open_depths(*triangle_);
  if (!stored.is_open) return true;
  if (stored.bits != 0) stored.reach = reach_of(scene_->contract().depth_store) * (1 - 0x1p-52);
  // If several viewports are allowed, the one that was used may show another depth at the sample
  // than the requested one.
  const cases::Contract& contract = scene_->contract();
  stored.permits_exact =
      !is_open_ || (contract.basis == cases::Basis::unspecified && !contract.has_open_viewport());
  stored.has_readings = is_open_ && sample_shifts_ && set_readings(value);
  value.is_open = false;
  value.errors = &statistics_->enclosed(value.kind, stratum_);
  return true;
}

}  // namespace rastercheck::oracle
