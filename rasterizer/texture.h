#pragma once

// Textures, and the shader that draws them (seed 004: tiling and transparency).
//
// A texture coordinate s lies in texel ⌊s W⌋, wrapped: with Wrap::repeat k is k modulo W, with
// Wrap::mirror texels 0…W − 1 are followed by W − 1…0, and so on. Bilinear filtering is between the
// centres (i + 1/2) / W, at x = c W − 1/2 with s wrapped to c in [0, 1]: repeat c = s − ⌊s⌋, mirror
// m = s − 2 ⌊s/2⌋ and c = m < 1 ? m : 2 − m. Texel index, wrap and level of detail are computed in
// double, before anything is rounded to float32.
//
// Nearest: the texel is that of exact arithmetic at every covered lane (where double leaves a doubt
// ExactAttributes decide), and its colour k/255 correctly rounded.
//
// Bilinear: colours are within W (e_s + 2^-51) + H (e_t + 2^-51) + 6 · 2^-24 of those of exact
// arithmetic, e what coordinates are off by at most (FragmentBatch::errors). A colour changes by at
// most 1 from one centre to the next; c is off by e + 2^-53 (coordinate_kernels.h), the product and
// the difference by half a unit of W each, so that x is off by W (e + 3 · 2^-53). The rest, in
// units of 2^-24:
//   - both fractions are rounded to float32, half a unit each: 1;
//   - with texels of 0…255, a + f (b − a) along rows has two roundings of numbers up to 255, 2^-17
//     each, as b − a is exact; between rows there are three more: 5 · 2^-17 / 255 < 2.52;
//   - q = v (2^-8 + 2^-16) and q + (2^-16 + 2^-32) q instead of v / 255: two roundings of numbers
//     up to 1, and 2^-40: 2.01.
// Nothing leaves [0, 1]: f is at most 1, |b − a| at most 2^-17 above 255 − a, and 255 + 2^-17
// rounds to 255. Equal texels give k/255 correctly rounded.
//
// Trilinear: W (e_s + 2^-51) + H (e_t + 2^-51) + 8 · 2^-24, where the level of detail is that of
// the batch's derivatives: with the level's fraction (half a unit), its error (2^-36, find_levels)
// and three more roundings up to 255 (1.51) it is 7.6 units in place of 5.6. Smaller levels only
// lessen the first two terms.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rasterizer/rasterizer.h"
#include "rasterizer/shading.h"

namespace rastercheck::rasterizer {

/// Beyond [0, 1): again and again (seed 004's `tile`, for coordinates below 0 and far away as
/// well), the edge's texels, or every other time mirrored.
enum class Wrap { repeat, clamp, mirror };

/// `trilinear`: bilinear on the two levels next to the level of detail, and linear between them.
enum class Filter { nearest, bilinear, trilinear };

struct Sampler {
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  Filter filter = Filter::trilinear;
};

/// Red, green, blue and alpha in bytes, k for k/255, and its smaller levels.
class Texture {
 public:
  /// Row 0 is that of t = 0. Builds the levels: ⌊size / 2⌋ each, a texel being the mean of what it
  /// covers of the level before (of an odd size partly), rounded once, halves up.
  /// Error::target_size where a side is not 1…kMaxSize, Error::attribute_values where there are not
  /// width × height × 4 bytes, Error::out_of_memory; then `texture` is left as it was.
  static std::optional<Error> make(int width, int height, std::span<const std::uint8_t> rgba,
                                   Texture& texture);

  int width(std::size_t level = 0) const { return levels_[level].width; }
  int height(std::size_t level = 0) const { return levels_[level].height; }
  std::size_t level_count() const { return levels_.size(); }
  /// [y][x], red in the lowest byte.
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

/// Filtered colours in [0, 1] for all lanes of a batch: `s` and `t` are the attributes that are its
/// coordinates; color[0…3][lane], aligned to 64 bytes. Filter::trilinear wants a shader that
/// uses_derivatives(); where these are no numbers, the level is 0. Lanes whose coordinates are no
/// numbers, or infinite and not clamped, have the colour at 0, those of quads without a covered one
/// that of any texels. `texture` has been made.
void sample(const Texture& texture, const Sampler& sampler, const FragmentBatch& in, std::size_t s,
            std::size_t t, std::span<float* const, 4> color);

/// A texture as it is. `discard_below`: fragments whose alpha is less are not drawn (seed 004's
/// transparency).
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
