#pragma once

// A picture's layout (picture_layout.h) applied to a case: what each channel of a file shows of it.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/picture_file.h"
#include "cases/picture_layout.h"

namespace rastercheck::cases {

/// One channel of a file, and the part of the case that it shows.
struct ShownChannel {
  std::string name;
  Shown shows = Shown::nothing;
  std::uint32_t attribute = 0;  ///< index into the case's attributes
  float constant = 0;           ///< the number of Shown::constant; 1 for coverage
  float background = 0;
  Storage storage = Storage::float32;
};

struct PictureView {
  FramebufferSize size;                ///< the case's
  std::vector<ShownChannel> channels;  ///< [channel of the file]
  StoreRounding rounding = StoreRounding::nearest;
  ResolveOf resolve = ResolveOf::linear;
  bool is_flipped = false;  ///< true if row 0 of the file is the framebuffer's last row
  Alpha alpha = Alpha::straight;
  Blend blend = Blend::off;
  std::optional<std::size_t> alpha_channel;  ///< index into channels: the channel named A

  /// True for a channel that alpha multiplies: an attribute or a number, except alpha itself.
  /// Depths, triangles and coverage are no colours.
  bool is_color(std::size_t channel) const {
    const Shown shows = channels[channel].shows;
    return channel != alpha_channel && (shows == Shown::attribute || shows == Shown::constant);
  }
  /// True for a channel that drawing blends with what the target holds.
  bool is_blended(std::size_t channel) const {
    return blend != Blend::off && (channel == alpha_channel || is_color(channel));
  }

  /// The window y of a row of the file, and vice versa.
  int flipped(int y) const { return is_flipped ? size.height - 1 - y : y; }
};

/// Plans a picture file that does not exist yet. It has the layout's channels or, if the layout
/// names none, one channel for each attribute. Numbers are stored as the layout says; the default
/// is float32.
PictureFile planned_picture(const Case& c, const PictureLayout& layout);

/// Finds out what a file's channels show. Fails if the file has another size than the case, if the
/// layout names a channel that the file lacks, leaves one out, shows what the case does not have,
/// or needs alpha where channel A shows none. `file` is the name used in errors.
Result<PictureView> view_of(const Case& c, const PictureLayout& layout, const PictureFile& picture,
                            const std::string& file);

}  // namespace rastercheck::cases
