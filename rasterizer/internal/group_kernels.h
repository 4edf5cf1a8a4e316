#pragma once

// Set-up of up to eight triangles at once, one in each lane of the vectors, and everything that is
// to be done for those of them that are small: their boxes have at most 8×8 pixels, so that what
// one covers is a word of 64 bits; then lanes are fragments.
//
// It computes what drawing.cpp does, operation by operation. What is not plain is left to that:
// a determinant or values for which double is not enough; of small triangles, samples within the
// band of an edge; of snapped ones, whatever is clipped.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "rasterizer/internal/kernel_setting.h"

namespace rastercheck::rasterizer {

/// Triangles of a group.
inline constexpr std::size_t kGroup = 8;
/// Pixels per side of the box of a small triangle.
inline constexpr int kSmallBox = 8;

/// What a group's triangles are made of, as it stands in meshes.
struct GroupInput {
  /// [vertex][lane]
  alignas(64) std::array<std::array<glm::vec4, kGroup>, 3> positions;
  /// [vertex][lane][attribute], without gaps
  alignas(64) std::array<std::array<float, kGroup * kMaxAttributes>, 3> attributes;
};

/// What is to become of a triangle.
enum class LaneFate : std::uint8_t {
  hidden,      ///< nothing of it is drawn; or its fragments were appended
  not_finite,  ///< it has a position that is not
  degenerate,  ///< two of its corners are the same but for z
  numbered,    ///< its numbers are to draw it by (tile_kernels.h)
  covered,     ///< it is small: what it covers, and its planes, are to shade it by
  left,        ///< to drawing.cpp
};

struct GroupOutput {
  std::array<LaneFate, kGroup> fate;
  bool had_ties = false;  ///< a hint from one group to the next
  /// Of what is numbered or covered: the pixels that it may touch.
  std::array<PixelBox, kGroup> box;
  /// [sample][lane], of what is covered: bit 8 y + x is the sample of the pixel (x, y) of its box.
  alignas(64) std::array<std::array<std::uint64_t, kGroup>, DrawBounds::kMaxSamples> covered;
  /// [TriangleNumbers][lane]
  alignas(64) std::array<std::array<double, kGroup>, TriangleNumbers::kMost> numbers;
};

/// Fragments. Those of one sample are in submission order; and all that come before a triangle that
/// is no fragments are before all that come after it. Arrays are longer than `size`.
struct FragmentList {
  std::size_t size = 0;
  std::vector<std::uint32_t> tile;  ///< its number in the framebuffer
  std::vector<std::uint32_t> key;   ///< fragment_key
  std::vector<float> depth;
  std::vector<std::vector<float>> attributes;  ///< [attribute]

  /// Makes room for another group's.
  void reserve_group(std::size_t samples, std::size_t attribute_count);
};

/// The number of the triangle, below 2^16, and its place in the arrays of a tile: sample, row and
/// column.
inline constexpr int kKeyTriangle = 16;
constexpr std::uint32_t fragment_key(std::uint32_t triangle, std::uint32_t sample,
                                     std::uint32_t pixel) {
  return triangle << kKeyTriangle | sample << 12 | pixel;
}
constexpr std::uint32_t place_of(std::uint32_t key) { return key & 0xffff; }
constexpr std::uint32_t triangle_of(std::uint32_t key) { return key >> kKeyTriangle; }

/// Sets up the first `count` lanes; their triangles have numbers from `first`. Appends the
/// fragments of small ones.
void set_up_group(const KernelSetting& setting, const GroupInput& input, std::size_t count,
                  std::uint32_t first, GroupOutput& output, FragmentList& fragments);

}  // namespace rastercheck::rasterizer
