#include "oracle/internal/value_ranges.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/internal/depth_filter.h"
#include "oracle/internal/float_ulp.h"
#include "oracle/internal/next_double.h"
#include "oracle/internal/scene.h"
#include "oracle/internal/stored_depth.h"
#include "oracle/internal/value_bound.h"

namespace rastercheck::oracle {
namespace {

using records::Enclosure;

constexpr double kEverything = std::numeric_limits<double>::infinity();
constexpr double kRoundedUp = 1 + 0x1p-40;  // more than the few roundings of a bound can take away
/// A bound in ULP that leaves no digit.
constexpr double kNoDigit = 0x1p24;

/// The exponent of the scale ULP of a value of this magnitude.
double scale_ulp_of(double magnitude) {
  if (!(magnitude > 0)) return std::ldexp(1.0, kLeastUlpExponent);
  return std::ldexp(1.0, static_cast<int>(ulp_exponent_at(std::ilogb(magnitude))));
}

}  // namespace

ValueRanges::ValueRanges(const SceneTruth& scene, std::vector<bool> is_wanted)
    : scene_(&scene), is_wanted_(std::move(is_wanted)), prepared_(scene, Level::filter, unused_) {}

void ValueRanges::begin(const TriangleTruth& truth, const TriangleFilter& filter) {
  truth_ = &truth;
  coverage_ = &filter;
  prepared_.prepare(truth, filter);
  const TriangleSetup& setup = truth.setup();
  radius_.reset();
  const bool is_open = setup.shape != Shape::exact && setup.value_map() == nullptr;
  if (is_open && !scene_->contract().has_open_viewport()) radius_ = placement_radius(setup);
  condition_.reset();
  bounds_.clear();
  bounds_.push_back(make_bound(std::nullopt));
  for (std::size_t a = 0; a + 1 < is_wanted_.size(); ++a) bounds_.push_back(make_bound(a));
  const bool varies =
      std::any_of(bounds_.begin(), bounds_.end(), [](const Bound& bound) { return bound.varies; });
  if (varies) set_condition();
}

ValueRanges::Bound ValueRanges::make_bound(std::optional<std::size_t> attribute) const {
  const TriangleSetup& setup = truth_->setup();
  Bound bound;
  bound.terms = bound_of(setup, attribute);
  const cases::Viewport& viewport = scene_->source().viewport;
  double least{std::min(viewport.min_depth, viewport.max_depth)};
  double greatest{std::max(viewport.min_depth, viewport.max_depth)};
  if (attribute) {
    least = kEverything;
    greatest = -kEverything;
    for (const std::uint32_t vertex : setup.indices) {
      const double value{scene_->source().attributes_of(vertex)[*attribute]};
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
  }
  bound.magnitude = std::max(std::abs(least), std::abs(greatest));
  bound.scale_ulp = scale_ulp_of(bound.magnitude);
  if (bound.terms.constant >= kNoDigit) return bound;
  double fixed{bound.terms.constant};
  fixed += bound.terms.absolute / bound.scale_ulp;
  if (const int bits = scene_->scene().unorm_bits(); bits != 0 && !attribute) {
    fixed += reach_of(scene_->contract().depth_store) / steps_of(bits) / bound.scale_ulp;
  }
  if (attribute) fixed += bound.terms.range_share * (greatest - least) / bound.scale_ulp;
  bound.fixed = fixed * kRoundedUp;
  bound.varies = attribute && !bound.terms.is_uniform() && setup.ideal.orientation() != 0;
  return bound;
}

/// Sets the terms of g and K if all w are positive and the map is the exact one of a triangle.
void ValueRanges::set_condition() {
  const TriangleSetup& setup = truth_->setup();
  if (!setup.is_triangle() || setup.has_nonpositive_w || prepared_.map() != &setup.ideal) return;
  if (scene_->contract().has_open_viewport()) return;
  const cases::Viewport& viewport = scene_->source().viewport;
  const std::array<double, 2> half{std::abs(viewport.width / 2.0), std::abs(viewport.height / 2.0)};
  const std::array<double, 2> origin{std::abs(double{viewport.x}), std::abs(double{viewport.y})};
  std::array<std::array<double, 2>, 3> size{};  // [vertex]: |X|, |Y|
  Condition condition;
  condition.least_w = kEverything;
  for (std::size_t i = 0; i < 3; ++i) {
    const cases::ClipVertex& p = scene_->source().positions[setup.indices[i]];
    condition.w[i] = double{p.w};
    condition.least_w = std::min(condition.least_w, condition.w[i]);
    size[i] = {std::abs(double{p.x}) * half[0] + condition.w[i] * (origin[0] + half[0]),
               std::abs(double{p.y}) * half[1] + condition.w[i] * (origin[1] + half[1])};
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    condition.of_u[i] = size[j][1] * condition.w[k] + size[k][1] * condition.w[j];
    condition.of_v[i] = size[j][0] * condition.w[k] + size[k][0] * condition.w[j];
    condition.constant[i] = size[j][0] * size[k][1] + size[k][0] * size[j][1];
  }
  condition.determinant = near_double(setup.ideal.determinant());
  if (condition.determinant > 0) condition_ = condition;
}

void ValueRanges::gather(std::span<const SampleAt> places) {
  const auto pattern = scene_->scene().pattern();
  const PixelBox& box = coverage_->box();
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double x = places[k].x - box.x0;
    const double y = places[k].y - box.y0;
    const cases::SamplePosition& sample = pattern[static_cast<std::size_t>(places[k].sample)];
    x_[k] = x + sample.x / 16.0;
    y_[k] = y + sample.y / 16.0;
    center_x_[k] = x + 0.5;
    center_y_[k] = y + 0.5;
  }
  if (prepared_.map() == nullptr) return;
  const int count = static_cast<int>(places.size());
  weigh_samples(prepared_.edges(), x_, y_, count, at_sample_);
  if (prepared_.has_center()) {
    weigh_samples(prepared_.edges(), center_x_, center_y_, count, at_center_);
  }
}

/// Widens the exact triangle's value at a sample to those that placements may have there.
std::optional<Enclosure> ValueRanges::spread(const PreparedValue& prepared, std::size_t lane,
                                             const Enclosure& exact) const {
  if (prepared.at_center || scene_->contract().has_open_viewport()) return std::nullopt;
  const bool has_ends = std::isfinite(prepared.readings.least_end.lo) &&
                        std::isfinite(prepared.readings.greatest_end.hi);
  const Enclosure ends = has_ends ? Enclosure{std::min(prepared.readings.least_end.lo, exact.lo),
                                              std::max(prepared.readings.greatest_end.hi, exact.hi)}
                                  : Enclosure{-kEverything, kEverything};
  const auto ends_alone = has_ends ? std::optional(ends) : std::nullopt;
  if (!radius_) return ends_alone;

  const ValueFilter& filter = prepared.filter;
  const std::array<FilterLine, 3>& edges = prepared_.edges();
  const double middle = exact.lo + (exact.hi - exact.lo) / 2;
  double slope_x = 0;
  double slope_y = 0;
  double sizes = 0;  // of the terms of both slopes
  double unsure = 0;
  double divisor_x = 0;
  double divisor_y = 0;
  double divisor_sizes = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double g = (middle * filter.p[i] - filter.s[i]) * filter.t[i];
    const double lines = std::abs(edges[i].a) + std::abs(edges[i].b);
    slope_x += g * edges[i].a;
    slope_y += g * edges[i].b;
    sizes +=
        (std::abs(middle * filter.p[i]) + std::abs(filter.s[i])) * std::abs(filter.t[i]) * lines;
    unsure += std::abs(filter.p[i] * filter.t[i]) * lines;
    divisor_x += edges[i].a;
    divisor_y += edges[i].b;
    divisor_sizes += lines;
  }
  const double slope =
      std::abs(slope_x) + std::abs(slope_y) + sizes * 0x1p-45 + unsure * (exact.hi - exact.lo);
  double divisor = filter.determinant - filter.determinant_error;
  if (filter.is_perspective) {
    const double change =
        *radius_ * (std::abs(divisor_x) + std::abs(divisor_y) + divisor_sizes * 0x1p-45);
    // The reciprocal is within 2^-20 of the sum's (BatchWeights).
    divisor = (1 - 0x1p-18) / at_sample_.reciprocal[lane] - change * kRoundedUp;
  }
  // Written so that NaN fails.
  if (!(divisor > 0)) return ends_alone;
  const double move = *radius_ * slope / divisor * kRoundedUp;
  return Enclosure{std::max(ends.lo, exact.lo - move), std::min(ends.hi, exact.hi + move)};
}

/// Encloses the values permitted at the lane's sample, from lo_ and hi_; empty if doubles cannot.
std::optional<Enclosure> ValueRanges::by_doubles(const PreparedValue& prepared,
                                                 std::size_t lane) const {
  const ValueFilter& filter = prepared.filter;
  if (prepared.method == ValueMethod::copy) return Enclosure{filter.s[0], filter.s[0]};
  if (prepared.method != ValueMethod::map) return std::nullopt;
  // The errors of a computed 0, in ULP, are −value.
  Enclosure exact{-hi_[lane] / filter.units, -lo_[lane] / filter.units};
  if (!(exact.lo <= exact.hi)) return std::nullopt;
  std::optional<Enclosure> range = exact;
  if (prepared.is_open) range = spread(prepared, lane, exact);
  const bool is_clamped = !prepared.attribute && scene_->scene().clamps_depth();
  if (range && is_clamped && scene_->scene().has_depth_bias()) {
    const std::optional<DepthOffset>& offset = truth_->setup().depth_offset();
    if (!offset) return std::nullopt;
    *range = {next_below(range->lo + offset->near.lo), next_above(range->hi + offset->near.hi)};
  }
  if (range && is_clamped) {
    const double near = near_double(scene_->scene().clamp_least());
    const double far = near_double(scene_->scene().clamp_greatest());
    *range = {std::clamp(range->lo, near, far), std::clamp(range->hi, near, far)};
  }
  return range;
}

std::optional<Enclosure> ValueRanges::exactly(const PreparedValue& prepared,
                                              const SampleAt& at) const {
  const std::optional<ValueRange> range =
      prepared.attribute ? truth_->attribute(*prepared.attribute, at.x, at.y, at.sample)
                         : truth_->depth(at.x, at.y, at.sample);
  if (!range) return std::nullopt;
  return Enclosure{range->lo.enclosure().lo, range->hi.enclosure().hi};
}

/// A bound with terms that depend on the place; empty if nothing is promised there.
std::optional<double> ValueRanges::varying_bound(const PreparedValue& prepared, const Bound& bound,
                                                 std::size_t lane, const SampleAt& at) const {
  const bool is_at_sample = prepared.method == ValueMethod::map && !prepared.at_center;
  if (!condition_ || !is_at_sample || !(at_sample_.reciprocal[lane] > 0)) {
    const auto exact = truth_->value_bound(prepared.attribute, at.x, at.y, at.sample);
    return exact ? std::optional(exact->enclosure().hi) : std::nullopt;
  }
  constexpr double kRoundings = 1 + 0x1p-16;
  const bool is_affine = !prepared.filter.is_perspective;
  const PixelBox& box = coverage_->box();
  const double u = std::abs(x_[lane] + box.x0);
  const double v = std::abs(y_[lane] + box.y0);
  double sizes = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double e = condition_->of_u[i] * u + condition_->of_v[i] * v + condition_->constant[i];
    sizes += is_affine ? condition_->w[i] * e : e;
  }
  const double reciprocal = is_affine ? 1 / condition_->determinant : at_sample_.reciprocal[lane];
  const double lost = bound.terms.per_condition * sizes * reciprocal * kRoundings;
  const double horizon =
      is_affine ? 1 : condition_->determinant / condition_->least_w * reciprocal * kRoundings;
  if (lost >= kNoDigit) return std::nullopt;
  return (*bound.fixed + lost + bound.terms.per_horizon * horizon) * kRoundedUp;
}

std::optional<double> ValueRanges::bound_at(const PreparedValue& prepared, const Bound& bound,
                                            std::size_t lane, const SampleAt& at) const {
  if (!bound.fixed || !bound.varies) return bound.fixed;
  return varying_bound(prepared, bound, lane, at);
}

/// Widens a range by a bound in scale ULP of the magnitude or of the range's largest magnitude,
/// whichever is greater.
ValueSpan ValueRanges::Bound::widen(const Enclosure& range, double ulps) const {
  if (ulps == 0) return {range.lo, range.hi, false};
  const double greatest = std::max(std::abs(range.lo), std::abs(range.hi));
  const double slack = ulps * (greatest <= magnitude ? scale_ulp : scale_ulp_of(greatest));
  return {next_below(range.lo - slack), next_above(range.hi + slack), false};
}

void ValueRanges::find(std::span<const SampleAt> places, std::span<ValueSpan> spans) {
  gather(places);
  const std::size_t width = is_wanted_.size();
  const int count = static_cast<int>(places.size());
  for (std::size_t v = 0; v < width; ++v) {
    const PreparedValue& prepared = prepared_.values()[v];
    const bool is_free = !is_wanted_[v] || prepared.why_free.has_value();
    if (!is_free && prepared.method == ValueMethod::map) {
      value_errors(prepared.filter, prepared.at_center ? at_center_ : at_sample_, zeros_, count,
                   lo_, hi_);
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
      ValueSpan& span = spans[k * width + v];
      span = {};
      if (is_free) continue;
      std::optional<Enclosure> range = by_doubles(prepared, k);
      if (!range) range = exactly(prepared, places[k]);
      const std::optional<double> ulps = bound_at(prepared, bounds_[v], k, places[k]);
      if (range && ulps) span = bounds_[v].widen(*range, *ulps);
    }
  }
}

}  // namespace rastercheck::oracle
