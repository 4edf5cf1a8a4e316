#include "oracle/picture_truth.h"

#include <algorithm>
#include <utility>

#include "oracle/internal/floating_point.h"
#include "oracle/internal/latest.h"
#include "oracle/internal/layers.h"
#include "oracle/internal/nearest.h"
#include "oracle/internal/triangle_boxes.h"
#include "oracle/internal/value_ranges.h"

namespace rastercheck::oracle {
namespace {

/// A candidate of a band, before its values are known.
struct Seen {
  std::uint32_t triangle = 0;
  SampleAt at;
};

/// The answers of a band of rows: candidates and values in flat lists, found triangle by triangle.
class BandAnswers {
 public:
  BandAnswers(const SceneTruth& scene, int y0, int y1, PreparedTriangles& triangles)
      : scene_(&scene), y0_(y0), y1_(y1), triangles_(&triangles) {
    const cases::FramebufferSize& size = scene.source().framebuffer;
    samples_ = static_cast<std::size_t>(size.samples);
    row_samples_ = static_cast<std::size_t>(size.width) * samples_;
    first_of_sample_.assign(row_samples_ * static_cast<std::size_t>(y1 - y0) + 1, 0);
    is_required_.assign(first_of_sample_.size(), false);
  }

  /// Finds the candidates by drawing all triangles of these rows.
  void find_candidates(std::span<const PixelBox> boxes) {
    if (scene_->source().depth_test == cases::DepthTest::none) {
      fill(LatestBand(*scene_, y0_, y1_, *triangles_), boxes);
      return;
    }
    // Depths of open placements are slow to compare, and seldom told apart.
    const auto comparison = scene_->contract().is_unspecified() ? NearestBand::Comparison::enclosed
                                                                : NearestBand::Comparison::exact;
    fill(NearestBand(*scene_, y0_, y1_, *triangles_, comparison), boxes);
  }

  /// Finds the samples that several triangles may be drawn at.
  void find_overlaps(std::span<const PixelBox> boxes) {
    LayerBand band(*scene_, y0_, y1_, *triangles_);
    for (std::uint32_t t = 0; t < boxes.size(); ++t) {
      if (boxes[t].y0 < y1_ && boxes[t].y1 > y0_) band.add(t);
    }
    overlaps_ = std::move(band).take_overlaps();
  }

  /// Finds the values of all candidates.
  void find_values(const std::vector<bool>& is_wanted) {
    const std::size_t width = is_wanted.size();
    const std::vector<std::uint32_t> order = order_by_triangle();
    values_.resize(seen_.size() * width);
    ValueRanges ranges(*scene_, is_wanted);
    std::vector<SampleAt> places;
    std::vector<ValueSpan> spans(kBatchSize * width);
    for (std::size_t begin = 0; begin < order.size();) {
      const std::uint32_t triangle = seen_[order[begin]].triangle;
      const PreparedTriangles::Prepared prepared = triangles_->of(triangle);
      ranges.begin(*prepared.truth, *prepared.filter);
      while (begin < order.size() && seen_[order[begin]].triangle == triangle) {
        places.clear();
        std::size_t end = begin;
        while (end < order.size() && places.size() < kBatchSize &&
               seen_[order[end]].triangle == triangle) {
          places.push_back(seen_[order[end++]].at);
        }
        ranges.find(places, spans);
        for (std::size_t i = begin; i < end; ++i) {
          std::copy_n(spans.begin() + static_cast<std::ptrdiff_t>((i - begin) * width), width,
                      values_.begin() + static_cast<std::ptrdiff_t>(order[i] * width));
        }
        begin = end;
      }
    }
    candidates_.reserve(seen_.size());
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      candidates_.push_back({seen_[i].triangle, std::span(values_).subspan(i * width, width)});
    }
  }

  void for_each_pixel(const PictureTruth::TakePixel& take) const {
    std::vector<SampleAnswer> answers(samples_);
    const int width = scene_->source().framebuffer.width;
    std::size_t sample = 0;
    for (int y = y0_; y < y1_; ++y) {
      for (int x = 0; x < width; ++x) {
        for (SampleAnswer& answer : answers) {
          const std::size_t first = first_of_sample_[sample];
          answer.candidates =
              std::span(candidates_).subspan(first, first_of_sample_[sample + 1] - first);
          answer.may_be_empty = !is_required_[sample];
          answer.may_overlap = !overlaps_.empty() && overlaps_[sample];
          ++sample;
        }
        take(x, y, answers);
      }
    }
  }

 private:
  /// The indices of the candidates, in ascending order of triangles.
  std::vector<std::uint32_t> order_by_triangle() const {
    // A triangle and an index in one number are compared without looking up the candidate.
    std::vector<std::uint64_t> keys(seen_.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      keys[i] = std::uint64_t{seen_[i].triangle} << 32U | i;
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order(keys.size());
    std::transform(keys.begin(), keys.end(), order.begin(),
                   [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
    return order;
  }

  template <typename Band>
  void fill(Band band, std::span<const PixelBox> boxes) {
    records::LevelCounts unused;
    for (std::uint32_t t = 0; t < boxes.size(); ++t) {
      if (boxes[t].y0 < y1_ && boxes[t].y1 > y0_) band.add(t, unused);
    }
    std::size_t next = 0;
    band.for_each_answer([&](int y, int x, int s, auto candidates, bool is_required) {
      const std::size_t sample = static_cast<std::size_t>(y - y0_) * row_samples_ +
                                 static_cast<std::size_t>(x) * samples_ +
                                 static_cast<std::size_t>(s);
      while (next <= sample) first_of_sample_[next++] = seen_.size();
      for (const auto& candidate : candidates) {
        seen_.push_back({candidate.triangle, {x, y, s}});
      }
      is_required_[sample] = is_required;
    });
    while (next < first_of_sample_.size()) first_of_sample_[next++] = seen_.size();
  }

  const SceneTruth* scene_;
  int y0_;
  int y1_;
  PreparedTriangles* triangles_;
  std::size_t samples_ = 1;
  std::size_t row_samples_ = 0;
  std::vector<Seen> seen_;
  std::vector<std::size_t> first_of_sample_;  ///< into seen_; one more at the end
  std::vector<bool> is_required_;             ///< [sample]
  std::vector<bool> overlaps_;                ///< [sample]; empty unless found
  std::vector<ValueSpan> values_;             ///< [candidate][value]
  std::vector<SampleAnswer::Candidate> candidates_;
};

}  // namespace

PictureTruth::PictureTruth(const SceneTruth& scene, std::vector<bool> is_wanted, Layers layers)
    : scene_(&scene), is_wanted_(std::move(is_wanted)), layers_(layers) {
  const cases::Case& source = scene.source();
  for (std::size_t t = 0; t < source.triangles.size(); ++t) {
    if (!cases::promise_of(scene.contract(), source, t).is_made) ++unpromised_;
  }
}

void PictureTruth::for_each_pixel(const TakePixel& take) const {
  for_each_pixel_of_rows(0, scene_->source().framebuffer.height, take);
}

void PictureTruth::for_each_pixel_of_rows(int y0, int y1, const TakePixel& take) const {
  const DefaultFloatingPoint floating_point;
  const std::vector<PixelBox> boxes = boxes_of_triangles(*scene_);
  const int height = rows_of_band(scene_->source().framebuffer);
  PreparedTriangles triangles(*scene_, Level::filter);
  for (int y = y0; y < y1; y += height) {
    triangles.forget_rows_before(y);
    BandAnswers band(*scene_, y, std::min(y + height, y1), triangles);
    band.find_candidates(boxes);
    if (layers_ == Layers::all) band.find_overlaps(boxes);
    band.find_values(is_wanted_);
    band.for_each_pixel(take);
  }
}

}  // namespace rastercheck::oracle
