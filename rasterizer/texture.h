#pragma once

// Textures, and the shader that draws them (MIT 6.837 2000, lecture 18: tiling and transparency).
//
// A texture coordinate s lies in texel k = ⌊s W⌋, wrapped. With Wrap::repeat, k is taken modulo W;
// with Wrap::mirror, texels 0…W − 1 are followed by W − 1…0, and so on. Bilinear filtering
// interpolates between the centres (i + 1/2) / W, at x = c W − 1/2, where s is wrapped to c in
// [0, 1]: for repeat, c = s − ⌊s⌋; for mirror, m = s − 2 ⌊s/2⌋ and c = m < 1 ? m : 2 − m. Texel
// index, wrap and level of detail are computed in double, before anything is rounded to float32.
//
// Nearest: every covered lane gets the texel that exact arithmetic gives (ExactAttributes decide
// where double cannot), with its colour k/255 correctly rounded.
//
// Bilinear: colours differ by at most W (e_s + 2^-51) + H (e_t + 2^-51) + 6 · 2^-24 from exact
// arithmetic, where e bounds the error of a coordinate (FragmentBatch::errors). A colour changes by
// at most 1 from one centre to the next. c has an error of e + 2^-53 (coordinate_kernels.h); the
// product and the difference add at most 2^-53 W each, so x has an error of W (e + 3 · 2^-53). The
// other errors, in units of 2^-24, are:
//   - both fractions are rounded to float32, half a unit each: 1;
//   - with texels of 0…255, a + f (b − a) along rows has two roundings of numbers up to 255, 2^-17
//     each, because b − a is exact; between rows there are three more: 5 · 2^-17 / 255 < 2.52;
//   - q = v (2^-8 + 2^-16) and q + (2^-16 + 2^-32) q instead of v / 255: two roundings of numbers
//     up to 1, and 2^-40: 2.01.
// No colour leaves [0, 1]: f is at most 1, |b − a| is at most 2^-17 above 255 − a, and 255 + 2^-17
// rounds to 255. Equal texels give k/255 correctly rounded.
//
// Trilinear: the bound is W (e_s + 2^-51) + H (e_t + 2^-51) + 8 · 2^-24, for the level of detail
// that the batch's derivatives give. The rounding of the level's fraction (half a unit), its error
// (2^-36, find_levels) and three more roundings of numbers up to 255 (1.51) raise the sum from 5.6
// to 7.6 units. Smaller levels only reduce the first two terms.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rasterizer/rasterizer.h"
#include "rasterizer/shading.h"

namespace rastercheck::rasterizer {

/// The colour at coordinates beyond [0, 1): the texture again (like `tile` in MIT 6.837 2000,
/// lecture 18, but also below 0 and far away), the edge's texels, or the texture mirrored every
/// other time.
enum class Wrap { repeat, clamp, mirror };

/// `trilinear`: bilinear on the two levels next to the level of detail, then linear between these
/// levels.
enum class Filter { nearest, bilinear, trilinear };

struct Sampler {
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  Filter filter = Filter::trilinear;
};

/// A texture: red, green, blue and alpha in bytes (k means k/255), with its smaller levels.
class Texture {
 public:
  /// Makes a texture with all its levels. Row 0 is at t = 0. Each level has half the size of the
  /// level before, rounded down. A texel is the mean, rounded once with halves up, of the texels
  /// that it covers in the level before; with odd sizes, it covers some of them in part. Returns
  /// Error::target_size if a side is not in 1…kMaxSize, Error::attribute_values unless `rgba` has
  /// width × height × 4 bytes, or Error::out_of_memory; `texture` is then unchanged.
  static std::optional<Error> make(int width, int height, std::span<const std::uint8_t> rgba,
                                   Texture& texture);

  int width(std::size_t level = 0) const { return levels_[level].width; }
  int height(std::size_t level = 0) const { return levels_[level].height; }
  std::size_t level_count() const { return levels_.size(); }
  /// Returns the texels, [y][x], with red in the lowest byte.
  std::span<const std::uint32_t> texels(std::size_t level = 0) const;

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::size_t first = 0;  ///< in texels_
  };
  std::vector<Level> levels_;
  std::vector<std::uint32_t> texels_;
};

/// Writes filtered colours in [0, 1] for all lanes of a batch to color[0…3][lane], aligned to 64
/// bytes. `s` and `t` are the indices of the attributes that serve as coordinates; `texture` must
/// have been made. Filter::trilinear needs a shader that uses_derivatives(); NaN derivatives give
/// level 0. Lanes with NaN coordinates, or with infinite coordinates that are not clamped, get the
/// colour at 0. Lanes of quads without a covered lane get the colour of arbitrary texels.
void sample(const Texture& texture, const Sampler& sampler, const FragmentBatch& in, std::size_t s,
            std::size_t t, std::span<float* const, 4> color);

/// Draws the texture's colours. If `discard_below` is set, fragments whose alpha is lower are
/// discarded (transparency in MIT 6.837 2000, lecture 18).
struct TexturedShader {
  const Texture* texture = nullptr;
  Sampler sampler;
  std::size_t s = 0;
  std::size_t t = 1;
  std::optional<float> discard_below = {};

  std::size_t outputs() const { return 4; }
  bool uses_derivatives() const { return sampler.filter == Filter::trilinear; }
  bool discards() const { return discard_below.has_value(); }
  void operator()(const FragmentBatch& in, ShadedBatch& out) const;
};

}  // namespace rastercheck::rasterizer
