#include "oracle/internal/value_cascade.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/internal/float_ulp.h"
#include "oracle/internal/value_bound.h"

namespace rastercheck::oracle {
namespace {

using records::AttributeKind;
using records::Enclosure;
using records::FragmentClass;
using records::Stratum;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// 1/ulp(magnitude), a power of two.
double units_of(float magnitude) { return std::ldexp(1.0, -ulp_exponent(magnitude)); }

/// The least magnitude of an enclosed number.
double least_magnitude(const Enclosure& e) {
  if (e.lo <= 0 && e.hi >= 0) return 0;
  return std::min(std::abs(e.lo), std::abs(e.hi));
}

ExtremeLimit limit_of(const std::optional<records::WorstError>& extreme) {
  if (!extreme) return {};
  return {std::min(std::abs(extreme->error.lo), std::abs(extreme->error.hi)), place_of(*extreme)};
}

bool may_be_extreme(const records::Extremes& seen, const Enclosure& error,
                    const SamplePlace& place) {
  return limit_of(seen.most_positive).lets(error.hi, place) ||
         limit_of(seen.most_negative).lets(-error.lo, place);
}

/// What makes a triangle's fragments hard (records::Stratum); window positions in double are near
/// enough.
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
  if (area * kSliver < longest) return Stratum::sliver;  // height = twice the area / longest edge
  return triangle.scene->source().framebuffer.samples > 1 ? Stratum::multisampled
                                                          : Stratum::ordinary;
}

}  // namespace

std::vector<JudgedValue> JudgedBatch::values_of(std::size_t lane) const {
  std::vector<JudgedValue> values;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const Column& column = columns_[c];
    if (column.is_by_enclosure[lane]) {
      values.push_back({column.kind, column.attribute, FragmentClass::correct, column.actual[lane],
                        Enclosure{column.lo[lane], column.hi[lane]},
                        Enclosure{column.lo[lane], column.hi[lane]}});
      continue;
    }
    for (const Exact& exact : exact_) {
      if (exact.column == c && exact.lane == lane) values.push_back(exact.value);
    }
  }
  return values;
}

ValueCascade::ValueCascade(const SceneTruth& scene, const cases::Framebuffer& drawn,
                           const JudgeOptions& options, ValueStatistics& statistics)
    : scene_(&scene),
      drawn_(&drawn),
      case_index_(options.case_index),
      first_level_(options.first_level),
      statistics_(&statistics) {}

void ValueCascade::begin(const TriangleTruth& truth, const TriangleFilter& filter) {
  truth_ = &truth;
  triangle_ = &truth.setup();
  coverage_ = &filter;
  is_prepared_ = false;
}

void ValueCascade::prepare() {
  is_prepared_ = true;
  stratum_ = stratum_of(*triangle_);
  interval_edges_.reset();
  map_ = triangle_->value_map();
  // With a camera w is no float32, and what follows counts on that.
  const bool is_filtered = map_ != nullptr && map_->orientation() != 0 &&
                           !scene_->source().camera && first_level_ != Level::exact;
  if (!is_filtered) map_ = nullptr;
  if (map_ != nullptr) set_edges();

  const std::size_t attributes = scene_->source().attributes.size();
  subjects_.resize(1 + attributes);
  subjects_[0] = make_subject(std::nullopt);
  for (std::uint32_t a = 0; a < attributes; ++a) subjects_[1 + a] = make_subject(a);
  has_center_ = std::any_of(subjects_.begin(), subjects_.end(),
                            [](const Subject& subject) { return subject.at_center; });
}

/// Sets the edges of the values' map, or gives that map up.
void ValueCascade::set_edges() {
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

ValueCascade::Subject ValueCascade::make_subject(std::optional<std::uint32_t> attribute) const {
  const cases::Case& source = scene_->source();
  Subject subject;
  subject.attribute = attribute;
  subject.kind = kind_of(source, attribute);
  subject.is_free = attribute && truth_->is_value_free(*attribute);
  if (subject.is_free) return subject;
  subject.bound = bound_of(scene_->contract(), source, attribute).constant;

  cases::Attribute declared;  // of the depth: at the sample
  if (attribute) declared = source.attributes[*attribute];
  const bool is_flat = declared.interpolation == cases::Interpolation::flat;
  const bool is_open = declared.location == cases::Location::centroid && !is_flat;
  subject.is_single = !is_open && !scene_->contract().is_unspecified();
  subject.errors = &statistics_->single(subject.kind, stratum_);
  if (!subject.is_single) {
    records::ErrorStatistics& of_kind = statistics_->of(subject.kind);
    subject.ideal_extremes = &of_kind.strata[stratum_].extremes;
    subject.excess_extremes = &of_kind.excess.extremes;
  }
  if (is_flat) {
    set_flat_filter(subject);
  } else if (map_ != nullptr && !is_open) {
    subject.at_center =
        declared.location == cases::Location::center && source.framebuffer.samples > 1;
    subject.is_mean = !subject.at_center && coverage_->edges_of(map_) != nullptr;
    subject.method = set_filter(subject) ? Method::map : Method::exact;
  }
  return subject;
}

void ValueCascade::set_flat_filter(Subject& subject) const {
  const std::size_t vertex = triangle_->indices[scene_->scene().conventions().provoking_vertex];
  const float value = scene_->source().attributes_of(vertex)[*subject.attribute];
  subject.method = Method::copy;
  subject.filter.s[0] = value;
  set_attribute_scale(subject);
}

/// What depends on the vertices' values alone.
void ValueCascade::set_attribute_scale(Subject& subject) const {
  std::array<float, 3> values{};
  float largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    values[i] = scene_->source().attributes_of(triangle_->indices[i])[*subject.attribute];
    largest = std::max(largest, std::abs(values[i]));
  }
  subject.filter.units = units_of(largest);
  const bool are_one_zero = largest == 0 && std::signbit(values[0]) == std::signbit(values[1]) &&
                            std::signbit(values[0]) == std::signbit(values[2]);
  if (are_one_zero) subject.only_zero = std::signbit(values[0]) ? Zero::negative : Zero::positive;
}

bool ValueCascade::set_filter(Subject& subject) const {
  const cases::Case& source = scene_->source();
  ValueFilter& filter = subject.filter;
  for (std::size_t i = 0; i < 3; ++i) filter.edge_error[i] = edges_[i].band * (1 + 0x1p-40);
  filter.is_perspective = subject.kind == AttributeKind::smooth;
  if (!filter.is_perspective) {
    const double determinant = near_double(map_->determinant());
    // As for the edges' coefficients (triangle_filter.cpp), of degree three in place of two.
    constexpr double kLeast = 0x1p-900;
    constexpr double kMost = 0x1p900;
    if (determinant <= kLeast || determinant >= kMost) return false;
    filter.determinant = determinant;
    filter.determinant_error = kNearDoubleError * determinant;
  }
  if (!subject.attribute) {
    subject.is_clamped = scene_->scene().clamps_depth() && (source.depth_clamp || !subject.is_mean);
    filter.units = units_of(std::max(source.viewport.min_depth, source.viewport.max_depth));
    return set_depth_filter(filter);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t vertex = triangle_->indices[i];
    filter.s[i] = source.attributes_of(vertex)[*subject.attribute];
    if (!filter.is_perspective) filter.t[i] = source.positions[vertex].w;
  }
  set_attribute_scale(subject);
  return true;
}

/// False where a vertex's depth · w is no double.
bool ValueCascade::set_depth_filter(ValueFilter& filter) const {
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
    const Enclosure s = enclose(scene_->scene().depth_numerator(triangle_->indices[i]));
    if (s.lo != s.hi) return false;
    filter.s[i] = s.lo;
  }
  return true;
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
  if (map_ == nullptr) return;
  const int count = static_cast<int>(fragments.size());
  weigh_samples(edges_, x_, y_, count, at_sample_);
  if (has_center_) weigh_samples(edges_, center_x_, center_y_, count, at_center_);
}

/// Enclosures of the errors of a column's first `count` values, by the first level; NaN where it
/// has none.
void ValueCascade::filter_column(const Subject& subject, int count, const Batch<float>& actual) {
  const auto lanes = static_cast<std::size_t>(count);
  if (subject.method == Method::exact || first_level_ != Level::filter) {
    std::fill_n(lo_.begin(), lanes, kNaN);
    std::fill_n(hi_.begin(), lanes, kNaN);
    return;
  }
  if (subject.method == Method::copy) {
    for (std::size_t k = 0; k < lanes; ++k) {
      // One rounding, of up to 2^-53 of it; of a right copy none.
      const double difference = double{actual[k]} - subject.filter.s[0];
      const double slack = std::abs(difference) * 0x1p-50;
      lo_[k] = (difference - slack) * subject.filter.units;
      hi_[k] = (difference + slack) * subject.filter.units;
    }
    return;
  }
  std::copy_n(actual.begin(), lanes, computed_.begin());
  value_errors(subject.filter, subject.at_center ? at_center_ : at_sample_, computed_, count, lo_,
               hi_);
}

/// The first level's enclosures end strictly beyond their errors, unless these are 0: an error that
/// keeps the limits is less than an extreme.
ErrorLimits ValueCascade::limits_of(const Subject& subject) {
  if (subject.is_single) {
    return {subject.bound, subject.errors->least(), subject.errors->most()};
  }
  const records::Extremes& ideal = *subject.ideal_extremes;
  const records::Extremes& excess = *subject.excess_extremes;
  return {subject.bound,
          -std::min(limit_of(ideal.most_negative).size, limit_of(excess.most_negative).size),
          std::min(limit_of(ideal.most_positive).size, limit_of(excess.most_positive).size)};
}

/// What is asked besides the error's size.
bool ValueCascade::is_certain(const Subject& subject, float actual, const Enclosure& error) const {
  if (subject.only_zero != Zero::none && actual == 0 &&
      std::signbit(actual) != (subject.only_zero == Zero::negative)) {
    return false;
  }
  if (subject.method == Method::copy) return true;
  const ValueFilter& filter = subject.filter;
  const double most = std::max(std::abs(error.lo), std::abs(error.hi));
  if (subject.is_clamped) {
    // Within 2^-50 of itself: two roundings.
    const double slack = (std::abs(actual) + most / filter.units) * 0x1p-50;
    const cases::Viewport& viewport = scene_->source().viewport;
    const auto [near, far] = std::minmax(viewport.min_depth, viewport.max_depth);
    return actual - error.hi / filter.units - slack >= near &&
           actual - error.lo / filter.units + slack <= far;
  }
  // Of a mean of the vertices' values ulp is that of the largest; any other may be larger still.
  return subject.is_mean || std::abs(actual) * filter.units + most < 0x1.ffffffp23;
}

/// Counts what the first level decides.
void ValueCascade::count_filtered(const Subject& subject, int count, JudgedBatch::Column& column) {
  const auto lanes = static_cast<std::size_t>(count);
  std::copy_n(lo_.begin(), lanes, column.lo.begin());
  std::copy_n(hi_.begin(), lanes, column.hi.begin());
  const bool is_plain = subject.only_zero == Zero::none && !subject.is_clamped &&
                        (subject.is_mean || subject.method == Method::copy);
  for (std::size_t k = 0; !is_plain && k < lanes; ++k) {
    if (!is_certain(subject, column.actual[k], {lo_[k], hi_[k]})) lo_[k] = kNaN;
  }
  count_errors(limits_of(subject), lo_, hi_, count, counted_);
  std::uint64_t decided = 0;
  for (std::size_t k = 0; k < lanes; ++k) {
    const bool is_counted = (counted_.is_counted[k / 64] >> (k % 64) & 1U) != 0;
    column.is_by_enclosure[k] = is_counted;
    if (is_counted) {
      subject.errors->sizes.histogram.add_to_bucket(static_cast<std::size_t>(counted_.bucket[k]),
                                                    1);
      ++decided;
    } else {
      open_.push_back(k);
    }
  }
  if (decided == 0) return;
  subject.errors->sizes.sum.add(counted_.sum_lo, counted_.sum_hi, decided);
  statistics_->levels().values.filter += decided;
}

/// Counts an error of the second level, if it decides all.
bool ValueCascade::take(const Subject& subject, float actual, const Enclosure& error,
                        std::size_t fragment) {
  const ErrorLimits limits = limits_of(subject);
  const double most = std::max(std::abs(error.lo), std::abs(error.hi));
  // Written so that NaN is not.
  const bool is_within = most <= limits.bound &&
                         records::Histogram::share_bucket(least_magnitude(error), most) &&
                         is_certain(subject, actual, error);
  if (!is_within) return false;
  if (error.hi >= limits.most || error.lo <= limits.least) {
    const SamplePlace place = place_of(*drawn_, fragment);
    if (!subject.is_single) {
      if (may_be_extreme(*subject.ideal_extremes, error, place) ||
          may_be_extreme(*subject.excess_extremes, error, place)) {
        return false;
      }
    } else if (subject.errors->may_be_extreme(error, place)) {
      subject.errors->note({error, place, fragment, subject.attribute});
      if (subject.errors->has_many_candidates()) {
        settle_extremes(*scene_, *drawn_, case_index_, *subject.errors);
      }
    }
  }
  subject.errors->sizes.histogram.add_to_bucket(records::Histogram::bucket_of(most), 1);
  subject.errors->sizes.sum.add(error);
  ++statistics_->levels().values.interval;
  return true;
}

/// The second level; under UpwardRounding.
Enclosure ValueCascade::by_interval(const Subject& subject, std::size_t lane, float actual) const {
  if (subject.method != Method::map || !std::isfinite(actual)) return {kNaN, kNaN};
  const ValueFilter& filter = subject.filter;
  if (!interval_edges_) {
    const auto line = [this](std::size_t i) {
      return interval_line(map_->edge(i), coverage_->box());
    };
    interval_edges_ = std::array{line(0), line(1), line(2)};
  }
  const double x = subject.at_center ? center_x_[lane] : x_[lane];
  const double y = subject.at_center ? center_y_[lane] : y_[lane];
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
  const Interval divisor = filter.is_perspective ? weights : interval_of(map_->determinant());
  const Interval error = sum / divisor * Interval(filter.units);
  return {error.inf(), error.sup()};
}

void ValueCascade::judge_exactly(const Subject& subject, std::size_t column, std::size_t lane,
                                 std::size_t fragment) {
  const auto judged =
      judge_value(*scene_, *truth_, computed_value(*drawn_, fragment, subject.attribute),
                  case_index_, stratum_, subject.is_single, *statistics_);
  if (!judged) return;
  ++statistics_->levels().values.exact;
  judged_.is_wrong_[lane] =
      judged_.is_wrong_[lane] || judged->fragment_class != FragmentClass::correct;
  judged_.exact_.push_back({column, lane, *judged});
}

void ValueCascade::judge_column(const Subject& subject, std::size_t index,
                                std::span<const std::size_t> fragments) {
  JudgedBatch::Column& column = judged_.columns_[index];
  column.kind = subject.kind;
  column.attribute = subject.attribute;
  for (std::size_t k = 0; k < fragments.size(); ++k) {
    column.actual[k] = subject.attribute ? drawn_->attributes_of(fragments[k])[*subject.attribute]
                                         : drawn_->depth[fragments[k]];
  }
  const int count = static_cast<int>(fragments.size());
  filter_column(subject, count, column.actual);
  open_.clear();
  count_filtered(subject, count, column);
  std::uint64_t decided = fragments.size() - open_.size();

  if (!open_.empty() && subject.method == Method::map) {
    const UpwardRounding upward;
    for (const std::size_t k : open_) {
      const Enclosure error = by_interval(subject, k, column.actual[k]);
      column.lo[k] = error.lo;
      column.hi[k] = error.hi;
    }
  }
  for (const std::size_t k : open_) {
    column.is_by_enclosure[k] =
        take(subject, column.actual[k], {column.lo[k], column.hi[k]}, fragments[k]);
    if (column.is_by_enclosure[k]) {
      ++decided;
    } else {
      judge_exactly(subject, index, k, fragments[k]);
    }
  }
  if (decided > 0) statistics_->of(subject.kind).classes[FragmentClass::correct] += decided;
}

const JudgedBatch& ValueCascade::judge(std::span<const std::size_t> fragments) {
  if (!is_prepared_) prepare();
  gather(fragments);
  judged_.columns_.resize(subjects_.size());
  judged_.exact_.clear();
  judged_.is_wrong_.fill(false);
  std::size_t column = 0;
  for (const Subject& subject : subjects_) {
    if (!subject.is_free) judge_column(subject, column++, fragments);
  }
  judged_.columns_.resize(column);
  return judged_;
}

}  // namespace rastercheck::oracle
