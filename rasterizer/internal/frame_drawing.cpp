#include "rasterizer/internal/frame_drawing.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "rasterizer/internal/binning.h"
#include "rasterizer/internal/cell_painter.h"
#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/fallback_drawing.h"
#include "rasterizer/internal/parallel.h"
#include "rasterizer/internal/tile.h"
#include "rasterizer/internal/tile_kernels.h"

namespace rastercheck::rasterizer {
namespace {

/// Minimum number of triangles per chunk. A chunk also has at least as many triangles as there are
/// tiles, so that its list of tiles is no larger than the chunk itself.
constexpr std::size_t kLeastChunk = 2048;
/// Number of triangles, times samples per pixel, to sort between two checks of memory use.
constexpr std::size_t kWave = 65536;

/// A thread's tile, with the data that the kernels need.
class DrawnTile {
 public:
  DrawnTile(const Picture& framebuffer, bool has_words)
      : tile_(framebuffer.size.samples, framebuffer.attribute_count, has_words),
        of_samples_(static_cast<std::size_t>(framebuffer.size.samples)) {
    for (std::size_t s = 0; s < of_samples_.size(); ++s) {
      for (std::size_t a = 0; a < (has_words ? 1 : framebuffer.attribute_count); ++a) {
        of_samples_[s].values.push_back(tile_.values(a, s));
      }
      areas_.push_back(area(s));
    }
  }

  Tile& tile() { return tile_; }

  /// Sets up the samples' areas for the tile's current place.
  void place(const KernelSetting& setting) {
    drawn_ = 0;
    for (std::size_t s = 0; s < of_samples_.size(); ++s) {
      find_greatest(tile_.depths(s), of_samples_[s].greatest);
      for (int i = 0; i < kTileSize + kTilePadding; ++i) {
        const auto at = static_cast<std::size_t>(i);
        of_samples_[s].u[at] = setting.u_first[s] + (tile_.columns().begin + i) * setting.u_step;
        of_samples_[s].v[at] = setting.v_first[s] + (tile_.rows().begin + i) * setting.v_step;
      }
    }
  }
  TileArea area(std::size_t sample) {
    const OfSample& of_sample = of_samples_[sample];
    return {of_sample.u.data(), of_sample.v.data(), tile_.depths(sample), of_sample.values,
            of_sample.greatest.data()};
  }
  std::span<const TileArea> areas() const { return areas_; }
  /// Must be called after each triangle. Updates the greatest depths only now and then, because
  /// scanning all depths takes as long as drawing a small triangle.
  void count_triangle() {
    constexpr int kLooksAfter = 32;
    if (++drawn_ % kLooksAfter != 0) return;
    for (std::size_t s = 0; s < of_samples_.size(); ++s) {
      find_greatest(tile_.depths(s), of_samples_[s].greatest);
    }
  }

 private:
  struct OfSample {
    alignas(64) std::array<double, kTileSize + kTilePadding> u{};
    alignas(64) std::array<double, kTileSize + kTilePadding> v{};
    std::vector<float*> values;  ///< [attribute]
    std::array<float, kBands> greatest{};
  };
  int drawn_ = 0;  ///< number of triangles
  Tile tile_;
  std::vector<OfSample> of_samples_;
  std::vector<TileArea> areas_;  ///< [sample]
};

/// A sample's depth, and its attributes before rounding to float32.
struct SampleValues {
  SampleValues() {
    for (std::size_t a = 0; a < attributes.size(); ++a) of_attribute[a] = &attributes[a];
  }
  SampleValues(const SampleValues&) = delete;  // it points into itself
  SampleValues& operator=(const SampleValues&) = delete;

  LaneOutput output() { return {&depth, of_attribute, {}, {}, 0}; }

  float depth = 0;
  std::array<double, kMaxAttributes> attributes{};
  std::array<double*, kMaxAttributes> of_attribute{};
  /// The vertex values of flat attributes; nullptr for others. These are copied, because
  /// conversions to double and back would change the bits of some NaNs.
  std::array<const float*, kMaxAttributes> flat{};
};

class FrameDrawing {
 public:
  FrameDrawing(const State& state, const Mesh& mesh, Picture& framebuffer, std::size_t workers,
               std::optional<float> clear_depth, const ShaderView* shader)
      : setting_(state, framebuffer.size),
        mesh_(mesh),
        framebuffer_(framebuffer),
        clear_depth_(clear_depth),
        columns_(static_cast<std::size_t>(tiles_across(framebuffer.size.width))),
        tiles_(columns_ * static_cast<std::size_t>(tiles_across(framebuffer.size.height))),
        kernel_(kernel_setting(setting_, static_cast<int>(columns_))) {
    if (shader != nullptr) paint_ = paint_setting(*shader, state, mesh, framebuffer);
    // Cells are made of samples.
    if (paint_ && state.conservative != Conservative::off) kernel_.reset();
    if (kernel_) kernel_->makes_cells = paint_.has_value();
    chunk_ = std::max(kLeastChunk, tiles_);
    chunks_ = (mesh.triangles.size() + chunk_ - 1) / chunk_;
    const std::size_t busy = std::min(workers, std::max(tiles_, chunks_));
    wave_ = std::max(busy, kWave / (chunk_ * setting_.pattern.size()));
    for (std::size_t i = 0; i < busy; ++i) {
      workers_.push_back(std::make_unique<Worker>(*this));
    }
  }

  DrawCounts draw() {
    DrawCounts counts;
    with_workers(workers_.size(), [&] { counts = draw_with_workers(); });
    return counts;
  }

 private:
  DrawCounts draw_with_workers() {
    DrawCounts counts;
    std::size_t done = 0;
    do {
      const std::size_t used = sort_from(done);
      for (std::size_t i = 0; i < used; ++i) {
        counts.discarded_not_finite += bins_[i].counts.discarded_not_finite;
        counts.discarded_degenerate += bins_[i].counts.discarded_degenerate;
      }
      done += used;
      for_each_index(tiles_, workers_.size(), [&](std::size_t tile, std::size_t worker) {
        draw_tile(tile, std::span(bins_).first(used), *workers_[worker]);
      });
      clear_depth_.reset();  // later passes must not clear tiles
    } while (done < chunks_);
    return counts;
  }

  struct Worker {
    explicit Worker(const FrameDrawing& frame)
        : fallback(make_fallback_drawing(frame.setting_, frame.mesh_,
                                         frame.paint_ && frame.paint_->shader.uses_derivatives)),
          binning(frame.setting_, frame.kernel_ ? &*frame.kernel_ : nullptr, frame.mesh_,
                  frame.framebuffer_.size),
          tile(frame.framebuffer_, frame.paint_ && frame.paint_->merging.has_words) {
      if (!frame.paint_) return;
      painter = std::make_unique<CellPainter>(frame.setting_, *frame.paint_, *fallback);
    }
    std::unique_ptr<FallbackDrawing> fallback;
    std::unique_ptr<CellPainter> painter;  ///< set if a shader is used
    Binning binning;
    DrawnTile tile;
    std::vector<std::span<const double>> records;  ///< of the current tile
    std::size_t next_record = 0;
  };

  /// Sorts chunks from `begin` on, until all are sorted or memory is full. Returns how many chunks
  /// were sorted.
  std::size_t sort_from(std::size_t begin) {
    std::size_t used = 0;
    std::size_t memory = 0;
    while (begin + used < chunks_ && memory < kBinMemory) {
      const std::size_t wave = std::min(wave_, chunks_ - begin - used);
      if (bins_.size() < used + wave) bins_.resize(used + wave);
      for_each_index(wave, workers_.size(), [&](std::size_t i, std::size_t worker) {
        const std::size_t first = (begin + used + i) * chunk_;
        Worker& at_work = *workers_[worker];
        at_work.binning.sort(first, std::min(first + chunk_, mesh_.triangles.size()),
                             *at_work.fallback, bins_[used + i]);
      });
      for (std::size_t i = 0; i < wave; ++i) memory += bins_[used + i].memory();
      used += wave;
    }
    return used;
  }

  void draw_tile(std::size_t tile, std::span<const Bins> all_bins, Worker& worker) {
    const bool is_touched = std::any_of(all_bins.begin(), all_bins.end(), [tile](const Bins& bins) {
      const auto [first_fragment, last_fragment] = bins.fragments.range(tile);
      const auto [first_triangle, last_triangle] = bins.triangles.range(tile);
      return first_fragment < last_fragment || first_triangle < last_triangle;
    });
    if (!is_touched && !clear_depth_) return;
    Tile& drawn = worker.tile.tile();
    const auto column = static_cast<int>(tile % columns_);
    const auto row = static_cast<int>(tile / columns_);
    if (clear_depth_) {
      drawn.clear(framebuffer_, column, row, *clear_depth_);
    } else {
      drawn.load(framebuffer_, column, row);
    }
    if (is_touched) {
      if (kernel_) worker.tile.place(*kernel_);
      if (worker.painter) worker.painter->begin(drawn, worker.tile.areas());
      list_records(tile, all_bins, worker);
      for (const Bins& bins : all_bins) draw_bins(tile, bins, worker);
      if (worker.painter) worker.painter->end();
    }
    drawn.store(framebuffer_);
  }

  /// Lists the records of a tile's triangles, in order. The list allows prefetching the records,
  /// which are scattered in memory.
  static void list_records(std::size_t tile, std::span<const Bins> all_bins, Worker& worker) {
    worker.records.clear();
    worker.next_record = 0;
    for (const Bins& bins : all_bins) {
      const auto [first, last] = bins.triangles.range(tile);
      for (std::size_t i = first; i < last; ++i) {
        worker.records.push_back(bins.record(bins.by_tile[i]));
      }
    }
  }
  static void fetch_ahead(Worker& worker) {
    constexpr std::size_t kAhead = 6;
    const std::size_t at = worker.next_record++ + kAhead;
    if (at >= worker.records.size()) return;
    constexpr std::size_t kLine = 64 / sizeof(double);
    const std::span<const double> record = worker.records[at];
    for (std::size_t i = 0; i < record.size(); i += kLine) __builtin_prefetch(&record[i]);
  }

  /// Draws a chunk's fragments and triangles in a tile, in submission order.
  void draw_bins(std::size_t tile, const Bins& bins, Worker& worker) {
    const std::size_t size = 2 + setting_.state.attributes.size();
    auto [fragment, last_fragment] = bins.fragments.range(tile);
    const auto [first_triangle, last_triangle] = bins.triangles.range(tile);
    const auto put = [&](std::size_t begin, std::size_t end) {
      if (begin == end) return;
      put_fragments(*kernel_, std::span(bins.words).subspan(begin * size, (end - begin) * size),
                    worker.tile.area(0));
    };
    for (std::size_t i = first_triangle; i < last_triangle; ++i) {
      fetch_ahead(worker);
      const BinnedTriangle binned = bins.binned(bins.by_tile[i], setting_.pattern.size());
      const std::size_t begin = fragment;
      while (fragment < last_fragment &&
             triangle_of(bins.words[fragment * size]) < binned.triangle - bins.first) {
        ++fragment;
      }
      put(begin, fragment);
      draw_triangle(binned, worker);
    }
    put(fragment, last_fragment);
  }

  void draw_triangle(const BinnedTriangle& binned, Worker& worker) {
    Tile& tile = worker.tile.tile();
    if (binned.covered != nullptr) {
      worker.painter->draw_covered(*kernel_, binned);
      return worker.tile.count_triangle();
    }
    if (binned.numbers == nullptr) {
      if (worker.painter) return worker.painter->draw_lanes(binned.triangle, ~Mask{0});
      return draw_samples(binned.triangle, ~Mask{0}, worker);
    }
    const PixelRange columns = intersection(binned.box.columns, tile.columns());
    const PixelRange rows = intersection(binned.box.rows, tile.rows());
    const int left = tile.columns().begin;
    const int top = tile.rows().begin;
    const TilePart part{{columns.begin - left, columns.end - left},
                        {rows.begin - top, rows.end - top}};
    if (worker.painter) {
      worker.painter->draw(*kernel_, binned.numbers, binned.triangle, part);
      return worker.tile.count_triangle();
    }
    Mask undrawn = 0;
    for (std::size_t s = 0; s < kernel_->samples; ++s) {
      undrawn |= draw_sample(binned, part, worker.tile.area(s));
    }
    worker.tile.count_triangle();
    // Some of these samples have been drawn already; drawing them again changes nothing.
    if (undrawn != 0) draw_samples(binned.triangle, undrawn, worker);
  }

  /// Draws one sample of each pixel of a part. Returns the rows that were left out.
  Mask draw_sample(const BinnedTriangle& binned, const TilePart& part, const TileArea& area) const {
    const Undrawn undrawn = draw_part(*kernel_, binned.numbers, area, part);
    for (std::size_t i = 0; i < undrawn.vertex_count; ++i) {
      const VertexSample& sample = undrawn.vertices[i];
      const glm::uvec3& corners = mesh_.triangles[binned.triangle];
      const std::size_t vertex = corners[static_cast<glm::length_t>(sample.vertex)];
      const std::size_t attributes = kernel_->attributes;
      put_vertex(*kernel_, binned.numbers, sample,
                 mesh_.attributes.subspan(vertex * attributes, attributes), area);
    }
    return undrawn.rows;
  }

  /// Draws a triangle sample by sample, in these rows of the tile.
  void draw_samples(std::uint32_t triangle, Mask rows, Worker& worker) const {
    FallbackDrawing& fallback = *worker.fallback;
    if (!fallback.begin(triangle)) return;
    Tile& tile = worker.tile.tile();
    const int left = tile.columns().begin;
    const int top = tile.rows().begin;
    SampleValues values;
    const std::size_t count = setting_.state.attributes.size();
    const glm::uvec3& corners = mesh_.triangles[triangle];
    const std::size_t vertex =
        corners[static_cast<glm::length_t>(provoking_vertex(setting_.state))];
    for (std::size_t a = 0; a < count; ++a) {
      const bool is_flat = setting_.state.attributes[a].interpolation == Interpolation::flat;
      if (is_flat) values.flat[a] = &mesh_.attributes[vertex * count + a];
    }
    for_each_bit(rows & columns_mask(tile.rows(), top), [&](int row) {
      for (std::size_t s = 0; s < setting_.pattern.size(); ++s) {
        for_each_bit(fallback.cover(s, top + row, left), [&](int column) {
          fallback.evaluate({s, left + column, top + row}, values.output());
          put(values, worker.tile.areas()[s], row * kTileSize + column);
        });
      }
    });
  }

  /// Writes a sample's values to an element of a tile's arrays, if it passes the depth test.
  void put(const SampleValues& values, const TileArea& area, int at) const {
    const State& state = setting_.state;
    if (state.depth_test == DepthTest::less && !(values.depth < area.depth[at])) return;
    area.depth[at] = values.depth;
    for (std::size_t a = 0; a < state.attributes.size(); ++a) {
      area.attributes[a][at] =
          values.flat[a] != nullptr ? *values.flat[a] : static_cast<float>(values.attributes[a]);
    }
  }

  const DrawSetting setting_;
  const Mesh& mesh_;
  Picture& framebuffer_;
  std::optional<float> clear_depth_;
  std::size_t columns_;  ///< number of tile columns
  std::size_t tiles_;
  std::optional<KernelSetting> kernel_;
  std::optional<PaintSetting> paint_;  ///< set if a shader is used
  std::size_t chunk_ = 0;              ///< triangles per chunk
  std::size_t chunks_ = 0;
  std::size_t wave_ = 1;  ///< chunks per wave
  std::vector<std::unique_ptr<Worker>> workers_;
  std::vector<Bins> bins_;  ///< of the current chunks
};

}  // namespace

DrawCounts draw_frame(const State& state, const Mesh& mesh, Picture& framebuffer,
                      std::size_t workers, std::optional<float> clear_depth,
                      const ShaderView* shader) {
  State drawn = state;
  drawn.derivatives = false;  // a framebuffer holds no derivatives
  // The kernels are made for double; float32 would be slower and less exact.
  drawn.precision = Precision::float64;
  const bool is_plain =
      (drawn.depth_test == DepthTest::less || drawn.depth_test == DepthTest::always) &&
      drawn.depth_write && drawn.blend == Blend::off;
  if (shader != nullptr || is_plain) {
    return FrameDrawing(drawn, mesh, framebuffer, workers, clear_depth, shader).draw();
  }
  const AttributesShader attributes{state.attributes.size()};
  const ShaderView view = view_of(attributes);
  return FrameDrawing(drawn, mesh, framebuffer, workers, clear_depth, &view).draw();
}

}  // namespace rastercheck::rasterizer
