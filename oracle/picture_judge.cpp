#include "oracle/picture_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/internal/picture_options.h"
#include "oracle/internal/triangle_boxes.h"
#include "oracle/internal/value_ranges.h"
#include "oracle/picture_truth.h"
#include "oracle/stored_values.h"

namespace rastercheck::oracle {
namespace {

using records::JudgedPicture;
using records::PixelVerdict;
using records::WrongPixel;

/// Wrong pixels that are compared with hidden triangles. One comparison sets up every triangle
/// whose box holds the pixel.
constexpr std::uint64_t kMostCompared = 4096;

constexpr records::Enclosure kAnyNumber{-std::numeric_limits<double>::infinity(),
                                        std::numeric_limits<double>::infinity()};

class PictureJudge {
 public:
  PictureJudge(const SceneTruth& scene, const cases::PictureView& view,
               const cases::PictureFile& picture)
      : scene_(&scene),
        view_(&view),
        picture_(&picture),
        options_(scene, view),
        hidden_(scene, options_.wanted_values()) {
    judged_.width = view.size.width;
    judged_.height = view.size.height;
    judged_.channels = picture.channels;
    judged_.pixels.resize(static_cast<std::size_t>(view.size.width) *
                          static_cast<std::size_t>(view.size.height));
    judged_.steps.resize(judged_.pixels.size());
  }

  JudgedPicture run() && {
    const PictureTruth truth(*scene_, options_.wanted_values(), options_.wanted_layers());
    judged_.unpromised_triangles = truth.unpromised();
    truth.for_each_pixel([this](int x, int y, std::span<const SampleAnswer> samples) {
      judge_pixel(x, y, samples);
    });
    judged_.freedom.widened = options_.widened();
    return std::move(judged_);
  }

 private:
  void judge_pixel(int x, int y, std::span<const SampleAnswer> samples) {
    options_.make(samples);
    const int row = view_->flipped(y);
    const std::span<const float> stored(picture_->pixel(x, row), view_->channels.size());
    options_.set_stored(stored);
    count_freedom();
    const std::size_t place =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(judged_.width) +
        static_cast<std::size_t>(x);
    PixelVerdict verdict = PixelVerdict::right;
    if (options_.is_layered()) {
      verdict = PixelVerdict::not_judged;
    } else if (!options_.explain_any()) {
      verdict = kind_of_wrong(x, y);
      if (verdict != PixelVerdict::not_judged) {
        WrongPixel wrong = wrong_pixel(x, row, verdict, stored);
        judged_.steps[place] = static_cast<float>(wrong.steps);
        keep(std::move(wrong));
      }
    }
    ++judged_.counts[static_cast<std::size_t>(verdict)];
    judged_.pixels[place] = verdict;
  }

  void count_freedom() {
    if (options_.is_layered()) {
      ++judged_.freedom.may_differ;
      ++judged_.freedom.layered;
    } else if (options_.must_be_background()) {
      ++judged_.freedom.background;
    } else if (options_.has_one_value()) {
      ++judged_.freedom.one_value;
    } else {
      ++judged_.freedom.may_differ;
    }
  }

  PixelVerdict kind_of_wrong(int x, int y) {
    if (judged_.unpromised_triangles > 0) return PixelVerdict::not_judged;
    if (options_.stores_nan()) return PixelVerdict::not_a_number;
    if (options_.must_be_background()) return PixelVerdict::extra;
    if (options_.is_background_stored()) return PixelVerdict::missing;
    if (view_->size.samples > 1) return PixelVerdict::wrong_value;
    if (compared_ == kMostCompared) {
      ++judged_.not_compared;
      return PixelVerdict::wrong_value;
    }
    ++compared_;
    return is_another_triangle(x, y) ? PixelVerdict::wrong_triangle : PixelVerdict::wrong_value;
  }

  /// True if a triangle that must not be seen at the pixel, but covers it, explains its colour.
  bool is_another_triangle(int x, int y) {
    if (boxes_.empty()) boxes_ = boxes_of_triangles(*scene_);
    for (std::uint32_t t = 0; t < boxes_.size(); ++t) {
      if (!boxes_[t].holds(x, y) || options_.has_triangle(t)) continue;
      const TriangleTruth truth(*scene_, t);
      if (truth.judge(x, y, 0).verdict == records::Verdict::forbidden) continue;
      const TriangleFilter filter(truth.setup(), truth.setup().pixels(), Level::filter);
      hidden_.begin(truth, filter);
      std::vector<ValueSpan> values(options_.wanted_values().size());
      const SampleAt at{x, y, 0};
      hidden_.find({&at, 1}, values);
      if (options_.explains({t, values})) return true;
    }
    return false;
  }

  WrongPixel wrong_pixel(int x, int row, PixelVerdict verdict, std::span<const float> stored) {
    WrongPixel pixel{x, row, verdict, {}, {}, std::numeric_limits<double>::infinity()};
    for (std::size_t option = 0; option < options_.size(); ++option) {
      std::vector<records::WrongChannel> channels;
      double steps = 0;
      for (std::size_t c = 0; c < stored.size(); ++c) {
        const ChannelRange range = options_.stored_range(option, c);
        channels.push_back({stored[c], range.least, range.greatest, range.is_free});
        steps = std::max(steps, options_.steps_off(c, range));
      }
      if (!pixel.channels.empty() && !(steps < pixel.steps)) continue;
      pixel.steps = steps;
      pixel.channels = std::move(channels);
      pixel.triangle = options_.triangle_of(option);
    }
    return pixel;
  }

  /// Keeps a wrong pixel if it is among the farthest; of equally far ones, the first.
  void keep(WrongPixel pixel) {
    std::vector<WrongPixel>& worst = judged_.worst;
    const auto at = std::upper_bound(
        worst.begin(), worst.end(), pixel,
        [](const WrongPixel& a, const WrongPixel& b) { return a.steps > b.steps; });
    worst.insert(at, std::move(pixel));
    if (worst.size() > records::kMostWrongPixels) worst.pop_back();
  }

  const SceneTruth* scene_;
  const cases::PictureView* view_;
  const cases::PictureFile* picture_;
  PictureOptions options_;
  ValueRanges hidden_;
  JudgedPicture judged_;
  std::vector<PixelBox> boxes_;  ///< made for the first wrong pixel
  std::uint64_t compared_ = 0;
};

}  // namespace

records::PictureMask mask_of(const SceneTruth& scene, const cases::PictureView& view) {
  using records::PixelFreedom;
  PictureOptions options(scene, view);
  const PictureTruth truth(scene, options.wanted_values(), options.wanted_layers());
  const bool is_unpromised = truth.unpromised() > 0;
  records::PictureMask mask;
  mask.width = view.size.width;
  mask.height = view.size.height;
  for (const cases::ShownChannel& channel : view.channels) mask.channels.push_back(channel.name);
  const auto width = static_cast<std::size_t>(view.size.width);
  const std::size_t channels = view.channels.size();
  mask.pixels.resize(width * static_cast<std::size_t>(view.size.height));
  mask.least.resize(mask.pixels.size() * channels);
  mask.greatest.resize(mask.least.size());
  truth.for_each_pixel([&](int x, int y, std::span<const SampleAnswer> samples) {
    options.make(samples);
    const bool is_free = is_unpromised || options.is_layered();
    mask.freedom.layered += options.is_layered() ? 1U : 0U;
    const std::size_t pixel =
        static_cast<std::size_t>(view.flipped(y)) * width + static_cast<std::size_t>(x);
    for (std::size_t c = 0; c < channels; ++c) {
      const records::Enclosure range = is_free ? kAnyNumber : options.stored_numbers(c);
      mask.least[pixel * channels + c] = static_cast<float>(range.lo);
      mask.greatest[pixel * channels + c] = static_cast<float>(range.hi);
    }
    const PixelFreedom freedom = is_free                        ? PixelFreedom::may_differ
                                 : options.must_be_background() ? PixelFreedom::background
                                 : options.has_one_value()      ? PixelFreedom::one_value
                                                                : PixelFreedom::may_differ;
    mask.pixels[pixel] = freedom;
    ++(freedom == PixelFreedom::background  ? mask.freedom.background
       : freedom == PixelFreedom::one_value ? mask.freedom.one_value
                                            : mask.freedom.may_differ);
  });
  mask.freedom.widened = options.widened();
  return mask;
}

records::JudgedPicture judge_picture(const SceneTruth& scene, const cases::PictureView& view,
                                     const cases::PictureFile& picture) {
  return PictureJudge(scene, view, picture).run();
}

}  // namespace rastercheck::oracle
