#pragma once

// Decides the coverage of one triangle by the first two levels of the cascade (docs/oracle.md);
// decide() (oracle/internal/coverage.h) handles the samples they leave open.

#include <array>
#include <optional>
#include <vector>

#include "oracle/internal/coverage.h"
#include "oracle/internal/filter_kernels.h"
#include "oracle/internal/intervals.h"
#include "oracle/internal/triangle_setup.h"
#include "oracle/level.h"

namespace rastercheck::oracle {

/// The verdicts of a row of samples, two bits each. Both bits of an open sample are zero.
struct RowVerdicts {
  std::vector<std::uint64_t> required;   ///< bit x − box.x0: inside all boundaries
  std::vector<std::uint64_t> forbidden;  ///< likewise: outside some boundary
};

Point corner_of(const PixelBox& box);

/// Converts a line to doubles relative to the box's corner, for samples of the box. Empty if a
/// coefficient is so large or small that results might leave the normal doubles.
std::optional<FilterLine> filter_line(const Line& line, const PixelBox& box);

/// Like filter_line(), in intervals.
IntervalLine interval_line(const Line& line, const PixelBox& box);

class TriangleFilter {
 public:
  /// The triangle must outlive the filter. `box` must hold all pixels that will be asked for.
  /// Levels before `first` leave everything open.
  TriangleFilter(const TriangleSetup& triangle, const PixelBox& box, Level first);

  const PixelBox& box() const { return box_; }
  /// True if no sample in the box is required or permitted.
  bool is_empty() const { return is_empty_; }

  /// True if the first level can decide any sample of the triangle.
  bool has_first_level() const { return !lines_.empty(); }

  /// The three edges of a map, if exactly these edges decide coverage, perhaps together with clip
  /// planes; else nullptr.
  const FilterLine* edges_of(const ProjectiveMap* map) const;

  /// The first level, for one sample of each pixel of row y. Leaves samples open, rather than
  /// required, in any pixel that may have a sample outside the viewport.
  void classify(int y, const cases::SamplePosition& sample, RowVerdicts& row) const;

  /// The second level; requires UpwardRounding. Empty if left open.
  std::optional<records::SampleVerdict> decide(int x, int y,
                                               const cases::SamplePosition& sample) const;

 private:
  struct SignedLine {
    IntervalLine line;
    int sign_a = 0;
    int sign_b = 0;
  };
  /// A boundary under one reading of the contract, with an error of up to `margin`.
  struct OpenLine {
    Line line;
    Ring margin;
  };
  bool is_cut_and_culled() const;
  void set_inner_pixels();
  void add_line_of_degenerate();
  void add_cut_lines();
  void add_conservative_lines();
  void add_primitive_lines();
  bool add_lines_of_line(const std::array<RingVector3, 3>& at, const Ring& width,
                         const Ring& moved);
  bool add(const Line& line, const Ring& margin);
  bool add_enclosing(const std::vector<OpenLine>& readings);
  std::vector<OpenLine> readings_of_edge(std::size_t edge) const;
  bool add_clip_line(const ClipFunctional& functional);
  void make_interval_lines() const;

  const TriangleSetup* triangle_;
  PixelBox box_;
  Level first_level_;
  std::optional<CoverageBoundary> boundary_;
  /// Pixels whose samples lie within the viewport, whatever the error of its sides.
  PixelBox inner_;
  bool is_empty_ = false;
  /// Edges, then clip functionals; of a line or point the borders of what it covers; or, for a
  /// degenerate triangle without boundary_, one line and its negative. If empty, the first level
  /// decides nothing.
  std::vector<FilterLine> lines_;
  mutable std::vector<SignedLine> interval_lines_;  ///< made when first asked for
};

}  // namespace rastercheck::oracle
