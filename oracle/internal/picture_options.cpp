#include "oracle/internal/picture_options.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rastercheck::oracle {
namespace {

using cases::ResolveOf;
using cases::Shown;
using cases::ShownChannel;
using cases::Storage;

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// The index of a triangle plus 1, as a channel stores it. Integers keep only its lowest bits.
double shown_index(Storage storage, std::uint32_t triangle) {
  const std::uint32_t number = triangle + 1;
  switch (storage) {
    case Storage::unorm8:
    case Storage::srgb8:
      return number_of_stored(storage, static_cast<float>(number & 0xffU));
    case Storage::unorm16:
      return number_of_stored(storage, static_cast<float>(number & 0xffffU));
    case Storage::float32:
    case Storage::float16:
      break;
  }
  return number;
}

using Box = std::vector<ValueSpan>;  ///< [channel]

Box sum_of(const Box& a, const Box& b) {
  Box sum(a.size());
  for (std::size_t c = 0; c < a.size(); ++c) {
    sum[c] = {a[c].lo + b[c].lo, a[c].hi + b[c].hi, a[c].is_free || b[c].is_free};
    // Infinities of both signs make NaN.
    const bool is_nan = std::isnan(sum[c].lo) || std::isnan(sum[c].hi);
    if (sum[c].is_free || is_nan) sum[c] = {};
  }
  return sum;
}

Box hull_of(const std::vector<Box>& boxes) {
  Box hull = boxes.front();
  for (const Box& box : boxes) {
    for (std::size_t c = 0; c < hull.size(); ++c) {
      hull[c].lo = std::min(hull[c].lo, box[c].lo);
      hull[c].hi = std::max(hull[c].hi, box[c].hi);
      hull[c].is_free = hull[c].is_free || box[c].is_free;
    }
  }
  return hull;
}

/// The mean that a program may compute of `count` numbers with this sum. `magnitude`: the greatest
/// sum of their magnitudes.
ValueSpan mean_of(const ValueSpan& sum, double count, double magnitude) {
  if (sum.is_free) return {};
  if (std::isinf(magnitude)) {
    return {sum.lo == kUnlimited ? kUnlimited : -kUnlimited,
            sum.hi == -kUnlimited ? -kUnlimited : kUnlimited, false};
  }
  // The n − 1 roundings of the sums are divided by n, and the mean is rounded once. Each of these
  // adds at most 2^-24 magnitude/n. If the mean is subnormal, its rounding adds at most 2^-150
  // instead.
  const double slack = magnitude * 0x1p-24 + 0x1p-149;
  return {sum.lo / count - slack, sum.hi / count + slack, false};
}

void add_once(std::vector<Box>& boxes, Box box) {
  if (std::find(boxes.begin(), boxes.end(), box) == boxes.end()) boxes.push_back(std::move(box));
}

}  // namespace

PictureOptions::PictureOptions(const SceneTruth& scene, const cases::PictureView& view)
    : view_(&view),
      painting_(view),
      is_wanted_(1 + scene.source().attributes.size(), false),
      numbers_(view.channels.size()) {
  for (const ShownChannel& channel : view.channels) {
    if (channel.shows == Shown::depth) is_wanted_[0] = true;
    if (channel.shows == Shown::attribute) is_wanted_[1 + channel.attribute] = true;
  }
  codes_.resize(view.channels.size());
  for (std::size_t c = 0; c < codes_.size(); ++c) {
    const Storage storage = final_storage(c);
    if (storage == Storage::unorm8 || storage == Storage::srgb8) codes_[c] = make_codes(c);
  }
}

ValueSpan PictureOptions::shown_of(std::size_t channel,
                                   const SampleAnswer::Candidate& candidate) const {
  const ShownChannel& shown = view_->channels[channel];
  switch (shown.shows) {
    case Shown::attribute:
      return candidate.values[1 + shown.attribute];
    case Shown::depth:
      return candidate.values[0];
    case Shown::triangle:
      return exactly(shown_index(shown.storage, candidate.triangle));
    case Shown::coverage:
    case Shown::constant:
      return exactly(double{shown.constant});
    case Shown::nothing:
      break;
  }
  return {};
}

ValueSpan PictureOptions::span_of(std::size_t channel,
                                  const SampleAnswer::Candidate& candidate) const {
  const ValueSpan shown = shown_of(channel, candidate);
  const ValueSpan alpha =
      painting_.needs_alpha(channel) ? shown_of(*view_->alpha_channel, candidate) : exactly(1);
  return painting_.painted(channel, shown, alpha);
}

Storage PictureOptions::final_storage(std::size_t channel) const {
  const Storage storage = view_->channels[channel].storage;
  const bool is_mean_of_codes = view_->size.samples > 1 && view_->resolve == ResolveOf::stored;
  return is_mean_of_codes && storage == Storage::srgb8 ? Storage::unorm8 : storage;
}

void PictureOptions::make(std::span<const SampleAnswer> samples) {
  triangles_.clear();
  spans_.clear();
  may_be_background_ = std::all_of(samples.begin(), samples.end(),
                                   [](const SampleAnswer& one) { return one.may_be_empty; });
  is_empty_ = std::all_of(samples.begin(), samples.end(),
                          [](const SampleAnswer& one) { return one.candidates.empty(); });
  is_layered_ = std::any_of(samples.begin(), samples.end(),
                            [](const SampleAnswer& one) { return one.may_overlap; });
  const std::size_t channels = view_->channels.size();
  if (samples.size() > 1) {
    mix(samples);
    return;
  }
  for (const SampleAnswer::Candidate& candidate : samples.front().candidates) {
    triangles_.emplace_back(candidate.triangle);
    for (std::size_t c = 0; c < channels; ++c) spans_.push_back(span_of(c, candidate));
  }
  if (!may_be_background_) return;
  triangles_.emplace_back(std::nullopt);
  for (std::size_t c = 0; c < channels; ++c) spans_.push_back(painting_.background(c));
}

// --- Several samples -----------------------------------------------------------------------------

/// Maps a sample's numbers to those that enter the mean: the numbers after they have been stored.
ValueSpan PictureOptions::averaged(std::size_t channel, const ValueSpan& span) const {
  const Storage storage = view_->channels[channel].storage;
  if (span.is_free || storage == Storage::float32) return span;
  const StoredNumbers stored = values_stored_of(storage, view_->rounding, {span.lo, span.hi});
  const Storage as = final_storage(channel);
  return {number_of_stored(as, stored.least), number_of_stored(as, stored.greatest), false};
}

void PictureOptions::add_sample_boxes(const SampleAnswer& sample, std::vector<Box>& boxes) {
  const std::size_t channels = view_->channels.size();
  for (const SampleAnswer::Candidate& candidate : sample.candidates) {
    Box box;
    for (std::size_t c = 0; c < channels; ++c) box.push_back(averaged(c, span_of(c, candidate)));
    add_once(boxes, std::move(box));
  }
  if (!sample.may_be_empty) return;
  Box box;
  for (std::size_t c = 0; c < channels; ++c) box.push_back(averaged(c, painting_.background(c)));
  add_once(boxes, std::move(box));
}

void PictureOptions::mix(std::span<const SampleAnswer> samples) {
  const std::size_t channels = view_->channels.size();
  std::vector<Box> sums{Box(channels, exactly(0))};
  std::vector<double> magnitudes(channels, 0);  // the greatest sum of magnitudes
  bool is_widened = false;
  for (const SampleAnswer& sample : samples) {
    std::vector<Box> boxes;
    add_sample_boxes(sample, boxes);
    std::vector<Box> next;
    for (const Box& sum : sums) {
      for (const Box& box : boxes) add_once(next, sum_of(sum, box));
    }
    const Box around = hull_of(boxes);
    for (std::size_t c = 0; c < channels; ++c) {
      magnitudes[c] += std::max(std::abs(around[c].lo), std::abs(around[c].hi));
    }
    if (next.size() > kMostMixtures) {
      next = {hull_of(next)};
      is_widened = true;
    }
    sums = std::move(next);
  }
  widened_ += is_widened ? 1 : 0;
  const auto count = static_cast<double>(samples.size());
  for (const Box& sum : sums) {
    triangles_.emplace_back(std::nullopt);
    for (std::size_t c = 0; c < channels; ++c) {
      spans_.push_back(mean_of(sum[c], count, magnitudes[c]));
    }
  }
}

// --- Stored values -------------------------------------------------------------------------------

bool PictureOptions::has_triangle(std::uint32_t triangle) const {
  return std::find(triangles_.begin(), triangles_.end(), std::optional(triangle)) !=
         triangles_.end();
}

bool PictureOptions::has_one_value() const {
  if (triangles_.size() != 1) return false;
  for (std::size_t c = 0; c < view_->channels.size(); ++c) {
    if (view_->channels[c].shows == Shown::nothing) continue;
    if (const std::optional<bool> is_alone = is_stored_alone(c, spans_[c])) {
      if (!*is_alone) return false;
      continue;
    }
    const ChannelRange range = stored_range(0, c);
    if (range.is_free || range.least != range.greatest) return false;
  }
  return true;
}

ChannelRange PictureOptions::stored_range(std::size_t option, std::size_t channel) const {
  const ValueSpan& span = spans_[option * view_->channels.size() + channel];
  if (span.is_free)
    return {-std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(), true};
  const StoredNumbers stored =
      values_stored_of(final_storage(channel), view_->rounding, {span.lo, span.hi});
  return {stored.least, stored.greatest, false};
}

records::Enclosure PictureOptions::stored_numbers(std::size_t channel) const {
  records::Enclosure numbers{kUnlimited, -kUnlimited};
  const Storage storage = final_storage(channel);
  for (std::size_t option = 0; option < triangles_.size(); ++option) {
    const ChannelRange range = stored_range(option, channel);
    if (range.is_free) return {-kUnlimited, kUnlimited};
    numbers.lo = std::min(numbers.lo, number_of_stored(storage, range.least));
    numbers.hi = std::max(numbers.hi, number_of_stored(storage, range.greatest));
  }
  return numbers;
}

void PictureOptions::set_stored(std::span<const float> stored) {
  stored_ = stored;
  for (std::size_t c = 0; c < stored.size(); ++c) {
    const StoredNumbers* const code = stored_code(c);
    numbers_[c] = code ? std::optional(*code)
                       : numbers_stored_as(final_storage(c), view_->rounding, stored[c]);
  }
}

PictureOptions::Codes PictureOptions::make_codes(std::size_t channel) const {
  const Storage storage = final_storage(channel);
  Codes codes;
  for (std::size_t k = 0; k < codes.size(); ++k) {
    codes[k] = *numbers_stored_as(storage, view_->rounding, static_cast<float>(k));
  }
  return codes;
}

const StoredNumbers* PictureOptions::stored_code(std::size_t channel) const {
  if (!codes_[channel] || stored_.empty()) return nullptr;
  const float value = stored_[channel];
  const Codes& codes = *codes_[channel];
  const bool is_code =
      value >= 0 && value < static_cast<float>(codes.size()) && value == std::floor(value);
  return is_code ? &codes[static_cast<std::size_t>(value)] : nullptr;
}

/// True if the numbers of the span may be stored as the picture's code and as no other. Empty if
/// they may not be stored as this code, or if the storage has no codes.
std::optional<bool> PictureOptions::is_stored_alone(std::size_t channel,
                                                    const ValueSpan& span) const {
  const StoredNumbers* const code = stored_code(channel);
  if (code == nullptr || span.is_free || !is_explained(channel, span)) return std::nullopt;
  // The numbers of codes are ordered as the codes are, so the neighbours decide.
  const Codes& codes = *codes_[channel];
  const bool has_lower = code != &codes.front() && span.lo <= double{(code - 1)->greatest};
  const bool has_higher = code != &codes.back() && span.hi >= double{(code + 1)->least};
  return !has_lower && !has_higher;
}

bool PictureOptions::is_explained(std::size_t channel, const ValueSpan& span) const {
  if (span.is_free) return true;
  const std::optional<StoredNumbers>& numbers = numbers_[channel];
  return numbers && double{numbers->least} <= span.hi && double{numbers->greatest} >= span.lo;
}

bool PictureOptions::explain_any() const {
  const std::size_t channels = view_->channels.size();
  for (std::size_t option = 0; option < triangles_.size(); ++option) {
    bool is_explanation = true;
    for (std::size_t c = 0; c < channels && is_explanation; ++c) {
      is_explanation = is_explained(c, spans_[option * channels + c]);
    }
    if (is_explanation) return true;
  }
  return false;
}

bool PictureOptions::explains(const SampleAnswer::Candidate& candidate) const {
  for (std::size_t c = 0; c < view_->channels.size(); ++c) {
    if (!is_explained(c, span_of(c, candidate))) return false;
  }
  return true;
}

bool PictureOptions::is_background_stored() const {
  for (std::size_t c = 0; c < view_->channels.size(); ++c) {
    const ValueSpan background = painting_.background(c);
    const bool is_mean = view_->size.samples > 1;
    if (!is_explained(c, is_mean ? averaged(c, background) : background)) return false;
  }
  return true;
}

bool PictureOptions::stores_nan() const {
  for (std::size_t c = 0; c < view_->channels.size(); ++c) {
    if (view_->channels[c].shows != Shown::nothing && std::isnan(stored_[c])) return true;
  }
  return false;
}

double PictureOptions::steps_off(std::size_t channel, const ChannelRange& range) const {
  const float value = stored_[channel];
  if (range.is_free) return 0;
  if (std::isnan(value)) return kUnlimited;
  const Storage storage = final_storage(channel);
  if (value < range.least) return steps_between(storage, value, range.least);
  if (value > range.greatest) return steps_between(storage, range.greatest, value);
  return 0;
}

}  // namespace rastercheck::oracle
