#include "oracle/picture_parts.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "oracle/internal/picture_options.h"
#include "oracle/picture_truth.h"

namespace rastercheck::oracle {
namespace {

using records::DetailedPixel;
using records::JudgedPicture;
using records::PicturePart;
using records::PixelVerdict;

std::size_t index_of(const JudgedPicture& judged, int x, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(judged.width) +
         static_cast<std::size_t>(x);
}

/// A part of kPartSide pixels a side with this pixel as near to its middle as the picture allows.
PicturePart part_around(const JudgedPicture& judged, std::size_t place) {
  PicturePart part;
  part.x = static_cast<int>(place % static_cast<std::size_t>(judged.width));
  part.row = static_cast<int>(place / static_cast<std::size_t>(judged.width));
  part.width = std::min(kPartSide, judged.width);
  part.height = std::min(kPartSide, judged.height);
  part.left = std::clamp(part.x - part.width / 2, 0, judged.width - part.width);
  part.top = std::clamp(part.row - part.height / 2, 0, judged.height - part.height);
  return part;
}

bool is_wrong_pixel(PixelVerdict verdict) {
  return verdict != PixelVerdict::right && verdict != PixelVerdict::not_judged;
}

/// Chooses the parts of a large picture.
class PartChoice {
 public:
  explicit PartChoice(const JudgedPicture& judged)
      : judged_(&judged), is_in_part_(judged.pixels.size(), false) {}

  /// For each kind of wrong pixel in turn, adds a part around the farthest one in no part yet.
  void add_farthest() {
    std::vector<std::vector<std::size_t>> queues = queues_by_kind();
    for (std::size_t turn = 0; !queues.empty() && parts_.size() < kFarthestParts;) {
      const std::size_t kind = turn % queues.size();
      std::vector<std::size_t>& queue = queues[kind];
      while (!queue.empty() && is_in_part_[queue.back()]) queue.pop_back();
      if (queue.empty()) {
        queues.erase(queues.begin() + static_cast<std::ptrdiff_t>(kind));
        continue;
      }
      add(queue.back());
      ++turn;
    }
  }

  /// Adds parts around wrong pixels in no part yet, evenly spread in the file's order.
  void add_sample() {
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < judged_->pixels.size(); ++i) {
      if (is_wrong_pixel(judged_->pixels[i]) && !is_in_part_[i]) left.push_back(i);
    }
    const std::size_t wanted = kMostParts - parts_.size();
    for (std::size_t i = 0; i < wanted && !left.empty(); ++i) {
      const std::size_t place = left[(2 * i + 1) * left.size() / (2 * wanted)];
      if (!is_in_part_[place]) add(place);
    }
  }

  std::vector<PicturePart> parts() && {
    // The report names one pixel as the farthest off, and shows its part first.
    std::stable_sort(
        parts_.begin(), parts_.end(),
        [this](const PicturePart& a, const PicturePart& b) { return steps_of(a) > steps_of(b); });
    return std::move(parts_);
  }

 private:
  /// Groups the wrong pixels by kind, or the pixels not judged if none is wrong. Each group ends
  /// with the pixel that is farthest off; of several equally far ones, the first in the file.
  std::vector<std::vector<std::size_t>> queues_by_kind() const {
    const bool is_any_wrong = judged_->wrong() > 0;
    std::vector<std::vector<std::size_t>> queues(records::kPixelVerdicts);
    for (std::size_t i = judged_->pixels.size(); i-- > 0;) {
      const PixelVerdict verdict = judged_->pixels[i];
      const bool is_wanted =
          is_any_wrong ? is_wrong_pixel(verdict) : verdict == PixelVerdict::not_judged;
      if (is_wanted) queues[static_cast<std::size_t>(verdict)].push_back(i);
    }
    std::erase_if(queues, [](const auto& queue) { return queue.empty(); });
    for (std::vector<std::size_t>& queue : queues) {
      std::stable_sort(queue.begin(), queue.end(), [this](std::size_t a, std::size_t b) {
        return judged_->steps[a] < judged_->steps[b];
      });
    }
    return queues;
  }

  void add(std::size_t place) {
    parts_.push_back(part_around(*judged_, place));
    const PicturePart& part = parts_.back();
    for (int row = part.top; row < part.top + part.height; ++row) {
      for (int x = part.left; x < part.left + part.width; ++x) {
        is_in_part_[index_of(*judged_, x, row)] = true;
      }
    }
  }

  float steps_of(const PicturePart& part) const {
    return judged_->steps[index_of(*judged_, part.x, part.row)];
  }

  const JudgedPicture* judged_;
  std::vector<bool> is_in_part_;
  std::vector<PicturePart> parts_;
};

/// Makes the whole picture one part. Its pixel is the one that is farthest off, else one that was
/// not judged, else the middle.
PicturePart whole(const JudgedPicture& judged) {
  PicturePart part;
  part.width = judged.width;
  part.height = judged.height;
  part.x = judged.width / 2;
  part.row = judged.height / 2;
  const auto open = std::find(judged.pixels.begin(), judged.pixels.end(), PixelVerdict::not_judged);
  if (!judged.worst.empty()) {
    part.x = judged.worst.front().x;
    part.row = judged.worst.front().row;
  } else if (open != judged.pixels.end()) {
    const auto place = static_cast<int>(open - judged.pixels.begin());
    part.x = place % judged.width;
    part.row = place / judged.width;
  }
  return part;
}

DetailedPixel detailed_pixel(const PictureOptions& options, std::span<const float> stored,
                             PixelVerdict verdict) {
  DetailedPixel pixel;
  pixel.verdict = verdict;
  pixel.stored.assign(stored.begin(), stored.end());
  for (std::size_t option = 0; option < options.size(); ++option) {
    records::PermittedAnswer answer;
    answer.triangle = options.triangle_of(option);
    for (std::size_t c = 0; c < stored.size(); ++c) {
      const ChannelRange range = options.stored_range(option, c);
      answer.channels.push_back({range.least, range.greatest, range.is_free});
      answer.steps = std::max(answer.steps, options.steps_off(c, range));
    }
    pixel.answers.push_back(std::move(answer));
  }
  std::stable_sort(pixel.answers.begin(), pixel.answers.end(),
                   [](const auto& a, const auto& b) { return a.steps < b.steps; });
  if (pixel.answers.size() > records::kMostAnswers) {
    pixel.more_answers = pixel.answers.size() - records::kMostAnswers;
    pixel.answers.resize(records::kMostAnswers);
  }
  return pixel;
}

/// Rows of the framebuffer, y0 <= y < y1.
struct Rows {
  int y0 = 0;
  int y1 = 0;
};

/// Returns the rows of all parts in ascending order, without repeats, so that none is drawn twice.
std::vector<Rows> rows_of(const std::vector<PicturePart>& parts, const cases::PictureView& view) {
  std::vector<Rows> all;
  for (const PicturePart& part : parts) {
    const int first = view.flipped(part.top);
    const int last = view.flipped(part.top + part.height - 1);
    all.push_back({std::min(first, last), std::max(first, last) + 1});
  }
  std::sort(all.begin(), all.end(), [](const Rows& a, const Rows& b) { return a.y0 < b.y0; });
  std::vector<Rows> merged;
  for (const Rows& rows : all) {
    if (!merged.empty() && rows.y0 <= merged.back().y1) {
      merged.back().y1 = std::max(merged.back().y1, rows.y1);
    } else {
      merged.push_back(rows);
    }
  }
  return merged;
}

}  // namespace

std::vector<PicturePart> choose_parts(const JudgedPicture& judged) {
  if (judged.width <= kWholeSide && judged.height <= kWholeSide) return {whole(judged)};
  PartChoice choice(judged);
  choice.add_farthest();
  choice.add_sample();
  return std::move(choice).parts();
}

void detail_parts(const SceneTruth& scene, const cases::PictureView& view,
                  const cases::PictureFile& picture, const JudgedPicture& judged,
                  std::vector<PicturePart>& parts) {
  PictureOptions options(scene, view);
  const PictureTruth truth(scene, options.wanted_values());
  for (PicturePart& part : parts) {
    part.pixels.resize(static_cast<std::size_t>(part.width) *
                       static_cast<std::size_t>(part.height));
  }
  const auto take = [&](int x, int y, std::span<const SampleAnswer> samples) {
    const int row = view.flipped(y);
    std::optional<DetailedPixel> pixel;
    for (PicturePart& part : parts) {
      const int column = x - part.left;
      const int line = row - part.top;
      if (column < 0 || column >= part.width || line < 0 || line >= part.height) continue;
      if (!pixel) {
        const std::span<const float> stored(picture.pixel(x, row), view.channels.size());
        options.make(samples);
        options.set_stored(stored);
        pixel = detailed_pixel(options, stored, judged.pixels[index_of(judged, x, row)]);
      }
      part.pixels[static_cast<std::size_t>(line) * static_cast<std::size_t>(part.width) +
                  static_cast<std::size_t>(column)] = *pixel;
    }
  };
  for (const Rows& rows : rows_of(parts, view)) {
    truth.for_each_pixel_of_rows(rows.y0, rows.y1, take);
  }
}

}  // namespace rastercheck::oracle
