#pragma once

// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// Draws the triangles and rows that the kernels of frames and shaded frames leave (tile_kernels.h,
// cell_kernels.h). Draws sample by sample, in any mode of coverage and at any location. Coverage,
// depths and values are those of fragment_drawing.h, but values are not yet rounded to float32.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "rasterizer/internal/discard.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/exact_coverage.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A sample of a pixel.
struct LanePlace {
  std::size_t sample = 0;
  int x = 0;
  int y = 0;
};

/// Where to write a lane's numbers: to element `lane` of each array.
struct LaneOutput {
  float* depth = nullptr;
  std::span<double* const> values;
  std::span<double* const> along_u;  ///< empty if derivatives are not wanted
  std::span<double* const> along_v;
  std::size_t lane = 0;
};

/// Draws one triangle at a time. Each thread has its own FallbackDrawing.
class FallbackDrawing {
 public:
  virtual ~FallbackDrawing() = default;
  /// Returns the triangle's fate; if it is drawn, sets `box` to the pixels that it may touch.
  /// Afterwards no triangle is the current one.
  virtual Fate locate(std::uint32_t triangle, PixelBox& box) = 0;
  /// Makes a triangle the current one; returns true if the triangle is drawn at all.
  virtual bool begin(std::uint32_t triangle) = 0;
  /// Returns the samples with index `sample` that the triangle covers in kBlockSize pixels of a
  /// row. The first pixel, bit 0, is `first`, which must be a multiple of kBlockSize.
  virtual Mask cover(std::size_t sample, int y, int first) = 0;
  /// Evaluates a sample, covered or not.
  virtual void evaluate(const LanePlace& place, const LaneOutput& out) = 0;
  /// True if the current triangle is a front face.
  virtual bool is_front() const = 0;
  /// Returns the depth and 1/w of a sample, covered or not.
  virtual float depth(const LanePlace& place) = 0;
  virtual double reciprocal_w(const LanePlace& place) = 0;
  /// Returns ⌊scale · r⌋ without rounding (exact_floor_at() in exact_values.h).
  virtual double floor(const LanePlace& place, std::size_t attribute, double scale,
                       double period) = 0;
};

/// Makes a FallbackDrawing for checked arguments, which must outlive it.
std::unique_ptr<FallbackDrawing> make_fallback_drawing(const DrawSetting& setting, const Mesh& mesh,
                                                       bool has_derivatives);

}  // namespace rastercheck::rasterizer
