#include "rasterizer/internal/frame_drawing.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/drawing.h"
#include "rasterizer/internal/parallel.h"

namespace rastercheck::rasterizer {
namespace {

/// Chunks are at least so large; and so large beside the number of tiles that a chunk's list of
/// tiles is no larger than itself.
constexpr std::size_t kLeastChunk = 1024;

/// The triangles of a chunk, by tile.
struct Bins {
  std::vector<std::uint32_t> triangles;  ///< by tile, in submission order
  std::vector<std::uint32_t> ends;       ///< [tile]: one past its last in `triangles`
  DrawCounts counts;

  std::span<const std::uint32_t> of(std::size_t tile) const {
    const std::size_t begin = tile == 0 ? 0 : ends[tile - 1];
    return std::span(triangles).subspan(begin, ends[tile] - begin);
  }
};

/// Tiles that a box of pixels touches.
struct TileBox {
  PixelRange columns;
  PixelRange rows;
};

TileBox tiles_of(const PixelBox& box) {
  return {{box.columns.begin / kTileSize, tiles_across(box.columns.end)},
          {box.rows.begin / kTileSize, tiles_across(box.rows.end)}};
}

class FrameDrawing {
 public:
  FrameDrawing(const State& state, const Mesh& mesh, Framebuffer& framebuffer, std::size_t workers)
      : setting_(state, framebuffer.size),
        mesh_(mesh),
        framebuffer_(framebuffer),
        columns_(tiles_across(framebuffer.size.width)),
        rows_(tiles_across(framebuffer.size.height)) {
    const std::size_t tiles = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    chunk_ = std::max(kLeastChunk, tiles);
    bins_.resize((mesh.triangles.size() + chunk_ - 1) / chunk_);
    const std::size_t busy = std::min(workers, std::max(tiles, bins_.size()));
    for (std::size_t i = 0; i < busy; ++i) {
      workers_.push_back({make_tile_drawing(setting_, mesh),
                          Tile(framebuffer.size.samples, framebuffer.attribute_count),
                          {},
                          {}});
    }
  }

  DrawCounts draw() {
    for_each_index(bins_.size(), workers_.size(), [&](std::size_t i, std::size_t worker) {
      const std::size_t first = i * chunk_;
      sort(first, std::min(first + chunk_, mesh_.triangles.size()), workers_[worker], bins_[i]);
    });
    const std::size_t tiles = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    for_each_index(tiles, workers_.size(), [&](std::size_t tile, std::size_t worker) {
      draw_tile(tile, workers_[worker]);
    });
    DrawCounts counts;
    for (const Bins& bins : bins_) {
      counts.discarded_not_finite += bins.counts.discarded_not_finite;
      counts.discarded_degenerate += bins.counts.discarded_degenerate;
    }
    return counts;
  }

 private:
  struct Worker {
    std::unique_ptr<TileDrawing> drawing;
    Tile tile;
    std::vector<std::pair<std::uint32_t, TileBox>> located;  ///< of a chunk
    std::vector<std::uint32_t> triangles;                    ///< of a tile
  };

  template <typename Visit>
  void for_each_tile(const TileBox& box, const Visit& visit) const {
    for (int row = box.rows.begin; row < box.rows.end; ++row) {
      for (int column = box.columns.begin; column < box.columns.end; ++column) {
        visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
              static_cast<std::size_t>(column));
      }
    }
  }

  /// Sorts triangles first … last − 1 by counting.
  void sort(std::size_t first, std::size_t last, Worker& worker, Bins& bins) const {
    worker.located.clear();
    bins.ends.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
    for (std::size_t t = first; t < last; ++t) {
      PixelBox box;
      const Fate fate = worker.drawing->locate(t, box);
      count(fate, bins.counts);
      if (fate != Fate::drawn) continue;
      const TileBox tiles = tiles_of(box);
      worker.located.emplace_back(static_cast<std::uint32_t>(t), tiles);
      for_each_tile(tiles, [&bins](std::size_t tile) { ++bins.ends[tile]; });
    }
    std::size_t begin = 0;
    for (std::uint32_t& end : bins.ends) {
      const std::uint32_t of_tile = end;
      end = static_cast<std::uint32_t>(begin);
      begin += of_tile;
    }
    // Such a chunk needs 16 GiB.
    if (begin > std::numeric_limits<std::uint32_t>::max()) throw std::length_error("bins");
    bins.triangles.resize(begin);
    // Each end starts at its tile's beginning and moves past what is put there.
    for (const auto& [triangle, tiles] : worker.located) {
      for_each_tile(tiles, [&bins, t = triangle](std::size_t tile) {
        bins.triangles[bins.ends[tile]++] = t;
      });
    }
  }

  void draw_tile(std::size_t tile, Worker& worker) {
    worker.triangles.clear();
    for (const Bins& bins : bins_) {
      const std::span<const std::uint32_t> of_tile = bins.of(tile);
      worker.triangles.insert(worker.triangles.end(), of_tile.begin(), of_tile.end());
    }
    if (worker.triangles.empty()) return;
    const auto columns = static_cast<std::size_t>(columns_);
    worker.tile.load(framebuffer_, static_cast<int>(tile % columns),
                     static_cast<int>(tile / columns));
    worker.drawing->draw(worker.triangles, worker.tile);
    worker.tile.store(framebuffer_);
  }

  const DrawSetting setting_;
  const Mesh& mesh_;
  Framebuffer& framebuffer_;
  int columns_;  ///< of tiles
  int rows_;
  std::size_t chunk_ = 0;  ///< triangles of a chunk
  std::vector<Worker> workers_;
  std::vector<Bins> bins_;  ///< [chunk]
};

}  // namespace

DrawCounts draw_frame(const State& state, const Mesh& mesh, Framebuffer& framebuffer,
                      std::size_t workers) {
  State drawn = state;
  drawn.derivatives = false;  // a framebuffer holds none
  return FrameDrawing(drawn, mesh, framebuffer, workers).draw();
}

}  // namespace rastercheck::rasterizer
