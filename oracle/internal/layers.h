#pragma once

// Finds the samples where several triangles may be drawn, so that blending would mix them.

#include <cstdint>
#include <utility>
#include <vector>

#include "oracle/internal/nearest.h"

namespace rastercheck::oracle {

class LayerBand {
 public:
  /// Covers the rows y0 <= y < y1. The scene and the triangles must outlive the band.
  LayerBand(const SceneTruth& scene, int y0, int y1, PreparedTriangles& triangles);

  /// Adds a triangle that may cover pixels of the band.
  void add(std::uint32_t triangle);

  /// [y − y0][x][sample]: true if two triangles may be drawn there, ignoring any depth test.
  std::vector<bool> take_overlaps() && { return std::move(overlaps_); }

 private:
  const SceneTruth* scene_;
  int y0_;
  int y1_;
  PreparedTriangles* triangles_;
  std::vector<bool> covered_;
  std::vector<bool> overlaps_;
  CoverageRow row_;
};

}  // namespace rastercheck::oracle
