#pragma once

// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// Sets up at most eight triangles at once, one in each lane of the vectors, and draws the small
// ones. The box of a small triangle has at most 8×8 pixels, so its coverage fits a word of 64 bits.
// Its fragments are then computed with one fragment in each lane.
//
// Computes the same as fragment_drawing.cpp, operation by operation, and leaves the difficult cases
// to fallback_drawing.h: triangles whose determinant or values need more than double; small
// triangles with samples within the band of an edge; snapped triangles that are clipped.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "rasterizer/internal/kernel_setting.h"

namespace rastercheck::rasterizer {

/// Maximum number of triangles in a group.
inline constexpr std::size_t kGroup = 8;
/// Maximum number of pixels per side of a small triangle's box.
inline constexpr int kSmallBox = 8;

/// The vertices of a group's triangles, unchanged from the mesh.
struct GroupInput {
  /// [vertex][lane]
  alignas(64) std::array<std::array<glm::vec4, kGroup>, 3> positions;
  /// [vertex][lane][attribute], without gaps
  alignas(64) std::array<std::array<float, kGroup * kMaxAttributes>, 3> attributes;
};

/// How a triangle is handled after its set-up.
enum class LaneFate : std::uint8_t {
  hidden,      ///< nothing is left to draw, or its fragments were appended
  not_finite,  ///< one of its positions is not finite
  degenerate,  ///< two of its corners are equal, except perhaps in z
  numbered,    ///< to be drawn from its numbers (tile_kernels.h)
  covered,     ///< small: to be shaded from its covered samples and planes
  left,        ///< left to fallback_drawing.h
};

struct GroupOutput {
  std::array<LaneFate, kGroup> fate;
  bool had_ties = false;  ///< samples lay on or near edges; a hint for the next group
  /// For LaneFate::numbered and covered: the pixels that the triangle may touch.
  std::array<PixelBox, kGroup> box;
  /// [sample][lane], for LaneFate::covered: bit 8 y + x stands for the sample in pixel (x, y) of
  /// the box.
  alignas(64) std::array<std::array<std::uint64_t, kGroup>, DrawBounds::kMaxSamples> covered;
  /// [TriangleNumbers][lane]
  alignas(64) std::array<std::array<double, kGroup>, TriangleNumbers::kMost> numbers;
};

/// Fragments of small triangles, in submission order within each sample index. A triangle drawn
/// another way splits the list: all fragments of earlier triangles precede all fragments of later
/// ones. Arrays may be longer than `size`.
struct FragmentList {
  std::size_t size = 0;
  std::vector<std::uint32_t> tile;  ///< the tile's index in the framebuffer
  std::vector<std::uint32_t> key;   ///< fragment_key
  std::vector<float> depth;
  std::vector<std::vector<float>> attributes;  ///< [attribute]

  /// Makes room for the fragments of another group.
  void reserve_group(std::size_t samples, std::size_t attribute_count);
};

/// A key packs a triangle's number, below 2^16, and the fragment's place in the arrays of a tile:
/// sample, row and column.
inline constexpr int kKeyTriangle = 16;
constexpr std::uint32_t fragment_key(std::uint32_t triangle, std::uint32_t sample,
                                     std::uint32_t pixel) {
  return triangle << kKeyTriangle | sample << 12 | pixel;
}
constexpr std::uint32_t place_of(std::uint32_t key) { return key & 0xffff; }
constexpr std::uint32_t triangle_of(std::uint32_t key) { return key >> kKeyTriangle; }

/// Sets up the first `count` lanes, whose triangles are numbered from `first`. Appends the
/// fragments of small triangles.
void set_up_group(const KernelSetting& setting, const GroupInput& input, std::size_t count,
                  std::uint32_t first, GroupOutput& output, FragmentList& fragments);

}  // namespace rastercheck::rasterizer
