#pragma once

// Shared wording of judged pictures: verdicts, stored values, and sentences about what was
// judged.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cases/picture_view.h"
#include "records/judged_picture.h"
#include "reports/image.h"

namespace rastercheck::reports {

/// Says what a pixel of this verdict is: "drawn where nothing may be drawn".
std::string_view meaning_of(records::PixelVerdict verdict);
/// The colour of a verdict in pictures.
Color color_of(records::PixelVerdict verdict);

std::uint64_t pixel_count(const records::JudgedPicture& judged);

/// How much the case leaves open, and what was judged less strictly and why.
std::vector<std::string> freedom_sentences(const records::JudgedPicture& judged);

/// How the stored values of a channel are written for people.
struct ChannelUnit {
  /// 255 or 65535 if stored values are integers, else 1.
  int scale = 1;
  /// True if an integer k stands not for k/scale, but for the number that decoding k/scale from
  /// sRGB gives.
  bool is_encoded = false;
};
ChannelUnit unit_of(const cases::PictureView& view, std::size_t channel);

/// True if a channel's stored value is not among the permitted ones.
bool is_wrong(const records::WrongChannel& channel);

/// Describes each wrong channel, up to four: "R was drawn as 0.141 and must be 0.161 to 0.165 (36,
/// not 41 to 42, of 255)".
std::string fault_of(const records::WrongPixel& pixel, const cases::PictureView& view);

/// "off by 5 steps"; empty for NaN and for a million steps or more: for floats so far apart, the
/// numbers themselves say more.
std::string steps_text(double steps);

}  // namespace rastercheck::reports
