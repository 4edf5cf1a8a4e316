#include "oracle/texture_truth.h"

#include <algorithm>
#include <cmath>

#include "oracle/internal/rational_number.h"

namespace rastercheck::oracle {
namespace {

constexpr int kMostByte = 255;

/// i modulo n, 0…n − 1, for integers.
int modulo(const Field& i, int n) {
  const Field rest = i - floor_of(i / Field(n)) * Field(n);
  return static_cast<int>(floor_to_long(rest));
}

/// Wraps an integer texel coordinate.
int wrapped(const Field& i, int size, cases::Wrap wrap) {
  switch (wrap) {
    case cases::Wrap::repeat:
      return modulo(i, size);
    case cases::Wrap::clamp:
      if (i < Field(0)) return 0;
      return i < Field(size) ? static_cast<int>(floor_to_long(i)) : size - 1;
    case cases::Wrap::mirror:
      break;
  }
  const int within = modulo(i, 2 * size);
  return within < size ? within : 2 * size - 1 - within;
}

/// Two neighbouring texels along an axis, and the fraction of the way from the first to the second.
struct Neighbors {
  std::array<int, 2> at{};
  Field fraction;
};

Neighbors neighbors_of(const Field& coordinate, int size, cases::Wrap wrap) {
  const Field x = coordinate * Field(size) - Field(1, 2);
  const Field low = floor_of(x);
  return {{wrapped(low, size, wrap), wrapped(low + Field(1), size, wrap)}, x - low};
}

Field between(const Field& a, const Field& b, const Field& fraction) {
  return a + fraction * (b - a);
}

/// The texels of a level (n along the axis) that texel j of the next level (m along the axis)
/// covers. `parts` says how much of each is covered, from texel `first` on, in units of 1/m texel.
/// The parts add up to n.
struct TexelCover {
  int first = 0;
  std::vector<std::uint64_t> parts;
};

TexelCover cover_of(int n, int m, int j) {
  TexelCover cover{j * n / m, {}};
  for (int k = cover.first; k * m < (j + 1) * n; ++k) {
    const int begin = std::max(k * m, j * n);
    const int end = std::min((k + 1) * m, (j + 1) * n);
    cover.parts.push_back(static_cast<std::uint64_t>(end - begin));
  }
  return cover;
}

struct Bounded {
  Field lo;
  Field hi;
};

/// Bounds |d| for a d that may differ from `exact` by `share` · max(|exact|, scale).
Bounded magnitude_of(const Rational& exact, const Rational& scale, const Field& share) {
  const Field size = magnitude(to_field(exact));
  const Field error = share * std::max(size, to_field(scale));
  return {std::max(Field(0), Field(size - error)), size + error};
}

/// The most texels, or squares between texels, along an axis of a range of coordinates.
constexpr int kMostAcross = 4;

/// The wrapped indices of the texels along an axis that coordinates of a range may fall into, each
/// off by at most `share` of the distance from 0 and `distance` texels; empty if they are too many.
std::vector<int> indices_within(const ValueRange& range, int size, cases::Wrap wrap,
                                const cases::PictureBounds& bounds) {
  const auto reach = [&](const Field& texels) {
    return Field(exact_field(bounds.texel_share) * magnitude(texels) +
                 exact_field(bounds.texel_distance));
  };
  const Field least = to_field(range.lo) * Field(size);
  const Field greatest = to_field(range.hi) * Field(size);
  Field first = floor_of(least - reach(least));
  Field last = floor_of(greatest + reach(greatest));
  if (wrap == cases::Wrap::clamp) {  // all beyond an end is one texel
    first = std::clamp(first, Field(0), Field(size - 1));
    last = std::clamp(last, Field(0), Field(size - 1));
  }
  std::vector<int> indices;
  if (last - first >= Field(kMostAcross)) return indices;
  for (Field i = first; i <= last; i = i + Field(1)) indices.push_back(wrapped(i, size, wrap));
  return indices;
}

/// Coordinates between which a bilinear colour is a polynomial: the ends of a range, and within it
/// the middles of texels. Empty if they are too many.
std::vector<Field> pieces_of(const ValueRange& range, int size) {
  const Field least = to_field(range.lo);
  const Field greatest = to_field(range.hi);
  const Field half(1, 2);
  std::vector<Field> ends{least};
  Field middle = floor_of(least * Field(size) - half) + Field(1) + half;
  for (; middle < greatest * Field(size); middle = middle + Field(1)) {
    if (ends.size() > kMostAcross) return {};
    ends.push_back(middle / Field(size));
  }
  if (greatest > least) ends.push_back(greatest);
  return ends;
}

}  // namespace

TexelIndex texel_index(const Rational& coordinate, int size, cases::Wrap wrap) {
  const Field p = to_field(coordinate) * Field(size);
  const Field low = floor_of(p);
  return {wrapped(low, size, wrap), low == p, p < Field(0) || p >= Field(size)};
}

/// Colours at one place, by level.
struct TextureTruth::Sampling {
  const TextureTruth& texture;
  const Field& s;
  const Field& t;

  std::array<Field, 4> bilinear(std::size_t level) const {
    const Level& of = texture.levels_[level];
    const Neighbors columns = neighbors_of(s, of.width, texture.wrap_s_);
    const Neighbors rows = neighbors_of(t, of.height, texture.wrap_t_);
    std::array<Color, 4> texels{};
    for (std::size_t k = 0; k < 4; ++k) {
      texels[k] = of.texel(columns.at[k % 2], rows.at[k / 2]);
    }
    std::array<Field, 4> color;
    for (std::size_t channel = 0; channel < 4; ++channel) {
      const auto value = [&](std::size_t k) { return Field(int{texels[k][channel]}); };
      const Field low = between(value(0), value(1), columns.fraction);
      const Field high = between(value(2), value(3), columns.fraction);
      color[channel] = between(low, high, rows.fraction) / Field(kMostByte);
    }
    return color;
  }

  /// The colour at a level of detail within 0…last.
  std::array<Field, 4> trilinear(double lambda) const {
    const auto level = static_cast<std::size_t>(std::floor(lambda));
    std::array<Field, 4> color = bilinear(level);
    const Field fraction = Field(lambda) - Field(static_cast<int>(level));
    if (sign_of(fraction) == 0) return color;
    const std::array<Field, 4> next = bilinear(level + 1);
    for (std::size_t k = 0; k < 4; ++k) color[k] = between(color[k], next[k], fraction);
    return color;
  }

  /// W (share · max|s| + constant) + H (share · max|t| + constant) + units · 2^-24.
  Field bound(const CoordinateSizes& sizes, const cases::TextureBounds& bounds, float units) const {
    const Field share = exact_field(bounds.coordinate_share);
    const Field constant = exact_field(bounds.coordinate_constant);
    const Level& level = texture.levels_.front();
    const Field most_s = std::max(to_field(sizes.s), magnitude(s));
    const Field most_t = std::max(to_field(sizes.t), magnitude(t));
    return Field(level.width) * (share * most_s + constant) +
           Field(level.height) * (share * most_t + constant) +
           exact_field(units) * power_of_two(-24);
  }
};

TextureTruth::TextureTruth(const cases::Texturing& texturing)
    : wrap_s_(texturing.wrap_s), wrap_t_(texturing.wrap_t) {
  levels_.push_back({texturing.texture.width, texturing.texture.height, texturing.texture.texels});
  if (texturing.filter != cases::Filter::trilinear) return;
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    levels_.push_back(half_of(levels_.back()));
  }
}

TextureTruth::Level TextureTruth::half_of(const Level& level) {
  Level half{std::max(1, level.width / 2), std::max(1, level.height / 2), {}};
  const auto whole =
      static_cast<std::uint64_t>(level.width) * static_cast<std::uint64_t>(level.height);
  for (int row = 0; row < half.height; ++row) {
    const TexelCover rows = cover_of(level.height, half.height, row);
    for (int column = 0; column < half.width; ++column) {
      const TexelCover columns = cover_of(level.width, half.width, column);
      std::array<std::uint64_t, 4> sums{};
      for (std::size_t y = 0; y < rows.parts.size(); ++y) {
        for (std::size_t x = 0; x < columns.parts.size(); ++x) {
          const Color color =
              level.texel(columns.first + static_cast<int>(x), rows.first + static_cast<int>(y));
          const std::uint64_t weight = rows.parts[y] * columns.parts[x];
          for (std::size_t k = 0; k < 4; ++k) sums[k] += weight * color[k];
        }
      }
      for (const std::uint64_t sum : sums) {
        half.texels.push_back(static_cast<std::uint8_t>((2 * sum + whole) / (2 * whole)));
      }
    }
  }
  return half;
}

TextureTruth::Color TextureTruth::Level::texel(int column, int row) const {
  const std::size_t at = 4 * static_cast<std::size_t>(row * width + column);
  return {texels[at], texels[at + 1], texels[at + 2], texels[at + 3]};
}

TextureTruth::Color TextureTruth::nearest(const Rational& s, const Rational& t) const {
  const Level& level = levels_.front();
  return level.texel(texel_index(s, level.width, wrap_s_).index,
                     texel_index(t, level.height, wrap_t_).index);
}

TextureTruth::Filtered TextureTruth::bilinear(const Rational& s, const Rational& t,
                                              const CoordinateSizes& sizes,
                                              const cases::TextureBounds& bounds) const {
  const Sampling sampling{*this, to_field(s), to_field(t)};
  const std::array<Field, 4> color = sampling.bilinear(0);
  const Field bound = sampling.bound(sizes, bounds, bounds.bilinear);
  Filtered filtered;
  for (std::size_t k = 0; k < 4; ++k) {
    filtered[k].exact = {to_rational(color[k]), to_rational(color[k])};
    filtered[k].allowed = {to_rational(color[k] - bound), to_rational(color[k] + bound), true};
  }
  return filtered;
}

std::vector<TextureTruth::Color> TextureTruth::nearest_within(
    const CoordinateRanges& at, const cases::PictureBounds& bounds) const {
  const Level& level = levels_.front();
  std::vector<Color> colors;
  for (const int row : indices_within(at.t, level.height, wrap_t_, bounds)) {
    for (const int column : indices_within(at.s, level.width, wrap_s_, bounds)) {
      const Color color = level.texel(column, row);
      if (std::find(colors.begin(), colors.end(), color) == colors.end()) colors.push_back(color);
    }
  }
  return colors;
}

std::optional<TextureTruth::Filtered> TextureTruth::bilinear_within(
    const CoordinateRanges& at, const CoordinateSizes& sizes,
    const cases::TextureBounds& bounds) const {
  const Level& level = levels_.front();
  const std::vector<Field> columns = pieces_of(at.s, level.width);
  const std::vector<Field> rows = pieces_of(at.t, level.height);
  if (columns.empty() || rows.empty()) return std::nullopt;
  // Within a square between four texels the colour is linear along each axis, so that its extremes
  // are at the corners.
  std::array<Field, 4> lo;
  std::array<Field, 4> hi;
  Field most(0);
  bool is_first = true;
  for (const Field& t : rows) {
    for (const Field& s : columns) {
      const Sampling sampling{*this, s, t};
      const std::array<Field, 4> color = sampling.bilinear(0);
      for (std::size_t k = 0; k < 4; ++k) {
        lo[k] = is_first ? color[k] : std::min(lo[k], color[k]);
        hi[k] = is_first ? color[k] : std::max(hi[k], color[k]);
      }
      most = std::max(most, sampling.bound(sizes, bounds, bounds.bilinear));
      is_first = false;
    }
  }
  Filtered filtered;
  for (std::size_t k = 0; k < 4; ++k) {
    filtered[k].exact = {to_rational(lo[k]), to_rational(hi[k]), true};
    filtered[k].allowed = {to_rational(lo[k] - most), to_rational(hi[k] + most), true};
  }
  return filtered;
}

TextureTruth::Filtered TextureTruth::trilinear(const Rational& s, const Rational& t,
                                               const records::Enclosure& level,
                                               const CoordinateSizes& sizes,
                                               const cases::TextureBounds& bounds) const {
  const double last = static_cast<double>(levels_.size() - 1);
  const double least = std::clamp(level.lo, 0.0, last);
  const double most = std::clamp(level.hi, 0.0, last);
  const Sampling sampling{*this, to_field(s), to_field(t)};
  std::array<Field, 4> lo = sampling.trilinear(least);
  std::array<Field, 4> hi = lo;
  const auto take_in = [&](double lambda) {
    const std::array<Field, 4> color = sampling.trilinear(lambda);
    for (std::size_t k = 0; k < 4; ++k) {
      lo[k] = std::min(lo[k], color[k]);
      hi[k] = std::max(hi[k], color[k]);
    }
  };
  // The colour is linear in λ between levels, so the extremes are at the ends or at integer levels.
  for (int whole = static_cast<int>(std::floor(least)) + 1; whole < most; ++whole) {
    take_in(static_cast<double>(whole));
  }
  if (most > least) take_in(most);
  const Field bound = sampling.bound(sizes, bounds, bounds.trilinear);
  Filtered filtered;
  for (std::size_t k = 0; k < 4; ++k) {
    filtered[k].exact = {to_rational(lo[k]), to_rational(hi[k]), most > least};
    filtered[k].allowed = {to_rational(lo[k] - bound), to_rational(hi[k] + bound), true};
  }
  return filtered;
}

records::Enclosure TextureTruth::level_of_detail(const ScaledDerivatives& s,
                                                 const ScaledDerivatives& t,
                                                 const cases::TextureBounds& bounds) const {
  const Field share = exact_field(bounds.derivative_share);
  const Field width(levels_.front().width);
  const Field height(levels_.front().height);
  const auto square_length = [&](const Rational& ds, const Rational& s_scale, const Rational& dt,
                                 const Rational& t_scale) {
    const Bounded along_s = magnitude_of(ds, s_scale, share);
    const Bounded along_t = magnitude_of(dt, t_scale, share);
    const auto square = [&](const Field& a, const Field& b) {
      return Field(a * width * a * width + b * height * b * height);
    };
    return Bounded{square(along_s.lo, along_t.lo), square(along_s.hi, along_t.hi)};
  };
  const Bounded u = square_length(s.exact.du, s.scale.du, t.exact.du, t.scale.du);
  const Bounded v = square_length(s.exact.dv, s.scale.dv, t.exact.dv, t.scale.dv);
  // Lengths of at most 1 give λ = 0, so log2(0) is never computed. Halving is exact in this range.
  const auto level_of = [](const Field& square) {
    return square > Field(1) ? enclose_log2(square) : records::Enclosure{0, 0};
  };
  return {level_of(std::max(u.lo, v.lo)).lo / 2, level_of(std::max(u.hi, v.hi)).hi / 2};
}

}  // namespace rastercheck::oracle
