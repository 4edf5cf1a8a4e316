#pragma once

// Judges finished pictures, and says what a picture may show (RULES §12).
//
// One sample per pixel. A pixel is right if some candidate (oracle/picture_truth.h), or the
// background where it may be seen, explains all channels at once: for each channel, some permitted
// number is stored as the channel's value (oracle/stored_values.h).
//
// Several samples. Each sample has a set of boxes, one per candidate, with a range for each
// channel. The pixel is the mean, over its samples, of one point from one box of each sample. Sums
// of boxes that are equal count once. Where more than kMostMixtures remain, they are replaced by
// the box around them, which is counted (widened). A program that adds n numbers in float32 and
// multiplies by 1/n rounds n times, which adds n 2^-24 of the greatest sum of magnitudes.
//
// Blending (oracle/internal/painting.h) is judged where at most one triangle may be drawn at each
// sample of a pixel. Other pixels are not judged, and counted (layered).

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "cases/picture_file.h"
#include "cases/picture_view.h"
#include "oracle/triangle_truth.h"
#include "records/judged_picture.h"

namespace rastercheck::oracle {

/// The most mixtures of a pixel's samples that are told apart.
inline constexpr std::size_t kMostMixtures = 64;

/// The stored values that a channel may have.
struct ChannelRange {
  float least = 0;
  float greatest = 0;
  bool is_free = false;  ///< any value, even NaN
};

/// Finds what each pixel of the view's pictures may show.
records::PictureMask mask_of(const SceneTruth& scene, const cases::PictureView& view);

/// Judges a picture of the view's size and channels by the scene's contract.
records::JudgedPicture judge_picture(const SceneTruth& scene, const cases::PictureView& view,
                                     const cases::PictureFile& picture);

}  // namespace rastercheck::oracle
