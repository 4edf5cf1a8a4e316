#pragma once

// The parts of a pipeline that the case file does not have, as plain data: how vertices become
// triangles, and what becomes of fragments on their way into a picture. Laws about these choose
// them by the case alone (properties/).

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cases/case.h"

namespace rastercheck::cases {

/// How vertices become triangles.
enum class Topology { triangles, strip, fan };

/// An index that is no vertex: with the next begins a new list, strip or fan.
inline constexpr std::uint32_t kRestart = 0xffffffff;

/// When a fragment is kept: `less`, where its depth is less than the sample's, and so on.
enum class DepthFunction {
  always,
  never,
  less,
  equal,
  less_or_equal,
  greater,
  not_equal,
  greater_or_equal
};

/// What is drawn of a colour s where d is: s itself; s_a s + (1 − s_a) d, of alpha s_a + (1 − s_a)
/// d_a; s + d (properties/laws/internal/picture_model.h).
enum class Blend { off, over, additive };

/// Floats, or bytes k that are k/255.
enum class ColorFormat { float32, rgba8 };

enum class Wrap { repeat, clamp, mirror };
enum class Filter { nearest, bilinear, trilinear };

/// Four bytes a texel: red, green, blue, alpha.
struct Texture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> texels;  ///< [t][s][4]
};

/// What colours are made of.
enum class Shading {
  attributes,     ///< one channel each, as they are
  vertex_colors,  ///< the first three or four: red, green, blue and alpha, 1 where there are three
  /// Differences of attributes across quads of 2×2 pixels, from the even column to the odd one, or
  /// from the even row: r(x_odd) − r(x_even) of the fragment's own triangle and sample, drawn there
  /// or not.
  differences_along_x,
  differences_along_y
};

/// A texture at the first two attributes.
struct Texturing {
  Texture texture;
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  Filter filter = Filter::nearest;
  std::optional<float> discard_below;  ///< fragments with less alpha are not drawn
};

/// The case's own depth_test has no say.
struct Pipeline {
  DepthFunction depth_function = DepthFunction::less;
  bool writes_depth = true;
  float clear_depth = 1;  ///< colours are cleared to 0
  Blend blend = Blend::off;
  ColorFormat format = ColorFormat::float32;
  Shading shading = Shading::attributes;
  std::optional<Texturing> texturing;  ///< in place of the shading
  bool resolves = false;               ///< whether the picture is the mean of the samples
};

struct Picture {
  FramebufferSize size;      ///< one sample where it was resolved
  std::size_t channels = 0;  ///< the case's attributes, or four of a colour
  std::vector<float> color;  ///< [y][x][sample][channel]; a byte k as the float next to k/255
  std::vector<float> depth;  ///< [y][x][sample]
};

}  // namespace rastercheck::cases
