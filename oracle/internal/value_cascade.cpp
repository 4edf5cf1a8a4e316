#include "oracle/internal/value_cascade.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/internal/next_double.h"
#include "oracle/internal/stored_depth.h"

namespace rastercheck::oracle {
namespace {

using records::Enclosure;
using records::FragmentClass;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The least magnitude of a number in the enclosure.
double least_magnitude(const Enclosure& e) {
  if (e.lo <= 0 && e.hi >= 0) return 0;
  return std::min(std::abs(e.lo), std::abs(e.hi));
}

ExtremeLimit limit_of(const std::optional<records::WorstError>& extreme) {
  if (!extreme) return {};
  return {std::min(std::abs(extreme->error.lo), std::abs(extreme->error.hi)), extreme->place};
}

bool may_be_extreme(const records::Extremes& seen, const Enclosure& error,
                    const cases::SamplePlace& place) {
  return limit_of(seen.most_positive).lets(error.hi, place) ||
         limit_of(seen.most_negative).lets(-error.lo, place);
}

/// True if all vertices have the same zero and the value is the zero of the other sign.
bool is_wrong_zero(const PreparedValue& prepared, float actual) {
  return prepared.only_zero != PreparedValue::Zero::none && actual == 0 &&
         std::signbit(actual) != (prepared.only_zero == PreparedValue::Zero::negative);
}

}  // namespace

std::vector<JudgedValue> JudgedBatch::values_of(std::size_t lane) const {
  std::vector<JudgedValue> values;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const Column& column = columns_[c];
    if (column.is_by_enclosure[lane]) {
      const Enclosure ideal{column.lo[lane], column.hi[lane]};
      JudgedValue& value = values.emplace_back(
          JudgedValue{column.kind, column.attribute, FragmentClass::correct, column.actual[lane],
                      column.is_open ? column.excess[lane] : ideal, ideal});
      if (!column.has_ideal) value.ideal.reset();
      continue;
    }
    for (const OneValue& one : one_by_one_) {
      if (one.column == c && one.lane == lane) values.push_back(one.value);
    }
  }
  return values;
}

ValueCascade::ValueCascade(const SceneTruth& scene, const cases::Fragments& drawn,
                           const JudgeOptions& options, ValueStatistics& statistics)
    : scene_(&scene),
      drawn_(&drawn),
      case_index_(options.case_index),
      statistics_(&statistics),
      prepared_(scene, options.first_level, statistics),
      first_level_(options.first_level) {}

void ValueCascade::begin(const TriangleTruth& truth, const TriangleFilter& filter) {
  truth_ = &truth;
  coverage_ = &filter;
  is_prepared_ = false;
}

void ValueCascade::gather(std::span<const std::size_t> fragments) {
  const auto pattern = scene_->scene().pattern();
  const PixelBox& box = coverage_->box();
  for (std::size_t k = 0; k < fragments.size(); ++k) {
    const std::size_t fragment = fragments[k];
    const double x = drawn_->x[fragment] - box.x0;
    const double y = drawn_->y[fragment] - box.y0;
    const cases::SamplePosition& sample = pattern[drawn_->sample[fragment]];
    x_[k] = x + sample.x / 16.0;
    y_[k] = y + sample.y / 16.0;
    center_x_[k] = x + 0.5;
    center_y_[k] = y + 0.5;
  }
  first_place_ = drawn_->place_of(fragments.front());
  for (const std::size_t fragment : fragments) {
    first_place_ = std::min(first_place_, drawn_->place_of(fragment));
  }
  if (prepared_.map() == nullptr) return;
  const int count = static_cast<int>(fragments.size());
  weigh_samples(prepared_.edges(), x_, y_, count, at_sample_);
  if (prepared_.has_center()) {
    weigh_samples(prepared_.edges(), center_x_, center_y_, count, at_center_);
  }
  if (const std::optional<PlacementFilter>& shifts = prepared_.sample_shifts()) {
    shift_samples(shifts->shifts, shifts->guards, at_sample_, x_, y_, count, sample_shifts_);
  }
  if (const std::optional<PlacementFilter>& shifts = prepared_.center_shifts()) {
    shift_samples(shifts->shifts, shifts->guards, at_center_, center_x_, center_y_, count,
                  center_shifts_);
  }
}

/// Finds which of a column's first `count` values certainly lie within the range that the contract
/// leaves open.
void ValueCascade::find_between(const PreparedValue& prepared, int count) {
  find_between_readings(
      prepared.filter, prepared.readings, prepared.at_center ? at_center_ : at_sample_,
      prepared.at_center ? center_shifts_ : sample_shifts_, computed_, count, is_between_);
}

/// Computes the first level's enclosures of the errors of a column's first `count` values; NaN if
/// the level has no enclosure.
void ValueCascade::filter_column(const PreparedValue& prepared, int count,
                                 const Batch<float>& actual) {
  const auto lanes = static_cast<std::size_t>(count);
  if (prepared.method == ValueMethod::exact || first_level_ != Level::filter) {
    std::fill_n(lo_.begin(), lanes, kNaN);
    std::fill_n(hi_.begin(), lanes, kNaN);
    return;
  }
  if (prepared.method == ValueMethod::copy) {
    for (std::size_t k = 0; k < lanes; ++k) {
      // One rounding has a relative error of at most 2^-53; an exact copy has none.
      const double difference = double{actual[k]} - prepared.filter.s[0];
      const double slack = std::abs(difference) * 0x1p-50;
      lo_[k] = (difference - slack) * prepared.filter.units;
      hi_[k] = (difference + slack) * prepared.filter.units;
    }
    return;
  }
  std::copy_n(actual.begin(), lanes, computed_.begin());
  value_errors(prepared.filter, prepared.at_center ? at_center_ : at_sample_, computed_, count, lo_,
               hi_);
  if (prepared.is_open) find_between(prepared, count);
}

namespace {

/// A depth as a number of its units that has no error: the depth itself, or its number of steps;
/// NaN if it is none of the format.
double units_of_depth(float depth, const StoredFilter& stored) {
  return stored.bits == 0 ? depth : stored_number(depth, stored.bits).value_or(kNaN);
}

/// Encloses the exact depth at a sample after bias and clamping, in units of depth; `below` and
/// `above` are the least and the greatest offset. `near` − depth lies in `error`.
Enclosure biased(const StoredFilter& stored, double near, const Enclosure& error, double below,
                 double above) {
  const double lo = next_below(next_below(near - error.hi) + below);
  const double hi = next_above(next_above(near - error.lo) + above);
  return {std::clamp(lo, stored.least, stored.greatest),
          std::clamp(hi, stored.least, stored.greatest)};
}

}  // namespace

/// Computes enclosures of the errors of a column's first `count` depths, whose bias and format the
/// contract does not leave open. The kernel expects float32, so it is asked for the error of a
/// float32 near the depth without its bias, and what is exact follows from that.
void ValueCascade::filter_stored(const PreparedValue& prepared, int count,
                                 const Batch<float>& actual) {
  const StoredFilter& stored = prepared.stored;
  const auto lanes = static_cast<std::size_t>(count);
  const double middle = stored.offset.lo + (stored.offset.hi - stored.offset.lo) / 2;
  for (std::size_t k = 0; k < lanes; ++k) {
    computed_[k] = static_cast<float>(double{actual[k]} - middle);
  }
  if (first_level_ != Level::filter) {
    std::fill_n(lo_.begin(), lanes, kNaN);
    std::fill_n(hi_.begin(), lanes, kNaN);
    return;
  }
  value_errors(prepared.filter, at_sample_, computed_, count, lo_, hi_);
  const bool is_unorm = stored.bits != 0;
  for (std::size_t k = 0; k < lanes; ++k) {
    const Enclosure exact =
        biased(stored, computed_[k], {lo_[k], hi_[k]}, stored.offset.lo, stored.offset.hi);
    const double depth = units_of_depth(actual[k], stored);
    // An ulp is a power of two; steps are not, so their product is rounded.
    const double lo = is_unorm ? next_below(exact.lo * stored.units) : exact.lo;
    const double hi = is_unorm ? next_above(exact.hi * stored.units) : exact.hi;
    const double scale = is_unorm ? 1 : stored.units;
    const bool is_known = exact.lo <= exact.hi;  // false for NaN
    lo_[k] = is_known ? next_below(depth - hi) * scale : kNaN;
    hi_[k] = is_known ? next_above(depth - lo) * scale : kNaN;
  }
}

/// Finds which of a column's first `count` depths certainly have, without their bias, a value
/// between two permitted ones. The kernel expects float32, so it is asked for the float32 on both
/// sides.
void ValueCascade::find_between_roundings(const PreparedValue& prepared, int count,
                                          const Batch<float>& actual) {
  const StoredFilter& stored = prepared.stored;
  const double width = stored.offset.hi - stored.offset.lo;
  const double middle = stored.offset.lo + width / 2;
  // The middle of a range that is wider than its roundings is an offset for certain.
  const bool is_wide = width > 0x1p-40 * (std::abs(stored.offset.lo) + std::abs(stored.offset.hi));
  const double least = is_wide ? middle : stored.offset.lo;
  const double greatest = is_wide ? middle : stored.offset.hi;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto lanes = static_cast<std::size_t>(count);
  for (std::size_t k = 0; k < lanes; ++k) {
    const double lo = next_below(double{actual[k]} - greatest);
    const auto rounded = static_cast<float>(lo);
    computed_[k] = rounded > lo ? std::nextafter(rounded, -kInfinity) : rounded;
  }
  find_between_readings(prepared.filter, prepared.readings, at_sample_, sample_shifts_, computed_,
                        count, is_between_);
  const auto from_below = is_between_;
  for (std::size_t k = 0; k < lanes; ++k) {
    const double hi = next_above(double{actual[k]} - least);
    const auto rounded = static_cast<float>(hi);
    computed_[k] = rounded < hi ? std::nextafter(rounded, kInfinity) : rounded;
  }
  find_between_readings(prepared.filter, prepared.readings, at_sample_, sample_shifts_, computed_,
                        count, is_between_);
  for (std::size_t word = 0; word < is_between_.size(); ++word) {
    is_between_[word] &= from_below[word];
  }
}

/// Counts the depths that the first level knows to be among those that the contract leaves open,
/// with an excess of 0.
void ValueCascade::take_stored(const PreparedValue& prepared,
                               std::span<const std::size_t> fragments,
                               JudgedBatch::Column& column) {
  const StoredFilter& stored = prepared.stored;
  const int count = static_cast<int>(fragments.size());
  const bool is_asked = first_level_ == Level::filter;
  is_between_.fill(0);
  if (is_asked && stored.has_readings && stored.bits == 0) {
    find_between_roundings(prepared, count, column.actual);
  }
  for (std::size_t k = 0; k < fragments.size(); ++k) computed_[k] = column.actual[k];
  if (is_asked) value_errors(prepared.filter, at_sample_, computed_, count, lo_, hi_);
  const double units = stored.bits == 0 ? 1 : stored.units;
  for (std::size_t k = 0; k < fragments.size(); ++k) {
    const double depth = units_of_depth(column.actual[k], stored);
    const bool is_inside = depth >= stored.least * units && depth <= stored.greatest * units;
    const Enclosure error{lo_[k], hi_[k]};
    const double least = biased(stored, computed_[k], error, 0, stored.inner.lo).hi;
    const double greatest = biased(stored, computed_[k], error, stored.inner.hi, 0).lo;
    // Written so that NaN fails.
    const bool is_known = is_asked && stored.permits_exact && error.lo <= error.hi &&
                          depth >= next_above(least * units) - stored.reach &&
                          depth <= next_below(greatest * units) + stored.reach;
    column.is_by_enclosure[k] = is_inside && (is_known || is_between(k));
    if (!column.is_by_enclosure[k]) open_.push_back(k);
  }
  const std::uint64_t decided = fragments.size() - open_.size();
  records::ErrorSizes& excess = statistics_->of(prepared.kind).excess;
  excess.histogram.add_to_bucket(0, decided);
  excess.sum.add(0, 0, decided);
  statistics_->levels().values.filter += decided;
}

/// The sign that the contract forbids errors of the column's values to have; 0 if either is
/// permitted.
int ValueCascade::forbidden_sign(const PreparedValue& prepared) const {
  const cases::Contract& contract = scene_->contract();
  if (prepared.attribute || contract.depth_error == cases::DepthError::either_side) return 0;
  const bool is_never_nearer = contract.depth_error == cases::DepthError::never_nearer;
  return is_never_nearer == contract.is_depth_reversed() ? 1 : -1;
}

/// True if an error certainly does not have the sign that the contract forbids.
bool ValueCascade::is_on_side(const PreparedValue& prepared, const Enclosure& error) const {
  const int forbidden = forbidden_sign(prepared);
  return forbidden == 0 || (forbidden < 0 ? error.lo >= 0 : error.hi <= 0);
}

/// Returns the limits within which an error is certainly no extreme. Enclosures of the first level
/// end strictly beyond their errors, unless an error is 0 or the filter knows it exactly. An
/// exactly known error may be just as large as the extreme so far. It is then a new extreme if it
/// comes from an earlier place, so it must lie outside the limits.
ErrorLimits ValueCascade::limits_of(const PreparedValue& prepared) const {
  const auto kept = [&](const ExtremeLimit& limit) {
    const bool may_equal = prepared.filter.exact_bits > 0 && limit.lets(limit.size, first_place_);
    return may_equal ? std::nextafter(limit.size, 0.0) : limit.size;
  };
  // Errors on the side that the contract excludes are left to exact numbers.
  const auto on_one_side = [forbidden = forbidden_sign(prepared)](ErrorLimits limits) {
    if (forbidden < 0) limits.least = std::max(limits.least, 0.0);
    if (forbidden > 0) limits.most = std::min(limits.most, 0.0);
    return limits;
  };
  if (prepared.is_single || prepared.is_open) {
    // If is_open, the counted values lie in the range; their excess is 0 and within every bound.
    return on_one_side({prepared.is_open ? kMostSummed : prepared.bound,
                        -kept(prepared.errors->least_limit()),
                        kept(prepared.errors->most_limit())});
  }
  const records::Extremes& ideal = *prepared.ideal_extremes;
  const records::Extremes& excess = *prepared.excess_extremes;
  return on_one_side(
      {prepared.bound,
       -std::min(kept(limit_of(ideal.most_negative)), kept(limit_of(excess.most_negative))),
       std::min(kept(limit_of(ideal.most_positive)), kept(limit_of(excess.most_positive)))});
}

/// True if the questions besides the error's size have certain answers.
bool ValueCascade::is_certain(const PreparedValue& prepared, float actual,
                              const Enclosure& error) const {
  if (is_wrong_zero(prepared, actual)) return false;
  if (prepared.method == ValueMethod::copy) return true;
  if (prepared.method == ValueMethod::stored) {
    // An exact depth beyond the depth range may have a larger scale ULP.
    const double size = std::max(std::abs(error.lo), std::abs(error.hi));
    return prepared.stored.bits != 0 ||
           std::abs(actual) * prepared.stored.units + size < 0x1.ffffffp23;
  }
  const ValueFilter& filter = prepared.filter;
  const double most = std::max(std::abs(error.lo), std::abs(error.hi));
  if (prepared.is_clamped) {
    // Two roundings, together within 2^-50 relative.
    const double slack = (std::abs(actual) + most / filter.units) * 0x1p-50;
    const cases::Viewport& viewport = scene_->source().viewport;
    const auto [near, far] = std::minmax(viewport.min_depth, viewport.max_depth);
    return actual - error.hi / filter.units - slack >= near &&
           actual - error.lo / filter.units + slack <= far;
  }
  // The scale ULP of a mean of the vertices' values is the ulp of the largest vertex value; any
  // other value may have a larger ulp.
  return prepared.is_mean || std::abs(actual) * filter.units + most < 0x1.ffffffp23;
}

/// Counts the errors that the first level decides.
void ValueCascade::count_filtered(const PreparedValue& prepared, int count,
                                  JudgedBatch::Column& column) {
  const auto lanes = static_cast<std::size_t>(count);
  std::copy_n(lo_.begin(), lanes, column.lo.begin());
  std::copy_n(hi_.begin(), lanes, column.hi.begin());
  const bool is_plain = prepared.only_zero == PreparedValue::Zero::none && !prepared.is_clamped &&
                        (prepared.is_mean || prepared.method == ValueMethod::copy);
  for (std::size_t k = 0; prepared.is_open && k < lanes; ++k) {
    if (!is_between(k)) lo_[k] = kNaN;
  }
  for (std::size_t k = 0; !is_plain && k < lanes; ++k) {
    if (!is_certain(prepared, column.actual[k], {lo_[k], hi_[k]})) lo_[k] = kNaN;
  }
  count_errors(limits_of(prepared), lo_, hi_, count, counted_);
  std::uint64_t decided = 0;
  for (std::size_t k = 0; k < lanes; ++k) {
    const bool is_counted = (counted_.is_counted[k / 64] >> (k % 64) & 1U) != 0;
    column.is_by_enclosure[k] = is_counted;
    if (is_counted) {
      prepared.errors->sizes.histogram.add_to_bucket(static_cast<std::size_t>(counted_.bucket[k]),
                                                     1);
      ++decided;
    } else {
      open_.push_back(k);
    }
  }
  if (decided == 0) return;
  prepared.errors->sizes.sum.add(counted_.sum_lo, counted_.sum_hi, decided);
  statistics_->levels().values.filter += decided;
}

/// Counts a value whose error the second level encloses, if the enclosure decides everything.
bool ValueCascade::take(const PreparedValue& prepared, float actual, const Enclosure& error,
                        std::size_t fragment) {
  const ErrorLimits limits = limits_of(prepared);
  const double most = std::max(std::abs(error.lo), std::abs(error.hi));
  // Written so that NaN fails.
  const bool is_within = most <= limits.bound && is_on_side(prepared, error) &&
                         records::Histogram::share_bucket(least_magnitude(error), most) &&
                         is_certain(prepared, actual, error);
  if (!is_within) return false;
  if (prepared.is_single || prepared.is_open) {
    note(prepared, *prepared.errors, error, fragment);
  } else if (error.hi >= limits.most || error.lo <= limits.least) {
    const cases::SamplePlace place = drawn_->place_of(fragment);
    if (may_be_extreme(*prepared.ideal_extremes, error, place) ||
        may_be_extreme(*prepared.excess_extremes, error, place)) {
      return false;
    }
  }
  prepared.errors->sizes.histogram.add_to_bucket(records::Histogram::bucket_of(most), 1);
  prepared.errors->sizes.sum.add(error);
  ++statistics_->levels().values.interval;
  return true;
}

/// Records an error that may be an extreme.
void ValueCascade::note(const PreparedValue& prepared, EnclosedErrors& errors,
                        const Enclosure& error, std::size_t fragment) {
  if (error.hi < errors.most() && error.lo > errors.least()) return;
  const cases::SamplePlace place = drawn_->place_of(fragment);
  if (!errors.may_be_extreme(error, place)) return;
  errors.note({error, place, fragment, prepared.attribute});
  if (errors.has_many_candidates()) settle_extremes(*scene_, *drawn_, case_index_, errors);
}

/// Counts the values that the first level knows to be permitted in their pixel, with an excess of
/// 0.
void ValueCascade::take_centroids(const PreparedValue& prepared,
                                  std::span<const std::size_t> fragments,
                                  JudgedBatch::Column& column) {
  CentroidFilter& pixels = *prepared_.centroids();
  for (std::size_t k = 0; k < fragments.size(); ++k) {
    const cases::SamplePlace place = drawn_->place_of(fragments[k]);
    column.is_by_enclosure[k] = !is_wrong_zero(prepared, column.actual[k]) &&
                                pixels.holds(static_cast<int>(place.x), static_cast<int>(place.y),
                                             prepared.filter, column.actual[k]);
    if (!column.is_by_enclosure[k]) open_.push_back(k);
  }
  const std::uint64_t decided = fragments.size() - open_.size();
  records::ErrorSizes& excess = statistics_->of(prepared.kind).excess;
  excess.histogram.add_to_bucket(0, decided);
  excess.sum.add(0, 0, decided);
  statistics_->levels().values.filter += decided;
}

/// Counts a value that the first level knows to lie beyond the range that the contract leaves open,
/// if the enclosure of its excess decides everything. The column must hold its ideal error.
bool ValueCascade::take_beyond(const PreparedValue& prepared, JudgedBatch::Column& column,
                               std::size_t lane, std::size_t fragment) {
  const float actual = column.actual[lane];
  const Enclosure ideal{column.lo[lane], column.hi[lane]};
  const std::optional<PlacementFilter>& placements =
      prepared.at_center ? prepared_.center_shifts() : prepared_.sample_shifts();
  const std::optional<Enclosure> excess = excess_of(
      *placements, prepared.filter, prepared.readings, prepared.at_center ? at_center_ : at_sample_,
      prepared.at_center ? center_shifts_ : sample_shifts_, lane, actual, ideal);
  if (!excess) return false;
  // Written so that NaN fails.
  const auto is_known = [&](const Enclosure& error, double most_allowed) {
    const double most = std::max(std::abs(error.lo), std::abs(error.hi));
    return most <= most_allowed && records::Histogram::share_bucket(least_magnitude(error), most) &&
           is_certain(prepared, actual, error);
  };
  if (!is_known(*excess, std::min(prepared.bound, kMostSummed)) || !is_known(ideal, kMostSummed) ||
      !is_on_side(prepared, *excess)) {
    return false;
  }
  const auto count = [&](EnclosedErrors& errors, const Enclosure& error) {
    note(prepared, errors, error, fragment);
    errors.sizes.histogram.add(std::max(std::abs(error.lo), std::abs(error.hi)));
    errors.sizes.sum.add(error);
  };
  count(*prepared.excesses, *excess);
  count(*prepared.errors, ideal);
  ++statistics_->levels().values.filter;
  column.excess[lane] = *excess;
  return true;
}

/// Computes the second level's enclosure of an error; requires UpwardRounding.
Enclosure ValueCascade::by_interval(const PreparedValue& prepared, std::size_t lane,
                                    float actual) const {
  if (prepared.method != ValueMethod::map || !std::isfinite(actual)) return {kNaN, kNaN};
  const ValueFilter& filter = prepared.filter;
  if (!interval_edges_) {
    const auto line = [this](std::size_t i) {
      return interval_line(prepared_.map()->edge(i), coverage_->box());
    };
    interval_edges_ = std::array{line(0), line(1), line(2)};
  }
  const double x = prepared.at_center ? center_x_[lane] : x_[lane];
  const double y = prepared.at_center ? center_y_[lane] : y_[lane];
  Interval sum(0);
  Interval weights(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval e = (*interval_edges_)[i].at(x, y);
    const Interval g =
        (Interval(actual) * Interval(filter.p[i]) - Interval(filter.s[i])) * Interval(filter.t[i]);
    sum += g * e;
    weights += e;
  }
  if (!(weights.inf() > 0)) return {kNaN, kNaN};
  const Interval divisor =
      filter.is_perspective ? weights : interval_of(prepared_.map()->determinant());
  const Interval error = sum / divisor * Interval(filter.units);
  return {error.inf(), error.sup()};
}

void ValueCascade::judge_exactly(const PreparedValue& prepared, std::size_t column,
                                 std::size_t lane, std::size_t fragment) {
  const auto judged =
      judge_value(*scene_, *truth_, computed_value(*drawn_, fragment, prepared.attribute),
                  case_index_, prepared_.stratum(), prepared.is_single, *statistics_);
  if (!judged) return;
  ++statistics_->levels().values.exact;
  judged_.is_wrong_[lane] =
      judged_.is_wrong_[lane] || judged->fragment_class != FragmentClass::correct;
  judged_.one_by_one_.push_back({column, lane, *judged});
}

void ValueCascade::judge_column(const PreparedValue& prepared, std::size_t index,
                                std::span<const std::size_t> fragments) {
  JudgedBatch::Column& column = judged_.columns_[index];
  column.kind = prepared.kind;
  column.attribute = prepared.attribute;
  const bool is_stored = prepared.method == ValueMethod::stored;
  column.has_ideal = prepared.method != ValueMethod::centroid && !prepared.stored.is_open;
  column.is_open = prepared.is_open || !column.has_ideal;
  if (column.is_open) column.excess.fill({});
  for (std::size_t k = 0; k < fragments.size(); ++k) {
    column.actual[k] = prepared.attribute ? drawn_->attributes_of(fragments[k])[*prepared.attribute]
                                          : drawn_->depth[fragments[k]];
  }
  open_.clear();
  if (prepared.method == ValueMethod::centroid) {
    take_centroids(prepared, fragments, column);
  } else if (is_stored && prepared.stored.is_open) {
    take_stored(prepared, fragments, column);
  } else {
    const int count = static_cast<int>(fragments.size());
    if (is_stored) {
      filter_stored(prepared, count, column.actual);
    } else {
      filter_column(prepared, count, column.actual);
    }
    count_filtered(prepared, count, column);
  }
  std::uint64_t decided = fragments.size() - open_.size();

  if (prepared.is_open) {
    // The second level knows no more about values that do not lie between readings.
    decided += std::erase_if(open_, [&](std::size_t k) {
      column.is_by_enclosure[k] = !is_between(k) && take_beyond(prepared, column, k, fragments[k]);
      return column.is_by_enclosure[k];
    });
    for (const std::size_t k : open_) {
      if (!is_between(k)) column.lo[k] = column.hi[k] = kNaN;
    }
  }
  if (!open_.empty() && prepared.method == ValueMethod::map) {
    const UpwardRounding upward;
    for (const std::size_t k : open_) {
      if (prepared.is_open && !is_between(k)) continue;
      const Enclosure error = by_interval(prepared, k, column.actual[k]);
      column.lo[k] = error.lo;
      column.hi[k] = error.hi;
    }
  }
  for (const std::size_t k : open_) {
    column.is_by_enclosure[k] =
        column.has_ideal &&
        take(prepared, column.actual[k], {column.lo[k], column.hi[k]}, fragments[k]);
    if (column.is_by_enclosure[k]) {
      ++decided;
    } else {
      judge_exactly(prepared, index, k, fragments[k]);
    }
  }
  if (decided > 0) statistics_->of(prepared.kind).classes[FragmentClass::correct] += decided;
}

const JudgedBatch& ValueCascade::judge(std::span<const std::size_t> fragments) {
  if (!is_prepared_) {
    prepared_.prepare(*truth_, *coverage_);
    interval_edges_.reset();
    is_prepared_ = true;
  }
  gather(fragments);
  judged_.columns_.resize(prepared_.values().size());
  judged_.one_by_one_.clear();
  judged_.is_wrong_.fill(false);
  std::size_t column = 0;
  for (const PreparedValue& value : prepared_.values()) {
    if (value.why_free) {
      statistics_->of(value.kind).not_judged[*value.why_free] += fragments.size();
    } else {
      judge_column(value, column++, fragments);
    }
  }
  judged_.columns_.resize(column);
  return judged_;
}

}  // namespace rastercheck::oracle
