#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "cases/picture_file.h"
#include "reports/image.h"

namespace rastercheck::reports {

/// How the pixels of a picture file look on a screen: the channels R, G and B, else the first
/// three, else the first as grey. Integers are taken as they are, which is what image viewers do.
/// Floats from 0 to 1 run from black to white; a channel with numbers outside [0, 1] is stretched
/// from its least to its greatest. NaN and infinities are magenta.
class PictureColors {
 public:
  /// The picture must outlive the object.
  explicit PictureColors(const cases::PictureFile& picture);

  /// The colour of a pixel with these stored values: [channel].
  Color of(const float* stored) const;
  /// True if the numbers of a channel were stretched.
  bool is_stretched() const { return is_stretched_; }
  /// The file's channels for red, green and blue.
  const std::array<std::size_t, 3>& channels() const { return channels_; }

 private:
  struct Range {
    float low = 0;
    float high = 1;
  };

  std::array<std::size_t, 3> channels_{};
  std::array<Range, 3> ranges_;
  bool is_stretched_ = false;
};

/// The colours of all pixels, row 0 on top; the file's last row on top if `is_upwards`.
Image image_of(const cases::PictureFile& picture, const PictureColors& colors, bool is_upwards);

}  // namespace rastercheck::reports
