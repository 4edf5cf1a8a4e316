#pragma once

// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// Sorts triangles into the framebuffer tiles that they touch, a chunk of triangles at a time. A
// small triangle becomes fragments or, if it is to be shaded, sets of covered samples. A larger
// triangle becomes its coefficients, from which the tile kernels draw it. A triangle that the
// kernels cannot draw becomes only an index (group_kernels.h).

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "rasterizer/internal/fallback_drawing.h"
#include "rasterizer/internal/group_kernels.h"

namespace rastercheck::rasterizer {

/// Items grouped by tile.
struct TileLists {
  std::vector<std::uint32_t> ends;  ///< [tile]: one past the tile's last item

  std::pair<std::size_t, std::size_t> range(std::size_t tile) const {
    return {tile == 0 ? 0 : ends[tile - 1], ends[tile]};
  }
};

/// A triangle to be drawn tile by tile. If both `numbers` and `covered` are nullptr,
/// fallback_drawing.h draws the triangle.
struct BinnedTriangle {
  std::uint32_t triangle = 0;  ///< in the mesh
  PixelBox box;
  const double* numbers = nullptr;  ///< TriangleNumbers, if it is drawn from them
  const double* covered = nullptr;  ///< [sample]: covered pixels of `box`, as bits of a double
  const double* planes = nullptr;   ///< TrianglePlanes; set together with `covered`
};

/// A sorted chunk: items grouped by tile, in submission order within each tile.
struct Bins {
  std::uint32_t first = 0;  ///< index of the chunk's first triangle in the mesh
  TileLists fragments;
  std::vector<std::uint32_t> words;  ///< [fragment]: key, depth, attributes; may be longer
  TileLists triangles;
  std::vector<std::uint32_t> by_tile;  ///< indices of records, for `triangles`
  /// Records in submission order: a BinnedTriangle's fields, as bits, followed by the data that it
  /// points to. The data is stored with the record because the triangles of a tile are scattered in
  /// memory.
  std::vector<double> records;
  std::vector<std::size_t> starts;  ///< [record]: its first index in `records`
  DrawCounts counts;

  std::size_t record_count() const { return starts.size(); }
  /// How a triangle is drawn: by fallback_drawing.h (whole), from its numbers, or from its covered
  /// samples.
  enum class Kind : std::uint32_t { whole, numbered, covered };
  /// Adds a record with room for `count` numbers, which the caller must fill in.
  double* add(std::uint32_t triangle, const PixelBox& box, Kind kind, std::size_t count);
  std::span<const double> record(std::size_t index) const {
    const std::size_t end = index + 1 < starts.size() ? starts[index + 1] : records.size();
    return std::span(records).subspan(starts[index], end - starts[index]);
  }
  BinnedTriangle binned(std::size_t index, std::size_t samples) const;
  PixelBox box(std::size_t index) const;
  /// Memory in use, in bytes.
  std::size_t memory() const;
};

/// Sorts chunks; each thread has its own.
class Binning {
 public:
  /// If `kernel` is nullptr, fallback_drawing.h draws all triangles. The arguments must outlive
  /// this object.
  Binning(const DrawSetting& setting, const KernelSetting* kernel, const Mesh& mesh,
          const TargetSize& size);

  /// Sorts triangles `first` to last − 1, at most 2^16 of them.
  void sort(std::size_t first, std::size_t last, FallbackDrawing& fallback, Bins& bins);

 private:
  void take_group(std::uint32_t first, std::size_t count, FallbackDrawing& fallback, Bins& bins);
  void fill_group(std::size_t first, std::size_t count);
  void take_whole(std::uint32_t triangle, FallbackDrawing& fallback, Bins& bins) const;
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
