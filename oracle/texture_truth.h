#pragma once

// Exact texture lookups: the texel of nearest filtering, and the colours of bilinear and trilinear
// filtering, in rational numbers. Implements the meaning of cases::Texturing:
//
//   nearest     texel ⌊s W⌋, ⌊t H⌋. Wrapped, index i of n texels is
//                 repeat   i mod n
//                 clamp    the nearest of 0…n − 1
//                 mirror   m if m < n, else 2n − 1 − m, with m = i mod 2n
//   bilinear    x = s W − 1/2 lies x − ⌊x⌋ of the way from texel ⌊x⌋ to ⌊x⌋ + 1, each wrapped;
//               likewise y = t H − 1/2
//   trilinear   λ = log2 ρ, clamped to 0…last, lies λ − ⌊λ⌋ of the way from the bilinear colour of
//               level ⌊λ⌋ to the colour of level ⌊λ⌋ + 1; ρ is the greater length of the screen
//               derivatives of (s W, t H)
//
// Where a level has n texels along an axis, the next level has max(1, ⌊n / 2⌋), all of equal size.
// A texel is the mean of the texels that it covers in the level before, weighted by overlap
// (partial if n is odd), and rounded to an integer, halves up.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cases/contract.h"
#include "cases/picture.h"
#include "oracle/rational.h"
#include "oracle/triangle_truth.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

/// The texel index along one axis at a coordinate.
struct TexelIndex {
  int index = 0;
  bool is_on_border = false;  ///< coordinate · size is an integer
  bool is_beyond = false;     ///< the coordinate is not in [0, 1)
};
TexelIndex texel_index(const Rational& coordinate, int size, cases::Wrap wrap);

/// A channel of a filtered colour, 0…1.
struct FilteredChannel {
  ValueRange exact;    ///< a range if the level of detail is only known as a range
  ValueRange allowed;  ///< `exact`, widened by the bound
};

/// The greatest |s| and |t| of the drawn vertices; they scale the error bounds
/// (cases::TextureBounds).
struct CoordinateSizes {
  Rational s = Rational();
  Rational t = Rational();
};

struct CoordinateRanges {
  ValueRange s;
  ValueRange t;
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

  /// The colours that nearest filtering may give anywhere within these coordinates, if each texel
  /// may be looked up as far off as the bounds allow; each colour once. Empty if more than 4×4
  /// texels are within.
  std::vector<Color> nearest_within(const CoordinateRanges& at,
                                    const cases::PictureBounds& bounds) const;

  /// The colours of bilinear filtering anywhere within these coordinates. Empty if more than 4×4
  /// squares between texels are within.
  std::optional<Filtered> bilinear_within(const CoordinateRanges& at, const CoordinateSizes& sizes,
                                          const cases::TextureBounds& bounds) const;

  /// `level` encloses λ; its ends may be infinite.
  Filtered trilinear(const Rational& s, const Rational& t, const records::Enclosure& level,
                     const CoordinateSizes& sizes, const cases::TextureBounds& bounds) const;

  /// Encloses λ for derivatives of s and t that may be off by as much as the bounds allow.
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
