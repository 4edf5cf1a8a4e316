#pragma once

// Looks closer at parts of a judged picture: what each of their pixels stores, and what it may
// show. A picture of at most kWholeSide pixels a side is one part. In a larger picture, parts are
// chosen around single pixels: for each kind of wrong pixel in turn, the one that is farthest off
// and in no part yet. The last parts are a sample of the wrong pixels that remain.

#include <vector>

#include "cases/picture_file.h"
#include "cases/picture_view.h"
#include "oracle/triangle_truth.h"
#include "records/judged_picture.h"
#include "records/picture_part.h"

namespace rastercheck::oracle {

/// The largest picture, in pixels a side, that is shown as a whole.
inline constexpr int kWholeSide = 64;
/// The size of other parts, in pixels a side; odd, so that the chosen pixel is in the middle.
inline constexpr int kPartSide = 17;
/// The largest number of parts.
inline constexpr std::size_t kMostParts = 16;
/// The largest number of parts that are chosen because their pixel is farthest off.
inline constexpr std::size_t kFarthestParts = 10;

/// Chooses the parts of a picture that are worth a look; their pixels are still empty. If no pixel
/// of a large picture is wrong, the parts show pixels that were not judged, if any.
std::vector<records::PicturePart> choose_parts(const records::JudgedPicture& judged);

/// Fills in the pixels of parts, but no outlines. The picture must be the one that was judged.
void detail_parts(const SceneTruth& scene, const cases::PictureView& view,
                  const cases::PictureFile& picture, const records::JudgedPicture& judged,
                  std::vector<records::PicturePart>& parts);

}  // namespace rastercheck::oracle
