#include "rasterizer/texture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "rasterizer/internal/color_kernels.h"
#include "rasterizer/internal/coordinate_kernels.h"
#include "rasterizer/internal/try_allocating.h"

namespace rastercheck::rasterizer {
namespace {

/// The texels of the previous level that one texel of this level covers, along one axis. If the
/// previous size is 2m, two texels are covered. If it is 2m + 1, texel j covers [j (2m + 1) / m,
/// (j + 1) (2m + 1) / m), which are three texels with the weights (m − j), m and (j + 1), each
/// divided by 2m + 1.
struct Cover {
  std::size_t first = 0;
  std::size_t last = 0;
  std::array<std::uint64_t, 3> weights{};  ///< of texels first…last
};

int half_of(int size) { return std::max(size / 2, 1); }

Cover cover_of(int size, int j) {
  const std::size_t first = 2 * static_cast<std::size_t>(j);
  if (size == 1) return {0, 0, {1, 0, 0}};
  if (size % 2 == 0) return {first, first + 1, {1, 1, 0}};
  const auto m = static_cast<std::uint64_t>(size / 2);
  const auto index = static_cast<std::uint64_t>(j);
  return {first, first + 2, {m - index, m, index + 1}};
}

/// The sum of a cover's weights.
std::uint64_t weight_of(int size) {
  return size == 1 ? 1 : size % 2 == 0 ? 2 : static_cast<std::uint64_t>(size);
}

/// The mean of the texels in these columns and rows. Each channel is rounded once, halves up. A
/// channel's sum is below 2^8 2^14 2^14.
std::uint32_t mean(std::span<const std::uint32_t> texels, std::size_t width, const Cover& columns,
                   const Cover& rows, std::uint64_t weight) {
  std::array<std::uint64_t, 4> sums{};
  for (std::size_t y = rows.first; y <= rows.last; ++y) {
    for (std::size_t x = columns.first; x <= columns.last; ++x) {
      const std::uint64_t share = columns.weights[x - columns.first] * rows.weights[y - rows.first];
      const std::uint32_t texel = texels[y * width + x];
      for (std::size_t k = 0; k < 4; ++k) sums[k] += share * (texel >> 8 * k & 255U);
    }
  }
  std::uint32_t result = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint64_t rounded = (2 * sums[k] + weight) / (2 * weight);
    result |= static_cast<std::uint32_t>(rounded) << 8 * k;
  }
  return result;
}

/// The same mean of two pairs of texels. Computes two channels at a time, in 16 bits each.
std::uint32_t mean_of_four(std::span<const std::uint32_t, 2> above,
                           std::span<const std::uint32_t, 2> below) {
  constexpr std::uint32_t kChannels = 0x00ff00ff;
  const auto sum = [&](int shift) {
    std::uint32_t total = 0x00020002;
    for (const std::uint32_t texel : {above[0], above[1], below[0], below[1]}) {
      total += texel >> shift & kChannels;
    }
    return total >> 2 & kChannels;
  };
  return sum(0) | sum(8) << 8;
}

/// Computes the next level.
void halve(std::span<const std::uint32_t> texels, int width, int height,
           std::span<std::uint32_t> half) {
  const auto pitch = static_cast<std::size_t>(width);
  const std::uint64_t weight = weight_of(width) * weight_of(height);
  std::size_t at = 0;
  for (int y = 0; y < half_of(height); ++y) {
    const Cover rows = cover_of(height, y);
    for (int x = 0; x < half_of(width); ++x, ++at) {
      const Cover columns = cover_of(width, x);
      if (weight == 4) {  // nearly all textures
        const std::size_t first = rows.first * pitch + columns.first;
        half[at] = mean_of_four(texels.subspan(first).first<2>(),
                                texels.subspan(first + pitch).first<2>());
      } else {
        half[at] = mean(texels, pitch, columns, rows, weight);
      }
    }
  }
}

std::uint32_t texel_of(std::span<const std::uint8_t, 4> bytes) {
  std::uint32_t texel = 0;
  for (std::size_t k = 0; k < 4; ++k) texel |= std::uint32_t{bytes[k]} << 8 * k;
  return texel;
}

/// The number of texels after which wrapped coordinates repeat.
double period_of(double size, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::numeric_limits<double>::infinity();
  return wrap == Wrap::repeat ? size : 2 * size;
}

/// Wraps a texel index, which must be a whole number, without any rounding.
double wrapped(double index, double size, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(index, 0.0, size - 1);
  if (!std::isfinite(index)) return 0;
  const double period = period_of(size, wrap);
  double within = std::fmod(index, period);
  if (within < 0) within += period;
  return within < size ? within : period - 1 - within;
}

/// Finds the columns (or rows) in which the coordinates lie. For covered lanes, the result is that
/// of exact arithmetic.
void find_exact_texels(const FragmentBatch& in, std::size_t attribute, const TextureAxis& axis,
                       std::int32_t* at) {
  const LaneMask open = find_texels(axis, in.errors[attribute], in.lanes, at);
  for (std::size_t word = 0; word < open.size(); ++word) {
    for (std::uint64_t rest = open[word]; rest != 0; rest &= rest - 1) {
      const std::size_t lane = 64 * word + static_cast<std::size_t>(std::countr_zero(rest));
      const FragmentBatch::Cell& cell = in.cells[lane / FragmentBatch::kCellLanes];
      const bool is_covered = (cell.covered >> lane % FragmentBatch::kCellLanes & 1) != 0;
      if (!is_covered || !std::isfinite(axis.values[lane])) continue;
      const double index =
          in.exact->floor(attribute, lane, axis.size, period_of(axis.size, axis.wrap));
      at[lane] = static_cast<std::int32_t>(wrapped(index, axis.size, axis.wrap));
    }
  }
}

/// All lanes of the quads that have at least one covered lane.
LaneMask seen_quads(const FragmentBatch& in) {
  LaneMask lanes{};
  for (std::size_t i = 0; i < in.lanes / FragmentBatch::kCellLanes; ++i) {
    const unsigned covered = in.cells[i].covered;
    const unsigned columns = covered | covered >> FragmentBatch::kCellWidth;
    const std::uint64_t quads = (columns | columns >> 1) & 0x55;
    const std::uint64_t of_row = 3 * quads;
    const std::uint64_t of_cell = of_row | of_row << FragmentBatch::kCellWidth;
    const std::size_t first = i * FragmentBatch::kCellLanes;
    lanes[first / 64] |= of_cell << first % 64;
  }
  return lanes;
}

/// The data of level 0.
TexelLevels first_level(const Texture& texture, const std::array<TextureAxis, 2>& axes) {
  TexelLevels level;
  level.texels = texture.texels().data();
  level.width = texture.width();
  level.height = texture.height();
  level.repeats_columns = axes[0].wrap == Wrap::repeat;
  level.repeats_rows = axes[1].wrap == Wrap::repeat;
  return level;
}

TexelLevels all_levels(const Texture& texture, const std::array<TextureAxis, 2>& axes) {
  TexelLevels levels = first_level(texture, axes);
  const std::size_t last = texture.level_count() - 1;
  for (std::size_t i = 0; i < kLevelSlots; ++i) {
    const std::span<const std::uint32_t> texels = texture.texels(std::min(i, last));
    levels.first[i] = static_cast<std::int32_t>(texels.data() - levels.texels);
  }
  std::copy(levels.first.begin() + 1, levels.first.end(), levels.next.begin());
  levels.next.back() = levels.first.back();
  return levels;
}

void sample_nearest(const Texture& texture, const FragmentBatch& in,
                    const std::array<std::size_t, 2>& attributes,
                    const std::array<TextureAxis, 2>& axes, ColorArrays color) {
  alignas(64) LaneArray<std::int32_t> columns;
  alignas(64) LaneArray<std::int32_t> rows;
  find_exact_texels(in, attributes[0], axes[0], columns.data());
  find_exact_texels(in, attributes[1], axes[1], rows.data());
  fetch_texels(first_level(texture, axes), columns.data(), rows.data(), seen_quads(in), in.lanes,
               color);
}

void sample_bilinear(const Texture& texture, const FragmentBatch& in,
                     const std::array<TextureAxis, 2>& axes, ColorArrays color) {
  Squares squares;
  find_neighbors(axes[0], in.lanes, squares.columns);
  find_neighbors(axes[1], in.lanes, squares.rows);
  filter_bilinear(first_level(texture, axes), squares, seen_quads(in), in.lanes, color);
}

void sample_trilinear(const Texture& texture, const FragmentBatch& in,
                      const std::array<std::size_t, 2>& attributes,
                      const std::array<TextureAxis, 2>& axes, ColorArrays color) {
  const CoordinateSlopes slopes{in.along_u[attributes[0]], in.along_v[attributes[0]],
                                in.along_u[attributes[1]], in.along_v[attributes[1]]};
  const int last = static_cast<int>(texture.level_count()) - 1;
  LevelsOfDetail levels;
  if (!find_levels(slopes, texture.width(), texture.height(), last, in.lanes, levels)) {
    return sample_bilinear(texture, in, axes, color);
  }
  std::array<Squares, 2> squares;
  double factor = 1;
  for (Squares& of_level : squares) {
    find_neighbors(axes[0], in.lanes, factor, levels.shrink.data(), of_level.columns);
    find_neighbors(axes[1], in.lanes, factor, levels.shrink.data(), of_level.rows);
    factor /= 2;
  }
  filter_trilinear(all_levels(texture, axes), levels, squares, seen_quads(in), in.lanes, color);
}

}  // namespace

std::optional<Error> Texture::make(int width, int height, std::span<const std::uint8_t> rgba,
                                   Texture& texture) {
  if (width < 1 || width > kMaxSize || height < 1 || height > kMaxSize) return Error::target_size;
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (rgba.size() != 4 * count) return Error::attribute_values;
  Texture made;
  const auto error = try_allocating([&] {
    Level level{width, height, 0};
    std::size_t total = count;
    made.levels_.push_back(level);
    while (level.width > 1 || level.height > 1) {
      level = {half_of(level.width), half_of(level.height), total};
      made.levels_.push_back(level);
      total += static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
    }
    made.texels_.resize(total);
  });
  if (error) return error;
  for (std::size_t i = 0; i < count; ++i) {
    made.texels_[i] = texel_of(rgba.subspan(4 * i).first<4>());
  }
  const std::span<std::uint32_t> all = made.texels_;
  for (std::size_t i = 1; i < made.levels_.size(); ++i) {
    const Level& before = made.levels_[i - 1];
    halve(made.texels(i - 1), before.width, before.height, all.subspan(made.levels_[i].first));
  }
  texture = std::move(made);
  return std::nullopt;
}

std::span<const std::uint32_t> Texture::texels(std::size_t level) const {
  const Level& of = levels_[level];
  const std::size_t count =
      static_cast<std::size_t>(of.width) * static_cast<std::size_t>(of.height);
  return std::span<const std::uint32_t>(texels_).subspan(of.first, count);
}

void sample(const Texture& texture, const Sampler& sampler, const FragmentBatch& in, std::size_t s,
            std::size_t t, std::span<float* const, 4> color) {
  assert(texture.level_count() > 0);
  assert(in.lanes <= FragmentBatch::kLanes && in.lanes % FragmentBatch::kCellLanes == 0);
  const std::array<TextureAxis, 2> axes{
      TextureAxis{in.values[s], sampler.wrap_s, texture.width()},
      TextureAxis{in.values[t], sampler.wrap_t, texture.height()}};
  switch (sampler.filter) {
    case Filter::nearest:
      return sample_nearest(texture, in, {s, t}, axes, color);
    case Filter::bilinear:
      return sample_bilinear(texture, in, axes, color);
    case Filter::trilinear:
      return sample_trilinear(texture, in, {s, t}, axes, color);
  }
}

}  // namespace rastercheck::rasterizer
