#pragma once

// The parts of a pipeline that the case file does not have, as plain data: how vertices become
// triangles, and how fragments become a picture. A law (properties/) derives them from nothing but
// the case, so the same case always gets the same pipeline.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cases/case.h"
#include "cases/picture_layout.h"

namespace rastercheck::cases {

/// How vertices become triangles.
enum class Topology { triangles, strip, fan };

/// An index that names no vertex: the next index begins a new list, strip or fan.
inline constexpr std::uint32_t kRestart = 0xffffffff;

/// When a fragment is kept: `less` if its depth is less than the sample's, and so on.
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

/// Floats, or bytes k that mean k/255.
enum class ColorFormat { float32, rgba8 };

enum class Wrap { repeat, clamp, mirror };
enum class Filter { nearest, bilinear, trilinear };

/// Four bytes per texel: red, green, blue, alpha.
struct Texture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> texels;  ///< [t][s][4]
  bool operator==(const Texture&) const = default;
};

/// The source of colours.
enum class Shading {
  attributes,     ///< one channel per attribute, unchanged
  vertex_colors,  ///< the first three or four attributes: red, green, blue and alpha; alpha is 1
                  ///< if there are only three
  /// Differences of attributes across quads of 2×2 pixels: odd column minus even column (or odd row
  /// minus even row), both evaluated on the fragment's own triangle and sample, even where the
  /// triangle does not cover the neighbour.
  differences_along_x,
  differences_along_y,
  facing,  ///< 1 on front faces and 0 on back faces in channels 0 to 2; alpha is 1
  /// Window x and y of the fragment's sample, the fragment's depth, and 1/w.
  window_coordinates
};

/// True if a picture of this shading has four channels, whatever the case's attributes.
constexpr bool has_four_channels(Shading shading) {
  return shading == Shading::vertex_colors || shading == Shading::facing ||
         shading == Shading::window_coordinates;
}

/// A texture looked up at the first two attributes.
struct Texturing {
  Texture texture;
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  Filter filter = Filter::nearest;
  bool operator==(const Texturing&) const = default;
};

/// The pipeline of a picture; overrides the case's own depth_test.
struct Pipeline {
  DepthFunction depth_function = DepthFunction::less;
  bool writes_depth = true;
  float clear_depth = 1;  ///< colours are cleared to 0
  Blend blend = Blend::off;
  ColorFormat format = ColorFormat::float32;
  Shading shading = Shading::attributes;
  std::optional<Texturing> texturing;  ///< replaces the shading, if present
  /// Fragments are not drawn if the texture's alpha or, without a texture, the value of the case's
  /// last attribute is less. Differences across quads are taken before.
  std::optional<float> discard_below;
  bool resolves = false;  ///< true if the picture is the mean of the samples
  bool operator==(const Pipeline&) const = default;
};

struct Picture {
  FramebufferSize size;      ///< one sample if resolved
  std::size_t channels = 0;  ///< one per attribute of the case, or four (has_four_channels())
  std::vector<float> color;  ///< [y][x][sample][channel]; a byte k as the float nearest to k/255
  std::vector<float> depth;  ///< [y][x][sample]
};

}  // namespace rastercheck::cases
