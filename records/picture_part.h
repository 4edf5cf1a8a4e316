#pragma once

// Parts of a judged picture in detail (oracle/picture_parts.h), as plain data.

#include <cstdint>
#include <optional>
#include <vector>

#include "records/inspection.h"
#include "records/judged_picture.h"

namespace rastercheck::records {

/// The stored values that a channel may have, both ends inclusive, as in WrongChannel.
struct StoredRange {
  float least = 0;
  float greatest = 0;
  bool is_free = false;  ///< any value is permitted
};

/// One permitted answer for a pixel: a range for each channel, all of which must hold at once.
struct PermittedAnswer {
  /// The triangle that is seen; empty for the background and for means of several samples.
  std::optional<std::uint32_t> triangle;
  std::vector<StoredRange> channels;
  double steps = 0;  ///< how far the stored values are off from this answer, as WrongPixel::steps
};

struct DetailedPixel {
  PixelVerdict verdict = PixelVerdict::right;
  std::vector<float> stored;             ///< [channel]
  std::vector<PermittedAnswer> answers;  ///< the closest first, at most kMostAnswers
  std::uint64_t more_answers = 0;        ///< number of further answers
};
inline constexpr std::size_t kMostAnswers = 6;

/// The outline of a triangle, in pixels of the file: x to the right, y along the rows.
struct TriangleOutline {
  std::uint32_t triangle = 0;
  std::vector<WindowPoint> points;
};

/// A rectangle of a picture, in pixels of the file.
struct PicturePart {
  int left = 0;
  int top = 0;  ///< row of the file
  int width = 0;
  int height = 0;
  int x = 0;                          ///< the pixel that the part was chosen for
  int row = 0;                        ///< row of the file
  std::vector<DetailedPixel> pixels;  ///< [row][x]
  std::vector<TriangleOutline> outlines;

  const DetailedPixel& at(int column, int line) const {
    return pixels[static_cast<std::size_t>(line - top) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column - left)];
  }
};

}  // namespace rastercheck::records
