#pragma once

// Serves the route “shaded frames” (docs/rasterizer.md, Routes).
//
// The memory of a batch of cells (shading.h). Each thread has one batch. The thread fills the batch
// with the cells of successive triangles, has the full batch shaded, and merges it into its tile.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rasterizer/rasterizer.h"
#include "rasterizer/shading.h"

namespace rastercheck::rasterizer {

class CellBatch {
 public:
  static constexpr std::size_t kLanes = FragmentBatch::kLanes;
  static constexpr std::size_t kCells = FragmentBatch::kCells;
  static constexpr std::size_t kCellLanes = FragmentBatch::kCellLanes;

  CellBatch(std::size_t attributes, std::size_t outputs, bool has_derivatives)
      : doubles_(kLanes * attributes * (has_derivatives ? 3 : 1)), floats_(kLanes * (1 + outputs)) {
    double* next = doubles_.data();
    for (auto* arrays : {&values, &along_u, &along_v}) {
      if (arrays != &values && !has_derivatives) break;
      for (std::size_t a = 0; a < attributes; ++a, next += kLanes) arrays->push_back(next);
    }
    depth = floats_.data();
    for (std::size_t k = 1; k <= outputs; ++k) color.push_back(depth + k * kLanes);
  }
  CellBatch(const CellBatch&) = delete;  // it points into itself
  CellBatch& operator=(const CellBatch&) = delete;

  bool has_derivatives() const { return !along_u.empty(); }
  bool is_full() const { return count == kCells; }

  std::size_t count = 0;  ///< number of cells
  std::array<FragmentBatch::Cell, kCells> cells{};
  std::array<std::uint16_t, kCells> discarded{};
  float* depth = nullptr;  ///< [lane]
  // [attribute][lane]
  std::vector<double*> values;
  std::vector<double*> along_u;
  std::vector<double*> along_v;
  std::vector<float*> color;  ///< [output][lane]

 private:
  std::vector<double, CacheLineAllocator<double>> doubles_;
  std::vector<float, CacheLineAllocator<float>> floats_;
};

}  // namespace rastercheck::rasterizer
