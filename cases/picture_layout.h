#pragma once

// The channels of a picture file: what they show of a case, how numbers are stored (RULES §12).

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rastercheck::cases {

/// The largest number of channels of a picture, inclusive.
inline constexpr std::size_t kMaxPictureChannels = 64;

/// How a number is stored. unorm8 and unorm16: k/255 and k/65535, clamped to [0, 1]. srgb8: like
/// unorm8, after the transfer function of sRGB (IEC 61966-2-1:1999), which is not applied to
/// channel A.
enum class Storage { float32, float16, unorm8, unorm16, srgb8 };

/// The stored values that a program may choose for a number between two of them. `nearest`: the
/// nearer one, or either one if the number is midway; `either`: either one.
enum class StoreRounding { nearest, either };

/// Which rows a picture begins with: the uppermost or the lowest as displayed.
enum class FirstRow { top, bottom };

/// The numbers that are averaged over a pixel's samples; matters only for several samples.
/// `linear`: the numbers that stored values stand for; `stored`: the stored values, which differ
/// for srgb8.
enum class ResolveOf { linear, stored };

/// How colours are stored: as they are, or multiplied by the alpha that channel A shows.
enum class Alpha { straight, premultiplied };

/// The result of drawing colour s, with alpha s_a, over a target that holds d. off: s; over: s_a s
/// + (1 − s_a) d, with alpha s_a + (1 − s_a) d_a; additive: s + d, and so for alpha. If colours are
/// premultiplied, s already contains the factor s_a, so `over` is s + (1 − s_a) d. Integer targets
/// clamp s and s_a to [0, 1] first.
enum class Blend { off, over, additive };

/// The kinds of things that a channel shows where a triangle is drawn.
enum class Shown { attribute, depth, triangle, coverage, constant, nothing };

/// One channel. `shows` is `depth`, `triangle` (the index of the triangle, plus 1), `coverage` (1),
/// a number (that number), `-` (anything: not judged), or an attribute's name; a name that could be
/// mistaken is preceded by `attribute:`.
struct PictureChannel {
  std::string name;  ///< as in the file: R, G, B, A, Y for grey, or an EXR channel's name
  std::string shows;
  /// The number that the channel shows where nothing is drawn. Empty: 1 for depth, else 0.
  std::optional<float> background;
  bool operator==(const PictureChannel&) const = default;
};

struct PictureLayout {
  /// Empty: the attributes in order, on the file's channels R, G, B and A.
  std::vector<PictureChannel> channels;
  /// Empty: as the file stores its numbers, without a transfer function.
  std::optional<Storage> storage;
  StoreRounding rounding = StoreRounding::nearest;
  FirstRow first_row = FirstRow::top;
  ResolveOf resolve = ResolveOf::linear;
  Alpha alpha = Alpha::straight;
  Blend blend = Blend::off;
  bool operator==(const PictureLayout&) const = default;
};

}  // namespace rastercheck::cases
