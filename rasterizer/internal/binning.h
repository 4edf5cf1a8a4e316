#pragma once

// Sorting triangles into the tiles of a framebuffer that they touch, a chunk of them at a time:
// small ones as fragments or, to be shaded, as what they cover; others as numbers to be drawn by
// or, where nothing else will do, as what they are (group_kernels.h).

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "rasterizer/internal/drawing.h"
#include "rasterizer/internal/group_kernels.h"

namespace rastercheck::rasterizer {

/// Things in an order of their own, by tile.
struct TileLists {
  std::vector<std::uint32_t> ends;  ///< [tile]: one past its last

  std::pair<std::size_t, std::size_t> range(std::size_t tile) const {
    return {tile == 0 ? 0 : ends[tile - 1], ends[tile]};
  }
};

/// A triangle that is drawn tile by tile.
struct BinnedTriangle {
  std::uint32_t triangle = 0;  ///< in the mesh
  PixelBox box;
  const double* numbers = nullptr;  ///< TriangleNumbers to be drawn by; or
  const double* covered = nullptr;  ///< [sample] what it covers of its box, as bits of doubles,
  const double* planes = nullptr;   ///< and TrianglePlanes; or none of them: by drawing.h
};

/// A chunk, by tile, each tile's in submission order.
struct Bins {
  std::uint32_t first = 0;  ///< triangle of the mesh
  TileLists fragments;
  std::vector<std::uint32_t> words;  ///< of fragments: key, depth, attributes; or longer
  TileLists triangles;
  std::vector<std::uint32_t> by_tile;  ///< which record
  /// Records, in submission order: what a BinnedTriangle says, as bits, and what it points to. Side
  /// by side, as a tile's triangles lie anywhere in memory.
  std::vector<double> records;
  std::vector<std::size_t> starts;  ///< of each record
  DrawCounts counts;

  std::size_t record_count() const { return starts.size(); }
  /// How a triangle is drawn: by drawing.h, by numbers, or by what it covers.
  enum class Kind : std::uint32_t { whole, numbered, covered };
  /// Adds a record with so many numbers, which are to be filled in.
  double* add(std::uint32_t triangle, const PixelBox& box, Kind kind, std::size_t count);
  std::span<const double> record(std::size_t index) const {
    const std::size_t end = index + 1 < starts.size() ? starts[index + 1] : records.size();
    return std::span(records).subspan(starts[index], end - starts[index]);
  }
  BinnedTriangle binned(std::size_t index, std::size_t samples) const;
  PixelBox box(std::size_t index) const;
  /// In bytes.
  std::size_t memory() const;
};

/// Sorts chunks; each thread has its own.
class Binning {
 public:
  /// No kernel: all triangles are drawn by drawing.h. The arguments must outlive it.
  Binning(const DrawSetting& setting, const KernelSetting* kernel, const Mesh& mesh,
          const TargetSize& size);

  /// Triangles first … last − 1, at most 2^16.
  void sort(std::size_t first, std::size_t last, TileDrawing& drawing, Bins& bins);

 private:
  void take_group(std::uint32_t first, std::size_t count, TileDrawing& drawing, Bins& bins);
  void fill_group(std::size_t first, std::size_t count);
  void take_whole(std::uint32_t triangle, TileDrawing& drawing, Bins& bins) const;
  void sort_fragments(Bins& bins) const;
  template <std::size_t kAttributes>
  void put_fragments_in_order(Bins& bins) const;
  void sort_triangles(Bins& bins) const;

  const DrawSetting& setting_;
  const KernelSetting* kernel_;
  const Mesh& mesh_;
  std::size_t tile_columns_;
  std::size_t tiles_;
  std::unique_ptr<GroupInput> input_;
  std::unique_ptr<GroupOutput> output_;
  FragmentList fragments_;
};

}  // namespace rastercheck::rasterizer
