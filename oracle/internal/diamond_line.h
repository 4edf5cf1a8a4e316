#pragma once

// One of Bresenham's lines (RULES §10), with all that is the same for each of its pixels.

#include <array>
#include <optional>

#include "oracle/internal/diamond_exit.h"
#include "oracle/internal/projective_map.h"
#include "oracle/internal/triangle_setup.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// The nearest whole number of pixels to the case's line width, at least 1; halves are rounded up.
long rounded_width(const Scene& scene);

class DiamondLine {
 public:
  /// `line` must be of shape exact, or placed with one placement.
  explicit DiamondLine(const TriangleSetup& line);

  /// The verdict of all samples of a pixel. The viewport must have an area.
  records::SampleVerdict decide(int x, int y) const;

 private:
  using NearPosition = std::array<double, 2>;

  void set_ends(const std::array<ExactPosition, 2>& ends);
  bool is_far_beside(int x, int y) const;
  bool is_near_cut(const ExactPosition& cut, int x, int y) const;
  bool selects(int x, int y) const;
  std::optional<bool> nearly_selects(int x, int y) const;

  const Scene* scene_;
  long width_;     ///< pixels
  Line middle_;    ///< the line through both ends
  Ring far_away_;  ///< the middle's magnitude from which on a pixel's centre is too far beside it
  /// The ends of what clipping leaves, in pixels; empty if that is nothing, or if an end is at the
  /// eye.
  std::optional<std::array<ExactPosition, 2>> ends_;
  std::array<bool, 2> is_cut_{};  ///< true if clipping made the end
  /// The ends, moved by half of what the line is wider than a pixel, and from one to the other.
  std::array<ExactPosition, 2> moved_;
  std::array<Field, 2> direction_;
  std::size_t major_ = 0;
  /// The moved ends in double; empty if these do not decide (set_ends()).
  std::optional<std::array<NearPosition, 2>> near_;
};

}  // namespace rastercheck::oracle
