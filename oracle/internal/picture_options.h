#pragma once

// The answers for one pixel of a picture: for each thing that may be seen there, the numbers of all
// channels before they are stored (oracle/picture_judge.h).

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cases/picture_view.h"
#include "oracle/internal/painting.h"
#include "oracle/picture_judge.h"
#include "oracle/picture_truth.h"
#include "oracle/stored_values.h"

namespace rastercheck::oracle {

class PictureOptions {
 public:
  /// The scene and the view must outlive the object.
  PictureOptions(const SceneTruth& scene, const cases::PictureView& view);

  /// The values that the channels show: the depth, then each attribute.
  const std::vector<bool>& wanted_values() const { return is_wanted_; }

  /// The triangles that answers must contain: those seen or, if blending mixes several, all.
  Layers wanted_layers() const {
    return view_->blend == cases::Blend::off ? Layers::seen : Layers::all;
  }

  /// Makes the options of a pixel from what its samples may show.
  void make(std::span<const SampleAnswer> samples);
  std::size_t size() const { return triangles_.size(); }
  /// Empty for the background and for mixtures of several samples.
  std::optional<std::uint32_t> triangle_of(std::size_t option) const { return triangles_[option]; }
  bool has_triangle(std::uint32_t triangle) const;
  bool may_be_background() const { return may_be_background_; }
  bool must_be_background() const { return is_empty_; }
  /// True if several triangles may be blended at a sample: the options then do not hold.
  bool is_layered() const { return is_layered_; }
  /// True if there is one option, and each channel has one stored value in it.
  bool has_one_value() const;
  /// The stored values of a channel in an option.
  ChannelRange stored_range(std::size_t option, std::size_t channel) const;
  /// The numbers that a channel's stored values stand for, over all options.
  records::Enclosure stored_numbers(std::size_t channel) const;
  /// The number of pixels that had more than kMostMixtures mixtures.
  std::uint64_t widened() const { return widened_; }

  // --- Compared with a picture -------------------------------------------------------------------

  /// Sets the pixel's stored values: [channel].
  void set_stored(std::span<const float> stored);
  /// True if some option explains all channels at once.
  bool explain_any() const;
  /// True if a triangle's values explain all channels; for one sample per pixel.
  bool explains(const SampleAnswer::Candidate& candidate) const;
  /// True if all judged channels have their background.
  bool is_background_stored() const;
  /// True if a judged channel holds NaN.
  bool stores_nan() const;
  /// The distance of the stored value from a range, in steps of its storage.
  double steps_off(std::size_t channel, const ChannelRange& range) const;

 private:
  /// [code]: the numbers that an 8-bit storage may store as the code.
  using Codes = std::array<StoredNumbers, 256>;

  /// The number that the triangle shows in a channel, and the number that the target holds after
  /// the triangle has been drawn.
  ValueSpan shown_of(std::size_t channel, const SampleAnswer::Candidate& candidate) const;
  ValueSpan span_of(std::size_t channel, const SampleAnswer::Candidate& candidate) const;
  /// The storage of the resolved pixel. If stored values are averaged, the mean of srgb8 codes is
  /// stored as a unorm8, without encoding it again.
  cases::Storage final_storage(std::size_t channel) const;
  Codes make_codes(std::size_t channel) const;
  /// The numbers of the code that is stored in the channel; nullptr if its storage has no codes.
  const StoredNumbers* stored_code(std::size_t channel) const;
  bool is_explained(std::size_t channel, const ValueSpan& span) const;
  std::optional<bool> is_stored_alone(std::size_t channel, const ValueSpan& span) const;
  void mix(std::span<const SampleAnswer> samples);
  void add_sample_boxes(const SampleAnswer& sample, std::vector<std::vector<ValueSpan>>& boxes);
  ValueSpan averaged(std::size_t channel, const ValueSpan& span) const;

  const cases::PictureView* view_;
  Painting painting_;
  std::vector<bool> is_wanted_;
  std::vector<std::optional<std::uint32_t>> triangles_;  ///< [option]
  std::vector<ValueSpan> spans_;                         ///< [option][channel]
  bool may_be_background_ = true;
  bool is_empty_ = true;  ///< no triangle may be seen
  bool is_layered_ = false;
  std::uint64_t widened_ = 0;

  std::vector<std::optional<Codes>> codes_;  ///< [channel]; only for 8-bit storages
  std::span<const float> stored_;            ///< [channel]
  /// [channel]: the numbers that may be stored as stored_[channel]
  std::vector<std::optional<StoredNumbers>> numbers_;
};

}  // namespace rastercheck::oracle
