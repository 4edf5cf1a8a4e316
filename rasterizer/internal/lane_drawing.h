#pragma once

// Lanes of cells (shading.h) one by one, in any mode of coverage and at any location, for what the
// kernels leave (cell_kernels.h): the samples that drawing.cpp covers, and its depths and values
// before they are rounded to float32.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/exact_coverage.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A sample of a pixel.
struct LanePlace {
  std::size_t sample = 0;
  int x = 0;
  int y = 0;
  bool is_covered = false;
  bool is_at_vertex = false;  ///< CoveredBlock::at_vertex has it
};

/// Where a lane's numbers go: arrays by attribute, of which `lane` is meant.
struct LaneOutput {
  float* depth = nullptr;
  std::span<double* const> values;
  std::span<double* const> along_u;  ///< empty where derivatives are not wanted
  std::span<double* const> along_v;
  std::size_t lane = 0;
};

/// Each thread has its own.
class LaneDrawing {
 public:
  virtual ~LaneDrawing() = default;
  /// Makes a triangle the one at hand; whether it is drawn at all.
  virtual bool begin(std::uint32_t triangle) = 0;
  /// Whether it may touch a row.
  virtual bool touches(int y) const = 0;
  /// Which samples of that index it covers of a row, for at most 64 columns; bit 0 is the first.
  virtual CoveredBlock cover(std::size_t sample, int y, const PixelRange& columns) = 0;
  virtual void evaluate(const LanePlace& place, const LaneOutput& out) = 0;
  /// ⌊scale · r⌋ without rounding (exact_values.h).
  virtual double floor(const LanePlace& place, std::size_t attribute, double scale,
                       double period) = 0;
};

/// For checked arguments, which must outlive it.
std::unique_ptr<LaneDrawing> make_lane_drawing(const DrawSetting& setting, const Mesh& mesh,
                                               bool has_derivatives);

}  // namespace rastercheck::rasterizer
