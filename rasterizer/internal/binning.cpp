#include "rasterizer/internal/binning.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>

#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/tile.h"

namespace rastercheck::rasterizer {
namespace {

/// The head of a record. The record's columns, rows and numbers follow.
struct RecordHead {
  std::uint32_t triangle = 0;
  Bins::Kind kind = Bins::Kind::whole;
};
constexpr std::size_t kRecordHead = 3;

/// The tiles that a box of pixels touches.
PixelBox tiles_of(const PixelBox& box) {
  return {{box.columns.begin / kTileSize, tiles_across(box.columns.end)},
          {box.rows.begin / kTileSize, tiles_across(box.rows.end)}};
}

template <typename Visit>
void for_each_tile(const PixelBox& pixels, std::size_t tile_columns, const Visit& visit) {
  const PixelBox tiles = tiles_of(pixels);
  for (int row = tiles.rows.begin; row < tiles.rows.end; ++row) {
    for (int column = tiles.columns.begin; column < tiles.columns.end; ++column) {
      visit(static_cast<std::size_t>(row) * tile_columns + static_cast<std::size_t>(column));
    }
  }
}

/// Replaces each tile's count by the index of its first item; returns the total.
std::size_t begins_from_counts(std::vector<std::uint32_t>& ends) {
  std::size_t begin = 0;
  for (std::uint32_t& end : ends) {
    const std::uint32_t of_tile = end;
    end = static_cast<std::uint32_t>(begin);
    begin += of_tile;
  }
  // A chunk with more items than this needs 16 GiB.
  if (begin > std::numeric_limits<std::uint32_t>::max()) throw std::length_error("bins");
  return begin;
}

template <typename T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

}  // namespace

double* Bins::add(std::uint32_t triangle, const PixelBox& box, Kind kind, std::size_t count) {
  const std::size_t at = records.size();
  starts.push_back(at);
  records.resize(at + kRecordHead + count);
  double* const record = records.data() + at;
  record[0] = std::bit_cast<double>(RecordHead{triangle, kind});
  record[1] = std::bit_cast<double>(box.columns);
  record[2] = std::bit_cast<double>(box.rows);
  return record + kRecordHead;
}

PixelBox Bins::box(std::size_t index) const {
  const double* const at = records.data() + starts[index];
  return {std::bit_cast<PixelRange>(at[1]), std::bit_cast<PixelRange>(at[2])};
}

BinnedTriangle Bins::binned(std::size_t index, std::size_t samples) const {
  const double* const at = records.data() + starts[index];
  const auto head = std::bit_cast<RecordHead>(at[0]);
  BinnedTriangle binned;
  binned.triangle = head.triangle;
  binned.box = box(index);
  if (head.kind == Kind::numbered) binned.numbers = at + kRecordHead;
  if (head.kind == Kind::covered) {
    binned.covered = at + kRecordHead;
    binned.planes = binned.covered + samples;
  }
  return binned;
}

std::size_t Bins::memory() const {
  return bytes_of(fragments.ends) + bytes_of(words) + bytes_of(triangles.ends) + bytes_of(by_tile) +
         bytes_of(records) + bytes_of(starts);
}

Binning::Binning(const DrawSetting& setting, const KernelSetting* kernel, const Mesh& mesh,
                 const TargetSize& size)
    : setting_(setting),
      kernel_(kernel),
      mesh_(mesh),
      tile_columns_(static_cast<std::size_t>(tiles_across(size.width))),
      tiles_(tile_columns_ * static_cast<std::size_t>(tiles_across(size.height))) {
  if (kernel == nullptr) return;
  input_ = std::make_unique<GroupInput>();
  output_ = std::make_unique<GroupOutput>();
}

void Binning::sort(std::size_t first, std::size_t last, FallbackDrawing& fallback, Bins& bins) {
  bins.first = static_cast<std::uint32_t>(first);
  bins.counts = {};
  bins.records.clear();
  bins.starts.clear();
  fragments_.size = 0;
  if (kernel_ != nullptr) {
    for (std::size_t t = first; t < last; t += kGroup) {
      take_group(static_cast<std::uint32_t>(t), std::min(kGroup, last - t), fallback, bins);
    }
  } else {
    for (std::size_t t = first; t < last; ++t) {
      take_whole(static_cast<std::uint32_t>(t), fallback, bins);
    }
  }
  sort_fragments(bins);
  sort_triangles(bins);
}

void Binning::take_group(std::uint32_t first, std::size_t count, FallbackDrawing& fallback,
                         Bins& bins) {
  fill_group(first, count);
  set_up_group(*kernel_, *input_, count, first - bins.first, *output_, fragments_);
  const std::size_t count_of_numbers = TriangleNumbers::count(kernel_->attributes);
  const std::size_t count_of_planes = TrianglePlanes::count(kernel_->attributes);
  for (std::size_t lane = 0; lane < count; ++lane) {
    const auto triangle = first + static_cast<std::uint32_t>(lane);
    switch (output_->fate[lane]) {
      case LaneFate::hidden:
        break;
      case LaneFate::not_finite:
        rasterizer::count(Fate::not_finite, bins.counts);
        break;
      case LaneFate::degenerate:
        rasterizer::count(Fate::degenerate, bins.counts);
        break;
      case LaneFate::numbered: {
        double* const numbers =
            bins.add(triangle, output_->box[lane], Bins::Kind::numbered, count_of_numbers);
        for (std::size_t i = 0; i < count_of_numbers; ++i) {
          numbers[i] = output_->numbers[i][lane];
        }
        break;
      }
      case LaneFate::covered: {
        double* const covered = bins.add(triangle, output_->box[lane], Bins::Kind::covered,
                                         kernel_->samples + count_of_planes);
        for (std::size_t s = 0; s < kernel_->samples; ++s) {
          covered[s] = std::bit_cast<double>(output_->covered[s][lane]);
        }
        double* const planes = covered + kernel_->samples;
        for (std::size_t i = 0; i < count_of_planes; ++i) {
          planes[i] = output_->numbers[TriangleNumbers::kPlanes + i][lane];
        }
        break;
      }
      case LaneFate::left:
        take_whole(triangle, fallback, bins);
        break;
    }
  }
}

void Binning::fill_group(std::size_t first, std::size_t count) {
  const std::size_t attributes = kernel_->attributes;
  // Vertices are scattered in memory, so the vertices of later groups are prefetched.
  constexpr std::size_t kAhead = 2 * kGroup;
  const std::size_t ahead = std::min(first + kAhead, mesh_.triangles.size());
  for (std::size_t t = ahead; t < std::min(ahead + kGroup, mesh_.triangles.size()); ++t) {
    const glm::uvec3& corners = mesh_.triangles[t];
    for (const std::uint32_t vertex : {corners.x, corners.y, corners.z}) {
      __builtin_prefetch(mesh_.positions.data() + vertex);
      __builtin_prefetch(mesh_.attributes.data() + vertex * attributes);
    }
  }
  for (std::size_t lane = 0; lane < count; ++lane) {
    const glm::uvec3& corners = mesh_.triangles[first + lane];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t vertex = corners[static_cast<glm::length_t>(i)];
      input_->positions[i][lane] = mesh_.positions[vertex];
      const float* const values = mesh_.attributes.data() + vertex * attributes;
      float* const out = input_->attributes[i].data() + lane * attributes;
      if (attributes == 2) {  // with a constant count, the copy is inlined
        std::copy_n(values, 2, out);
      } else {
        std::copy_n(values, attributes, out);
      }
    }
  }
}

void Binning::take_whole(std::uint32_t triangle, FallbackDrawing& fallback, Bins& bins) const {
  PixelBox box;
  const Fate fate = fallback.locate(triangle, box);
  count(fate, bins.counts);
  if (fate == Fate::drawn) bins.add(triangle, box, Bins::Kind::whole, 0);
}

void Binning::sort_fragments(Bins& bins) const {
  std::vector<std::uint32_t>& ends = bins.fragments.ends;
  ends.assign(tiles_, 0);
  for (std::size_t i = 0; i < fragments_.size; ++i) ++ends[fragments_.tile[i]];
  const std::size_t attributes = setting_.state.attributes.size();
  const std::size_t words = begins_from_counts(ends) * (2 + attributes);
  if (bins.words.size() < words) bins.words.resize(words);
  if (attributes == 2) return put_fragments_in_order<2>(bins);
  put_fragments_in_order<0>(bins);
}

/// `kAttributes` is the number of attributes, or 0 to use the state's number. On entry, ends[t] is
/// the place of tile t's first fragment; each fragment that is written advances it, so on return it
/// is one past the tile's last.
template <std::size_t kAttributes>
void Binning::put_fragments_in_order(Bins& bins) const {
  const std::size_t attributes = kAttributes == 0 ? setting_.state.attributes.size() : kAttributes;
  const std::size_t size = 2 + attributes;
  std::uint32_t* const ends = bins.fragments.ends.data();
  for (std::size_t i = 0; i < fragments_.size; ++i) {
    std::uint32_t* const words = bins.words.data() + size * std::size_t{ends[fragments_.tile[i]]++};
    words[0] = fragments_.key[i];
    words[1] = std::bit_cast<std::uint32_t>(fragments_.depth[i]);
    for (std::size_t a = 0; a < attributes; ++a) {
      words[2 + a] = std::bit_cast<std::uint32_t>(fragments_.attributes[a][i]);
    }
  }
}

void Binning::sort_triangles(Bins& bins) const {
  std::vector<std::uint32_t>& ends = bins.triangles.ends;
  ends.assign(tiles_, 0);
  for (std::size_t i = 0; i < bins.record_count(); ++i) {
    for_each_tile(bins.box(i), tile_columns_, [&ends](std::size_t tile) { ++ends[tile]; });
  }
  bins.by_tile.resize(begins_from_counts(ends));
  for (std::size_t i = 0; i < bins.record_count(); ++i) {
    for_each_tile(bins.box(i), tile_columns_, [&](std::size_t tile) {
      bins.by_tile[ends[tile]++] = static_cast<std::uint32_t>(i);
    });
  }
}

}  // namespace rastercheck::rasterizer
