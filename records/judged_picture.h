#pragma once

// The result of judging a finished picture (oracle/picture_judge.h), as plain data.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/names.h"

namespace rastercheck::records {

/// Says whether a pixel is right, and if not, in which way it is wrong.
enum class PixelVerdict {
  right,           ///< as some permitted drawing shows it
  wrong_value,     ///< no triangle that may be seen there has this colour
  wrong_triangle,  ///< the colour, or the index, of a triangle that must not be seen there
  extra,           ///< not the background, where nothing may be drawn
  missing,         ///< the background, where something must be drawn
  not_a_number,    ///< NaN
  not_judged,      ///< wrong for all triangles with a promise, but one without may be seen there;
                   ///< or several triangles may be blended there
};

constexpr auto names_of(PixelVerdict /*type*/) {
  return std::to_array<std::string_view>(
      {"right", "wrong value", "wrong triangle", "extra", "missing", "not a number", "not judged"});
}
constexpr std::string_view to_string(PixelVerdict verdict) { return cases::name_of(verdict); }
constexpr std::size_t kPixelVerdicts = names_of(PixelVerdict{}).size();

/// A channel of a wrong pixel: the stored value, and the stored values permitted for the candidate
/// that comes closest. For unorm and srgb8 these are the integers k.
struct WrongChannel {
  float actual = 0;
  float least = 0;
  float greatest = 0;
  bool is_free = false;  ///< any value is permitted
};

struct WrongPixel {
  int x = 0;    ///< pixels, as in the file
  int row = 0;  ///< row of the file, the first one is 0
  PixelVerdict verdict = PixelVerdict::wrong_value;
  /// The triangle that comes closest; empty for the background.
  std::optional<std::uint32_t> triangle;
  std::vector<WrongChannel> channels;  ///< [channel]
  /// The distance of the channel that is farthest off, in steps of its storage (ULP of floats);
  /// infinite for NaN.
  double steps = 0;
};

/// How much a picture of the case leaves open.
struct PictureFreedom {
  std::uint64_t one_value = 0;   ///< pixels of a triangle that must have one stored value each
  std::uint64_t may_differ = 0;  ///< pixels with several permitted values
  std::uint64_t background = 0;  ///< pixels that must stay background
  std::uint64_t widened = 0;     ///< resolved pixels with too many mixtures to tell apart
  std::uint64_t layered = 0;     ///< of may_differ, pixels where several triangles may be blended
};

/// Says how many answers a pixel has.
enum class PixelFreedom {
  background,  ///< nothing may be drawn there
  one_value,   ///< one triangle, with one stored value in each channel
  may_differ,  ///< several values
};

/// Holds the range of permitted values for each pixel and channel.
struct PictureMask {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  std::vector<PixelFreedom> pixels;  ///< [row][x] of the file
  /// [row][x][channel]: the least and the greatest number that a stored value stands for, over all
  /// that may be seen; infinite where nothing is promised.
  std::vector<float> least;
  std::vector<float> greatest;
  PictureFreedom freedom;
};

struct JudgedPicture {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  std::array<std::uint64_t, kPixelVerdicts> counts{};  ///< [PixelVerdict]
  std::vector<PixelVerdict> pixels;                    ///< [row][x] of the file
  std::vector<float> steps;       ///< [row][x] of the file: WrongPixel::steps, 0 if not wrong
  std::vector<WrongPixel> worst;  ///< the farthest off first
  PictureFreedom freedom;
  std::uint64_t unpromised_triangles = 0;  ///< nothing is promised about them
  /// The number of wrong pixels that were not compared with hidden triangles, because there were
  /// too many. They count as wrong_value.
  std::uint64_t not_compared = 0;

  std::uint64_t count(PixelVerdict verdict) const {
    return counts[static_cast<std::size_t>(verdict)];
  }
  std::uint64_t wrong() const {
    std::uint64_t all = 0;
    for (const std::uint64_t one : counts) all += one;
    return all - count(PixelVerdict::right) - count(PixelVerdict::not_judged);
  }
};

/// The largest number of wrong pixels that JudgedPicture::worst lists.
inline constexpr std::size_t kMostWrongPixels = 32;

}  // namespace rastercheck::records
