#pragma once

// What a texture gives at exact coordinates: the texel of nearest filtering, and the colours of
// bilinear and trilinear filtering, in rational numbers. It implements what cases::Texturing means:
//
//   nearest     texel ⌊s W⌋, ⌊t H⌋. Wrapped, index i of n texels is
//                 repeat   i mod n
//                 clamp    the nearest of 0…n − 1
//                 mirror   m = i mod 2n; m < n: m, else 2n − 1 − m
//   bilinear    x = s W − 1/2 lies x − ⌊x⌋ between texels ⌊x⌋ and ⌊x⌋ + 1, each wrapped; t alike
//   trilinear   λ = log2 ρ, held to 0…last, is λ − ⌊λ⌋ between the bilinear colours of levels ⌊λ⌋
//               and ⌊λ⌋ + 1; ρ is the greater of the lengths of the screen derivatives of (s W, t
//               H)
//
// A level has max(1, ⌊n / 2⌋) texels for n of the level before, of equal size and side by side; a
// texel is the mean of what it covers there, partly where n is odd, weighted by how much, and
// rounded to a whole number, halves up.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cases/contract.h"
#include "cases/picture.h"
#include "oracle/rational.h"
#include "oracle/triangle_truth.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

/// The texel of one axis that a coordinate is in.
struct TexelIndex {
  int index = 0;
  bool is_on_border = false;  ///< coordinate · size is a whole number
  bool is_beyond = false;     ///< the coordinate is not in [0, 1)
};
TexelIndex texel_index(const Rational& coordinate, int size, cases::Wrap wrap);

/// A channel of a filtered colour, 0…1.
struct FilteredChannel {
  ValueRange exact;    ///< more than one value where the level of detail is not known better
  ValueRange allowed;  ///< what is within the bound of that
};

/// The greatest |s| and |t| of the vertices drawn, which errors are measured by
/// (cases::TextureBounds).
struct CoordinateSizes {
  Rational s = Rational();
  Rational t = Rational();
};

class TextureTruth {
 public:
  using Color = std::array<std::uint8_t, 4>;
  using Filtered = std::array<FilteredChannel, 4>;

  explicit TextureTruth(const cases::Texturing& texturing);

  std::size_t level_count() const { return levels_.size(); }

  Color nearest(const Rational& s, const Rational& t) const;

  Filtered bilinear(const Rational& s, const Rational& t, const CoordinateSizes& sizes,
                    const cases::TextureBounds& bounds) const;

  /// `level` is any enclosure of λ; infinite ends are allowed.
  Filtered trilinear(const Rational& s, const Rational& t, const records::Enclosure& level,
                     const CoordinateSizes& sizes, const cases::TextureBounds& bounds) const;

  /// λ of derivatives of s and t that may be off as the bounds say.
  records::Enclosure level_of_detail(const ScaledDerivatives& s, const ScaledDerivatives& t,
                                     const cases::TextureBounds& bounds) const;

 private:
  struct Level {
    int width = 1;
    int height = 1;
    std::vector<std::uint8_t> texels;  ///< [t][s][4]

    Color texel(int column, int row) const;
  };
  static Level half_of(const Level& level);

  struct Sampling;

  cases::Wrap wrap_s_;
  cases::Wrap wrap_t_;
  std::vector<Level> levels_;
};

}  // namespace rastercheck::oracle
