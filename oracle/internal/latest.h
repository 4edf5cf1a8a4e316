#pragma once

// Finds the fragments that may remain visible at each sample when triangles are painted over each
// other without a depth test.

#include <cstdint>
#include <optional>
#include <vector>

#include "oracle/internal/nearest.h"

namespace rastercheck::oracle {

/// Finds the answers for a band of rows. A triangle is dropped as soon as a later one certainly
/// covers it.
class LatestBand {
 public:
  /// Covers the rows y0 <= y < y1. The scene and the triangles must outlive the band.
  LatestBand(const SceneTruth& scene, int y0, int y1, PreparedTriangles& triangles);

  /// Adds the next triangle in drawing order.
  void add(std::uint32_t triangle, records::LevelCounts& levels);

  /// Calls take as NearestBand does.
  void for_each_answer(const NearestBand::Take& take);

 private:
  using Candidate = NearestBand::Candidate;

  /// The triangles that may be left at a sample.
  struct Sample {
    std::optional<Candidate> required;  ///< the last triangle that must be drawn there
    std::vector<Candidate> permitted;   ///< later ones that may be drawn
  };

  const SceneTruth* scene_;
  int y0_;
  int y1_;
  PreparedTriangles* triangles_;
  std::vector<Sample> samples_;  ///< [y − y0][x][sample]
  CoverageRow row_;
};

}  // namespace rastercheck::oracle
